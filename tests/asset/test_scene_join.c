#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/asset/scene_join.h"
#include "tests/support/test_glb.h"
#include <math.h>
#include <stb/stb_image_write.h>
#include <stdio.h>
#include <string.h>

/* Bytes of an encoded image. */
typedef struct encoded {
    uint8_t bytes[256];
    size_t size;
} encoded;

static void collect(void *to, void *data, int size)
{
    encoded *out = to;
    memcpy(out->bytes + out->size, data, (size_t)size);
    out->size += (size_t)size;
}

/* A house of two quads with one picture, a lamp and a camera. `first` tells the picture's first byte. */
static nook_scene *load_house(const char *wall, uint8_t first, double x)
{
    const uint8_t pixels[8] = { first, 20, 30, 255, 40, 50, 60, 255 };
    static const uint16_t indices[6] = { 0, 1, 2, 2, 1, 3 };
    encoded png = { .size = 0 };
    char members[4096];
    assert_true(stbi_write_png_to_func(collect, &png, 2, 1, 4, pixels, 8));
    test_glb glb = { 0 };
    test_glb_add(&glb, test_quad_positions, sizeof test_quad_positions);
    test_glb_add(&glb, indices, sizeof indices);
    test_glb_add(&glb, png.bytes, png.size);
    snprintf(
        members, sizeof members,
        "'scenes': [ { 'nodes': [ 0, 2, 3 ] } ], 'nodes': [ { 'name': '%s', 'mesh': 0, 'children': [ 1 ], "
        "'translation': [ %g, 0, 0 ], 'extras': { 'nook_mass': 12.5, 'nook_hung': true } }, "
        "{ 'name': 'door', 'mesh': 1, 'translation': [ 0, 2, 0 ], 'extras': { 'nook_body': true } }, "
        "{ 'name': 'lamp', 'translation': [ 0, 3, 0 ], 'extensions': { 'KHR_lights_punctual': { 'light': 0 } } }, "
        "{ 'name': 'eye', 'camera': 0 } ], "
        "'extensionsUsed': [ 'KHR_lights_punctual' ], "
        "'extensions': { 'KHR_lights_punctual': { 'lights': [ { 'type': 'point', 'intensity': %g } ] } }, "
        "'cameras': [ { 'type': 'perspective', 'perspective': { 'yfov': 1, 'znear': 0.1 } } ], "
        "'meshes': [ { 'name': 'plain', 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'mode': 5 } ] }, "
        "{ 'name': 'painted', 'primitives': [ { 'attributes': { 'POSITION': 0 }, 'indices': 1, 'material': 0 } ] } ], "
        "'materials': [ { 'name': 'paint', 'pbrMetallicRoughness': { 'baseColorTexture': { 'index': 0 } } } ], "
        "'textures': [ { 'source': 0 } ], 'images': [ { 'bufferView': 2, 'mimeType': 'image/png' } ], "
        "'accessors': [ { 'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3', "
        "'min': [ 0, 0, 0 ], 'max': [ 1, 1, 0 ] }, "
        "{ 'bufferView': 1, 'componentType': 5123, 'count': 6, 'type': 'SCALAR' } ]",
        wall, x, (double)first);
    return test_glb_must_load(&glb, members);
}

/* Two houses; the second is a library of which `instances` are taken. */
typedef struct pair {
    nook_scene *first, *second, *joined;
} pair;

static pair join(bool second_stands, const nook_scene_instance *instances, uint32_t count)
{
    pair p = { load_house("wall", 11, 5.0), load_house("other wall", 99, -7.0), NULL };
    const nook_scene_part parts[] = { { p.first, true }, { p.second, second_stands } };
    assert_int_equal(nook_scene_join("joined", parts, 2, instances, count, &p.joined), NOOK_OK);
    return p;
}

static void destroy(pair *p)
{
    nook_scene_destroy(p->first);
    nook_scene_destroy(p->second);
    nook_scene_destroy(p->joined);
}

