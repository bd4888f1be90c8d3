#include "modules/bake/voxelize.h"
#include "engine/core/jobs.h"
#include "engine/core/log.h"
#include "modules/bake/rasterize.h"
#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

static const double side_of_a_point = 1e-6; /* metres: a single point still needs a voxel size */

/* ---- Reading triangles ------------------------------------------------------------------------------------------ */

static void read_position(const nook_triangles *triangles, uint32_t vertex, float out[3])
{
    size_t stride = triangles->stride ? triangles->stride : 3 * sizeof(float);
    memcpy(out, (const unsigned char *)triangles->positions + stride * vertex, 3 * sizeof(float));
}

/* False when a corner is not finite. */
static bool read_triangle(const nook_triangles *triangles, size_t triangle, float out[3][3])
{
    for (int i = 0; i < 3; i++) {
        read_position(triangles, triangles->indices[triangle * 3 + (size_t)i], out[i]);
        if (!isfinite(out[i][0]) || !isfinite(out[i][1]) || !isfinite(out[i][2]))
            return false;
    }
    return true;
}

static nook_result check_input(const nook_triangles *triangles, const nook_voxelize_desc *desc)
{
    if (desc->resolution < 1 || desc->resolution > NOOK_VOXELIZE_RESOLUTION_MAX)
        return nook_fail(NOOK_E_RANGE, "voxelize: resolution %u; choose 1 to %u", desc->resolution,
                         NOOK_VOXELIZE_RESOLUTION_MAX);
    if (triangles->index_count % 3 != 0 || (triangles->stride != 0 && triangles->stride < 3 * sizeof(float)))
        return nook_fail(NOOK_E_ARG, "voxelize: %zu indices, stride %u: not a list of triangles",
                         triangles->index_count, triangles->stride);
    for (size_t i = 0; i < triangles->index_count; i++)
        if (triangles->indices[i] >= triangles->vertex_count)
            return nook_fail(NOOK_E_ARG, "voxelize: index %u of %u vertices", triangles->indices[i],
                             triangles->vertex_count);
    return NOOK_OK;
}

/* ---- The grid --------------------------------------------------------------------------------------------------- */

static nook_result find_box(const nook_triangles *triangles, double out_min[3], double out_max[3])
{
    size_t left_out = 0, count = triangles->index_count / 3;
    vec3 box[2];
    glm_aabb_invalidate(box);
    for (size_t t = 0; t < count; t++) {
        float corner[3][3];
        if (!read_triangle(triangles, t, corner)) {
            left_out++;
            continue;
        }
        for (int i = 0; i < 3; i++) {
            glm_vec3_minv(box[0], corner[i], box[0]);
            glm_vec3_maxv(box[1], corner[i], box[1]);
        }
    }
    for (int axis = 0; axis < 3; axis++) {
        out_min[axis] = box[0][axis];
        out_max[axis] = box[1][axis];
    }
    if (left_out == count)
        return nook_fail(NOOK_E_ARG, "voxelize: none of %zu triangles is finite: nothing to voxelize", count);
    if (left_out > 0)
        nook_log_warning("voxelize: %zu of %zu triangles have a corner that is not finite; left out", left_out, count);
    return NOOK_OK;
}

typedef struct grid_frame {
    double voxel_size, origin[3];
    int32_t inner[3]; /* voxels without the border */
    uint32_t size[3]; /* with it */
} grid_frame;

/** Longest side; never 0, nor less than what corners in float can tell apart. No length of ours: bodies have any size. */
static double longest_side(const double box_min[3], const double box_max[3])
{
    double longest = 0.0;
    for (int axis = 0; axis < 3; axis++) {
        double step = FLT_EPSILON * fmax(fabs(box_min[axis]), fabs(box_max[axis]));
        longest = fmax(longest, fmax(box_max[axis] - box_min[axis], step));
    }
    return longest > 0.0 ? longest : side_of_a_point;
}

static grid_frame frame_box(const double box_min[3], const double box_max[3], uint32_t resolution)
{
    double longest = longest_side(box_min, box_max);
    grid_frame frame = { .voxel_size = longest / resolution };
    for (int axis = 0; axis < 3; axis++) {
        /* Rounding in the division must not buy a whole layer; snapping clamps what then stands out. */
        double voxels = ceil((box_max[axis] - box_min[axis]) / frame.voxel_size - 1e-6);
        frame.inner[axis] = (int32_t)fmin(fmax(voxels, 1.0), resolution);
        frame.size[axis] = (uint32_t)frame.inner[axis] + 2;
        double centre = box_min[axis] * 0.5 + box_max[axis] * 0.5;
        frame.origin[axis] = centre - 0.5 * frame.size[axis] * frame.voxel_size;
    }
    return frame;
}

