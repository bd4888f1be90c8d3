/* Volumes of every size and shape: cubes, slabs and needles of 1 to 512 voxels; empty, full, or one voxel. */
#include "game/extremes/edge_receiver.h"
#include "game/extremes/groups.h"
#include "game/extremes/voxel_forms.h"
#include "modules/bake/voxelize.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const uint32_t sides[] = { 1,  2,  3,  4,  5,  7,   8,   9,   15,  16,  17,  31,  32,
                                  33, 63, 64, 65, 96, 127, 128, 129, 255, 256, 257, 511, 512 };
enum { CLOSED_SIDE = 4 }; /* from here on a closed box is closed */

static size_t side_count(const nook_extremes *extremes)
{
    size_t count = 0;
    while (count < NOOK_COUNT(sides) && sides[count] <= (extremes->quick ? 65u : NOOK_VOXELIZE_RESOLUTION_MAX))
        count++;
    return count;
}

/* Cubes, slabs and needles: bit i of a shape says that side i is one voxel and not the whole length. */
enum { CUBE = 0, SHAPES = 7, NEEDLE_X = 6, SLAB_Z = 4 };
static const char *const shape_names[SHAPES] = { "cube",          "slab along yz",  "slab along xz", "needle along z",
                                                 "slab along xy", "needle along y", "needle along x" };

/* A shape of `side` voxels, its lower side in the middle over (0, 0), `height` above. The longest side is 1. */
static void add_shape(nook_fixture_mesh *mesh, int shape, uint32_t side, double height)
{
    double low[3], high[3];
    for (int axis = 0; axis < 3; axis++) {
        double length = shape >> axis & 1 ? 1.0 / side : 1.0;
        low[axis] = axis < 2 ? -0.5 * length : height;
        high[axis] = low[axis] + length;
    }
    nook_fixture_add_box(mesh, low, high, 63);
}

/* ---- What is baked ---------------------------------------------------------------------------------------------- */

static uint64_t count_wrong(const nook_volume *volume, const uint32_t expected[3])
{
    const uint32_t size[3] = { volume->info.width, volume->info.height, volume->info.depth };
    uint64_t wrong = 0, count = (uint64_t)size[0] * size[1] * size[2];
    for (int axis = 0; axis < 3; axis++)
        if (size[axis] != expected[axis] + 2)
            return count;
    for (uint32_t z = 0; z < size[2]; z++) {
        for (uint32_t y = 0; y < size[1]; y++) {
            const uint8_t *row = volume->voxels + ((size_t)z * size[1] + y) * size[0];
            for (uint32_t x = 0; x < size[0]; x++) {
                const uint32_t at[3] = { x, y, z };
                int border = 0, face = 0;
                for (int axis = 0; axis < 3; axis++) {
                    border |= at[axis] == 0 || at[axis] == size[axis] - 1;
                    face |= at[axis] == 1 || at[axis] == size[axis] - 2;
                }
                wrong += row[x] != (face && !border ? 255 : 0);
            }
        }
    }
    return wrong;
}

static nook_result bake_shape(int shape, uint32_t side, nook_extreme_found *out_found)
{
    nook_fixture_mesh mesh = { 0 };
    nook_volume volume = { 0 };
    uint32_t expected[3];
    for (int axis = 0; axis < 3; axis++)
        expected[axis] = shape >> axis & 1 ? 1 : side;
    add_shape(&mesh, shape, side, 0.0);
    const nook_triangles triangles = { mesh.positions, 0, mesh.vertex_count, mesh.indices, mesh.index_count };
    nook_result result = mesh.out_of_memory ? nook_fail(NOOK_E_MEMORY, "extremes: no memory for a box") : NOOK_OK;
    if (result == NOOK_OK)
        result = nook_voxelize(&triangles, &(nook_voxelize_desc){ .resolution = side }, &volume);
    if (result == NOOK_OK)
        nook_extreme_worst(out_found, (double)count_wrong(&volume, expected), "%s, %u voxels", shape_names[shape],
                           side);
    nook_volume_free(&volume);
    nook_fixture_mesh_free(&mesh);
    return result;
}

