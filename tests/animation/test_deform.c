/* Poses of scenes and the vertices that they give, against closed forms. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/animation/deform.h"
#include "engine/animation/scene_stand.h"
#include "engine/core/file.h"
#include "tests/support/bone_scene.h"
#include "tests/support/log_capture.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double origin[3] = { 0, 0, 0 };
static const double pi = 3.14159265358979323846;

/* A deformed mesh, in its node's space and in the world. */
typedef struct posed {
    nook_scene *scene;
    nook_scene_pose *pose;
    nook_vertex *vertices;
} posed;

static posed pose_at(nook_scene *scene, double seconds)
{
    posed p = { .scene = scene };
    const nook_deformable *d = &scene->deformables[0];
    assert_int_equal(nook_scene_pose_create(scene, &p.pose), NOOK_OK);
    nook_scene_pose_apply(p.pose, 0, seconds);
    nook_scene_pose_finish(p.pose);
    p.vertices = calloc(d->vertex_count, sizeof *p.vertices);
    assert_non_null(p.vertices);
    nook_deform(p.pose, 0, scene->vertices + d->first_vertex, p.vertices);
    return p;
}

static void free_posed(posed *p)
{
    free(p->vertices);
    nook_scene_pose_destroy(p->pose);
    nook_scene_destroy(p->scene);
}

static void assert_near(const float got[3], double x, double y, double z, double allowed)
{
    double d[3] = { (double)got[0] - x, (double)got[1] - y, (double)got[2] - z };
    if (!(fabs(d[0]) <= allowed && fabs(d[1]) <= allowed && fabs(d[2]) <= allowed))
        fail_msg("(%.9g %.9g %.9g), expected (%.9g %.9g %.9g)", (double)got[0], (double)got[1], (double)got[2], x, y,
                 z);
}

/* Where a point of the arm is when the lower bone has turned by `angle` and the target has `weight`. */
static void expect(const float rest[3], double angle, double weight, double out[3])
{
    double x = (double)rest[0] + (rest[1] == 2.0f ? weight : 0.0), y = (double)rest[1] - 1.0;
    double turned[2] = { cos(angle) * x - sin(angle) * y, sin(angle) * x + cos(angle) * y + 1.0 };
    double part = rest[1] > 1.0f ? 1.0 : rest[1] < 1.0f ? 0.0 : 0.5;
    out[0] = part * turned[0] + (1.0 - part) * x;
    out[1] = part * turned[1] + (1.0 - part) * (y + 1.0);
    out[2] = 0.0;
}

static void test_an_arm_of_two_bones_bends_as_on_paper(void **state)
{
    (void)state;
    for (double t = 0.0; t <= 2.0; t += 0.25) {
        posed p = pose_at(bone_scene_load(origin), t);
        for (uint32_t v = 0; v < 2 * BONE_SCENE_ROWS; v++) {
            double at[3];
            expect(p.scene->vertices[v].position, 0.25 * pi * t, 0.5 * t, at);
            assert_near(p.vertices[v].position, at[0], at[1], at[2], 1e-6);
            assert_near(p.vertices[v].normal, 0, 0, 1, 1e-6);
        }
        free_posed(&p);
    }
}

static void test_behind_its_end_a_clip_holds_its_last_pose(void **state)
{
    (void)state;
    posed end = pose_at(bone_scene_load(origin), 2.0), later = pose_at(bone_scene_load(origin), 77.0);
    assert_memory_equal(end.vertices, later.vertices, 2 * BONE_SCENE_ROWS * sizeof *end.vertices);
    free_posed(&end);
    free_posed(&later);
}

static void test_a_pose_has_no_memory(void **state)
{
    (void)state;
    posed p = pose_at(bone_scene_load(origin), 0.7), q = pose_at(bone_scene_load(origin), 1.9);
    nook_scene_pose_rest(q.pose);
    nook_scene_pose_apply(q.pose, 0, 0.7);
    nook_scene_pose_finish(q.pose);
    nook_deform(q.pose, 0, q.scene->vertices, q.vertices);
    assert_memory_equal(p.vertices, q.vertices, 2 * BONE_SCENE_ROWS * sizeof *p.vertices);
    free_posed(&p);
    free_posed(&q);
}

