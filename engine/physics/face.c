#include "engine/core/angle.h"
#include "engine/core/vector.h"
#include "engine/physics/internal.h"
#include <string.h>

/* ---- the face of a shape that looks against a normal ---- */

void nook_physics_axis(dGeomID geom, int index, double out[3])
{
    const double *r = dGeomGetRotation(geom);
    out[0] = r[index], out[1] = r[4 + index], out[2] = r[8 + index];
}

static void point_at(const double middle[3], const double a[3], double x, const double b[3], double y, double out[3])
{
    nook_vector_add_scaled(middle, x, a, out);
    nook_vector_add_scaled(out, y, b, out);
}

static int box_face(dGeomID box, const double normal[3], double outline[PHYSICS_OUTLINE_MAX][3])
{
    dVector3 sides;
    double axes[3][3], middle[3];
    int main_axis = 0;
    dGeomBoxGetLengths(box, sides);
    for (int i = 0; i < 3; i++)
        nook_physics_axis(box, i, axes[i]);
    for (int i = 1; i < 3; i++)
        if (fabs(nook_vector_dot(axes[i], normal)) > fabs(nook_vector_dot(axes[main_axis], normal)))
            main_axis = i;
    double out = nook_vector_dot(axes[main_axis], normal) > 0.0 ? -0.5 : 0.5;
    nook_vector_add_scaled(dGeomGetPosition(box), out * sides[main_axis], axes[main_axis], middle);
    int a = (main_axis + 1) % 3, b = (main_axis + 2) % 3;
    for (int i = 0; i < 4; i++) {
        static const double signs[4][2] = { { -0.5, -0.5 }, { 0.5, -0.5 }, { 0.5, 0.5 }, { -0.5, 0.5 } };
        point_at(middle, axes[a], signs[i][0] * sides[a], axes[b], signs[i][1] * sides[b], outline[i]);
    }
    return 4;
}

/* A lid as a polygon when the cylinder stands, else the line along which it lies. */
static int cylinder_face(dGeomID cylinder, const double normal[3], double outline[PHYSICS_OUTLINE_MAX][3])
{
    double radius, length, axis[3], across[3], side[3], middle[3];
    dGeomCylinderGetParams(cylinder, &radius, &length);
    nook_physics_axis(cylinder, 2, axis);
    double along = nook_vector_dot(axis, normal);
    if (fabs(along) > 0.7) {
        nook_physics_axis(cylinder, 0, across);
        nook_physics_axis(cylinder, 1, side);
        nook_vector_add_scaled(dGeomGetPosition(cylinder), along > 0.0 ? -0.5 * length : 0.5 * length, axis, middle);
        for (int i = 0; i < PHYSICS_OUTLINE_MAX; i++) {
            double angle = 2.0 * NOOK_PI * i / PHYSICS_OUTLINE_MAX;
            point_at(middle, across, radius * cos(angle), side, radius * sin(angle), outline[i]);
        }
        return PHYSICS_OUTLINE_MAX;
    }
    nook_vector_add_scaled(normal, -along, axis, across);
    nook_vector_normalize(across, across);
    nook_vector_add_scaled(dGeomGetPosition(cylinder), -radius, across, middle);
    nook_vector_add_scaled(middle, -0.5 * length, axis, outline[0]);
    nook_vector_add_scaled(middle, 0.5 * length, axis, outline[1]);
    return 2;
}

int nook_physics_face_against(dGeomID geom, const double normal[3], double outline[PHYSICS_OUTLINE_MAX][3])
{
    switch (dGeomGetClass(geom)) {
    case dBoxClass:
        return box_face(geom, normal, outline);
    case dCylinderClass:
        return cylinder_face(geom, normal, outline);
    default:
        return 0; /* round: ODE's contact will do */
    }
}

/* ---- clipping ---- */

int nook_physics_clip(double points[PHYSICS_CLIPPED_MAX][3], int count, const double edge_point[3],
                      const double inwards[3])
{
    double out[PHYSICS_CLIPPED_MAX][3];
    int kept = 0;
    for (int i = 0; i < count && kept < PHYSICS_CLIPPED_MAX - 1; i++) {
        const double *from = points[i], *to = points[(i + 1) % count];
        double a[3], b[3];
        nook_vector_add_scaled(from, -1.0, edge_point, a);
        nook_vector_add_scaled(to, -1.0, edge_point, b);
        double da = nook_vector_dot(a, inwards), db = nook_vector_dot(b, inwards);
        if (da >= 0.0)
            memcpy(out[kept++], from, sizeof out[0]);
        if ((da < 0.0) != (db < 0.0) && da != db) {
            double way[3];
            nook_vector_add_scaled(to, -1.0, from, way);
            nook_vector_add_scaled(from, da / (da - db), way, out[kept++]);
        }
    }
    memcpy(points, out, (size_t)kept * sizeof out[0]);
    return kept;
}
