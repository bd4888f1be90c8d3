#include "modules/ao_volume/boxes.h"
#include "modules/ao/draw_state.h"

enum { LOCATION_PART = 0, BOX_VERTICES = 36 };

void volume_boxes_release(volume_boxes *boxes, nook_gpu *gpu)
{
    if (boxes->framebuffer)
        gpu->gl->DeleteFramebuffers(1, &boxes->framebuffer);
    if (boxes->vertex_array)
        gpu->gl->DeleteVertexArrays(1, &boxes->vertex_array);
    *boxes = (volume_boxes){ 0 };
}

/** Attached anew each time: views of several scales take turns, and a texture of another size may have an old one's name. */
static nook_result fit(volume_boxes *boxes, const nook_ao_pass *pass)
{
    const nook_gl *gl = pass->gpu->gl;
    if (boxes->framebuffer == 0) {
        nook_framebuffer made;
        nook_result result = nook_framebuffer_create(pass->gpu, &pass->visibility, 1, (nook_texture){ 0 }, &made);
        if (result != NOOK_OK)
            return result;
        boxes->framebuffer = made.id;
        gl->CreateVertexArrays(1, &boxes->vertex_array); /* empty: vertices are made of their number */
    }
    gl->NamedFramebufferTexture(boxes->framebuffer, GL_COLOR_ATTACHMENT0, pass->visibility.id, 0);
    return NOOK_OK;
}

static void set_state(const volume_boxes *boxes, const nook_ao_pass *pass)
{
    const nook_gl *gl = pass->gpu->gl;
    gl->BindFramebuffer(GL_DRAW_FRAMEBUFFER, boxes->framebuffer);
    gl->Viewport(0, 0, (GLsizei)pass->width, (GLsizei)pass->height);
    gl->Scissor((GLint)pass->begin[0], (GLint)pass->begin[1], (GLsizei)(pass->end[0] - pass->begin[0]),
                (GLsizei)(pass->end[1] - pass->begin[1]));
    gl->Enable(GL_SCISSOR_TEST);
    gl->Enable(GL_CULL_FACE);
    gl->CullFace(GL_FRONT);
    gl->Enable(GL_BLEND);
    gl->BlendEquationSeparate(GL_FUNC_ADD, GL_FUNC_ADD);
    gl->BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE);
    gl->BindVertexArray(boxes->vertex_array);
}

static void draw_part(const nook_ao_pass *pass, uint32_t ray, uint32_t ray_end, uint32_t occluder, uint32_t count)
{
    const int32_t part[4] = { (int32_t)ray, (int32_t)ray_end, (int32_t)occluder, (int32_t)(occluder + count) };
    nook_uniform_int(pass->gpu, LOCATION_PART, part, 4);
    pass->gpu->gl->DrawArraysInstanced(GL_TRIANGLES, 0, BOX_VERTICES, (GLsizei)count);
}

static void draw_cut(const nook_ao_pass *pass, const volume_work *work, const volume_cut *cut)
{
    for (uint32_t occluder = 0; occluder < work->occluders; occluder++) {
        for (uint32_t ray = 0; ray < work->rays; ray += cut->rays) {
            uint32_t end = work->rays - ray < cut->rays ? work->rays : ray + cut->rays;
            draw_part(pass, ray, end, occluder, 1);
            pass->gpu->gl->MemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
        }
    }
}

nook_result volume_boxes_draw(volume_boxes *boxes, const nook_ao_pass *pass, nook_program program,
                              const volume_work *work, const volume_cut *cut)
{
    nook_draw_state host;
    nook_result result = fit(boxes, pass);
    if (result != NOOK_OK)
        return result;
    nook_draw_state_take(pass->gpu, &host);
    set_state(boxes, pass);
    nook_program_use(pass->gpu, program);
    pass->gpu->gl->MemoryBarrier(GL_FRAMEBUFFER_BARRIER_BIT); /* others have written the image by stores */
    if (cut->rays < work->rays)
        draw_cut(pass, work, cut);
    else
        draw_part(pass, 0, work->rays, 0, work->occluders);
    if (pass->counting) /* fragments have added to an image and to storage, which anyone may read next */
        pass->gpu->gl->MemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                                     GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT |
                                     GL_BUFFER_UPDATE_BARRIER_BIT);
    nook_draw_state_give_back(pass->gpu, &host);
    return NOOK_OK;
}