static void test_an_arm_far_away_keeps_its_shape(void **state)
{
    (void)state;
    const double far[3] = { 3e7, -2e7, 1e7 };
    posed near = pose_at(bone_scene_load(origin), 1.3), away = pose_at(bone_scene_load(far), 1.3);
    for (uint32_t v = 0; v < 2 * BONE_SCENE_ROWS; v++) {
        const float *a = near.vertices[v].position;
        assert_near(away.vertices[v].position, (double)a[0], (double)a[1], (double)a[2], 2e-7);
    }
    const double *world = away.pose->world_from_local[BONE_SCENE_MESH_NODE].m;
    assert_true(world[12] == 3e7 && world[13] == -2e7 && world[14] == 1e7);
    free_posed(&near);
    free_posed(&away);
}

static void test_the_node_of_a_skinned_mesh_has_no_say(void **state)
{
    (void)state;
    nook_scene *scene = bone_scene_load(origin);
    const double axis[4] = { 0.5, 0.5, 0.5, 0.5 }, by[3] = { 4, 5, 6 }, scale[3] = { 2, 2, 3 };
    scene->rest[BONE_SCENE_MESH_NODE].parent_from_local = nook_matrix_compose(by, axis, scale);
    posed p = pose_at(scene, 1.0);
    for (uint32_t v = 0; v < 2 * BONE_SCENE_ROWS; v++) {
        double at[3], got[3];
        for (int k = 0; k < 3; k++)
            got[k] = (double)p.vertices[v].position[k];
        nook_matrix_apply_point(&p.pose->world_from_local[BONE_SCENE_MESH_NODE], got, got);
        expect(scene->vertices[v].position, 0.25 * pi, 0.5, at);
        assert_true(fabs(got[0] - at[0]) < 2e-6 && fabs(got[1] - at[1]) < 2e-6 && fabs(got[2]) < 2e-6);
    }
    free_posed(&p);
}

static void test_normals_stay_perpendicular_when_a_bone_scales_and_mirrors(void **state)
{
    (void)state;
    static const double scales[][3] = { { 2, 1, 0.5 }, { -1, 1, 1 }, { 3, -2, 0.25 }, { 1e-3, 1, 1 } };
    for (size_t i = 0; i < sizeof scales / sizeof *scales; i++) {
        nook_scene *scene = bone_scene_load(origin);
        nook_node_rest *upper = &scene->rest[2];
        const double *s = scales[i];
        upper->parent_from_local = nook_matrix_compose(upper->translation, upper->rotation, s);
        const float slanted[3] = { 0.6f, 0.0f, 0.8f };
        memcpy(scene->vertices[0].normal, slanted, sizeof slanted);
        posed p = pose_at(scene, 0.0);
        double x = 0.6 / s[0], z = 0.8 / s[2], length = sqrt(x * x + z * z);
        assert_near(p.vertices[0].normal, x / length, 0.0, z / length, 1e-6);
        free_posed(&p);
    }
}

static void test_a_bone_scaled_to_nothing_leaves_finite_vertices(void **state)
{
    (void)state;
    nook_scene *scene = bone_scene_load(origin);
    const double zero[3] = { 0, 0, 0 };
    scene->rest[2].parent_from_local = nook_matrix_compose(zero, scene->rest[2].rotation, zero);
    posed p = pose_at(scene, 0.0);
    for (uint32_t v = 0; v < 2 * BONE_SCENE_ROWS; v++) {
        double length = 0.0;
        for (int k = 0; k < 3; k++) {
            assert_true(isfinite(p.vertices[v].position[k]));
            length += (double)p.vertices[v].normal[k] * (double)p.vertices[v].normal[k];
        }
        assert_true(fabs(length - 1.0) < 1e-6);
    }
    free_posed(&p);
}

static void test_a_scene_that_stands_still_has_its_pose_and_moves_no_more(void **state)
{
    (void)state;
    const double at[3] = { 7, 0, 0 };
    nook_scene *scene = bone_scene_load(at);
    assert_int_equal(nook_scene_stand_still(scene, 0, 2.0), NOOK_OK);
    assert_int_equal(scene->deformable_count, 0);
    assert_int_equal(scene->clip_count, 0);
    /* The forearm lies along -x, 1 m up; its tip was lifted along +x, which is +y by then. */
    assert_true(fabs(scene->bounds_min[0] - 6.0) < 1e-6 && fabs(scene->bounds_max[0] - 7.1) < 1e-6);
    assert_true(fabs(scene->bounds_max[1] - 2.1) < 1e-6 && fabs(scene->bounds_min[1]) < 1e-6);
    nook_scene_destroy(scene);
}

