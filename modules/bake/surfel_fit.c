#include "modules/bake/surfel_fit.h"
#include "engine/core/vector.h"
#include "modules/bake/surfel_extent.h"
#include "modules/bake/surfel_word.h"
#include <math.h>

enum { ROUNDS = 8 };
/* Voxels, root mean square. What lies within this of one plane is one: a third of what a ray may miss a plane by (tolerance). */
static const double flat = 1.0 / 32.0;
/*
 * A plane ends at the other one when its area lies so many standard deviations to one side. An even strip that ends there lies
 * sqrt(3) = 1.73 of them to the side, a corner cut off along there sqrt(2) = 1.41; one that crosses by a fifth of its width 1.04.
 */
static const double one_sided = 1.25;

typedef struct plane {
    double normal[3], offset;
} plane;

/* ---- Sums ------------------------------------------------------------------------------------------------------- */

static void add_bin(nook_surfel_bin *sum, const nook_surfel_bin *bin)
{
    double sign = nook_vector_dot(sum->normal, bin->normal) < 0.0 ? -1.0 : 1.0;
    sum->area += bin->area;
    for (int i = 0; i < 3; i++) {
        sum->normal[i] += sign * bin->normal[i];
        sum->first[i] += bin->first[i];
    }
    for (int i = 0; i < 6; i++)
        sum->second[i] += bin->second[i];
}

/* Sums the bins of a group; the largest first, whose direction the others' signs follow. */
static nook_surfel_bin sum_group(const nook_surfel_bin *bins, const uint8_t *group, size_t count, int wanted)
{
    nook_surfel_bin sum = { 0 };
    size_t largest = count;
    for (size_t i = 0; i < count; i++)
        if (group[i] == wanted && (largest == count || bins[i].area > bins[largest].area))
            largest = i;
    if (largest == count)
        return sum;
    add_bin(&sum, &bins[largest]);
    for (size_t i = 0; i < count; i++)
        if (group[i] == wanted && i != largest)
            add_bin(&sum, &bins[i]);
    return sum;
}

static plane plane_of(const nook_surfel_bin *sum)
{
    plane p = { .normal = { 0.0, 0.0, 1.0 } };
    nook_vector_normalize(sum->normal, p.normal);
    p.offset = nook_vector_dot(p.normal, sum->first) / sum->area;
    return p;
}

/* Integral of the squared distance to the plane over what a sum holds. */
static double distance_to(const nook_surfel_bin *sum, const plane *p)
{
    const double *n = p->normal, *m = sum->second;
    double squares = n[0] * n[0] * m[0] + n[1] * n[1] * m[1] + n[2] * n[2] * m[2] +
                     2.0 * (n[0] * n[1] * m[3] + n[1] * n[2] * m[4] + n[2] * n[0] * m[5]);
    double total = squares - 2.0 * p->offset * nook_vector_dot(n, sum->first) + p->offset * p->offset * sum->area;
    return fmax(total, 0.0);
}

/* ---- Two groups ------------------------------------------------------------------------------------------------- */

/* Which bin is worst off with the plane. */
static size_t farthest(const nook_surfel_bin *bins, size_t count, const plane *p)
{
    size_t worst = 0;
    double most = -1.0;
    for (size_t i = 0; i < count; i++) {
        double distance = distance_to(&bins[i], p);
        if (distance > most) {
            most = distance;
            worst = i;
        }
    }
    return worst;
}

static size_t largest_of(const nook_surfel_bin *bins, size_t count)
{
    size_t largest = 0;
    for (size_t i = 1; i < count; i++)
        if (bins[i].area > bins[largest].area)
            largest = i;
    return largest;
}

/* Lloyd's algorithm with planes for centres. @return false: one group is empty */
static bool split(const nook_surfel_bin *bins, size_t count, uint8_t *group, nook_surfel_bin sums[2])
{
    plane planes[2];
    planes[0] = plane_of(&bins[largest_of(bins, count)]);
    planes[1] = plane_of(&bins[farthest(bins, count, &planes[0])]);
    for (int round = 0; round < ROUNDS; round++) {
        bool changed = round == 0;
        for (size_t i = 0; i < count; i++) {
            uint8_t nearer = distance_to(&bins[i], &planes[1]) < distance_to(&bins[i], &planes[0]);
            changed = changed || nearer != group[i];
            group[i] = nearer;
        }
        for (int k = 0; k < 2; k++) {
            sums[k] = sum_group(bins, group, count, k);
            if (!(sums[k].area > 0.0))
                return false;
            planes[k] = plane_of(&sums[k]);
        }
        if (!changed)
            break;
    }
    return true;
}

