#include "engine/core/log.h"
#include "game/volumes.h"
#include "tests/support/scratch.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void count_lines(void *user, nook_log_level level, const char *file, int line, const char *text)
{
    (void)level, (void)file, (void)line, (void)text;
    ++*(int *)user;
}

/* ---- A scene by hand: meshes of one primitive each, a cube of 1 m around the origin ------------------------------ */

enum { MESHES = 3, NODES = 5, OPAQUE = 0, MASKED = 1, BLENDED = 2 };

typedef struct stage {
    nook_scene scene;
    nook_vertex vertices[8 * MESHES];
    uint32_t indices[36 * MESHES];
    nook_primitive primitives[MESHES];
    nook_mesh meshes[MESHES];
    nook_material materials[3];
    nook_node nodes[NODES];
} stage;

static char empty_name[1] = "", mesh_name[] = "crate", node_name[] = "post", path[] = "stage.glb";

static void make_cube(stage *s, uint32_t mesh)
{
    static const uint32_t cube[36] = { 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                       2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5 };
    for (uint32_t i = 0; i < 8; i++)
        for (uint32_t axis = 0; axis < 3; axis++)
            s->vertices[mesh * 8 + i].position[axis] = i >> axis & 1 ? 0.5f : -0.5f;
    memcpy(s->indices + mesh * 36, cube, sizeof cube);
    s->primitives[mesh] = (nook_primitive){ mesh * 8, 8, mesh * 36, 36, OPAQUE, false };
    s->meshes[mesh] =
        (nook_mesh){ .name = mesh == 0 ? mesh_name : empty_name, .first_primitive = mesh, .primitive_count = 1 };
}

static void place(stage *s, uint32_t node, uint32_t mesh, bool moving, double x)
{
    s->nodes[node] = (nook_node){ .name = node == 1 ? node_name : empty_name,
                                  .parent = NOOK_NONE,
                                  .mesh = mesh,
                                  .camera = NOOK_NONE,
                                  .light = NOOK_NONE,
                                  .skin = NOOK_NONE,
                                  .world_from_local = nook_matrix_translation(x, 0.0, 0.0),
                                  .moving = moving };
}

/* Two static cubes at x = -10 (mesh 1) and x = 10 (mesh 2), three instances of mesh 0 between them. */
static stage *make_stage(void)
{
    stage *s = calloc(1, sizeof *s);
    assert_non_null(s);
    for (uint32_t i = 0; i < MESHES; i++)
        make_cube(s, i);
    for (int i = 0; i < 3; i++)
        s->materials[i].base_colour_image = NOOK_NONE;
    s->materials[MASKED].alpha_mode = NOOK_ALPHA_MASK;
    s->materials[BLENDED].alpha_mode = NOOK_ALPHA_BLEND;
    place(s, 0, 1, false, -10.0);
    place(s, 1, 0, true, -2.0);
    place(s, 2, 0, true, 0.0);
    place(s, 3, 2, false, 10.0);
    place(s, 4, 0, true, 2.0);
    s->scene = (nook_scene){ .path = path,
                             .vertices = s->vertices,
                             .vertex_count = 8 * MESHES,
                             .indices = s->indices,
                             .index_count = 36 * MESHES,
                             .primitives = s->primitives,
                             .primitive_count = MESHES,
                             .meshes = s->meshes,
                             .mesh_count = MESHES,
                             .materials = s->materials,
                             .material_count = 3,
                             .nodes = s->nodes,
                             .node_count = NODES,
                             .bounds_min = { -10.5, -0.5, -0.5 },
                             .bounds_max = { 10.5, 0.5, 0.5 } };
    return s;
}

static nook_scene_volumes bake(const stage *s, uint32_t resolution, double r_max)
{
    nook_scene_volumes volumes = { 0 };
    const nook_volumes_desc desc = { .resolution = resolution, .r_max = r_max, .threads = 1 };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &volumes), NOOK_OK);
    return volumes;
}

/* ---- Tests ------------------------------------------------------------------------------------------------------ */

