#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/asset/image.h"
#include "tests/support/log_capture.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stb/stb_image_write.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const uint8_t pixels[2 * 1 * 4] = { 255, 128, 0, 255, 1, 2, 3, 64 };

/** Bytes of an encoded image. */
typedef struct encoded {
    uint8_t bytes[4096];
    size_t size;
} encoded;

static void collect(void *context, void *data, int size)
{
    encoded *to = context;
    assert_true(to->size + (size_t)size <= sizeof to->bytes);
    memcpy(to->bytes + to->size, data, (size_t)size);
    to->size += (size_t)size;
}

/* pixels, 2 x 1. */
static encoded make_png(void)
{
    encoded png = { .size = 0 };
    assert_true(stbi_write_png_to_func(collect, &png, 2, 1, 4, pixels, 8));
    return png;
}

static nook_scene *load_members(const char *members)
{
    char text[8192];
    snprintf(text, sizeof text, "{ 'asset': { 'version': '2.0' }, %s }", members);
    return test_scene_must_load(test_gltf_write("material.gltf", text));
}

static void assert_floats(const float *got, size_t count, const double *expected)
{
    for (size_t i = 0; i < count; i++)
        assert_true(fabs((double)got[i] - expected[i]) < 1e-6);
}

static void test_a_default_material_stands_at_the_end(void **state)
{
    (void)state;
    nook_scene *scene = load_members("'materials': [ { 'name': 'mine' } ]");
    assert_int_equal(scene->material_count, 2);
    assert_string_equal(scene->materials[0].name, "mine");
    for (int i = 0; i < 2; i++) { /* a material without members is the default one too */
        const nook_material *m = &scene->materials[i];
        assert_floats(m->base_colour, 4, (double[]){ 1, 1, 1, 1 });
        assert_floats(m->emissive, 3, (double[]){ 0, 0, 0 });
        assert_true(m->metallic == 1.0f && m->roughness == 1.0f && m->normal_scale == 1.0f);
        assert_true(m->occlusion_strength == 1.0f && m->alpha_cutoff == 0.5f && m->alpha_mode == NOOK_ALPHA_OPAQUE);
        assert_false(m->double_sided || m->unlit);
        assert_int_equal(m->base_colour_image, NOOK_NONE);
        assert_int_equal(m->normal_image, NOOK_NONE);
    }
    nook_scene_destroy(scene);
}

static void test_all_factors_are_read(void **state)
{
    (void)state;
    nook_scene *scene = load_members(
        "'images': [ { 'uri': 'a.png' }, { 'uri': 'b.png' } ], 'textures': [ { 'source': 1 }, { 'source': 0 } ], "
        "'materials': [ { 'pbrMetallicRoughness': { 'baseColorFactor': [ 0.1, 0.2, 0.3, 0.4 ], 'metallicFactor': 0.5, "
        "'roughnessFactor': 0.6, 'baseColorTexture': { 'index': 0 }, 'metallicRoughnessTexture': { 'index': 1 } }, "
        "'normalTexture': { 'index': 0, 'scale': 0.7 }, 'occlusionTexture': { 'index': 1, 'strength': 0.8 }, "
        "'emissiveTexture': { 'index': 0 }, 'emissiveFactor': [ 1, 0.5, 0.25 ], 'alphaMode': 'MASK', "
        "'alphaCutoff': 0.9, 'doubleSided': true, 'extensions': { 'KHR_materials_unlit': { }, "
        "'KHR_materials_emissive_strength': { 'emissiveStrength': 8 } } }, { 'alphaMode': 'BLEND' } ]");
    const nook_material *m = &scene->materials[0];
    assert_floats(m->base_colour, 4, (double[]){ 0.1, 0.2, 0.3, 0.4 });
    assert_floats(m->emissive, 3, (double[]){ 8, 4, 2 });
    assert_floats((float[]){ m->metallic, m->roughness, m->normal_scale, m->occlusion_strength, m->alpha_cutoff }, 5,
                  (double[]){ 0.5, 0.6, 0.7, 0.8, 0.9 });
    assert_true(m->double_sided && m->unlit && m->alpha_mode == NOOK_ALPHA_MASK);
    assert_int_equal(m->base_colour_image, 1);
    assert_int_equal(m->metallic_roughness_image, 0);
    assert_int_equal(m->normal_image, 1);
    assert_int_equal(m->occlusion_image, 0);
    assert_int_equal(m->emissive_image, 1);
    assert_int_equal(scene->materials[1].alpha_mode, NOOK_ALPHA_BLEND);
    nook_scene_destroy(scene);
}

