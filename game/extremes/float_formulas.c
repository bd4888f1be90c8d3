#include "game/extremes/float_formulas.h"
#include "game/extremes/oracle_matrix.h"
#include <math.h>

/** m * (p, w), as a shader does. */
static void transform(const float m[16], const float p[3], float w, float out[4])
{
    for (int row = 0; row < 4; row++)
        out[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row] * w;
}

static void view_position(const nook_float_setting *setting, const nook_float_pixel *pixel, float out[3])
{
    for (int axis = 0; axis < 2; axis++) {
        float ray_scale = (float)(1.0 / setting->clip_from_view.m[axis * 5]);
        out[axis] = pixel->ndc[axis] * ray_scale * pixel->distance;
    }
    out[2] = -pixel->distance;
}

static double apart(const float got[4], const long double truth[3])
{
    double worst = 0.0;
    for (int axis = 0; axis < 3; axis++)
        worst = fmax(worst, fabs((double)((long double)got[axis] - truth[axis])));
    return isfinite(got[0] + got[1] + got[2]) ? worst : INFINITY;
}

/* ---- Ours ---- */

static void by_relative(const nook_float_setting *setting, const nook_float_pixel *pixel, float out[4])
{
    nook_matrix view_from_voxel = nook_matrix_multiply(&setting->view_from_world, &setting->world_from_voxel), inverse;
    float matrix[16], position[3];
    nook_matrix_inverse_affine(&view_from_voxel, &inverse);
    nook_matrix_to_float(&inverse, matrix);
    view_position(setting, pixel, position);
    transform(matrix, position, 1.0f, out);
}

/* ---- The obvious ones ---- */

static void voxel_of_world(const nook_float_setting *setting, const float world[3], float out[4])
{
    nook_matrix voxel_from_world;
    float matrix[16];
    nook_matrix_inverse_affine(&setting->world_from_voxel, &voxel_from_world);
    nook_matrix_to_float(&voxel_from_world, matrix);
    transform(matrix, world, 1.0f, out);
}

static void by_world(const nook_float_setting *setting, const nook_float_pixel *pixel, float out[4])
{
    nook_matrix world_from_view;
    float matrix[16], position[3], world[4];
    nook_matrix_inverse_affine(&setting->view_from_world, &world_from_view);
    nook_matrix_to_float(&world_from_view, matrix);
    view_position(setting, pixel, position);
    transform(matrix, position, 1.0f, world);
    voxel_of_world(setting, world, out);
}

/** view_from_clip of the reversed, infinite projection: x = clip x / p0, y = clip y / p5, z = -clip w, w = clip z / near. */
static void by_projection(const nook_float_setting *setting, const nook_float_pixel *pixel, float out[4])
{
    const double *p = setting->clip_from_view.m;
    const nook_matrix view_from_clip = { { 1.0 / p[0], 0, 0, 0, 0, 1.0 / p[5], 0, 0, 0, 0, 0, 1.0 / p[14], 0, 0, -1,
                                           0 } };
    nook_matrix world_from_view, world_from_clip;
    float matrix[16], world[4];
    nook_matrix_inverse_affine(&setting->view_from_world, &world_from_view);
    world_from_clip = nook_matrix_multiply(&world_from_view, &view_from_clip);
    nook_matrix_to_float(&world_from_clip, matrix);
    const float ndc[3] = { pixel->ndc[0], pixel->ndc[1], (float)(p[14] / (double)pixel->distance) };
    transform(matrix, ndc, 1.0f, world);
    for (int axis = 0; axis < 3; axis++)
        world[axis] /= world[3];
    voxel_of_world(setting, world, out);
}

/* ---- The truth ---- */

static void true_voxel(const nook_float_setting *setting, const nook_float_pixel *pixel, long double out[3])
{
    const nook_oracle view_from_world = nook_oracle_of(&setting->view_from_world);
    const nook_oracle world_from_voxel = nook_oracle_of(&setting->world_from_voxel);
    const nook_oracle view_from_voxel = nook_oracle_multiply(&view_from_world, &world_from_voxel);
    const nook_oracle voxel_from_view = nook_oracle_inverse(&view_from_voxel);
    double position[3] = { 0, 0, -(double)pixel->distance };
    for (int axis = 0; axis < 2; axis++)
        position[axis] = (double)pixel->ndc[axis] / setting->clip_from_view.m[axis * 5] * (double)pixel->distance;
    nook_oracle_apply(&voxel_from_view, position, out);
}

nook_float_error nook_float_measure(const nook_float_setting *setting, const nook_float_pixel *pixel)
{
    long double truth[3];
    float relative[4], world[4], projection[4];
    true_voxel(setting, pixel, truth);
    by_relative(setting, pixel, relative);
    by_world(setting, pixel, world);
    by_projection(setting, pixel, projection);
    return (nook_float_error){ apart(relative, truth), apart(world, truth), apart(projection, truth) };
}
