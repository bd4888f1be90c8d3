#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <string.h>

/*
 * ODE gives two cylinders that are not in line one contact, whose normal it approaches by iteration: a drum across a drum rocks on
 * a point that wanders. Where a lid lies on something, or a side touches a side, there are closed forms. What is left to ODE are
 * rims.
 */

static const double flush_cosine = 0.98;    /* between a lid's normal and the contact's: it lies on the lid */
static const double side_cosine = 0.2;      /* between an axis and the contact's normal: it lies on the side */
static const double parallel_cosine = 0.98; /* between two axes: the sides touch along a line */

typedef struct cylinder {
    dGeomID geom;
    double middle[3], axis[3], radius, half;
} cylinder;

static cylinder cylinder_of(dGeomID geom)
{
    cylinder c = { .geom = geom };
    double length;
    dGeomCylinderGetParams(geom, &c.radius, &length);
    c.half = 0.5 * length;
    memcpy(c.middle, dGeomGetPosition(geom), sizeof c.middle);
    nook_physics_axis(geom, 2, c.axis);
    return c;
}

/* @param normal out of the second geom */
static void set_contact(dContactGeom *out, const dContactGeom *like, const double position[3], const double normal[3],
                        double depth)
{
    *out = *like;
    memcpy(out->pos, position, 3 * sizeof(double));
    memcpy(out->normal, normal, 3 * sizeof(double));
    out->depth = depth;
}

/* ---- on a lid ---- */

/* Clips to the prism over a convex outline that turns counter-clockwise about `up`. */
static int clip_to_outline(double points[PHYSICS_CLIPPED_MAX][3], int count, double outline[PHYSICS_OUTLINE_MAX][3],
                           int corners, const double up[3])
{
    for (int i = 0; i < corners && count > 0; i++) {
        double edge[3], inwards[3];
        nook_vector_add_scaled(outline[(i + 1) % corners], -1.0, outline[i], edge);
        nook_vector_cross(up, edge, inwards);
        count = nook_physics_clip(points, count, outline[i], inwards);
    }
    return count;
}

/* What of `other` lies below the lid of `lid` that looks along `up`. @param sign of the normals: 1 when lid is the second */
static uint32_t lie_on_lid(const cylinder *lid, const cylinder *other, const double up[3], double sign,
                           const dContactGeom *like, dContactGeom *out, uint32_t capacity)
{
    double points[PHYSICS_CLIPPED_MAX][3], outline[PHYSICS_OUTLINE_MAX][3], down[3], normal[3];
    for (int i = 0; i < 3; i++)
        down[i] = -up[i], normal[i] = sign * up[i];
    int corners = nook_physics_face_against(lid->geom, down, outline);
    /* outlines turn about the cylinder's axis: about `up` only when that is the axis */
    const double about = nook_vector_dot(up, lid->axis) > 0.0 ? 1.0 : -1.0;
    double turn[3];
    for (int i = 0; i < 3; i++)
        turn[i] = about * up[i];
    int count = nook_physics_face_against(other->geom, up, points);
    count = clip_to_outline(points, count, outline, corners, turn);
    uint32_t made = 0;
    for (int i = 0; i < count && made < capacity; i++) {
        double below[3];
        nook_vector_add_scaled(outline[0], -1.0, points[i], below);
        double depth = nook_vector_dot(below, up);
        if (depth >= 0.0)
            set_contact(&out[made++], like, points[i], normal, depth);
    }
    return made;
}

/* ---- side to side ---- */

static double clamp(double x, double low, double high)
{
    return fmax(low, fmin(high, x));
}

/* A contact between the sides at the points that lie `a` and `b` metres along the axes. @return whether they touch there */
static bool touch_sides(const cylinder *c1, const cylinder *c2, double a, double b, const dContactGeom *like,
                        dContactGeom *out)
{
    double p1[3], p2[3], way[3], normal[3], at[3];
    nook_vector_add_scaled(c1->middle, a, c1->axis, p1);
    nook_vector_add_scaled(c2->middle, b, c2->axis, p2);
    nook_vector_add_scaled(p1, -1.0, p2, way);
    double depth = c1->radius + c2->radius - nook_vector_length(way);
    if (depth < 0.0 || !nook_vector_normalize(way, normal))
        return false;
    nook_vector_add_scaled(p2, c2->radius - 0.5 * depth, normal, at);
    set_contact(out, like, at, normal, depth);
    return true;
}

/* Nearly parallel: at both ends of what they have in common. */
static uint32_t touch_along(const cylinder *c1, const cylinder *c2, double cosine, const double between[3],
                            const dContactGeom *like, dContactGeom *out)
{
    double offset = nook_vector_dot(between, c1->axis); /* of the second's middle, along the first's axis */
    double low = fmax(-c1->half, offset - c2->half), high = fmin(c1->half, offset + c2->half);
    uint32_t made = 0;
    if (low > high)
        return 0;
    for (int end = 0; end < 2; end++) {
        double a = end ? high : low, b = (a - offset) * (cosine > 0.0 ? 1.0 : -1.0);
        made += touch_sides(c1, c2, a, clamp(b, -c2->half, c2->half), like, &out[made]);
    }
    return made;
}

/* Where the axes' lines come nearest; 0 when that is beyond an end, where rims touch. */
static uint32_t touch_crossed(const cylinder *c1, const cylinder *c2, double cosine, const double between[3],
                              const dContactGeom *like, dContactGeom *out)
{
    double d1 = nook_vector_dot(between, c1->axis), d2 = nook_vector_dot(between, c2->axis);
    double sine2 = 1.0 - cosine * cosine;
    double a = (d1 - cosine * d2) / sine2, b = (cosine * d1 - d2) / sine2;
    if (fabs(a) > c1->half || fabs(b) > c2->half)
        return 0;
    return touch_sides(c1, c2, a, b, like, out);
}

uint32_t nook_physics_lay_cylinders(dGeomID g1, dGeomID g2, dContactGeom *contacts, uint32_t count, uint32_t capacity)
{
    if (count == 0 || capacity < 2)
        return count;
    const cylinder c1 = cylinder_of(g1), c2 = cylinder_of(g2);
    const dContactGeom like = contacts[0];
    double along1 = nook_vector_dot(c1.axis, like.normal), along2 = nook_vector_dot(c2.axis, like.normal);
    double cosine = nook_vector_dot(c1.axis, c2.axis), between[3];
    nook_vector_add_scaled(c2.middle, -1.0, c1.middle, between);
    uint32_t made = 0;
    if (fmax(fabs(along1), fabs(along2)) > flush_cosine) {
        bool second = fabs(along2) >= fabs(along1); /* whose lid it is; its normal points at the other */
        const cylinder *lid = second ? &c2 : &c1;
        double up[3], sign = second ? 1.0 : -1.0, side = (second ? along2 : -along1) > 0.0 ? 1.0 : -1.0;
        for (int i = 0; i < 3; i++)
            up[i] = side * lid->axis[i];
        made = lie_on_lid(lid, second ? &c1 : &c2, up, sign, &like, contacts, capacity);
    } else if (fabs(along1) < side_cosine && fabs(along2) < side_cosine) {
        made = fabs(cosine) > parallel_cosine ? touch_along(&c1, &c2, cosine, between, &like, contacts)
                                              : touch_crossed(&c1, &c2, cosine, between, &like, contacts);
    }
    return made > 0 ? made : count;
}