static void test_instances_share_one_bake(void **state)
{
    (void)state;
    stage *s = make_stage();
    nook_scene_volumes v = bake(s, 84, 2.0);
    assert_int_equal(v.volume_count, 2);
    assert_int_equal(v.occluder_count, 4);
    uint32_t seen = 0;
    for (uint32_t i = 0; i < v.occluder_count; i++) {
        const nook_scene_occluder *o = &v.occluders[i];
        if (o->node == NOOK_NONE)
            continue;
        assert_string_equal(v.volumes[o->volume].name, "crate");
        assert_true(o->world_from_mesh.m[12] == s->nodes[o->node].world_from_local.m[12]);
        seen |= 1u << o->node;
    }
    assert_int_equal(seen, 1u << 1 | 1u << 2 | 1u << 4);
    nook_volumes_free(&v);
    free(s);
}

static void test_static_nodes_become_one_volume_in_world_space(void **state)
{
    (void)state;
    stage *s = make_stage();
    for (int axis = 0; axis < 3; axis++) { /* far away: floats alone would lose the shape */
        for (uint32_t n = 0; n < NODES; n++)
            s->nodes[n].world_from_local.m[12 + axis] += 1e8;
        s->scene.bounds_min[axis] += 1e8;
        s->scene.bounds_max[axis] += 1e8;
    }
    nook_scene_volumes v = bake(s, 84, 2.0); /* 21 m: 4 voxels a metre */
    const nook_scene_occluder *o = &v.occluders[0];
    assert_int_equal(o->node, NOOK_NONE);
    const nook_scene_volume *volume = &v.volumes[o->volume];
    assert_string_equal(volume->name, "static");
    assert_int_equal(volume->index_count, 72);
    assert_int_equal(nook_scene_volume_bake(volume)->info.width, 86);
    assert_int_equal(nook_scene_volume_bake(volume)->info.height, 6);
    /* Two shells: 4x4x4 at the box's end, 5x4x4 at its start, whose far face lies on a boundary and takes the next layer. */
    assert_int_equal(nook_scene_volume_bake(volume)->info.occupied, (64 - 8) + (80 - 12));
    double corner[3];
    nook_matrix_apply_point(&o->world_from_mesh, nook_scene_volume_bake(volume)->info.origin, corner);
    assert_true(fabs(corner[0] - (1e8 - 10.75)) < 1e-6);
    assert_true(fabs(corner[1] - (1e8 - 0.75)) < 1e-6);
    nook_volumes_free(&v);
    free(s);
}

static void test_blended_materials_are_left_out_and_masked_ones_are_in(void **state)
{
    (void)state;
    stage *s = make_stage();
    s->primitives[0].material = BLENDED;
    s->primitives[1].material = BLENDED;
    s->primitives[2].material = MASKED;
    nook_scene_volumes v = bake(s, 16, 2.0);
    assert_int_equal(v.volumes[0].index_count, 36);
    assert_int_equal(v.volumes[0].blended_index_count, 36);
    assert_int_equal(v.volumes[1].index_count, 0); /* three instances of glass alone */
    assert_null(nook_scene_volume_bake(&v.volumes[1]));
    nook_volumes_free(&v);
    const nook_volumes_desc desc = {
        .resolution = 16, .r_max = 2.0, .threads = 1, .kinds = NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL)
    };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_OK);
    assert_non_null(nook_scene_volume_bake(&v.volumes[1])); /* surfels hold it, by its alpha */
    nook_volumes_free(&v);
    free(s);
}