static void test_a_scene_alone_stays_as_it_is(void **state)
{
    (void)state;
    nook_scene *alone = load_house("wall", 11, 5.0), *like = load_house("wall", 11, 5.0), *joined;
    const nook_scene_part part = { alone, true };
    assert_int_equal(nook_scene_join("joined", &part, 1, NULL, 0, &joined), NOOK_OK);
    assert_string_equal(joined->path, "joined");
    assert_int_equal(joined->vertex_count, like->vertex_count);
    assert_memory_equal(joined->vertices, like->vertices, like->vertex_count * sizeof *like->vertices);
    assert_memory_equal(joined->indices, like->indices, like->index_count * sizeof *like->indices);
    assert_memory_equal(joined->primitives, like->primitives, like->primitive_count * sizeof *like->primitives);
    assert_memory_equal(joined->bounds_max, like->bounds_max, sizeof like->bounds_max);
    assert_int_equal(joined->triangle_count, like->triangle_count);
    assert_int_equal(joined->node_count, like->node_count);
    assert_int_equal(joined->file_node_count, like->file_node_count);
    nook_scene_destroy(alone);
    nook_scene_destroy(like);
    nook_scene_destroy(joined);
}

static void test_what_stands_in_both_stands_in_the_joined_one(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    static const char *const names[] = { "wall", "door", "lamp", "eye", "other wall", "door", "lamp", "eye" };
    assert_int_equal(p.joined->node_count, 8);
    for (int i = 0; i < 8; i++)
        assert_string_equal(p.joined->nodes[i].name, names[i]);
    assert_int_equal(p.joined->nodes[5].parent, 4);
    assert_int_equal(p.joined->nodes[1].parent, 0);
    assert_int_equal(p.joined->nodes[4].parent, NOOK_NONE);
    assert_int_equal(p.joined->nodes[5].mesh, 3);
    assert_int_equal(p.joined->nodes[6].mesh, NOOK_NONE);
    assert_true(p.joined->bounds_min[0] == -7.0 && p.joined->bounds_max[0] == 6.0);
    assert_int_equal(p.joined->triangle_count, 8);
    destroy(&p);
}

static void test_mass_hung_and_moving_come_with_their_nodes(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    assert_true(p.joined->nodes[4].mass == 12.5 && p.joined->nodes[4].hung && !p.joined->nodes[4].moving);
    assert_true(p.joined->nodes[5].mass == 0.0 && !p.joined->nodes[5].hung && p.joined->nodes[5].moving);
    destroy(&p);
}

static void test_triangles_are_those_of_their_own_vertices(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    const nook_primitive *mine = &p.joined->primitives[3], *was = &p.second->primitives[1];
    assert_int_equal(p.joined->primitive_count, 4);
    assert_int_equal(mine->first_vertex, was->first_vertex + p.first->vertex_count);
    assert_int_equal(mine->first_index, was->first_index + p.first->index_count);
    assert_memory_equal(p.joined->vertices + mine->first_vertex, p.second->vertices + was->first_vertex,
                        was->vertex_count * sizeof(nook_vertex));
    assert_memory_equal(p.joined->indices + mine->first_index, p.second->indices + was->first_index,
                        was->index_count * sizeof(uint32_t));
    assert_int_equal(p.joined->meshes[3].first_primitive, 3);
    assert_string_equal(p.joined->meshes[3].name, "painted");
    destroy(&p);
}

static void test_materials_and_pictures_are_their_own_and_the_default_stays_last(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    const nook_scene *s = p.joined;
    assert_int_equal(s->material_count, 4);
    assert_int_equal(s->primitives[1].material, 0);
    assert_int_equal(s->primitives[2].material, 3);
    assert_int_equal(s->primitives[3].material, 2);
    assert_int_equal(s->materials[0].base_colour_image, 0);
    assert_int_equal(s->materials[2].base_colour_image, 1);
    assert_int_equal(s->materials[2].normal_image, NOOK_NONE);
    assert_string_equal(s->materials[2].name, "paint");
    assert_int_equal(s->image_count, 2);
    assert_int_equal(s->images[0].pixels[0], 11);
    assert_int_equal(s->images[1].pixels[0], 99);
    assert_null(p.first->images[0].pixels); /* moved, not copied */
    destroy(&p);
}