/* ---- From sums to a surfel -------------------------------------------------------------------------------------- */

/* On which side of `other` all of it lies. */
static nook_surfel_side side_of(const nook_surfel_bin *sum, const plane *other)
{
    double mean = nook_vector_dot(other->normal, sum->first) / sum->area - other->offset;
    double variance = fmax(distance_to(sum, other) / sum->area - mean * mean, 0.0);
    if (!(fabs(mean) > one_sided * sqrt(variance)))
        return NOOK_SIDE_BOTH;
    return mean >= 0.0 ? NOOK_SIDE_ABOVE : NOOK_SIDE_BELOW;
}

/* The plane in the voxel as triangles are cut by it, on its side of the other. */
static nook_polygon section_of(const plane *p, double bias, nook_surfel_side side, const plane *other)
{
    nook_polygon section, rest;
    nook_polygon_of_cube(p->normal, p->offset, -0.5 - bias, &section);
    if (side != NOOK_SIDE_BOTH) {
        double sign = side == NOOK_SIDE_ABOVE ? 1.0 : -1.0;
        const double inwards[3] = { sign * other->normal[0], sign * other->normal[1], sign * other->normal[2] };
        nook_polygon_clip(&section, inwards, sign * other->offset, &rest);
        section = rest;
    }
    return section;
}

static double area_of(const nook_polygon *section, const plane *p)
{
    const double centre[3] = { 0.0, 0.0, 0.0 };
    return nook_polygon_measure(section, p->normal, centre).area;
}

/* Of the section within the extent; its ends at the voxel's faces cut nothing. */
static double area_within(const nook_polygon *section, const plane *p, const nook_surfel_extent *extent)
{
    nook_polygon left = *section, rest;
    for (int axis = 0; axis < 3; axis++) {
        double inwards[3] = { 0.0, 0.0, 0.0 };
        inwards[axis] = 1.0;
        if (extent->low[axis] > -0.5) {
            nook_polygon_clip(&left, inwards, extent->low[axis], &rest);
            left = rest;
        }
        inwards[axis] = -1.0;
        if (extent->high[axis] < 0.5) {
            nook_polygon_clip(&left, inwards, -extent->high[axis], &rest);
            left = rest;
        }
    }
    return area_of(&left, p);
}

/* Area as it is seen along the plane's normal. */
static double seen_area(const nook_surfel_bin *sum, const plane *p)
{
    return fabs(nook_vector_dot(sum->normal, p->normal));
}

static double covered_part(double seen, double section)
{
    return section > 0.0 ? fmin(seen / section, 1.0) : 1.0;
}

/* Where the area lies along each axis: an even strip ends sqrt(3) standard deviations from its middle. */
static nook_surfel_extent extent_of(const nook_surfel_bin *sum)
{
    nook_surfel_extent extent;
    for (int axis = 0; axis < 3; axis++) {
        double mean = sum->first[axis] / sum->area;
        double reach = sqrt(3.0 * fmax(sum->second[axis] / sum->area - mean * mean, 0.0));
        extent.low[axis] = fmax(mean - reach, -0.5);
        extent.high[axis] = fmin(mean + reach, 0.5);
    }
    return extent;
}

/*
 * Rays that meet a plane of alpha a are wrong by a for 1 - a of its area and by 1 - a for a of it: squared and summed, this. What lies
 * outside of the section is missed.
 */
static double wrong_area(double seen, double section, double alpha)
{
    return section * alpha * (1.0 - alpha) + fmax(seen - section, 0.0);
}

static uint32_t steps_of(double alpha)
{
    return (uint32_t)lround(alpha * NOOK_SURFEL_ALPHA_MAX);
}

