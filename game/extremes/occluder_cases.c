/* From one occluder over a point to 4096 of them: what union and product of them must keep. */
#include "game/extremes/edge_receiver.h"
#include "game/extremes/groups.h"
#include "game/extremes/random_transform.h"
#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>

enum { MOST = 4096, MOST_QUICK = 256, PIXELS = NOOK_EDGE_PIXELS * NOOK_EDGE_PIXELS };
static const char *const unions[] = { "volume rays=4", "volume rays=10 stepping=fixed", "volume rays=4 guard=slab" };
static const char *const product = "volume rays=4 combine=multiply";
static const char *const falloffs[] = { "hard", "wendland" };

static uint32_t most(const nook_extremes *extremes)
{
    return extremes->quick ? MOST_QUICK : MOST;
}

/* ---- Piling up -------------------------------------------------------------------------------------------------- */

/* A crate that hides some of the sky, as the only occluder. */
static nook_result show_crate(nook_edge_receiver *receiver)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_view_drop_occluders(receiver->view);
    nook_fixture_add_box(&mesh, (double[]){ -0.1, -0.15, 0.3 }, (double[]){ 0.2, 0.1, 0.5 }, 63);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, 12, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    return result;
}

/* More of the crate, up to `count`: all in one place, or scattered around by a fixed sequence. */
static nook_result pile_up(nook_edge_receiver *receiver, uint32_t count, bool scattered)
{
    nook_result result = NOOK_OK;
    nook_random random = { 7 };
    for (uint32_t i = 1; i < count && result == NOOK_OK; i++) {
        nook_matrix place = nook_matrix_identity();
        if (scattered) {
            double x = nook_random_between(&random, -1.5, 1.5), y = nook_random_between(&random, -1.5, 1.5);
            nook_matrix move = nook_matrix_translation(x, y, nook_random_between(&random, 0.5, 1.5));
            nook_matrix shrink = nook_matrix_scale(0.1, 0.1, 0.1);
            place = nook_matrix_multiply(&move, &shrink);
        }
        if (i >= receiver->view->occluder_count)
            result = nook_fixture_view_add_instance(receiver->view, 0, &place);
    }
    return result;
}

/* Records; the picture is in view->visibility. */
static nook_result record(nook_edge_receiver *receiver, const char *what)
{
    nook_fixture_occlusion unused;
    return nook_edge_receiver_measure(receiver, &unused, "%u occluders, %s", receiver->view->occluder_count, what);
}

static void keep(const nook_edge_receiver *receiver, float out[PIXELS])
{
    memcpy(out, receiver->view->visibility, PIXELS * sizeof *out);
}

static uint32_t count_different(const nook_edge_receiver *receiver, const float other[PIXELS])
{
    uint32_t different = 0;
    for (int i = 0; i < PIXELS; i++)
        different += memcmp(&receiver->view->visibility[i], &other[i], sizeof *other) != 0;
    return different;
}

/* ---- Identical ones --------------------------------------------------------------------------------------------- */

static nook_result look_at_identical(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    nook_result result = NOOK_OK;
    for (size_t way = 0; way < NOOK_COUNT(unions) * NOOK_COUNT(falloffs) && result == NOOK_OK; way++) {
        float one[PIXELS];
        const char *falloff = falloffs[way % NOOK_COUNT(falloffs)];
        result = show_crate(receiver);
        if (result == NOOK_OK)
            result = nook_edge_receiver_set(receiver, 2.0, "%s", unions[way / NOOK_COUNT(falloffs)]);
        if (result == NOOK_OK)
            result = nook_ao_parse_param(receiver->view->ao, "ao.falloff", falloff);
        for (uint32_t count = 1; count <= most(extremes) && result == NOOK_OK; count *= 2) {
            result = pile_up(receiver, count, false);
            if (result == NOOK_OK)
                result = record(receiver, falloff);
            if (count == 1)
                keep(receiver, one);
            if (result == NOOK_OK)
                nook_extreme_worst(receiver->found, count_different(receiver, one), "%u of them, %s, %s", count,
                                   unions[way / NOOK_COUNT(falloffs)], falloff);
        }
    }
    return result;
}

static nook_result run_identical(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_identical);
}

/* The product of a pixel's visibility with itself; each factor rounds once, and what a float cannot hold is 0. */
static double excess_of_power(double measured, double one, uint32_t count)
{
    double exact = pow(one, count), allowed = exact * (count + 1) * 0.5 * FLT_EPSILON + FLT_MIN;
    return fabs(measured - exact) / allowed;
}

/* Pixels that are 0 where a float can hold what they should be. */
static uint32_t count_vanished(const nook_edge_receiver *receiver, const float one[PIXELS], uint32_t count)
{
    uint32_t vanished = 0;
    for (int k = 0; k < PIXELS; k++)
        vanished +=
            receiver->view->visibility[k] == 0.0f && pow(one[k], count) > (double)FLT_MIN * (1.0 + count * 1e-7);
    return vanished;
}