static void test_a_scene_can_be_stood_again_from_its_rest(void **state)
{
    (void)state;
    nook_scene *twice = bone_scene_load(origin), *once = bone_scene_load(origin);
    assert_int_equal(nook_scene_stand(twice, 0, 2.0), NOOK_OK);
    assert_int_equal(nook_scene_stand(twice, 0, 0.5), NOOK_OK);
    assert_int_equal(nook_scene_stand(once, 0, 0.5), NOOK_OK);
    assert_memory_equal(twice->vertices, once->vertices, once->vertex_count * sizeof *once->vertices);
    nook_scene_destroy(twice);
    nook_scene_destroy(once);
}

/* ---- Characters -------------------------------------------------------------------------------------------------- */

static void check_box(const char *path, const nook_mesh_pose *mesh, const nook_vertex *vertices, uint32_t count)
{
    for (uint32_t v = 0; v < count; v++)
        for (int k = 0; k < 3; k++) {
            float x = vertices[v].position[k];
            if (!(x >= mesh->box.min[k] && x <= mesh->box.max[k]))
                fail_msg("%s: vertex %u is at %g of axis %d, its box from %g to %g", path, v, (double)x, k,
                         (double)mesh->box.min[k], (double)mesh->box.max[k]);
        }
}

static void check_clips(const char *path, nook_scene *scene)
{
    nook_scene_pose *pose;
    assert_int_equal(nook_scene_pose_create(scene, &pose), NOOK_OK);
    for (uint32_t clip = 0; clip < scene->clip_count; clip++)
        for (int step = 0; step <= 4; step++) {
            nook_scene_pose_rest(pose);
            nook_scene_pose_apply(pose, clip, 0.25 * step * scene->clips[clip].duration);
            nook_scene_pose_finish(pose);
            for (uint32_t i = 0; i < scene->deformable_count; i++) {
                const nook_deformable *d = &scene->deformables[i];
                nook_vertex *out = calloc(d->vertex_count, sizeof *out);
                assert_non_null(out);
                nook_deform(pose, i, scene->vertices + d->first_vertex, out);
                check_box(path, &pose->meshes[i], out, d->vertex_count);
                free(out);
            }
        }
    nook_scene_pose_destroy(pose);
}

static void test_boxes_hold_every_vertex_of_characters_in_every_clip(void **state)
{
    (void)state;
    static const char *const files[] = { "CesiumMan.glb", "Fox.glb", "RobotExpressive.glb" };
    static const uint32_t clips[] = { 1, 3, 14 };
    const char *shared = getenv("NOOK_SHARED");
    if (!shared) {
        printf("skipped: NOOK_SHARED names no folder with characters\n");
        skip();
    }
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[1024];
        nook_scene *scene;
        nook_log_capture log;
        snprintf(path, sizeof path, "%s/scenes/characters/%s", shared, files[i]);
        nook_log_capture_begin(&log);
        nook_result result = nook_scene_load(path, NULL, &scene);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_OK);
        assert_int_equal(scene->clip_count, clips[i]);
        check_clips(path, scene);
        nook_scene_destroy(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_an_arm_of_two_bones_bends_as_on_paper),
        cmocka_unit_test(test_behind_its_end_a_clip_holds_its_last_pose),
        cmocka_unit_test(test_a_pose_has_no_memory),
        cmocka_unit_test(test_an_arm_far_away_keeps_its_shape),
        cmocka_unit_test(test_the_node_of_a_skinned_mesh_has_no_say),
        cmocka_unit_test(test_normals_stay_perpendicular_when_a_bone_scales_and_mirrors),
        cmocka_unit_test(test_a_bone_scaled_to_nothing_leaves_finite_vertices),
        cmocka_unit_test(test_a_scene_that_stands_still_has_its_pose_and_moves_no_more),
        cmocka_unit_test(test_a_scene_can_be_stood_again_from_its_rest),
        cmocka_unit_test(test_boxes_hold_every_vertex_of_characters_in_every_clip),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