static void test_factors_beyond_their_range_are_clamped(void **state)
{
    (void)state;
    nook_scene *scene =
        load_members("'materials': [ { 'pbrMetallicRoughness': { 'baseColorFactor': [ -1, 2, 1e300, 0 ], "
                     "'metallicFactor': 7, 'roughnessFactor': -7 } } ]");
    assert_floats(scene->materials[0].base_colour, 4, (double[]){ 0, 1, 1, 0 });
    assert_true(scene->materials[0].metallic == 1.0f && scene->materials[0].roughness == 0.0f);
    nook_scene_destroy(scene);
}

static void assert_pixels(const nook_image *image)
{
    assert_int_equal(image->width, 2);
    assert_int_equal(image->height, 1);
    assert_memory_equal(image->pixels, pixels, sizeof pixels);
}

static void test_image_in_a_buffer_is_decoded(void **state)
{
    (void)state;
    encoded png = make_png();
    test_glb glb = { 0 };
    test_glb_add(&glb, png.bytes, png.size);
    nook_scene *scene =
        test_glb_must_load(&glb, "'images': [ { 'bufferView': 0, 'mimeType': 'image/png', 'name': 'two pixels' } ]");
    assert_pixels(&scene->images[0]);
    assert_string_equal(scene->images[0].name, "two pixels");
    assert_int_equal(scene->warning_count, 1); /* nothing to draw */
    nook_scene_destroy(scene);
    scene = test_glb_must_load(&glb, "'images': [ { 'bufferView': 0, 'mimeType': 'image/jpeg' } ]");
    assert_pixels(&scene->images[0]);
    assert_non_null(strstr(scene->warnings[0], "images[0] is image/png, whatever its mimeType says"));
    nook_scene_destroy(scene);
}

static void test_image_beside_the_scene_is_decoded(void **state)
{
    (void)state;
    encoded png = make_png();
    test_bytes_write("two pixels.png", png.bytes, png.size);
    nook_scene *scene = load_members("'images': [ { 'uri': 'two%20pixels.png' } ]");
    assert_pixels(&scene->images[0]);
    nook_scene_destroy(scene);
}

static void test_images_can_be_skipped(void **state)
{
    (void)state;
    nook_scene *scene = NULL;
    nook_log_capture log;
    const char *path = test_gltf_write("skip.gltf", "{ 'asset': { 'version': '2.0' }, 'images': [ { 'uri': 'none.png', "
                                                    "'name': 'x' } ] }");
    nook_log_capture_begin(&log);
    nook_result result = nook_scene_load(path, &(nook_scene_options){ .skip_images = true }, &scene);
    nook_log_capture_end();
    assert_int_equal(result, NOOK_OK);
    assert_int_equal(scene->image_count, 1);
    assert_string_equal(scene->images[0].name, "x");
    assert_null(scene->images[0].pixels);
    assert_int_equal(scene->warning_count, 1); /* of nothing to draw, not of the missing image */
    nook_scene_destroy(scene);
}

static void check_left_out(const char *image, const char *reason)
{
    char members[512];
    snprintf(members, sizeof members, "'images': [ %s ]", image);
    nook_scene *scene = load_members(members);
    assert_int_equal(scene->image_count, 1);
    assert_null(scene->images[0].pixels);
    if (scene->warning_count != 2 || !strstr(scene->warnings[0], reason))
        fail_msg("%u warnings, '%s' does not say '%s'", scene->warning_count, scene->warnings[0], reason);
    nook_scene_destroy(scene);
}