static nook_result look_at_powers(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    receiver->found->bound = 1.0;
    uint32_t vanished = 0;
    nook_result result = NOOK_OK;
    /* At the edge of r_max smooth falloff gives factors near 1, a little farther in the product vanishes. */
    static const double reaches[] = { 0.305, 0.33, 0.5, 2.0 };
    for (size_t i = 0; i < NOOK_COUNT(reaches) && result == NOOK_OK; i++) {
        float one[PIXELS];
        result = show_crate(receiver);
        if (result == NOOK_OK)
            result = nook_edge_receiver_set(receiver, reaches[i], "%s", product);
        if (result == NOOK_OK)
            result = nook_ao_parse_param(receiver->view->ao, "ao.falloff", "wendland");
        for (uint32_t count = 1; count <= most(extremes) && result == NOOK_OK; count *= 2) {
            result = pile_up(receiver, count, false);
            if (result == NOOK_OK)
                result = record(receiver, "product");
            if (count == 1)
                keep(receiver, one);
            vanished += count_vanished(receiver, one, count);
            for (int k = 0; k < PIXELS && result == NOOK_OK; k++)
                nook_extreme_worst(receiver->found, excess_of_power(receiver->view->visibility[k], one[k], count),
                                   "%u of them, each %g", count, one[k]);
        }
    }
    nook_extreme_state(receiver->found, 0.0, 0.0, vanished, "pixels that are 0 for a product of over 1.2e-38");
    return result;
}

static nook_result run_powers(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_powers);
}

/* ---- Different ones --------------------------------------------------------------------------------------------- */

static nook_result look_at_more(const nook_extremes *extremes, nook_edge_receiver *receiver, const char *way,
                                double rounding)
{
    float fewer[PIXELS];
    nook_result result = show_crate(receiver);
    if (result == NOOK_OK)
        result = nook_edge_receiver_set(receiver, 2.0, "%s", way);
    for (uint32_t count = 1; count <= most(extremes) && result == NOOK_OK; count *= 2) {
        result = pile_up(receiver, count, true);
        if (result == NOOK_OK)
            result = record(receiver, way);
        for (int k = 0; k < PIXELS && count > 1 && result == NOOK_OK; k++)
            nook_extreme_worst(receiver->found, receiver->view->visibility[k] - fewer[k] * (1.0 + rounding * count),
                               "%u occluders, %s", count, way);
        keep(receiver, fewer);
    }
    return result;
}

static nook_result look_at_growing(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    nook_result result = look_at_more(extremes, receiver, product, 0.5 * FLT_EPSILON);
    for (size_t way = 0; way < NOOK_COUNT(unions) && result == NOOK_OK; way++)
        result = look_at_more(extremes, receiver, unions[way], 0.0);
    return result;
}

static nook_result run_growing(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_growing);
}

/* Swaps occluders by a fixed sequence. */
static void shuffle(nook_fixture_view *view)
{
    nook_random random = { 11 };
    for (uint32_t i = view->occluder_count - 1; i > 0; i--) {
        uint32_t k = (uint32_t)nook_random_between(&random, 0.0, i + 1.0);
        nook_ao_occluder held = view->occluders[i];
        view->occluders[i] = view->occluders[k];
        view->occluders[k] = held;
    }
}

static nook_result look_at_order(const nook_extremes *extremes, nook_edge_receiver *receiver, const char *way,
                                 double rounding)
{
    float before[PIXELS];
    nook_result result = show_crate(receiver);
    if (result == NOOK_OK)
        result = pile_up(receiver, most(extremes), true);
    if (result == NOOK_OK)
        result = nook_edge_receiver_set(receiver, 2.0, "%s", way);
    if (result == NOOK_OK) /* smooth: so many hide all of the sky, and only distances are left to differ */
        result = nook_ao_parse_param(receiver->view->ao, "ao.falloff", "wendland");
    if (result == NOOK_OK)
        result = record(receiver, way);
    keep(receiver, before);
    shuffle(receiver->view);
    if (result == NOOK_OK)
        result = record(receiver, way);
    for (int k = 0; k < PIXELS && result == NOOK_OK; k++) {
        double moved = fabs((double)receiver->view->visibility[k] - before[k]);
        nook_extreme_worst(receiver->found, moved - rounding * before[k], "%u shuffled, %s: by %g",
                           receiver->view->occluder_count, way, moved);
    }
    return result;
}

static nook_result look_at_orders(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    /* Two products of the same factors: each has rounded that often. */
    nook_result result = look_at_order(extremes, receiver, product, most(extremes) * (double)FLT_EPSILON);
    for (size_t way = 0; way < NOOK_COUNT(unions) && result == NOOK_OK; way++)
        result = look_at_order(extremes, receiver, unions[way], 0.0);
    return result;
}

static nook_result run_orders(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_orders);
}

/* ---- One that is none ------------------------------------------------------------------------------------------- */