static void test_lights_and_cameras_belong_to_their_nodes(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    assert_int_equal(p.joined->light_count, 2);
    assert_true(p.joined->lights[0].intensity == 11.0f && p.joined->lights[1].intensity == 99.0f);
    assert_int_equal(p.joined->nodes[6].light, 1);
    assert_int_equal(p.joined->nodes[2].light, 0);
    assert_int_equal(p.joined->camera_count, 2);
    assert_int_equal(p.joined->nodes[7].camera, 1);
    assert_string_equal(p.joined->cameras[1].name, "eye");
    destroy(&p);
}

static void test_files_are_those_of_both_each_once(void **state)
{
    (void)state;
    pair p = join(true, NULL, 0);
    assert_int_equal(p.first->file_count, 1);
    assert_string_equal(p.first->files[0], p.second->files[0]); /* the test writes over its file */
    assert_int_equal(p.joined->file_count, 1);
    assert_string_equal(p.joined->files[0], p.first->files[0]);
    destroy(&p);
}

static void test_a_library_brings_meshes_and_no_nodes(void **state)
{
    (void)state;
    pair p = join(false, NULL, 0);
    assert_int_equal(p.joined->node_count, 4);
    assert_int_equal(p.joined->mesh_count, 4);
    assert_int_equal(p.joined->light_count, 1);
    assert_int_equal(p.joined->camera_count, 1);
    assert_true(p.joined->bounds_min[0] == 5.0);
    destroy(&p);
}

static void test_scenes_made_by_code_are_joined_as_well(void **state)
{
    (void)state;
    static const uint32_t indices[] = { 0, 1, 2 };
    nook_scene *made, *joined;
    pair p = join(true, NULL, 0);
    assert_int_equal(nook_scene_from_triangles("made", test_quad_positions, 4, indices, 3, &made), NOOK_OK);
    const nook_scene_part parts[] = { { made, true }, { p.first, true } };
    assert_int_equal(nook_scene_join("joined", parts, 2, NULL, 0, &joined), NOOK_OK);
    assert_int_equal(joined->node_count, 5);
    assert_int_equal(joined->light_count, 1);
    assert_int_equal(joined->nodes[3].light, 0);
    nook_scene_destroy(made);
    nook_scene_destroy(joined);
    destroy(&p);
}

static void test_instances_draw_the_mesh_of_their_node_where_they_are_put(void **state)
{
    (void)state;
    const nook_scene_instance instances[] = { { "gate", 1, 0, nook_matrix_translation(0, 0, 40), true },
                                              { "sign", 0, 1, nook_matrix_translation(0, 50, 0), false } };
    pair p = join(false, instances, 2);
    const nook_node *gate = &p.joined->nodes[4], *sign = &p.joined->nodes[5];
    assert_int_equal(p.joined->node_count, 6);
    assert_string_equal(gate->name, "gate");
    assert_int_equal(gate->mesh, 2);
    assert_true(gate->moving && gate->mass == 12.5 && gate->hung);
    assert_int_equal(gate->parent, NOOK_NONE);
    assert_int_equal(gate->light, NOOK_NONE);
    assert_int_equal(sign->mesh, 1);
    assert_false(sign->moving);
    assert_true(p.joined->bounds_max[2] == 40.0 && p.joined->bounds_max[1] == 51.0);
    destroy(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_scene_alone_stays_as_it_is),
        cmocka_unit_test(test_what_stands_in_both_stands_in_the_joined_one),
        cmocka_unit_test(test_mass_hung_and_moving_come_with_their_nodes),
        cmocka_unit_test(test_triangles_are_those_of_their_own_vertices),
        cmocka_unit_test(test_materials_and_pictures_are_their_own_and_the_default_stays_last),
        cmocka_unit_test(test_lights_and_cameras_belong_to_their_nodes),
        cmocka_unit_test(test_files_are_those_of_both_each_once),
        cmocka_unit_test(test_a_library_brings_meshes_and_no_nodes),
        cmocka_unit_test(test_scenes_made_by_code_are_joined_as_well),
        cmocka_unit_test(test_instances_draw_the_mesh_of_their_node_where_they_are_put),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