static int32_t snap(const grid_frame *frame, int axis, float position)
{
    double steps = round((position - frame->origin[axis]) / frame->voxel_size * NOOK_SUBVOXEL);
    double low = NOOK_SUBVOXEL, high = (frame->inner[axis] + 1.0) * NOOK_SUBVOXEL;
    return (int32_t)fmin(fmax(steps, low), high);
}

static bool snap_triangle(const grid_frame *frame, const nook_triangles *triangles, size_t triangle,
                          nook_snapped_triangle *out)
{
    float corner[3][3];
    if (!read_triangle(triangles, triangle, corner))
        return false;
    for (int i = 0; i < 3; i++)
        for (int axis = 0; axis < 3; axis++)
            out->corner[i][axis] = snap(frame, axis, corner[i][axis]);
    return true;
}

/* ---- The two passes --------------------------------------------------------------------------------------------- */

typedef struct passes {
    const nook_triangles *triangles;
    const grid_frame *frame;
    nook_voxel_grid *rasterized; /* written by the first pass, only read by the second */
    nook_voxel_grid *extra;      /* written by the second */
} passes;

static void rasterize_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++)
        if (snap_triangle(p->frame, p->triangles, t, &snapped))
            nook_rasterize_three_way(&snapped, p->frame->inner, p->rasterized);
}

static void rasterize_narrow_triangles(void *user, size_t first, size_t last, unsigned worker)
{
    const passes *p = user;
    (void)worker;
    nook_snapped_triangle snapped;
    for (size_t t = first; t < last; t++)
        if (snap_triangle(p->frame, p->triangles, t, &snapped))
            nook_rasterize_narrow(&snapped, p->frame->inner, p->rasterized, p->extra);
}

/* ---- Public ----------------------------------------------------------------------------------------------------- */

uint64_t nook_voxelize_hash(const nook_triangles *triangles, const nook_voxelize_desc *desc)
{
    enum { CHUNK = 1024 };
    const uint64_t settings[] = { NOOK_VOXELIZE_VERSION, NOOK_VOLUME_VERSION, desc->resolution, triangles->vertex_count,
                                  triangles->index_count };
    uint64_t hash = XXH3_64bits(settings, sizeof settings);
    hash = XXH3_64bits_withSeed(triangles->indices, triangles->index_count * sizeof(uint32_t), hash);
    float chunk[CHUNK][3];
    for (uint32_t first = 0; first < triangles->vertex_count; first += CHUNK) {
        uint32_t left = triangles->vertex_count - first, count = left < CHUNK ? left : CHUNK;
        for (uint32_t i = 0; i < count; i++)
            read_position(triangles, first + i, chunk[i]);
        hash = XXH3_64bits_withSeed(chunk, count * sizeof chunk[0], hash);
        if (left <= CHUNK)
            break;
    }
    return hash;
}

nook_result nook_voxelize(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_volume *out_volume)
{
    double box_min[3], box_max[3];
    nook_result result = check_input(triangles, desc);
    if (result == NOOK_OK)
        result = find_box(triangles, box_min, box_max);
    if (result != NOOK_OK)
        return result;

    grid_frame frame = frame_box(box_min, box_max, desc->resolution);
    size_t voxel_count = (size_t)frame.size[0] * frame.size[1] * frame.size[2];
    nook_voxel_grid *rasterized = nook_voxel_grid_create(frame.size), *extra = nook_voxel_grid_create(frame.size);
    uint8_t *voxels = malloc(voxel_count);
    if (rasterized && extra && voxels) {
        passes p = { triangles, &frame, rasterized, extra };
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_triangles, &p);
        nook_parallel_for(triangles->index_count / 3, desc->threads, rasterize_narrow_triangles, &p);
        nook_volume_info info = { .kind = NOOK_VOLUME_BINARY,
                                  .width = frame.size[0],
                                  .height = frame.size[1],
                                  .depth = frame.size[2],
                                  .voxel_size = frame.voxel_size,
                                  .origin = { frame.origin[0], frame.origin[1], frame.origin[2] },
                                  .content_hash = nook_voxelize_hash(triangles, desc),
                                  .occupied = nook_voxel_grid_expand(rasterized, extra, voxels) };
        *out_volume = (nook_volume){ info, voxels };
    } else {
        free(voxels);
        result = nook_fail(NOOK_E_MEMORY, "voxelize: no memory for %ux%ux%u voxels; lower the resolution",
                           frame.size[0], frame.size[1], frame.size[2]);
    }
    nook_voxel_grid_destroy(rasterized);
    nook_voxel_grid_destroy(extra);
    return result;
}
