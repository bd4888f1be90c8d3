/* A body that spins for a million frames, through the ECS as in the game: does it drift, does its shadow? */
#include "engine/core/angle.h"
#include "engine/core/rotation.h"
#include "engine/core/vector.h"
#include "engine/ecs/spin.h"
#include "engine/ecs/world.h"
#include "game/extremes/groups.h"
#include "modules/ao_volume/volume.h"
#include "modules/fixture/receiver.h"
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double axis[3] = { 0.48, -0.6, 0.64 }; /* unit */
static const double pivot[3] = { 0.1, 0.2, 0.6 };

enum {
    FRAMES = 1000000,
    FRAMES_PER_TURN = 1000,
    STRIDE = 997,         /* frames between looks at the matrix: 1003 looks, at every angle there is */
    STRIDE_WHOLE = 25000, /* at its shadow: after whole turns, 40 looks */
    PIXELS = 16,
    RAYS = 64
};

/* ---- The body --------------------------------------------------------------------------------------------------- */

typedef struct body {
    nook_world *world;
    nook_entity entity;
    nook_component spin, transform;
} body;

/* A second is a turn, and a thousand frames. The body starts as `start`. */
static nook_result fill(body *b, const nook_matrix *start)
{
    const nook_time_step step = { 1.0 / FRAMES_PER_TURN };
    nook_spin spin = { .rotation = { 0, 0, 0, 1 } };
    nook_transform transform;
    for (int i = 0; i < 3; i++) {
        spin.pivot[i] = pivot[i];
        spin.angular_velocity[i] = 2.0 * NOOK_PI * axis[i];
    }
    memcpy(spin.world_from_start, start->m, sizeof spin.world_from_start);
    memcpy(transform.world_from_local, start->m, sizeof transform.world_from_local);
    nook_result result = nook_world_component(b->world, NOOK_TYPE_OF(nook_spin), &b->spin);
    if (result == NOOK_OK)
        result = nook_world_component(b->world, NOOK_TYPE_OF(nook_transform), &b->transform);
    if (result == NOOK_OK)
        result = nook_world_set_resource(b->world, NOOK_TYPE_OF(nook_time_step), &step);
    if (result == NOOK_OK)
        result = nook_world_add_system(b->world, &nook_advance_spins);
    if (result == NOOK_OK)
        result = nook_entity_create(b->world, (nook_component[]){ b->spin, b->transform }, 2, 1, &b->entity);
    if (result == NOOK_OK)
        result = nook_entity_add(b->world, b->entity, b->spin, &spin);
    return result == NOOK_OK ? nook_entity_add(b->world, b->entity, b->transform, &transform) : result;
}

static nook_result create_body(const nook_matrix *start, body *out)
{
    body b = { 0 };
    nook_result result = nook_world_create(&(nook_world_desc){ .threads = 1 }, &b.world);
    if (result == NOOK_OK)
        result = fill(&b, start);
    if (result == NOOK_OK)
        *out = b;
    else
        nook_world_destroy(b.world);
    return result;
}

static nook_matrix transform_of(const body *b)
{
    nook_matrix m;
    const nook_transform *transform = nook_entity_find(b->world, b->entity, b->transform);
    memcpy(m.m, transform->world_from_local, sizeof m.m);
    return m;
}

typedef nook_result (*look_at)(void *user, const nook_matrix *world_from_local, uint32_t frame);

/* Looks at the body in every frame that is a multiple of `stride`. */
static nook_result spin(const nook_extremes *extremes, body *b, uint32_t stride, void *user, look_at look)
{
    nook_result result = NOOK_OK;
    for (uint32_t frame = 1; frame <= FRAMES && result == NOOK_OK; frame++) {
        result = nook_world_run_phase(b->world, NOOK_PHASE_UPDATE);
        if (result != NOOK_OK || frame % stride != 0)
            continue;
        nook_matrix now = transform_of(b);
        result = look(user, &now, frame);
        nook_extreme_progress(extremes, (double)frame / FRAMES);
    }
    return result;
}

/* ---- Its axes and its angle ------------------------------------------------------------------------------------- */