/* A corner of the cube at x = 10 moves towards the other: of 43 x 3 x 3 bricks those around that cube are made. */
static void test_an_edited_scene_is_baked_where_it_changed(void **state)
{
    (void)state;
    char folder[1024];
    nook_scratch_path(folder, sizeof folder, "edited");
    stage *s = make_stage();
    nook_scene_volumes first, shown, edited, whole;
    nook_volumes_desc desc = {
        .resolution = 168, .r_max = 2.0, .threads = 1, .cache_dir = folder, .kinds = NOOK_VOLUME_BIT(NOOK_VOLUME_SURFEL)
    };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &first), NOOK_OK);
    assert_int_equal(nook_volumes_collect(&s->scene, &desc, &shown), NOOK_OK);
    s->vertices[8 * 2].position[0] -= 0.3f;
    desc.before = &shown;
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &edited), NOOK_OK);
    desc.before = NULL;
    desc.cache_dir = NULL;
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &whole), NOOK_OK);
    const nook_bake *bakes[] = { &edited.volumes[0].bakes[NOOK_VOLUME_SURFEL],
                                 &whole.volumes[0].bakes[NOOK_VOLUME_SURFEL] };
    assert_true(bakes[0]->bricks >= 1 && bakes[0]->bricks <= 4 * 4 * 4);
    assert_int_equal(bakes[0]->size, bakes[1]->size);
    assert_memory_equal(bakes[0]->bytes, bakes[1]->bytes, bakes[1]->size);
    assert_true(edited.volumes[1].bakes[NOOK_VOLUME_SURFEL].cache_hit); /* nothing of the crates has changed */
    nook_volumes_free(&first);
    nook_volumes_free(&shown);
    nook_volumes_free(&edited);
    nook_volumes_free(&whole);
    free(s);
}

static void test_densities_hold_blended_materials_with_their_alpha(void **state)
{
    (void)state;
    stage *s = make_stage();
    s->primitives[0].material = BLENDED;
    s->primitives[1].material = MASKED;
    s->materials[BLENDED].base_colour[3] = 0.4f;
    s->materials[MASKED].base_colour[3] = 0.4f;
    s->materials[MASKED].alpha_cutoff = 0.5f; /* nowhere there */
    nook_scene_volumes v;
    const nook_volumes_desc desc = {
        .resolution = 32, .r_max = 2.0, .threads = 1, .kinds = NOOK_VOLUME_BIT(NOOK_VOLUME_DENSITY)
    };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_OK);
    assert_int_equal(v.volume_count, 2);
    uint32_t most[2] = { 0, 0 };
    for (int i = 0; i < 2; i++) {
        const nook_bake *bake = nook_scene_volume_bake(&v.volumes[i]);
        nook_volume volume;
        assert_int_equal(nook_volume_decode("density", bake->bytes, bake->size, &volume), NOOK_OK);
        assert_int_equal(volume.info.kind, NOOK_VOLUME_DENSITY);
        size_t count = (size_t)volume.info.width * volume.info.height * volume.info.depth, half = volume.info.width / 2;
        for (size_t k = 0; k < count; k++)
            if (i == 1 || k % volume.info.width < half) /* of "static" the cube at x = -10 */
                most[i] = volume.voxels[k] > most[i] ? volume.voxels[k] : most[i];
        nook_volume_free(&volume);
    }
    assert_int_equal(most[0], 0);
    assert_int_equal(most[1], 102);
    nook_volumes_free(&v);
    free(s);
}

/* @return of the kind that was asked for; NULL: nothing was baked */
static const nook_bake *bake_distances(const stage *s, nook_scene_volumes *out, uint32_t volume)
{
    const nook_volumes_desc desc = {
        .resolution = 32, .r_max = 2.0, .threads = 1, .kinds = NOOK_VOLUME_BIT(NOOK_VOLUME_DISTANCE)
    };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, out), NOOK_OK);
    return nook_scene_volume_bake(&out->volumes[volume]);
}

/* Of the two static cubes, 21 m apart, one is that material; the crates are blended and clear. */
static void check_longest_distances(uint32_t material, double metres)
{
    stage *s = make_stage();
    s->primitives[0].material = BLENDED;
    s->primitives[1].material = material;
    nook_scene_volumes v;
    for (int clear = 0; clear < 2; clear++) {
        s->materials[BLENDED].base_colour[3] = s->materials[MASKED].base_colour[3] = clear ? 0.49f : 0.5f;
        s->materials[MASKED].alpha_cutoff = 0.5f;
        const nook_bake *cubes = bake_distances(s, &v, 0);
        assert_non_null(cubes);
        assert_true(fabs(32.0 * cubes->info.voxel_size - (clear ? metres : 21.0)) < 1e-5);
        assert_int_equal(nook_scene_volume_bake(&v.volumes[1]) == NULL, clear);
        assert_int_equal(nook_scene_volume_indices_of(&v.volumes[0], NOOK_VOLUME_SURFEL), 72);
        nook_volumes_free(&v);
    }
    free(s);
}

