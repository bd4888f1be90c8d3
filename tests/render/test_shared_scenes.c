/* Real files through the whole frame: loaded, seen by the default camera, every view without an error of GL. */
#include "engine/core/file.h"
#include "engine/render/renderer.h"
#include "tests/support/test_gpu.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 64 };

/** Pixels with geometry after a begin. */
static uint32_t count_covered(nook_gpu *gpu, const nook_renderer *renderer)
{
    static float depth[WIDTH * HEIGHT];
    uint32_t covered = 0;
    nook_texture_read(gpu, nook_renderer_gbuffer(renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, depth, sizeof depth);
    for (size_t i = 0; i < NOOK_COUNT(depth); i++)
        covered += depth[i] > 0.0f;
    return covered;
}

static void check_scene(nook_gpu *gpu, nook_renderer *renderer, const char *path)
{
    nook_scene *scene = NULL;
    nook_render_scene *uploaded = NULL;
    assert_int_equal(nook_scene_load(path, NULL, &scene), NOOK_OK);
    assert_int_equal(nook_render_scene_create(gpu, scene, &uploaded), NOOK_OK);
    assert_true(nook_render_scene_bytes(uploaded) > 0);
    size_t count = nook_scene_draws(scene, NULL);
    nook_draw *draws = calloc(count, sizeof *draws);
    assert_non_null(draws);
    assert_int_equal(nook_scene_draws(scene, draws), count);
    nook_lights lights = nook_lights_from_scene(scene);
    nook_frame frame = {
        .scene = uploaded,
        .draws = draws,
        .draw_count = count,
        .camera = nook_camera_frame(scene->bounds_min, scene->bounds_max, (double)WIDTH / HEIGHT),
        .lights = &lights,
    };
    assert_int_equal(nook_frame_begin(renderer, &frame), NOOK_OK);
    uint32_t covered = count_covered(gpu, renderer);
    assert_in_range(covered, WIDTH * HEIGHT / 20, WIDTH * HEIGHT * 19 / 20);
    for (int view = 0; view < NOOK_VIEW_COUNT; view++)
        nook_frame_finish(renderer, &frame, (nook_texture){ 0 }, (nook_view)view);
    assert_false(nook_gpu_check(gpu, path));
    nook_render_scene_destroy(uploaded);
    nook_scene_destroy(scene);
    free(draws);
}

static void test_shared_scenes_fill_the_default_picture(void **state)
{
    static const char *const files[] = {
        "meshes/utah_teapot.glb",
        "meshes/cornell_box.glb",
        "gltf-tests/khronos/OrientationTest/glTF-Binary/OrientationTest.glb",
        "gltf-tests/khronos/BoxVertexColors/glTF-Binary/BoxVertexColors.glb",
        "gltf-tests/generated/node_transforms.glb",
        "gltf-tests/generated/huge_offset.glb",
        "gltf-tests/generated/tiny_scale.glb",
        "gltf-tests/generated/materials_and_vertex_colours.glb",
        "gltf-tests/generated/instances_400.glb",
        "gltf-tests/generated/some_degenerate_triangles.glb",
        "transparent/blend_panes.glb",
    };
    const char *shared = getenv("NOOK_SHARED");
    if (shared == NULL || !nook_directory_exists(shared)) {
        print_message("NOOK_SHARED is not set or names no folder: no shared scenes\n");
        skip();
    }
    nook_gpu *gpu = test_gpu_of(state);
    nook_renderer *renderer = NULL;
    assert_int_equal(nook_renderer_create(gpu, WIDTH, HEIGHT, &renderer), NOOK_OK);
    for (size_t i = 0; i < NOOK_COUNT(files); i++) {
        char folder[1024], path[1024];
        nook_path_join(folder, sizeof folder, shared, "scenes");
        check_scene(gpu, renderer, nook_path_join(path, sizeof path, folder, files[i]));
    }
    nook_renderer_destroy(renderer);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_shared_scenes_fill_the_default_picture) };
    return cmocka_run_group_tests(tests, test_gpu_setup, test_gpu_teardown);
}
