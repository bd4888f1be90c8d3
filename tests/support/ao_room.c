#include "tests/support/ao_room.h"
#include <string.h>

void ao_room_look(ao_room *r, double x, double y)
{
    r->view->view_from_world =
        nook_matrix_look_at((double[]){ x - 1.5, y - 2, 1.5 }, (double[]){ x + 0.1, y, 0.2 }, (double[]){ 0, 0, 1 });
}

void ao_room_draw(ao_room *r)
{
    nook_fixture_view_clear(r->view);
    for (uint32_t i = 0; i < r->view->occluder_count; i++) {
        nook_matrix world_from_mesh;
        memcpy(world_from_mesh.m, r->view->occluders[i].world_from_mesh, sizeof world_from_mesh.m);
        nook_fixture_mesh moved = { 0 };
        const nook_fixture_mesh *mesh = &r->meshes[i % AO_ROOM_MESHES];
        for (uint32_t k = 0; k + 2 < mesh->index_count; k += 3) {
            double corners[3][3];
            for (int c = 0; c < 3; c++) {
                const float *p = mesh->positions + 3 * (size_t)mesh->indices[k + (uint32_t)c];
                nook_matrix_apply_point(&world_from_mesh, (double[]){ p[0], p[1], p[2] }, corners[c]);
            }
            nook_fixture_add_triangle(&moved, corners[0], corners[1], corners[2]);
        }
        ao_view_draw(r->view, &moved);
        nook_fixture_mesh_free(&moved);
    }
}

int ao_room_setup(void **state)
{
    static ao_room r;
    static const double boxes[][2][3] = { { { -0.5, -0.6, 0 }, { 0.1, 0.0, 0.5 } },
                                          { { 0.15, -0.4, 0 }, { 0.6, 0.3, 0.3 } } };
    r = (ao_room){ .view = ao_view_create(AO_ROOM_WIDTH, AO_ROOM_HEIGHT) };
    ao_screen_look(r.view, (double[]){ -1.5, -2, 1.5 }, (double[]){ 0.1, 0, 0.2 }, 1.0, 0.45);
    for (size_t i = 0; i < AO_ROOM_MESHES; i++) {
        if (i == 2)
            nook_fixture_add_quad(&r.meshes[i], (double[]){ -1, -1, 0 }, (double[]){ 2, 0, 0 }, (double[]){ 0, 2, 0 });
        else
            nook_fixture_add_box(&r.meshes[i], boxes[i][0], boxes[i][1], 63);
        ao_view_add(r.view, &r.meshes[i], 24);
    }
    ao_view_param(r.view, "volume.rays", "2");
    ao_view_param(r.view, "ao.filter", "tile");
    ao_room_draw(&r);
    *state = &r;
    return 0;
}

int ao_room_teardown(void **state)
{
    ao_room *r = *state;
    for (size_t i = 0; i < AO_ROOM_MESHES; i++)
        nook_fixture_mesh_free(&r->meshes[i]);
    ao_view_destroy(r->view);
    return 0;
}
