/* Vertices that the GPU poses, against those of engine/animation/deform.c; and pictures of them. */
#include "engine/animation/deform.h"
#include "engine/animation/scene_stand.h"
#include "engine/core/vector.h"
#include "engine/render/internal.h"
#include "tests/support/bone_scene.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_gpu.h"
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double origin[3] = { 0, 0, 0 };

typedef struct posed_scene {
    nook_scene *scene;
    nook_scene_pose *pose;
    nook_render_scene *uploaded;
    nook_frame frame;
} posed_scene;

/* Takes the scene. */
static posed_scene open_scene(nook_gpu *gpu, nook_scene *scene)
{
    posed_scene s = { .scene = scene };
    assert_int_equal(nook_scene_stand(scene, NOOK_NONE, 0.0), NOOK_OK);
    assert_int_equal(nook_scene_pose_create(scene, &s.pose), NOOK_OK);
    assert_int_equal(nook_render_scene_create(gpu, scene, &s.uploaded), NOOK_OK);
    s.frame = (nook_frame){ .scene = s.uploaded, .poses = s.pose->meshes };
    return s;
}

static void close_scene(posed_scene *s)
{
    nook_render_scene_destroy(s->uploaded);
    nook_scene_pose_destroy(s->pose);
    nook_scene_destroy(s->scene);
}

static void set_time(posed_scene *s, uint32_t clip, double seconds)
{
    nook_scene_pose_rest(s->pose);
    nook_scene_pose_apply(s->pose, clip, seconds);
    nook_scene_pose_finish(s->pose);
    s->frame.pose_version++;
}

static double distance(const float a[3], const float b[3])
{
    double between[3];
    nook_vector_between(a, b, between);
    return nook_vector_length(between);
}

/* A pose's size: what float makes of it is measured by that. */
static double size_of(const nook_box *box)
{
    double size = 0.0;
    for (int k = 0; k < 3; k++)
        size = fmax(size, fmax(fabs((double)box->min[k]), fabs((double)box->max[k])));
    return size;
}

static void check_triangles(const posed_scene *s, nook_gpu *gpu, const nook_deformable *d, const nook_vertex *expected,
                            double edge_min)
{
    const nook_mesh *mesh = &s->scene->meshes[d->mesh];
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &s->scene->primitives[mesh->first_primitive + p];
        const render_primitive *uploaded = &s->uploaded->primitives[mesh->first_primitive + p];
        const uint32_t *index = s->scene->indices + primitive->first_index;
        size_t count = primitive->index_count / 3;
        float(*normals)[3] = malloc((count + 1) * sizeof *normals);
        assert_non_null(normals);
        nook_buffer_read(gpu, s->uploaded->triangle_normals, (size_t)uploaded->first_triangle * sizeof *normals,
                         normals, count * sizeof *normals);
        const nook_vertex *v = expected + (primitive->first_vertex - d->first_vertex);
        for (size_t t = 0; t < count; t++) {
            double ab[3], ac[3], n[3];
            nook_vector_between(v[index[3 * t]].position, v[index[3 * t + 1]].position, ab);
            nook_vector_between(v[index[3 * t]].position, v[index[3 * t + 2]].position, ac);
            nook_vector_cross(ab, ac, n);
            if (nook_vector_length(n) < edge_min * edge_min)
                continue; /* so thin that rounding of its corners turns it */
            nook_vector_normalize(n, n);
            double got[3] = { (double)normals[t][0], (double)normals[t][1], (double)normals[t][2] };
            if (!(nook_vector_dot(n, got) > 0.999))
                fail_msg("%s: triangle %zu of primitive %u faces (%g %g %g), expected (%g %g %g)", s->scene->path, t, p,
                         got[0], got[1], got[2], n[0], n[1], n[2]);
        }
        free(normals);
    }
}