static void test_what_is_nowhere_there_makes_no_distances_coarser(void **state)
{
    (void)state;
    check_longest_distances(BLENDED, 1.0);
    check_longest_distances(MASKED, 1.0);
    check_longest_distances(OPAQUE, 21.0);
}

static void test_scene_with_nothing_to_bake_has_no_volumes(void **state)
{
    (void)state;
    stage *s = make_stage();
    for (uint32_t i = 0; i < MESHES; i++)
        s->meshes[i].primitive_count = 0;
    nook_scene_volumes v = bake(s, 16, 0.0);
    assert_int_equal(v.volume_count, 0);
    assert_int_equal(v.occluder_count, 0);
    nook_volumes_free(&v);
    s->scene.node_count = 0;
    v = bake(s, 16, 0.0);
    assert_int_equal(v.volume_count, 0);
    nook_volumes_free(&v);
    nook_volumes_free(&v);
    nook_volumes_free(NULL);
    free(s);
}

static void test_corners_that_are_not_finite_are_left_out(void **state)
{
    (void)state;
    stage *s = make_stage();
    s->vertices[0].position[1] = NAN; /* mesh 0: the triangles at corner 0 */
    for (uint32_t i = 8; i < 16; i++) /* mesh 1: everything */
        s->vertices[i].position[0] = INFINITY;
    nook_scene_volumes v = bake(s, 16, 2.0);
    assert_int_equal(v.volume_count, 2);
    assert_string_equal(v.volumes[0].name, "static");
    assert_int_equal(v.volumes[0].index_count, 36);
    size_t touching = 0;
    for (int i = 0; i < 36; i += 3)
        touching += s->indices[i] == 0 || s->indices[i + 1] == 0 || s->indices[i + 2] == 0;
    assert_int_equal(v.volumes[1].index_count, 36 - 3 * touching);
    nook_volumes_free(&v);
    free(s);
}

static void test_body_without_extent_is_warned_about_and_left_out(void **state)
{
    (void)state;
    stage *s = make_stage();
    int lines = 0;
    s->nodes[2].world_from_local = nook_matrix_scale(1.0, 0.0, 1.0);
    nook_log_set_sink(count_lines, &lines);
    nook_scene_volumes v = bake(s, 16, 2.0);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 1);
    assert_int_equal(v.occluder_count, 3);
    nook_volumes_free(&v);
    free(s);
}

static void test_body_resolution_follows_from_r_max(void **state)
{
    (void)state;
    assert_int_equal(nook_volumes_body_resolution(1.0, 2.0, 256), 32);    /* voxels of r_max / 64 */
    assert_int_equal(nook_volumes_body_resolution(1.0, 1.0, 256), 64);    /* half the r_max, twice as many */
    assert_int_equal(nook_volumes_body_resolution(0.01, 2.0, 256), 16);   /* never fewer than 16 */
    assert_int_equal(nook_volumes_body_resolution(100.0, 2.0, 256), 128); /* never more than half */
    assert_int_equal(nook_volumes_body_resolution(100.0, 2.0, 20), 10);
    assert_int_equal(nook_volumes_body_resolution(100.0, 2.0, 1), 1);
    assert_int_equal(nook_volumes_body_resolution(1.0, 0.0, 256), 16);
}

static void test_largest_instance_sets_the_resolution(void **state)
{
    (void)state;
    stage *s = make_stage();
    nook_matrix scale = nook_matrix_scale(1.0, 3.0, 1.0);
    s->nodes[2].world_from_local = scale;
    nook_scene_volumes v = bake(s, 256, 2.0);
    assert_int_equal(v.volumes[1].resolution, 96);
    assert_int_equal(v.volumes[1].bakes[NOOK_VOLUME_BINARY].info.width, 98);
    assert_int_equal(v.volumes[0].resolution, 256);
    nook_volumes_free(&v);
    free(s);
}