/* A plane by itself: the box that it lies in, where that says better than coverage what is there. @return the second word; alpha 0: nothing */
static uint32_t choose_box(const nook_surfel_bin *sum, const plane *p, double bias, uint32_t *alpha)
{
    nook_surfel_extent wanted = extent_of(sum), box;
    nook_polygon section = section_of(p, bias, NOOK_SIDE_BOTH, NULL);
    double seen = seen_area(sum, p), all = area_of(&section, p), part = covered_part(seen, all);
    *alpha = steps_of(part);
    if (*alpha == 0 || *alpha == NOOK_SURFEL_ALPHA_MAX)
        return 0;
    uint32_t word = nook_surfel_box_pack(&wanted, &box);
    double within = area_within(&section, p, &box), part_within = covered_part(seen, within);
    if (!(wrong_area(seen, within, part_within) < wrong_area(seen, all, part)))
        return 0;
    *alpha = steps_of(part_within);
    return word;
}

/* One of two planes, which has no room for both: an interval, all of which is there, or a side and coverage. */
static void choose_end(const nook_surfel_bin *sum, const plane *p, const plane *other, double bias,
                       nook_surfel_plane *out)
{
    nook_surfel_extent wanted = extent_of(sum), interval;
    nook_polygon section;
    nook_surfel_side side = side_of(sum, other);
    section = section_of(p, bias, side, other);
    double seen = seen_area(sum, p), all = area_of(&section, p), part = covered_part(seen, all);
    *out = (nook_surfel_plane){ .alpha = steps_of(part), .side = side };
    if (out->alpha == 0 || out->alpha == NOOK_SURFEL_ALPHA_MAX)
        return;
    double least = wrong_area(seen, all, part);
    section = section_of(p, bias, NOOK_SIDE_BOTH, NULL);
    for (int axis = 0; axis < 3; axis++) {
        uint32_t code = nook_surfel_interval_pack(&wanted, axis, &interval);
        double wrong = fabs(area_within(&section, p, &interval) - seen);
        if (wrong < least) {
            least = wrong;
            *out = (nook_surfel_plane){ .alpha = NOOK_SURFEL_ALPHA_MAX, .side = NOOK_SIDE_WITHIN, .interval = code };
        }
    }
}

static uint32_t pack(const nook_surfel_bin *sum, const plane *p, const nook_surfel_plane *ends)
{
    nook_surfel_plane packed = *ends;
    double through[3];
    for (int i = 0; i < 3; i++) {
        packed.normal[i] = p->normal[i];
        through[i] = sum->first[i] / sum->area;
    }
    return nook_surfel_pack(&packed, through);
}

static bool fit_one(const nook_surfel_bin *sum, double bias, nook_surfel *out)
{
    plane p = plane_of(sum);
    nook_surfel_plane ends = { .side = NOOK_SIDE_BOTH };
    uint32_t box = choose_box(sum, &p, bias, &ends.alpha);
    if (ends.alpha == 0)
        return false;
    *out = (nook_surfel){ { pack(sum, &p, &ends), box } };
    return true;
}

static bool fit_two(const nook_surfel_bin sums[2], double bias, nook_surfel *out)
{
    nook_surfel_plane ends[2];
    plane planes[2] = { plane_of(&sums[0]), plane_of(&sums[1]) };
    for (int k = 0; k < 2; k++)
        choose_end(&sums[k], &planes[k], &planes[1 - k], bias, &ends[k]);
    for (int k = 0; k < 2; k++)
        if (ends[k].alpha == 0) /* too little to be told from nothing */
            return fit_one(&sums[1 - k], bias, out);
    for (int k = 0; k < 2; k++)
        out->plane[k] = pack(&sums[k], &planes[k], &ends[k]);
    return true;
}

bool nook_surfel_fit(const nook_surfel_bin *bins, size_t count, double bias, nook_surfel *out)
{
    uint8_t group[NOOK_SURFEL_BINS_PER_VOXEL] = { 0 };
    nook_surfel_bin sums[2];
    nook_surfel_bin all = sum_group(bins, group, count, 0);
    plane p = plane_of(&all);
    if (count == 1 || distance_to(&all, &p) <= flat * flat * all.area || !split(bins, count, group, sums))
        return fit_one(&all, bias, out);
    return fit_two(sums, bias, out);
}