static nook_result run_shells(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    nook_result result = NOOK_OK;
    size_t count = side_count(extremes);
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        for (int shape = CUBE; shape < SHAPES && result == NOOK_OK; shape++)
            result = bake_shape(shape, sides[i], out_found);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    return result;
}

/* ---- What is seen in them --------------------------------------------------------------------------------------- */

/* Adds a shape as the only occluder. */
static nook_result show_shape(nook_edge_receiver *receiver, int shape, uint32_t side, double height)
{
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_view_drop_occluders(receiver->view);
    add_shape(&mesh, shape, side, height);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, side, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    return result;
}

static nook_result measure(nook_edge_receiver *receiver, const char *what, uint32_t side, double *out_occlusion)
{
    nook_fixture_occlusion occlusion;
    nook_result result = nook_edge_receiver_measure(receiver, &occlusion, "%s, %u voxels", what, side);
    if (result == NOOK_OK)
        *out_occlusion = occlusion.mean;
    return result;
}

/* Boxes too small to be closed, A on the floor with 1, 2 and 3 voxels. */
static const double open_boxes[CLOSED_SIDE] = { NAN, 0.0, 0.64, 0.995 };

static void judge_box(nook_extreme_found *found, uint32_t side, double occlusion)
{
    if (side >= CLOSED_SIDE)
        nook_extreme_worst(found, 1.0 - occlusion, "%u voxels", side);
    else
        nook_extreme_state(found, open_boxes[side], 0.005, occlusion, "A on the floor of a box of %u voxels a side",
                           side);
}

static nook_result look_in_boxes(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    size_t count = side_count(extremes);
    nook_result result = nook_edge_receiver_set(receiver, 2.0, "volume rays=64 steps=1024");
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        double occlusion = 0.0;
        result = show_shape(receiver, CUBE, sides[i], 0.0);
        if (result == NOOK_OK)
            result = measure(receiver, "in a box", sides[i], &occlusion);
        if (result == NOOK_OK)
            judge_box(receiver->found, sides[i], occlusion);
        nook_extreme_progress(extremes, (double)(i + 1) / (double)count);
    }
    return result;
}

static nook_result run_boxes(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_in_boxes);
}

/* A slab or a full cube of 1 m, its lower face half a metre overhead. Of one voxel it is a lone voxel, of which little is left. */
static void judge_overhead(nook_extreme_found *found, uint32_t side, double height, double occlusion)
{
    if (side == 1)
        nook_extreme_state(found, 0.07, 0.01, occlusion / nook_square_overhead(1.0, height),
                           "part of its A that a lone voxel keeps half its side away");
    else
        nook_extreme_worst(found, nook_layer_loss(occlusion, height, side), "%u voxels a side: A %.4f", side,
                           occlusion);
}

static nook_result look_at_slabs(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    const double height = 0.5;
    receiver->found->bound = 1.0;
    nook_result result = nook_edge_receiver_set(receiver, 2.0, "volume rays=4096 steps=1024");
    for (size_t i = 0; i < side_count(extremes) && result == NOOK_OK; i++) {
        double occlusion;
        result = show_shape(receiver, SLAB_Z, sides[i], height);
        if (result == NOOK_OK)
            result = measure(receiver, "under a slab", sides[i], &occlusion);
        if (result == NOOK_OK)
            judge_overhead(receiver->found, sides[i], height, occlusion);
    }
    return result;
}

static nook_result run_slabs(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_slabs);
}

/* ---- What is one voxel thick ------------------------------------------------------------------------------------ */