static nook_result look_at_singular(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    static const double flat[4] = { 0.0, NAN, INFINITY, 1e-320 }; /* instead of the matrix's z axis */
    nook_result result = show_crate(receiver);
    if (result == NOOK_OK)
        result = pile_up(receiver, most(extremes) - 1, true);
    for (size_t way = 0; way < 2 * NOOK_COUNT(flat) && result == NOOK_OK; way++) {
        float before[PIXELS];
        nook_fixture_view *view = receiver->view;
        const nook_matrix crushed = nook_matrix_scale(1.0, 1.0, flat[way / 2]);
        result = nook_edge_receiver_set(receiver, 2.0, "%s", way % 2 ? product : unions[0]);
        if (result == NOOK_OK)
            result = record(receiver, "none singular");
        keep(receiver, before);
        if (result == NOOK_OK)
            result = nook_fixture_view_add_instance(view, 0, &crushed);
        if (result != NOOK_OK)
            break;
        uint32_t middle = view->occluder_count / 2, behind = view->occluder_count - 1 - middle;
        nook_ao_occluder *place = view->occluders + middle, added = place[behind];
        memmove(place + 1, place, behind * sizeof added);
        *place = added;
        result = record(receiver, "one singular");
        if (result == NOOK_OK)
            nook_extreme_worst(receiver->found, count_different(receiver, before), "%u occluders, one of z axis %g, %s",
                               view->occluder_count, flat[way / 2], way % 2 ? product : unions[0]);
        memmove(place, place + 1, behind * sizeof added);
        view->occluder_count--;
    }
    return result;
}

static nook_result run_singular(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_singular);
}

/* ---- All of them on every ray ----------------------------------------------------------------------------------- */

/* A volume of 64 voxels a side around the receiver, all of it air but two specks in its corners. */
static nook_result add_air(nook_edge_receiver *receiver)
{
    nook_fixture_mesh mesh = { 0 };
    for (int side = 0; side < 2; side++) {
        double p = side ? 1.0 : -1.0;
        nook_fixture_add_triangle(&mesh, (double[]){ p, p, p }, (double[]){ p, p, p }, (double[]){ p, p, p });
    }
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, 64, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    return result;
}

/* Far around all of them. */
static nook_result add_walls(nook_edge_receiver *receiver)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_add_box(&mesh, (double[]){ -4, -4, 0 }, (double[]){ 4, 4, 8 }, 63);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, 32, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    return result;
}

static nook_result look_through_air(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    static const char *const ways[] = { "volume rays=4 steps=256", "volume rays=4 steps=256 combine=multiply" };
    nook_result result = NOOK_OK;
    static const uint32_t counts[] = { 16, 128, 512, MOST };
    for (size_t i = 0; i < NOOK_COUNT(counts) - extremes->quick && result == NOOK_OK; i++) {
        const uint32_t count = counts[i];
        nook_fixture_view_drop_occluders(receiver->view);
        result = add_air(receiver);
        const nook_matrix here = nook_matrix_identity();
        for (uint32_t k = 2; k < count && result == NOOK_OK; k++)
            result = nook_fixture_view_add_instance(receiver->view, 0, &here);
        if (result == NOOK_OK)
            result = add_walls(receiver); /* the last in the list */
        for (size_t way = 0; way < NOOK_COUNT(ways) && result == NOOK_OK; way++) {
            nook_fixture_occlusion occlusion = { 0 };
            result = nook_edge_receiver_set(receiver, 20.0, "%s", ways[way]);
            if (result == NOOK_OK)
                result = nook_edge_receiver_measure(receiver, &occlusion, "%u occluders", count);
            if (result == NOOK_OK)
                nook_extreme_worst(receiver->found, 1.0 - occlusion.lowest, "%u occluders, %s", count, ways[way]);
        }
    }
    return result;
}

static nook_result run_air(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_through_air);
}

static const nook_extreme cases[] = {
    { .name = "the union of 1 to 4096 identical occluders is that of one",
      .unit = "pixels that differ",
      .why = "the nearest of equal hits is each of them: not a bit may differ, with hard and smooth falloff",
      .run = run_identical },
    { .name = "the product of 1 to 4096 visibilities is their power, or 0 below 1.2e-38",
      .unit = "of the rounding",
      .why = "each factor rounds once to 24 bits; what no normal float holds, below 1.2e-38, may become 0",
      .limit =
          "combine=multiply: a product of visibilities below 1.2e-38 is 0; that is 127 volumes of which each lets half "
          "through.",
      .run = run_powers },
    { .name = "no pixel gets lighter by more occluders, up to 4096, by union or by product",
      .unit = "visibility gained",
      .why = "nearer hits and factors up to 1; products round once a factor, unions of hard falloff not at all",
      .run = run_growing },
    { .name = "the order of 4096 occluders does not show",
      .unit = "visibility moved",
      .why = "a minimum has no order: not a bit may differ; products have rounded once a factor each",
      .run = run_orders },
    { .name = "one singular matrix among 4096 occluders is left out, and nothing else is",
      .unit = "pixels that differ",
      .why = "the others are what they were, in their order: not a bit may differ",
      .run = run_singular },
    { .name = "rays through 4096 volumes of air still see the walls behind them",
      .unit = "1 - A",
      .why = "in a closed box every ray hits, however many samples it takes before: exactly 1",
      .run = run_air },
};

const nook_extreme_group nook_extreme_occluders = { "occluders", cases, NOOK_COUNT(cases) };