/* @return largest distance of a vertex, of the mesh's size */
static double check_deformable(const posed_scene *s, nook_gpu *gpu, uint32_t index)
{
    const nook_deformable *d = &s->scene->deformables[index];
    double size = size_of(&s->pose->meshes[index].box), largest = 0.0;
    nook_vertex *expected = calloc(d->vertex_count, sizeof *expected), *got = calloc(d->vertex_count, sizeof *got);
    if (!expected || !got)
        abort(); /* which the analyser knows to end here */
    nook_deform(s->pose, index, s->scene->rest_vertices + d->first_rest, expected);
    nook_buffer_read(gpu, s->uploaded->vertices, d->first_vertex * sizeof *got, got, d->vertex_count * sizeof *got);
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        largest = fmax(largest, distance(got[v].position, expected[v].position) / size);
        if (!(distance(got[v].normal, expected[v].normal) < 0.02))
            fail_msg("%s: normal of vertex %u is off by %g", s->scene->path, v,
                     distance(got[v].normal, expected[v].normal));
        assert_memory_equal(got[v].uv, expected[v].uv, sizeof got[v].uv);
        assert_memory_equal(got[v].colour, expected[v].colour, sizeof got[v].colour);
    }
    check_triangles(s, gpu, d, expected, 1e-3 * size);
    free(expected);
    free(got);
    return largest;
}

static void test_the_gpu_bends_an_arm_as_the_cpu_does(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    posed_scene s = open_scene(gpu, bone_scene_load(origin));
    for (double t = 0.0; t <= 2.0; t += 0.25) {
        set_time(&s, 0, t);
        nook_render_scene_pose(s.uploaded, s.frame.poses, s.frame.pose_version);
        assert_true(check_deformable(&s, gpu, 0) < 1e-6);
    }
    close_scene(&s);
}

static void test_the_gpu_poses_characters_as_the_cpu_does(void **state)
{
    static const char *const files[] = { "CesiumMan.glb", "Fox.glb", "RobotExpressive.glb" };
    nook_gpu *gpu = test_gpu_of(state);
    const char *shared = getenv("NOOK_SHARED");
    if (!shared) {
        print_message("NOOK_SHARED names no folder with characters\n");
        skip();
    }
    for (size_t i = 0; i < NOOK_COUNT(files); i++) {
        char path[1024];
        nook_scene *scene;
        nook_log_capture log;
        snprintf(path, sizeof path, "%s/scenes/characters/%s", shared, files[i]);
        nook_log_capture_begin(&log);
        nook_result result = nook_scene_load(path, NULL, &scene);
        nook_log_capture_end();
        assert_int_equal(result, NOOK_OK);
        posed_scene s = open_scene(gpu, scene);
        for (uint32_t clip = 0; clip < scene->clip_count; clip++) {
            set_time(&s, clip, 0.37 * scene->clips[clip].duration);
            nook_render_scene_pose(s.uploaded, s.frame.poses, s.frame.pose_version);
            for (uint32_t d = 0; d < scene->deformable_count; d++)
                if (!(check_deformable(&s, gpu, d) < 2e-6))
                    fail_msg("%s: clip %u, deformable %u: positions are off by more than 2e-6 of its size", path, clip,
                             d);
        }
        close_scene(&s);
    }
}