static nook_result look_at_thin(nook_edge_receiver *receiver, const nook_thin_body *body)
{
    const double rays = 4096.0 * NOOK_EDGE_PIXELS; /* of its 16 blocks */
    double length = body->voxel * body->side, truth = 0.0, occlusion = 0.0;
    nook_fixture_mesh mesh = { 0 };
    nook_fixture_view_drop_occluders(receiver->view);
    nook_fixture_add_box(&mesh, (double[]){ -0.5 * length, -0.5 * body->voxel, body->height },
                         (double[]){ 0.5 * length, 0.5 * body->voxel, body->height + body->voxel }, 63);
    nook_result result = nook_fixture_view_add(receiver->view, &mesh, body->side, NULL, NULL);
    nook_fixture_mesh_free(&mesh);
    if (result == NOOK_OK)
        result = nook_edge_receiver_set(receiver, 2.0, "reference rays=4096");
    if (result == NOOK_OK)
        result = measure(receiver, "reference under a needle", body->side, &truth);
    if (result == NOOK_OK)
        result = nook_edge_receiver_set(receiver, 2.0, "volume rays=4096 steps=1024");
    if (result == NOOK_OK)
        result = measure(receiver, "under a needle", body->side, &occlusion);
    if (result != NOOK_OK)
        return result;
    if (body->side == 1)
        nook_extreme_state(receiver->found, 0.3, 0.01, occlusion / truth, "part of its A that a lone voxel keeps");
    else if (body->side == 64)
        nook_extreme_state(receiver->found, 0.69, 0.01, occlusion / truth,
                           "part of its A that a needle of 64 voxels keeps");
    double outside = fmax(nook_thin_body_least(body) - occlusion, occlusion - truth);
    nook_extreme_worst(receiver->found, outside / sqrt(occlusion * (1.0 - occlusion) / rays),
                       "%u x 1 x 1 voxels: A %.4f, truth %.4f", body->side, occlusion, truth);
    return NOOK_OK;
}

static nook_result look_at_needles(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    nook_result result = NOOK_OK;
    receiver->found->bound = 3.0;
    for (size_t i = 0; i < side_count(extremes) && result == NOOK_OK; i++) {
        const uint32_t side = sides[i];
        const nook_thin_body body = { side, side == 1 ? 0.1 : 1.0 / side, side == 1 ? 0.4 : 3.0 / side };
        if (side == 1 || side >= 16)
            result = look_at_thin(receiver, &body);
    }
    return result;
}

static nook_result run_needles(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_needles);
}

/* ---- Empty and full --------------------------------------------------------------------------------------------- */

/* A cube of 1 m, its lower face in the middle over the origin at `height`, with all or none of its voxels set. */
static nook_result show_filled(nook_edge_receiver *receiver, uint32_t side, double height, uint8_t value)
{
    const uint32_t whole = side + 2;
    const double voxel = 1.0 / side;
    nook_volume volume = { .info = { .width = whole, .height = whole, .depth = whole, .voxel_size = voxel } };
    volume.voxels = calloc((size_t)whole * whole, whole);
    if (!volume.voxels)
        return nook_fail(NOOK_E_MEMORY, "extremes: no memory for %u voxels a side", whole);
    for (uint32_t z = 1; z <= side; z++)
        for (uint32_t y = 1; y <= side; y++)
            memset(volume.voxels + ((size_t)z * whole + y) * whole + 1, value, side);
    volume.info.occupied = value ? (uint64_t)side * side * side : 0;
    volume.info.origin[0] = volume.info.origin[1] = -0.5 - voxel;
    volume.info.origin[2] = height - voxel;
    nook_fixture_view_drop_occluders(receiver->view);
    nook_result result = nook_edge_receiver_add_volume(receiver, &volume);
    nook_volume_free(&volume);
    return result;
}

static const char *const ways[] = { "volume rays=64 steps=1024",
                                    "volume rays=64 steps=1024 guard=slab",
                                    "volume rays=64 steps=1024 stepping=fixed",
                                    "volume rays=64 steps=1024 combine=multiply",
                                    "volume rays=64 threshold=0.01",
                                    "volume rays=64 steps=1024 threshold=0.99" };

static nook_result look_in_empty(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < side_count(extremes) && result == NOOK_OK; i += 4) {
        result = show_filled(receiver, sides[i], -0.5, 0);
        for (size_t way = 0; way < NOOK_COUNT(ways) && result == NOOK_OK; way++) {
            nook_fixture_occlusion occlusion = { 0 };
            result = nook_edge_receiver_set(receiver, 2.0, "%s", ways[way]);
            if (result == NOOK_OK)
                result = nook_edge_receiver_measure(receiver, &occlusion, "%s, %u voxels", ways[way], sides[i]);
            if (result == NOOK_OK)
                nook_extreme_worst(receiver->found, occlusion.highest, "%s, %u voxels", ways[way], sides[i]);
        }
    }
    return result;
}

static nook_result run_empty(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_in_empty);
}

