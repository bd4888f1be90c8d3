/* Matrices of occluders: composing them, and what comes of the odd ones. */
#include "game/extremes/groups.h"
#include "game/extremes/oracle_matrix.h"
#include "game/extremes/random_transform.h"
#include "game/extremes/transform_internal.h"
#include <math.h>

/* ---- M_B^-1 M_A ---- */

static const double FILTER_STEP = 1.0 / 256.0; /* of a voxel: the step of hardware's filter weights */
enum { RESOLUTION_HIGH = 256 };

/** How far the corners of A's unit box land from where they belong, in voxels of B's unit box. */
static double relative_error(const nook_matrix *world_from_a, const nook_matrix *world_from_b)
{
    nook_matrix b_from_world, b_from_a;
    if (!nook_matrix_inverse_affine(world_from_b, &b_from_world))
        return NAN;
    b_from_a = nook_matrix_multiply(&b_from_world, world_from_a);
    const nook_oracle a = nook_oracle_of(world_from_a), b = nook_oracle_of(world_from_b);
    const nook_oracle inverse = nook_oracle_inverse(&b), truth = nook_oracle_multiply(&inverse, &a);
    double worst = 0.0;
    for (int corner = 0; corner < 8; corner++) {
        const double p[3] = { corner & 1, corner >> 1 & 1, corner >> 2 };
        double got[3];
        long double want[3];
        nook_matrix_apply_point(&b_from_a, p, got);
        nook_oracle_apply(&truth, p, want);
        for (int axis = 0; axis < 3; axis++)
            worst = fmax(worst, fabs((double)(got[axis] - want[axis])) * RESOLUTION_HIGH);
    }
    return worst;
}

/** Erratum C6: with A one to the right of B, A's origin is (1, 0, 0) in B, and not (-1, 0, 0). */
static double order_error(void)
{
    nook_matrix a = nook_matrix_translation(1.0, 0.0, 0.0), b = nook_matrix_identity(), inverse, product;
    double origin[3] = { 0.0, 0.0, 0.0 };
    nook_matrix_inverse_affine(&b, &inverse);
    product = nook_matrix_multiply(&inverse, &a);
    nook_matrix_apply_point(&product, origin, origin);
    return fabs(origin[0] - 1.0) + fabs(origin[1]) + fabs(origin[2]);
}

static nook_result run_relative(const nook_extremes *extremes, nook_extreme_found *out_found)
{
    static const double offsets[] = { 0.0, 1e3, 1e5, 1e7 }, shears[] = { 0.0, 1.0 };
    const int pairs = extremes->quick ? 200 : 20000;
    nook_random random = { 1 };
    out_found->bound = FILTER_STEP;
    nook_extreme_worst(out_found, order_error() * RESOLUTION_HIGH, "A one to the right of B (C6)");
    for (size_t k = 0; k < NOOK_COUNT(offsets); k++) {
        for (int i = 0; i < pairs; i++) {
            const double shear = shears[i & 1], at[3] = { offsets[k], -offsets[k], offsets[k] };
            const double beside[3] = { at[0] + nook_random_between(&random, -3.0, 3.0),
                                       at[1] + nook_random_between(&random, -3.0, 3.0), at[2] };
            nook_matrix a = nook_random_affine(&random, beside, 100.0, shear);
            nook_matrix b = nook_random_affine(&random, at, 100.0, shear);
            nook_extreme_worst(out_found, relative_error(&a, &b), "%g units off, shear %g, pair %d", offsets[k], shear,
                               i);
        }
        nook_extreme_progress(extremes, (double)(k + 1) / NOOK_COUNT(offsets));
    }
    return NOOK_OK;
}

static const nook_extreme cases[] = {
    { .name = "M_B^-1 M_A of matrices turned, mirrored, 100:1 stretched and sheared, up to 1e7 units off",
      .unit = "voxels of 256",
      .why = "Voxels are filtered with weights of 8 bits: a shift of less than 1/256 voxel changes nothing.",
      .run = run_relative },
    { .name = "voxel_from_view and its normal matrix as shaders get them, up to 1e7 units off",
      .unit = "roundings to float",
      .why = "Composed in double, rounded once: one rounding of each entry, and a twentieth for double's own at 1e7.",
      .run = nook_transform_run_uploaded },
    { .name = "singular, NaN, infinite, vast and tiny matrices change no bit of the others' picture",
      .unit = "pixels",
      .why = "What has no inverse in floats is left out; and nothing is left of a box that large or small in sight.",
      .run = nook_transform_run_left_out },
    { .name = "reference: a mesh under a matrix occludes as the mesh whose vertices it has moved",
      .unit = "A",
      .why = "The same rays: at most one of the 256 of each pixel may pass an edge on the other side.",
      .run = nook_transform_run_instances },
    { .name = "volume: a box turned, mirrored, 100:1 stretched and sheared occludes as to within a voxel",
      .unit = "A beyond",
      .why = "A filtered voxel surface lies within a voxel of the true one; 0.005 is the noise of 256 rays.",
      .run = nook_transform_run_volume },
};

const nook_extreme_group nook_extreme_transforms = { .name = "transforms", .cases = cases, .count = NOOK_COUNT(cases) };
