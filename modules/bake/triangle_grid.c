#include "modules/bake/triangle_grid.h"
#include "engine/core/log.h"
#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <string.h>

static const double side_of_a_point = 1e-6; /* metres: a single point still needs a voxel size */

/* ---- Reading triangles ------------------------------------------------------------------------------------------ */

void nook_grid_read_position(const nook_triangles *triangles, uint32_t vertex, float out[3])
{
    size_t stride = triangles->stride ? triangles->stride : 3 * sizeof(float);
    memcpy(out, (const unsigned char *)triangles->positions + stride * vertex, 3 * sizeof(float));
}

/* False when a corner is not finite. */
static bool read_triangle(const nook_triangles *triangles, size_t triangle, float out[3][3])
{
    for (int i = 0; i < 3; i++) {
        nook_grid_read_position(triangles, triangles->indices[triangle * 3 + (size_t)i], out[i]);
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
    if (!nook_volume_kind_name(desc->kind))
        return nook_fail(NOOK_E_RANGE, "voxelize: kind %d; there are " NOOK_VOLUME_KINDS_TEXT, (int)desc->kind);
    if (desc->level >= NOOK_VOXELIZE_LEVELS || (desc->level > 0 && desc->kind != NOOK_VOLUME_SURFEL))
        return nook_fail(NOOK_E_RANGE, "voxelize: level %u of a volume of kind %s; surfels have levels 0 to %d",
                         desc->level, nook_volume_kind_name(desc->kind), NOOK_VOXELIZE_LEVELS - 1);
    if (triangles->index_count % 3 != 0 || (triangles->stride != 0 && triangles->stride < 3 * sizeof(float)))
        return nook_fail(NOOK_E_ARG, "voxelize: %zu indices, stride %u: not a list of triangles",
                         triangles->index_count, triangles->stride);
    for (size_t i = 0; i < triangles->index_count; i++)
        if (triangles->indices[i] >= triangles->vertex_count)
            return nook_fail(NOOK_E_ARG, "voxelize: index %u of %u vertices", triangles->indices[i],
                             triangles->vertex_count);
    if (!nook_alphas_are_sound(desc->alphas, triangles->index_count))
        return nook_fail(NOOK_E_ARG, "voxelize: parts with alpha are not those of %zu indices, in order and apart",
                         triangles->index_count);
    return NOOK_OK;
}

/* ---- The grid --------------------------------------------------------------------------------------------------- */

/* @return how many triangles are left out */
static size_t find_box(const nook_triangles *triangles, double out_min[3], double out_max[3])
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
    return left_out;
}

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

static nook_grid_frame frame_box(const double box_min[3], const double box_max[3], uint32_t resolution)
{
    double longest = longest_side(box_min, box_max);
    nook_grid_frame frame = { .voxel_size = longest / resolution };
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

static int32_t snap(const nook_grid_frame *frame, int axis, float position)
{
    double steps = (position - frame->origin[axis]) / frame->voxel_size * NOOK_SUBVOXEL;
    double low = NOOK_SUBVOXEL, high = (frame->inner[axis] + 1.0) * NOOK_SUBVOXEL;
    steps = steps < low ? low : steps > high ? high : steps;
    int32_t whole = (int32_t)steps;
    return whole + (steps - whole >= 0.5); /* round, without the call */
}

bool nook_grid_snap(const nook_grid_frame *frame, const nook_triangles *triangles, size_t triangle,
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

int32_t nook_grid_layer(double depth, int32_t inner)
{
    int32_t layer = (int32_t)((depth + NOOK_LAYER_BIAS) / NOOK_SUBVOXEL); /* what is below 0 becomes 1 in any case */
    return layer < 1 ? 1 : layer > inner ? inner : layer;
}

int32_t nook_grid_level_layer(int32_t layer, uint32_t level)
{
    return (layer + (1 << level) - 1) >> level;
}

nook_grid_frame nook_grid_level(const nook_grid_frame *frame, uint32_t level)
{
    nook_grid_frame merged = { .voxel_size = frame->voxel_size * (1 << level) };
    for (int axis = 0; axis < 3; axis++) {
        merged.inner[axis] = nook_grid_level_layer(frame->inner[axis], level);
        merged.size[axis] = (uint32_t)merged.inner[axis] + 2;
        merged.origin[axis] =
            frame->origin[axis] - frame->voxel_size * ((1 << level) - 1); /* both borders are a voxel */
    }
    return merged;
}

nook_result nook_grid_place(const nook_triangles *triangles, const nook_voxelize_desc *desc, nook_grid_frame *out_frame)
{
    const size_t count = triangles->index_count / 3;
    nook_result result = check_input(triangles, desc);
    if (result != NOOK_OK)
        return result;
    size_t left_out = nook_grid_find(triangles, desc->resolution, out_frame);
    if (left_out == count)
        return nook_fail(NOOK_E_ARG, "voxelize: none of %zu triangles is finite: nothing to voxelize", count);
    if (left_out > 0)
        nook_log_warning("voxelize: %zu of %zu triangles have a corner that is not finite; left out", left_out, count);
    return NOOK_OK;
}

size_t nook_grid_find(const nook_triangles *triangles, uint32_t resolution, nook_grid_frame *out_frame)
{
    double box_min[3], box_max[3];
    size_t left_out = find_box(triangles, box_min, box_max);
    if (left_out < triangles->index_count / 3)
        *out_frame = frame_box(box_min, box_max, resolution);
    return left_out;
}
