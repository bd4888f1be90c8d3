#include "engine/physics/pose.h"
#include "engine/core/rotation.h"
#include "engine/core/vector.h"

nook_pose nook_pose_identity(void)
{
    return (nook_pose){ .rotation = { 0, 0, 0, 1 } };
}

static double length4(const double q[4])
{
    return sqrt(nook_vector_dot(q, q) + q[3] * q[3]);
}

bool nook_pose_valid(const nook_pose *pose)
{
    for (int i = 0; i < 3; i++)
        if (!isfinite(pose->position[i]))
            return false;
    return fabs(length4(pose->rotation) - 1.0) <= 1e-3; /* false for NaN and infinity */
}

static void normalize4(double q[4])
{
    double scale = 1.0 / length4(q);
    for (int i = 0; i < 4; i++)
        q[i] *= scale;
}

nook_pose nook_pose_multiply(const nook_pose *a, const nook_pose *b)
{
    nook_pose out = nook_pose_identity();
    nook_pose_apply_point(a, b->position, out.position);
    nook_rotation_multiply(a->rotation, b->rotation, out.rotation);
    normalize4(out.rotation);
    return out;
}

nook_pose nook_pose_inverse(const nook_pose *pose)
{
    const double *p = pose->position, back[3] = { -p[0], -p[1], -p[2] };
    nook_pose out = nook_pose_identity();
    nook_rotation_inverse(pose->rotation, out.rotation);
    nook_rotation_apply(out.rotation, back, out.position);
    return out;
}

void nook_pose_apply_point(const nook_pose *pose, const double point[3], double out[3])
{
    double turned[3];
    nook_rotation_apply(pose->rotation, point, turned);
    nook_vector_add_scaled(pose->position, 1.0, turned, out);
}

void nook_pose_apply_vector(const nook_pose *pose, const double vector[3], double out[3])
{
    nook_rotation_apply(pose->rotation, vector, out);
}

/* Along the chord and then made unit: between two steps the turn is small, and the error in speed with it. */
nook_pose nook_pose_between(const nook_pose *from, const nook_pose *to, double t)
{
    if (!(t > 0.0))
        return *from;
    if (t >= 1.0)
        return *to;
    nook_pose out;
    for (int i = 0; i < 3; i++)
        out.position[i] = from->position[i] + t * (to->position[i] - from->position[i]);
    const double *a = from->rotation, *b = to->rotation;
    double same_side = nook_vector_dot(a, b) + a[3] * b[3] < 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < 4; i++)
        out.rotation[i] = a[i] + t * (same_side * b[i] - a[i]);
    normalize4(out.rotation);
    return out;
}

void nook_pose_turn_rate(const double from[4], const double to[4], double seconds, double out_angular[3])
{
    double back[4], turn[4];
    nook_rotation_inverse(from, back);
    nook_rotation_multiply(to, back, turn);
    double sine = nook_vector_length(turn), angle = 2.0 * atan2(sine, fabs(turn[3]));
    double scale = (sine > 0.0 ? angle / sine : 2.0) / seconds * (turn[3] < 0.0 ? -1.0 : 1.0);
    for (int i = 0; i < 3; i++)
        out_angular[i] = turn[i] * scale;
}

nook_matrix nook_pose_matrix(const nook_pose *pose)
{
    const double unscaled[3] = { 1, 1, 1 };
    return nook_matrix_compose(pose->position, pose->rotation, unscaled);
}