static void test_images_that_cannot_be_had_are_left_out_with_a_warning(void **state)
{
    (void)state;
    check_left_out("{ 'uri': 'nothing_here.png' }", "cannot be read");
    check_left_out("{ 'uri': '../x.png' }", "climbs out");
    check_left_out("{ 'uri': 'http://127.0.0.1/x.png' }", "has a scheme");
    check_left_out("{ 'uri': 'data:image/png;base64,!' }", "broken base64");
    check_left_out("{ 'uri': 'data:image/png;base64,AAAA' }", "is neither PNG nor JPEG");
    check_left_out("{ }", "neither uri nor bufferView");
}

static void test_every_cut_of_a_png_is_an_error_or_the_picture(void **state)
{
    (void)state;
    encoded png = make_png();
    uint8_t *out = NULL;
    uint32_t width = 0, height = 0;
    for (size_t size = 0; size < png.size; size++) {
        uint8_t *exact = malloc(size ? size : 1); /* exact, so that the sanitizer sees a read past the end */
        assert_non_null(exact);
        memcpy(exact, png.bytes, size);
        const char *reason = nook_image_decode(exact, size, &out, &width, &height);
        if (!reason) {
            assert_true(size > 40); /* only the checksum or the end mark is missing */
            nook_image_free(out);
        } else {
            assert_null(out);
            assert_int_equal(width, 0);
        }
        out = NULL;
        width = height = 0;
        free(exact);
    }
}

/* A PNG header alone: signature and IHDR, without checksum. */
static const char *decode_header(uint32_t width, uint32_t height)
{
    uint8_t header[] = { 0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0,
                         0,    0,   0,   0,   0,  0,  8,  6,  0, 0, 0, 0,  0,   0,   0,   0,   0, 0 };
    uint8_t *out = NULL;
    for (int i = 0; i < 4; i++) {
        header[16 + i] = (uint8_t)(width >> (24 - 8 * i));
        header[20 + i] = (uint8_t)(height >> (24 - 8 * i));
    }
    const char *reason = nook_image_decode(header, sizeof header, &out, &width, &height);
    assert_null(out);
    return reason;
}

static void test_sizes_are_checked_before_decoding(void **state)
{
    (void)state;
    assert_string_equal(decode_header(16385, 1), "is larger than 16384 pixels");
    assert_string_equal(decode_header(1, 16385), "is larger than 16384 pixels");
    assert_string_equal(decode_header(16384, 16384), "needs more than 256 MiB");
    assert_string_equal(decode_header(0, 1), "has a broken header");
    assert_string_equal(decode_header(8, 8), "is broken"); /* no pixels follow */
}

static void test_other_image_formats_are_not_decoded(void **state)
{
    (void)state;
    encoded bmp = { .size = 0 };
    uint8_t *out = NULL;
    uint32_t width, height;
    assert_true(stbi_write_bmp_to_func(collect, &bmp, 2, 1, 4, pixels));
    assert_string_equal(nook_image_decode(bmp.bytes, bmp.size, &out, &width, &height), "is neither PNG nor JPEG");
}

static void test_textures_mapped_in_two_ways_are_a_warning(void **state)
{
    (void)state;
    nook_scene *scene = load_members(
        "'images': [ { 'uri': 'a.png' } ], 'textures': [ { 'source': 0 } ], 'materials': [ { 'emissiveTexture': "
        "{ 'index': 0, 'texCoord': 1 }, 'normalTexture': { 'index': 0 } } ]");
    assert_int_equal(scene->warning_count, 3);
    assert_non_null(strstr(scene->warnings[1], "materials[0] maps its textures in different ways"));
    nook_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_default_material_stands_at_the_end),
        cmocka_unit_test(test_all_factors_are_read),
        cmocka_unit_test(test_factors_beyond_their_range_are_clamped),
        cmocka_unit_test(test_image_in_a_buffer_is_decoded),
        cmocka_unit_test(test_image_beside_the_scene_is_decoded),
        cmocka_unit_test(test_images_can_be_skipped),
        cmocka_unit_test(test_images_that_cannot_be_had_are_left_out_with_a_warning),
        cmocka_unit_test(test_every_cut_of_a_png_is_an_error_or_the_picture),
        cmocka_unit_test(test_sizes_are_checked_before_decoding),
        cmocka_unit_test(test_other_image_formats_are_not_decoded),
        cmocka_unit_test(test_textures_mapped_in_two_ways_are_a_warning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
