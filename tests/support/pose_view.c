#include "tests/support/pose_view.h"
#include "engine/animation/scene_stand.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = POSE_VIEW_SIDE };

/* Stands at rest. */
static nook_scene *over_floor(nook_scene *actor, const double floor[2][2], double y)
{
    static const uint32_t indices[6] = { 0, 2, 1, 1, 2, 3 };
    float corners[4][3];
    nook_scene_part parts[2] = { { actor, true }, { NULL, true } };
    nook_scene *joined;
    for (int i = 0; i < 4; i++) {
        corners[i][0] = (float)floor[i & 1][0];
        corners[i][1] = (float)y;
        corners[i][2] = (float)floor[i >> 1][1];
    }
    assert_int_equal(nook_scene_from_triangles("floor", corners[0], 4, indices, 6, &parts[1].scene), NOOK_OK);
    assert_int_equal(nook_scene_join("actor and floor", parts, 2, NULL, 0, &joined), NOOK_OK);
    nook_scene_destroy(parts[0].scene);
    nook_scene_destroy(parts[1].scene);
    assert_int_equal(nook_scene_stand(joined, NOOK_NONE, 0.0), NOOK_OK);
    return joined;
}

int pose_view_open(pose_view *view, nook_scene *actor, const double floor[2][2], double floor_y, const double eye[3],
                   const double target[3], double r_max)
{
    const char *root = getenv("NOOK_ROOT");
    const double up[3] = { 0, 1, 0 };
    memset(view, 0, sizeof *view);
    const nook_stage_desc desc = { .root = root ? root : ".",
                                   .scene = over_floor(actor, floor, floor_y),
                                   .backend = NOOK_BACKEND_OSMESA,
                                   .width = SIDE,
                                   .height = SIDE,
                                   .plays = true };
    const nook_game_world_desc world = { 64, r_max, NULL };
    view->camera = (nook_camera){ nook_matrix_look_at(eye, target, up), 0.8, 0.01 };
    view->floor_y = floor_y;
    return nook_stage_open(&desc, &view->stage) != NOOK_OK || nook_stage_fill(&view->stage, &world) != NOOK_OK ||
           nook_ao_set_param(view->stage.ao, "ao.r_max", r_max) != NOOK_OK ||
           nook_ao_set_param(view->stage.ao, "reference.rays", 256) != NOOK_OK;
}

void pose_view_close(pose_view *view)
{
    nook_stage_close(&view->stage);
}

void pose_view_record(pose_view *view, const char *technique, double advance)
{
    nook_stage *stage = &view->stage;
    nook_game_world_advance(stage->world, advance);
    assert_int_equal(nook_ao_set_technique(stage->ao, technique), NOOK_OK);
    assert_int_equal(nook_stage_begin(stage, &view->camera), NOOK_OK);
    assert_int_equal(nook_stage_occlude(stage), NOOK_OK);
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT,
                      view->depth, sizeof view->depth);
    nook_texture_read(stage->gpu, nook_stage_visibility(stage), GL_RED, GL_FLOAT, view->visibility,
                      sizeof view->visibility);
}

bool pose_view_floor_at(const pose_view *view, int pixel, double out_point[3])
{
    if (!(view->depth[pixel] > 0.0f))
        return false;
    double up = tan(0.5 * view->camera.fov_y_radians), z = view->camera.z_near / (double)view->depth[pixel];
    nook_matrix world_from_view;
    nook_matrix_inverse_affine(&view->camera.view_from_world, &world_from_view);
    const double p[3] = { ((pixel % SIDE + 0.5) / SIDE * 2.0 - 1.0) * up * z,
                          ((pixel / SIDE + 0.5) / SIDE * 2.0 - 1.0) * up * z, -z };
    nook_matrix_apply_point(&world_from_view, p, out_point);
    return fabs(out_point[1] - view->floor_y) < 1e-4;
}