static void test_a_pose_of_the_same_version_is_not_computed_again(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    posed_scene s = open_scene(gpu, bone_scene_load(origin));
    nook_vertex before, after, changed;
    size_t last = (s.scene->vertex_count - 1) * sizeof before;
    set_time(&s, 0, 1.0);
    nook_render_scene_pose(s.uploaded, s.frame.poses, s.frame.pose_version);
    nook_buffer_read(gpu, s.uploaded->vertices, last, &before, sizeof before);
    set_time(&s, 0, 2.0);
    s.frame.pose_version--;
    nook_render_scene_pose(s.uploaded, s.frame.poses, s.frame.pose_version);
    nook_buffer_read(gpu, s.uploaded->vertices, last, &after, sizeof after);
    assert_memory_equal(&before, &after, sizeof before);
    s.frame.pose_version++;
    nook_render_scene_pose(s.uploaded, s.frame.poses, s.frame.pose_version);
    nook_buffer_read(gpu, s.uploaded->vertices, last, &changed, sizeof changed);
    assert_memory_not_equal(&before, &changed, sizeof before);
    close_scene(&s);
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

enum { SIDE = 64 };

/* How many pixels show the arm. Seen from 2 m to the left of the elbow: the forearm comes in only when it is bent. box: NULL, the pose's own */
static int count_pixels(nook_gpu *gpu, posed_scene *s, nook_renderer *renderer, double seconds, const nook_box *box)
{
    static float depth[SIDE * SIDE];
    const nook_lights lights = nook_lights_default();
    int count = 0;
    set_time(s, 0, seconds);
    const nook_draw draw = { .mesh = s->scene->deformables[0].mesh,
                             .moves = true,
                             .world_from_local = s->pose->world_from_local[BONE_SCENE_MESH_NODE],
                             .pose_version = s->frame.pose_version,
                             .box = box ? *box : s->pose->meshes[0].box };
    s->frame.draws = &draw;
    s->frame.draw_count = 1;
    s->frame.lights = &lights;
    s->frame.camera = (nook_camera){ nook_matrix_translation(0.7, -1.0, -0.5), 0.8, 0.01 };
    assert_int_equal(nook_frame_begin(renderer, &s->frame), NOOK_OK);
    nook_texture_read(gpu, nook_renderer_gbuffer(renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, depth, sizeof depth);
    for (int i = 0; i < SIDE * SIDE; i++)
        count += depth[i] > 0.0f;
    return count;
}

static void test_a_limb_that_bends_into_view_is_drawn_there(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    nook_renderer *renderer;
    posed_scene s = open_scene(gpu, bone_scene_load(origin));
    assert_int_equal(nook_renderer_create(gpu, SIDE, SIDE, &renderer), NOOK_OK);
    assert_int_equal(count_pixels(gpu, &s, renderer, 0.0, NULL), 0);
    int bent = count_pixels(gpu, &s, renderer, 2.0, NULL);
    assert_true(bent > SIDE);
    assert_int_equal(count_pixels(gpu, &s, renderer, 0.0, NULL), 0);
    s.frame.quick = true; /* leaves out what does not show */
    assert_int_equal(count_pixels(gpu, &s, renderer, 0.0, NULL), 0);
    assert_int_equal(count_pixels(gpu, &s, renderer, 2.0, NULL), bent);
    nook_renderer_destroy(renderer);
    close_scene(&s);
}

/* Texels of the sun's map that something is in. */
static int count_shadow(nook_gpu *gpu, nook_renderer *renderer, float *map)
{
    int count = 0;
    nook_texture_read(gpu, renderer->shadow_map, GL_DEPTH_COMPONENT, GL_FLOAT, map,
                      sizeof(float) * SHADOW_SIZE * SHADOW_SIZE);
    for (int i = 0; i < SHADOW_SIZE * SHADOW_SIZE; i++)
        count += map[i] < 1.0f;
    return count;
}

static void test_shadows_follow_the_pose_as_if_they_were_drawn_anew(void **state)
{
    nook_gpu *gpu = test_gpu_of(state);
    const nook_box all = { { -3, -3, -3 }, { 3, 3, 3 } }; /* of all poses: the map fits it once */
    nook_renderer *kept, *anew;
    float *map = malloc(sizeof(float) * SHADOW_SIZE * SHADOW_SIZE);
    posed_scene s = open_scene(gpu, bone_scene_load(origin));
    assert_non_null(map);
    assert_int_equal(nook_renderer_create(gpu, SIDE, SIDE, &kept), NOOK_OK);
    count_pixels(gpu, &s, kept, 2.0, &all);
    int bent = count_shadow(gpu, kept, map);
    for (double t = 1.75; t >= 0.0; t -= 0.25) {
        count_pixels(gpu, &s, kept, t, &all);
        int shadow = count_shadow(gpu, kept, map);
        assert_int_equal(nook_renderer_create(gpu, SIDE, SIDE, &anew), NOOK_OK);
        count_pixels(gpu, &s, anew, t, &all);
        assert_int_equal(shadow, count_shadow(gpu, anew, map));
        assert_true(shadow != bent && shadow > 0);
        nook_renderer_destroy(anew);
    }
    nook_renderer_destroy(kept);
    close_scene(&s);
    free(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_the_gpu_bends_an_arm_as_the_cpu_does, test_gpu_setup, test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_the_gpu_poses_characters_as_the_cpu_does, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_a_pose_of_the_same_version_is_not_computed_again, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_a_limb_that_bends_into_view_is_drawn_there, test_gpu_setup,
                                        test_gpu_teardown),
        cmocka_unit_test_setup_teardown(test_shadows_follow_the_pose_as_if_they_were_drawn_anew, test_gpu_setup,
                                        test_gpu_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