static nook_result look_at_axes(void *user, const nook_matrix *m, uint32_t frame)
{
    for (int a = 0; a < 3; a++)
        for (int b = a; b < 3; b++)
            nook_extreme_worst(user, fabs(nook_vector_dot(m->m + 4 * a, m->m + 4 * b) - (a == b)),
                               "columns %d and %d in frame %u", a, b, frame);
    return NOOK_OK;
}

/* v turned about the axis, by Rodrigues' formula in long double: v cos a + (k x v) sin a + k (k . v) (1 - cos a). */
static void turn_exactly(long double angle, const double v[3], long double out[3])
{
    const long double c = cosl(angle), s = sinl(angle);
    long double k[3], length = 0.0L, along = 0.0L;
    for (int i = 0; i < 3; i++)
        length += (long double)axis[i] * axis[i];
    for (int i = 0; i < 3; i++)
        k[i] = axis[i] / sqrtl(length), along += k[i] * v[i];
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, l = (i + 2) % 3;
        out[i] = v[i] * c + (k[j] * v[l] - k[l] * v[j]) * s + k[i] * along * (1.0L - c);
    }
}

/* Where frame `frame` should be: the whole turns are left out of the angle before anything is rounded. */
static nook_result look_at_angle(void *user, const nook_matrix *m, uint32_t frame)
{
    const long double angle = 2.0L * acosl(-1.0L) * (frame % FRAMES_PER_TURN) / FRAMES_PER_TURN;
    for (int i = 0; i < 3; i++) { /* a point a metre off the axis of rotation moves by the angle's error */
        double arm[3] = { 0, 0, 0 }, across[3];
        long double expected[3], off = 0.0L;
        arm[i] = 1.0;
        nook_vector_cross(axis, arm, across);
        nook_vector_normalize(across, across);
        turn_exactly(angle, across, expected);
        for (int row = 0; row < 3; row++) {
            long double got = -expected[row];
            for (int column = 0; column < 3; column++)
                got += (long double)m->m[column * 4 + row] * across[column];
            off += got * got;
        }
        nook_extreme_worst(user, (double)sqrtl(off), "frame %u", frame);
    }
    return NOOK_OK;
}

static nook_result run_spin(const nook_extremes *extremes, nook_extreme_found *out_found, look_at look)
{
    const nook_matrix start = nook_matrix_identity();
    body b;
    nook_result result = create_body(&start, &b);
    if (result != NOOK_OK)
        return result;
    result = spin(extremes, &b, STRIDE, out_found, look);
    nook_world_destroy(b.world);
    return result;
}

static nook_result run_axes(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = 8.0 * DBL_EPSILON;
    return run_spin(extremes, out_found, look_at_axes);
}

static nook_result run_angle(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    out_found->bound = sqrt(FRAMES) * DBL_EPSILON;
    return run_spin(extremes, out_found, look_at_angle);
}

/* ---- Its shadow ------------------------------------------------------------------------------------------------- */

typedef struct shadow {
    nook_extreme_found *found;
    nook_fixture_view *view;
    float first[PIXELS * PIXELS];
} shadow;

/* The floor under the body, which occludes as the only one: the body's own matrix in this frame. */
static nook_result measure_shadow(shadow *s, const nook_matrix *world_from_local, uint32_t frame)
{
    const nook_fixture_receiver floor = { .normal = { 0, 0, 1 }, .distance = 0.2 };
    nook_fixture_occlusion unused;
    memcpy(s->view->occluders[0].world_from_mesh, world_from_local->m, sizeof world_from_local->m);
    nook_result result = nook_fixture_measure(s->view, "volume", &floor, &unused);
    if (result == NOOK_OK)
        nook_extreme_check_view(s->found, s->view, "frame %u", frame);
    return result;
}

static double difference(const shadow *s)
{
    double sum = 0.0;
    for (int i = 0; i < PIXELS * PIXELS; i++)
        sum += pow(s->view->visibility[i] - s->first[i], 2.0);
    return sqrt(sum / (PIXELS * PIXELS));
}

