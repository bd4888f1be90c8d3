#include "modules/ao/ecs/occluder.h"
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { CAPACITY = 4 };

typedef struct scene {
    nook_world *world;
    nook_component both[2]; /* transform, volume occluder */
    nook_ao_occluder items[CAPACITY];
    const nook_occluder_list *list;
} scene;

static void make_scene(scene *s)
{
    *s = (scene){ 0 };
    assert_int_equal(nook_world_create(NULL, &s->world), NOOK_OK);
    assert_int_equal(nook_world_component(s->world, NOOK_TYPE_OF(nook_transform), &s->both[0]), NOOK_OK);
    assert_int_equal(nook_world_component(s->world, NOOK_TYPE_OF(nook_volume_occluder), &s->both[1]), NOOK_OK);
    assert_int_equal(nook_occluders_set_up(s->world, s->items, CAPACITY), NOOK_OK);
    s->list = nook_world_resource(s->world, NOOK_TYPE_OF(nook_occluder_list));
}

static nook_entity add_body(scene *s, uint32_t volume, uint32_t mesh, double x)
{
    nook_entity entity;
    assert_int_equal(nook_entity_create(s->world, s->both, 2, 1, &entity), NOOK_OK);
    nook_transform *transform = nook_entity_find(s->world, entity, s->both[0]);
    for (int i = 0; i < 4; i++)
        transform->world_from_local[5 * i] = 1;
    transform->world_from_local[12] = x;
    *(nook_volume_occluder *)nook_entity_find(s->world, entity, s->both[1]) =
        (nook_volume_occluder){ { volume }, { mesh } };
    return entity;
}

static void collect(scene *s)
{
    assert_int_equal(nook_world_run_phase(s->world, NOOK_PHASE_PRE_RENDER), NOOK_OK);
}

static void test_occluders_are_collected_with_their_transform(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    nook_entity body = add_body(&s, 5, 6, 1e9 + 0.125); /* lost in float */
    collect(&s);
    assert_int_equal(s.list->count, 1);
    assert_int_equal(s.items[0].volume.id, 5);
    assert_int_equal(s.items[0].mesh.id, 6);
    assert_true(s.items[0].world_from_mesh[12] == 1e9 + 0.125);
    assert_memory_equal(s.items[0].world_from_mesh, nook_entity_find(s.world, body, s.both[0]),
                        sizeof s.items[0].world_from_mesh);
    nook_world_destroy(s.world);
}

static void test_occluder_list_starts_empty_every_frame(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    nook_entity first = add_body(&s, 1, 1, 0);
    add_body(&s, 2, 2, 0);
    collect(&s);
    collect(&s);
    assert_int_equal(s.list->count, 2);
    assert_int_equal(nook_entity_destroy(s.world, first), NOOK_OK);
    collect(&s);
    assert_int_equal(s.list->count, 1);
    assert_int_equal(s.items[0].volume.id, 2);
    nook_world_destroy(s.world);
}

static void test_bodies_without_volume_and_mesh_are_left_out(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    add_body(&s, 0, 0, 0);
    add_body(&s, 3, 0, 0);
    add_body(&s, 0, 4, 0);
    collect(&s);
    assert_int_equal(s.list->count, 2);
    assert_int_equal(s.items[0].volume.id, 3);
    assert_int_equal(s.items[1].mesh.id, 4);
    nook_world_destroy(s.world);
}

static void test_occluders_that_do_not_fit_are_counted(void **state)
{
    (void)state;
    scene s;
    make_scene(&s);
    for (uint32_t i = 0; i < CAPACITY + 3; i++)
        add_body(&s, i + 1, 0, 0);
    collect(&s);
    assert_int_equal(s.list->count, CAPACITY);
    assert_int_equal(s.list->dropped, 3);
    collect(&s);
    assert_int_equal(s.list->dropped, 3);
    nook_world_destroy(s.world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_occluders_are_collected_with_their_transform),
        cmocka_unit_test(test_occluder_list_starts_empty_every_frame),
        cmocka_unit_test(test_bodies_without_volume_and_mesh_are_left_out),
        cmocka_unit_test(test_occluders_that_do_not_fit_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
