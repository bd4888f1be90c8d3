#include "modules/ao/draw_state.h"

static const GLenum switches[NOOK_DRAW_SWITCHES] = { GL_DEPTH_TEST,     GL_CULL_FACE,         GL_SCISSOR_TEST,
                                                     GL_BLEND,          GL_STENCIL_TEST,      GL_COLOR_LOGIC_OP,
                                                     GL_CLIP_DISTANCE0, GL_PRIMITIVE_RESTART, GL_RASTERIZER_DISCARD };

static void keep(nook_gpu *gpu, nook_draw_state *kept)
{
    const nook_gl *gl = gpu->gl;
    GLint polygon_modes[2] = { GL_FILL, GL_FILL }; /* compatibility profiles tell one for each side */
    gl->GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &kept->framebuffer);
    gl->GetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &kept->read_framebuffer);
    gl->GetIntegerv(GL_VERTEX_ARRAY_BINDING, &kept->vertex_array);
    gl->GetIntegerv(GL_VIEWPORT, kept->viewport);
    gl->GetIntegerv(GL_SCISSOR_BOX, kept->scissor);
    gl->GetIntegerv(GL_BLEND_SRC_RGB, &kept->blend_factors[0]);
    gl->GetIntegerv(GL_BLEND_DST_RGB, &kept->blend_factors[1]);
    gl->GetIntegerv(GL_BLEND_SRC_ALPHA, &kept->blend_factors[2]);
    gl->GetIntegerv(GL_BLEND_DST_ALPHA, &kept->blend_factors[3]);
    gl->GetIntegerv(GL_BLEND_EQUATION_RGB, &kept->blend_equations[0]);
    gl->GetIntegerv(GL_BLEND_EQUATION_ALPHA, &kept->blend_equations[1]);
    gl->GetIntegerv(GL_LOGIC_OP_MODE, &kept->logic_op);
    gl->GetIntegerv(GL_FRONT_FACE, &kept->front_face);
    gl->GetIntegerv(GL_CULL_FACE_MODE, &kept->cull_face);
    gl->GetIntegerv(GL_POLYGON_MODE, polygon_modes);
    gl->GetIntegerv(GL_CLIP_ORIGIN, &kept->clip_origin);
    gl->GetIntegerv(GL_CLIP_DEPTH_MODE, &kept->clip_depth);
    gl->GetBooleanv(GL_COLOR_WRITEMASK, kept->colour_mask);
    kept->polygon_mode = polygon_modes[0];
    for (int i = 0; i < NOOK_DRAW_SWITCHES; i++)
        kept->enabled[i] = gl->IsEnabled(switches[i]);
}

void nook_draw_state_take(nook_gpu *gpu, nook_draw_state *out_kept)
{
    const nook_gl *gl = gpu->gl;
    keep(gpu, out_kept);
    for (int i = 0; i < NOOK_DRAW_SWITCHES; i++)
        gl->Disable(switches[i]);
    gl->FrontFace(GL_CCW);
    gl->PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    gl->ClipControl(GL_LOWER_LEFT, (GLenum)out_kept->clip_depth);
    gl->ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void nook_draw_state_give_back(nook_gpu *gpu, const nook_draw_state *kept)
{
    const nook_gl *gl = gpu->gl;
    for (int i = 0; i < NOOK_DRAW_SWITCHES; i++) {
        if (kept->enabled[i])
            gl->Enable(switches[i]);
        else
            gl->Disable(switches[i]);
    }
    gl->BlendFuncSeparate((GLenum)kept->blend_factors[0], (GLenum)kept->blend_factors[1],
                          (GLenum)kept->blend_factors[2], (GLenum)kept->blend_factors[3]);
    gl->BlendEquationSeparate((GLenum)kept->blend_equations[0], (GLenum)kept->blend_equations[1]);
    gl->LogicOp((GLenum)kept->logic_op);
    gl->FrontFace((GLenum)kept->front_face);
    gl->CullFace((GLenum)kept->cull_face);
    gl->PolygonMode(GL_FRONT_AND_BACK, (GLenum)kept->polygon_mode);
    gl->ClipControl((GLenum)kept->clip_origin, (GLenum)kept->clip_depth);
    gl->ColorMask(kept->colour_mask[0], kept->colour_mask[1], kept->colour_mask[2], kept->colour_mask[3]);
    gl->BindVertexArray((GLuint)kept->vertex_array);
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)kept->framebuffer);
    gl->BindFramebuffer(GL_READ_FRAMEBUFFER, (GLuint)kept->read_framebuffer);
    gl->Viewport(kept->viewport[0], kept->viewport[1], kept->viewport[2], kept->viewport[3]);
    gl->Scissor(kept->scissor[0], kept->scissor[1], kept->scissor[2], kept->scissor[3]);
}