static nook_result look_at_shadow(void *user, const nook_matrix *world_from_local, uint32_t frame)
{
    shadow *s = user;
    nook_result result = measure_shadow(s, world_from_local, frame);
    if (result == NOOK_OK)
        nook_extreme_worst(s->found, difference(s), "frame %u, %u whole turns", frame, frame / FRAMES_PER_TURN);
    return result;
}

/* Before it spins: the picture to come back to, and that it is another one a quarter of a turn later. */
static nook_result look_at_first(shadow *s, const nook_matrix *start)
{
    nook_result result = measure_shadow(s, start, 0);
    if (result != NOOK_OK)
        return result;
    memcpy(s->first, s->view->visibility, sizeof s->first);
    double quarter[4] = { 0, 0, 0, 1 };
    nook_rotation_advance(quarter, axis, 0.5 * NOOK_PI);
    nook_matrix turn = nook_rotation_matrix(quarter), turned = nook_matrix_multiply(&turn, start);
    memcpy(turned.m + 12, start->m + 12, 3 * sizeof(double));
    result = measure_shadow(s, &turned, FRAMES_PER_TURN / 4);
    if (result == NOOK_OK && !(difference(s) > 0.02))
        nook_extreme_worst(s->found, INFINITY, "a quarter turn changes nothing: this body shows no drift");
    return result;
}

static nook_result set_up_view(nook_fixture_view *view)
{
    nook_fixture_mesh mesh = { 0 };
    char rays[16];
    snprintf(rays, sizeof rays, "%d", RAYS);
    nook_fixture_add_box(&mesh, (double[]){ -0.5, -0.2, -0.1 }, (double[]){ 0.5, 0.2, 0.1 }, 63);
    nook_result result = nook_fixture_view_add(view, &mesh, 48, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    if (result == NOOK_OK)
        result = nook_ao_parse_param(view->ao, "ao.filter", "none");
    if (result == NOOK_OK)
        result = nook_ao_parse_param(view->ao, "ao.r_max", "2");
    return result == NOOK_OK ? nook_ao_parse_param(view->ao, "volume.rays", rays) : result;
}

static nook_result run_shadow(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const nook_ao_technique *const techniques[] = { &nook_ao_volume_technique };
    const nook_fixture_view_desc desc = {
        .gpu = extremes->gpu, .width = PIXELS, .height = PIXELS, .techniques = techniques, .technique_count = 1
    };
    const nook_matrix start = nook_matrix_translation(pivot[0], pivot[1], pivot[2]);
    shadow s = { .found = out_found };
    body b = { 0 };
    out_found->bound = sqrt(1.0 / (PIXELS * PIXELS)) / RAYS;
    nook_result result = nook_fixture_view_create(&desc, &s.view);
    if (result == NOOK_OK)
        result = set_up_view(s.view);
    if (result == NOOK_OK)
        result = look_at_first(&s, &start);
    if (result == NOOK_OK)
        result = create_body(&start, &b);
    if (result == NOOK_OK)
        result = spin(extremes, &b, STRIDE_WHOLE, &s, look_at_shadow);
    nook_world_destroy(b.world);
    nook_fixture_view_destroy(s.view);
    return result;
}

static const nook_extreme cases[] = {
    { .name = "a body that spins for a million frames keeps its axes of unit length at right angles",
      .unit = "off orthonormal",
      .why = "its matrix is made anew from a unit quaternion each frame: 8 roundings of 2.2e-16, however many frames",
      .run = run_axes },
    { .name = "a body that spins for a million frames is where its closed form says",
      .unit = "radians",
      .why = "a frame rounds by 2.2e-16, to any side: a million add up as their root, 2.2e-13. By Rodrigues' formula "
             "in 80 bits",
      .run = run_angle },
    { .name = "a body that spins for a million frames occludes after whole turns as at first",
      .unit = "RMS of visibility",
      .why =
          "2e-13 radians are 1e-11 of a voxel, less than a float of the matrix: at most one ray of one pixel may flip",
      .run = run_shadow },
};

const nook_extreme_group nook_extreme_spinning = { "spinning", cases, NOOK_COUNT(cases) };
