#include "game/level/shape_fit.h"
#include "engine/core/angle.h"
#include "engine/core/vector.h"
#include <math.h>
#include <string.h>

enum { DIRECTIONS = 32 }; /* in which an outline is measured; half of them, as it is measured to both sides */

static const double round_tolerance =
    0.06;                            /* of a radius: how far a mesh may be from a circle or a sphere to count as one */
static const double thinnest = 1e-3; /* metres, half: what physics can still stack */

/* A mesh with a node's scale. */
typedef struct scaled_mesh {
    const nook_scene *scene;
    const nook_mesh *mesh;
    const double *scale;
    double middle[3], half[3]; /* of its bounds */
} scaled_mesh;

static scaled_mesh scale_mesh(const nook_scene *scene, uint32_t mesh, const double scale[3])
{
    scaled_mesh m = { .scene = scene, .mesh = &scene->meshes[mesh], .scale = scale };
    bool drawn = m.mesh->bounds_min[0] <= m.mesh->bounds_max[0];
    for (int k = 0; k < 3 && drawn; k++) {
        double low = scale[k] * (double)m.mesh->bounds_min[k], high = scale[k] * (double)m.mesh->bounds_max[k];
        m.middle[k] = 0.5 * (low + high);
        m.half[k] = 0.5 * fabs(high - low);
    }
    return m;
}

/* How far the mesh reaches from its middle along each direction. */
static void measure_reach(const scaled_mesh *m, double (*directions)[3], double *out_reach)
{
    for (int i = 0; i < DIRECTIONS; i++)
        out_reach[i] = 0.0;
    for (uint32_t p = 0; p < m->mesh->primitive_count; p++) {
        const nook_primitive *primitive = &m->scene->primitives[m->mesh->first_primitive + p];
        for (uint32_t v = 0; v < primitive->vertex_count; v++) {
            const float *at = m->scene->vertices[primitive->first_vertex + v].position;
            double from_middle[3];
            for (int k = 0; k < 3; k++)
                from_middle[k] = m->scale[k] * (double)at[k] - m->middle[k];
            for (int i = 0; i < DIRECTIONS; i++)
                out_reach[i] = fmax(out_reach[i], nook_vector_dot(from_middle, directions[i]));
        }
    }
}

/* Of reaches in all directions: whether they are those of one circle or sphere. @param out_radius their mean */
static bool is_round(const double *reach, double *out_radius)
{
    double least = reach[0], most = reach[0], sum = 0.0;
    for (int i = 0; i < DIRECTIONS; i++) {
        least = fmin(least, reach[i]);
        most = fmax(most, reach[i]);
        sum += reach[i];
    }
    *out_radius = sum / DIRECTIONS;
    return least >= (1.0 - round_tolerance) * most;
}

/* Round as seen along an axis. */
static bool round_about(const scaled_mesh *m, int axis, double *out_radius)
{
    double directions[DIRECTIONS][3] = { { 0 } }, reach[DIRECTIONS];
    for (int i = 0; i < DIRECTIONS; i++) {
        directions[i][(axis + 1) % 3] = cos(2.0 * NOOK_PI * i / DIRECTIONS);
        directions[i][(axis + 2) % 3] = sin(2.0 * NOOK_PI * i / DIRECTIONS);
    }
    measure_reach(m, directions, reach);
    return is_round(reach, out_radius);
}

/* Round from everywhere: directions on a spiral from pole to pole, evenly over the sphere (Saff and Kuijlaars 1997). */
static bool round_all_over(const scaled_mesh *m, double *out_radius)
{
    double directions[DIRECTIONS][3], reach[DIRECTIONS];
    const double golden = NOOK_PI * (3.0 - sqrt(5.0));
    for (int i = 0; i < DIRECTIONS; i++) {
        double height = 1.0 - 2.0 * (i + 0.5) / DIRECTIONS, width = sqrt(1.0 - height * height);
        directions[i][0] = width * cos(golden * i);
        directions[i][1] = height;
        directions[i][2] = width * sin(golden * i);
    }
    measure_reach(m, directions, reach);
    return is_round(reach, out_radius);
}

/* ---- shapes ------------------------------------------------------------------------------------------------------ */

static void make_box(const scaled_mesh *m, nook_shape *out)
{
    out->kind = NOOK_SHAPE_BOX;
    for (int k = 0; k < 3; k++)
        out->half[k] = fmax(m->half[k], thinnest);
}

static void make_sphere(double radius, nook_shape *out)
{
    out->kind = NOOK_SHAPE_SPHERE;
    out->half[0] = fmax(radius, thinnest);
}

/* A shape's Y onto one of the mesh's axes. */
static void turn_to(int axis, double out_rotation[4])
{
    const double h = 0.70710678118654752440;
    const double turns[3][4] = { { 0, 0, -h, h }, { 0, 0, 0, 1 }, { h, 0, 0, h } };
    memcpy(out_rotation, turns[axis], sizeof turns[axis]);
}

static void make_cylinder(const scaled_mesh *m, int axis, double radius, nook_shape *out)
{
    out->kind = NOOK_SHAPE_CYLINDER;
    out->half[0] = fmax(radius, thinnest);
    out->half[1] = fmax(m->half[axis], thinnest);
    turn_to(axis, out->body_from_shape.rotation);
}

/* The axis whose other two sides are most alike. */
static int roundest_axis(const scaled_mesh *m)
{
    int best = 1;
    double best_ratio = 0.0;
    for (int i = 0; i < 3; i++) {
        int axis = (i + 1) % 3; /* upright first: it wins when all are alike */
        double a = m->half[(axis + 1) % 3], b = m->half[(axis + 2) % 3];
        double ratio = fmin(a, b) / fmax(fmax(a, b), thinnest);
        if (ratio > best_ratio)
            best = axis, best_ratio = ratio;
    }
    return best;
}

static void make_simplest(const scaled_mesh *m, nook_shape *out)
{
    double radius;
    int axis = roundest_axis(m);
    if (round_all_over(m, &radius))
        make_sphere(radius, out);
    else if (round_about(m, axis, &radius))
        make_cylinder(m, axis, radius, out);
    else
        make_box(m, out);
}

void nook_level_shape_fit(const nook_scene *scene, uint32_t mesh, const double scale[3], nook_level_shape wanted,
                          nook_shape *out)
{
    const scaled_mesh m = scale_mesh(scene, mesh, scale);
    double radius;
    *out = (nook_shape){ .body_from_shape = nook_pose_identity() };
    memcpy(out->body_from_shape.position, m.middle, sizeof m.middle);
    if (wanted == NOOK_LEVEL_SHAPE_BOX) {
        make_box(&m, out);
    } else if (wanted == NOOK_LEVEL_SHAPE_SPHERE) {
        round_all_over(&m, &radius);
        make_sphere(radius, out);
    } else if (wanted == NOOK_LEVEL_SHAPE_CYLINDER) {
        round_about(&m, roundest_axis(&m), &radius);
        make_cylinder(&m, roundest_axis(&m), radius, out);
    } else {
        make_simplest(&m, out);
    }
}