static nook_result look_in_full(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < side_count(extremes) && result == NOOK_OK; i += sides[i] < CLOSED_SIDE ? 1 : 2) {
        nook_fixture_occlusion occlusion = { 0 };
        result = show_filled(receiver, sides[i], -0.5, 255);
        if (result == NOOK_OK)
            result = nook_edge_receiver_set(receiver, 2.0, "%s", ways[0]);
        if (result == NOOK_OK)
            result = nook_edge_receiver_measure(receiver, &occlusion, "in the middle of %u voxels", sides[i]);
        if (result == NOOK_OK && sides[i] < CLOSED_SIDE)
            nook_extreme_state(receiver->found, sides[i] == 3 ? 0.94 : 0.0, sides[i] == 3 ? 0.01 : 0.0,
                               occlusion.lowest, "the least A in the middle of %u voxels a side", sides[i]);
        else if (result == NOOK_OK)
            nook_extreme_worst(receiver->found, 1.0 - occlusion.lowest, "in the middle of %u voxels", sides[i]);
    }
    return result;
}

static nook_result run_full_inside(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_in_full);
}

static nook_result look_at_full(const nook_extremes *extremes, nook_edge_receiver *receiver)
{
    const double height = 0.5;
    nook_result result = nook_edge_receiver_set(receiver, 2.0, "volume rays=4096 steps=1024");
    receiver->found->bound = 1.0;
    for (size_t i = 0; i < side_count(extremes) && result == NOOK_OK; i++) {
        double occlusion = 0.0;
        result = show_filled(receiver, sides[i], height, 255);
        if (result == NOOK_OK)
            result = measure(receiver, "under a solid cube", sides[i], &occlusion);
        if (result == NOOK_OK)
            judge_overhead(receiver->found, sides[i], height, occlusion);
    }
    return result;
}

static nook_result run_full_outside(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    return nook_edge_receiver_look(extremes, out_found, look_at_full);
}

#define THIN_LIMIT                                                                                                \
    "What is one voxel thick keeps 69 % of its occlusion as a needle; a lone voxel keeps 30 %, and 7 % half its " \
    "side away (C9)."

static const nook_extreme cases[] = {
    { .name = "cubes, slabs and needles of 1 to 512 voxels become exactly their shells",
      .unit = "wrong voxels",
      .why = "their faces are faces of voxels: closed form, nothing may differ",
      .run = run_shells },
    { .name = "a closed box of 4 to 512 voxels a side is closed",
      .unit = "1 - A on its floor",
      .why = "its walls are one layer that no step jumps over: every ray of every pixel hits, exactly",
      .limit =
          "A closed box of less than 4 voxels a side leaks: A on its floor is 0.995 with 3 voxels, 0.64 with 2 and "
          "0 with 1.",
      .run = run_boxes },
    { .name = "slabs of 2 to 512 voxels, one thick, occlude as a square overhead",
      .unit = "of the expected loss",
      .why =
          "fixture 15 against a square 0.39 voxels narrower and half a voxel higher: what filtering leaves of its rim",
      .limit = THIN_LIMIT,
      .run = run_slabs },
    { .name = "needles of up to 512 voxels and a lone voxel occlude within their closed bounds",
      .unit = "standard deviations",
      .why = "between the integral of density >= 1/2 and the body itself, by Embree; 3 deviations of 65536 rays",
      .limit = THIN_LIMIT,
      .run = run_needles },
    { .name = "a volume without any voxel set occludes nothing",
      .unit = "A",
      .why = "no sample reaches any threshold: not a bit may differ from 1",
      .run = run_empty },
    { .name = "in the middle of a full volume of 4 to 512 voxels nothing is seen",
      .unit = "1 - A",
      .why = "every ray's first sample is a hit: exactly 1",
      .limit = "In the middle of a full volume of less than 4 voxels a side A is 0.94 at the least with 3 voxels, and "
               "0 with "
               "fewer.",
      .run = run_full_inside },
    { .name = "a full volume of 2 to 512 voxels occludes from outside as its surface does",
      .unit = "of the expected loss",
      .why = "it holds its lowest layer, which is such a slab, and no ray hits it that does not meet its lower face",
      .limit = THIN_LIMIT,
      .run = run_full_outside },
};

const nook_extreme_group nook_extreme_volumes = { "volumes", cases, NOOK_COUNT(cases) };