static void test_r_max_is_a_tenth_of_the_diagonal_by_itself(void **state)
{
    (void)state;
    stage *s = make_stage();
    nook_scene_volumes v = bake(s, 16, 0.0);
    assert_true(fabs(v.r_max - 0.1 * sqrt(21.0 * 21.0 + 2.0)) < 1e-12);
    nook_volumes_free(&v);
    free(s);
}

static void test_volumes_have_names_to_tell_them_apart(void **state)
{
    (void)state;
    stage *s = make_stage();
    s->nodes[0].moving = s->nodes[3].moving = true; /* meshes 1 and 2 have no name, nor have their nodes */
    s->nodes[4].mesh = NOOK_NONE;
    nook_scene_volumes v = bake(s, 16, 2.0);
    assert_int_equal(v.volume_count, 3);
    assert_string_equal(v.volumes[0].name, "mesh 1");
    assert_string_equal(v.volumes[1].name, "crate");
    assert_string_equal(v.volumes[2].name, "mesh 2");
    nook_volumes_free(&v);
    s->meshes[0].name = empty_name;
    v = bake(s, 16, 2.0);
    assert_string_equal(v.volumes[1].name, "post");
    nook_volumes_free(&v);
    free(s);
}

typedef struct watched {
    uint32_t calls, count;
} watched;

static void watch(void *user, const nook_scene_volume *done, uint32_t index, uint32_t count)
{
    watched *w = user;
    assert_int_equal(index, w->calls++);
    assert_non_null(nook_scene_volume_bake(done));
    w->count = count;
}

static void test_progress_is_told_after_each_volume(void **state)
{
    (void)state;
    stage *s = make_stage();
    watched w = { 0 };
    const nook_volumes_desc desc = { .resolution = 16, .threads = 1, .progress = watch, .user = &w };
    nook_scene_volumes v;
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_OK);
    assert_int_equal(w.calls, 2);
    assert_int_equal(w.count, 2);
    nook_volumes_free(&v);
    free(s);
}

static void test_absurd_settings_are_refused(void **state)
{
    (void)state;
    stage *s = make_stage();
    nook_volumes_desc desc = { .resolution = 513 };
    nook_scene_volumes v = { .volume_count = 77 };
    int lines = 0;
    nook_log_set_sink(count_lines, &lines);
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_E_RANGE);
    desc = (nook_volumes_desc){ .resolution = 16, .r_max = -1.0 };
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_E_RANGE);
    desc.r_max = (double)NAN;
    assert_int_equal(nook_volumes_bake(&s->scene, &desc, &v), NOOK_E_RANGE);
    nook_log_set_sink(NULL, NULL);
    assert_int_equal(lines, 3);
    assert_int_equal(v.volume_count, 77);
    free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_instances_share_one_bake),
        cmocka_unit_test(test_static_nodes_become_one_volume_in_world_space),
        cmocka_unit_test(test_blended_materials_are_left_out_and_masked_ones_are_in),
        cmocka_unit_test(test_an_edited_scene_is_baked_where_it_changed),
        cmocka_unit_test(test_densities_hold_blended_materials_with_their_alpha),
        cmocka_unit_test(test_what_is_nowhere_there_makes_no_distances_coarser),
        cmocka_unit_test(test_scene_with_nothing_to_bake_has_no_volumes),
        cmocka_unit_test(test_corners_that_are_not_finite_are_left_out),
        cmocka_unit_test(test_body_without_extent_is_warned_about_and_left_out),
        cmocka_unit_test(test_body_resolution_follows_from_r_max),
        cmocka_unit_test(test_largest_instance_sets_the_resolution),
        cmocka_unit_test(test_r_max_is_a_tenth_of_the_diagonal_by_itself),
        cmocka_unit_test(test_volumes_have_names_to_tell_them_apart),
        cmocka_unit_test(test_progress_is_told_after_each_volume),
        cmocka_unit_test(test_absurd_settings_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
