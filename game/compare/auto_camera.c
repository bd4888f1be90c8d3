#include "game/compare/auto_camera.h"
#include "engine/core/angle.h"
#include "engine/core/vector.h"
#include "game/compare/camera.h"
#include <math.h>

enum { DIRECTIONS = 16, PROBES = 9, GRID = 7 };
static const double backs_tolerated = 0.1;
/* In pictures longer than that the scene would be a dot: they show a strip of a picture that is not. */
static const double aspect_max = 4.0;

/* Whether a ray meets a box nearer than `limit`. Axes that it does not move along give infinities of the right signs. */
static bool meets_box(const float low[3], const float high[3], const double origin[3], const double direction[3],
                      double limit)
{
    double enter = 0.0, leave = limit;
    for (int i = 0; i < 3; i++) {
        double a = (low[i] - origin[i]) / direction[i], b = (high[i] - origin[i]) / direction[i];
        enter = fmax(enter, fmin(a, b)); /* fmin and fmax leave out NaN: 0 / 0, in the plane of a side */
        leave = fmin(leave, fmax(a, b));
    }
    return enter <= leave;
}

/* Moeller and Trumbore. @return the distance, or infinity; *out_facing is < 0 when the ray meets the front */
static double meet_triangle(const float *const corners[3], const double origin[3], const double direction[3],
                            double *out_facing)
{
    double u[3], v[3], from[3], p[3], q[3];
    nook_vector_between(corners[0], corners[1], u);
    nook_vector_between(corners[0], corners[2], v);
    for (int i = 0; i < 3; i++)
        from[i] = origin[i] - corners[0][i];
    nook_vector_cross(direction, v, p);
    double determinant = nook_vector_dot(u, p); /* = -direction . normal */
    if (determinant == 0.0)
        return INFINITY;
    nook_vector_cross(from, u, q);
    double a = nook_vector_dot(from, p) / determinant, b = nook_vector_dot(direction, q) / determinant;
    double distance = nook_vector_dot(v, q) / determinant;
    if (!(a >= 0.0 && b >= 0.0 && a + b <= 1.0 && distance > 0.0))
        return INFINITY;
    *out_facing = -determinant;
    return distance;
}

/* All of it in mesh space: glTF turns the winding of mirrored nodes, so that a front stays a front. */
static void meet_primitive(const nook_scene *scene, const nook_primitive *primitive, const double origin[3],
                           const double direction[3], nook_view_hit *hit)
{
    const nook_vertex *vertices = scene->vertices + primitive->first_vertex;
    const uint32_t *indices = scene->indices + primitive->first_index;
    for (uint32_t i = 0; i + 2 < primitive->index_count; i += 3) {
        const float *const corners[3] = { vertices[indices[i]].position, vertices[indices[i + 1]].position,
                                          vertices[indices[i + 2]].position };
        double facing = 0.0, distance = meet_triangle(corners, origin, direction, &facing);
        if (distance < hit->distance)
            *hit = (nook_view_hit){ distance, facing < 0.0 };
    }
}

nook_view_hit nook_scene_cast(const nook_scene *scene, const double origin[3], const double direction[3])
{
    nook_view_hit hit = { INFINITY, false };
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i];
        nook_matrix local_from_world;
        double from[3], along[3];
        if (node->mesh == NOOK_NONE || !nook_matrix_inverse_affine(&node->world_from_local, &local_from_world))
            continue;
        nook_matrix_apply_point(&local_from_world, origin, from);
        nook_matrix_apply_vector(&local_from_world, direction, along);
        const nook_mesh *mesh = &scene->meshes[node->mesh];
        if (!meets_box(mesh->bounds_min, mesh->bounds_max, from, along, hit.distance))
            continue;
        for (uint32_t p = 0; p < mesh->primitive_count; p++)
            meet_primitive(scene, &scene->primitives[mesh->first_primitive + p], from, along, &hit);
    }
    return hit;
}

/* A ray through the picture. @param u, v  in [-1, 1], v up */
static nook_view_hit cast_pixel(const nook_scene *scene, const nook_camera *view, double aspect, double u, double v)
{
    nook_matrix world_from_view;
    double tan_y = tan(0.5 * view->fov_y_radians), eye[3], direction[3];
    const double origin[3] = { 0.0, 0.0, 0.0 }, along[3] = { u * tan_y * aspect, v * tan_y, -1.0 };
    nook_matrix_inverse_affine(&view->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    nook_matrix_apply_vector(&world_from_view, along, direction);
    return nook_scene_cast(scene, eye, direction);
}

double nook_view_back_fraction(const nook_scene *scene, const nook_camera *view, double aspect)
{
    int hits = 0, backs = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        double u = 2.0 * (i % GRID + 0.5) / GRID - 1.0, v = 2.0 * (i / GRID + 0.5) / GRID - 1.0;
        nook_view_hit hit = cast_pixel(scene, view, aspect, u, v);
        hits += isfinite(hit.distance);
        backs += isfinite(hit.distance) && !hit.front;
    }
    return hits > 0 ? backs / (double)hits : 0.0;
}

/* Level, from one of the four sides, just far enough to hold the box. */
static nook_camera side_view(const nook_scene *scene, int side, const nook_camera *like, double aspect)
{
    const double away[4][3] = { { 0, 0, 1 }, { 1, 0, 0 }, { -1, 0, 0 }, { 0, 0, -1 } };
    double half[3], centre[3], eye[3], tan_y = tan(0.5 * like->fov_y_radians);
    for (int i = 0; i < 3; i++) {
        half[i] = 0.5 * (scene->bounds_max[i] - scene->bounds_min[i]);
        centre[i] = scene->bounds_min[i] + half[i];
    }
    int depth_axis = away[side][0] != 0.0 ? 0 : 2;
    double distance = half[depth_axis] + 1.04 * fmax(half[1], half[2 - depth_axis] / aspect) / tan_y;
    nook_camera camera = *like;
    nook_vector_add_scaled(centre, distance, away[side], eye);
    nook_camera_look(eye, centre, like->fov_y_radians, like->z_near, &camera);
    return camera;
}

static nook_camera frame_outside(const nook_scene *scene, double aspect)
{
    nook_camera best = nook_camera_frame(scene->bounds_min, scene->bounds_max, aspect);
    double least = nook_view_back_fraction(scene, &best, aspect);
    if (least < backs_tolerated)
        return best;
    const nook_camera three_quarters = best;
    for (int side = 0; side < 4; side++) {
        nook_camera camera = side_view(scene, side, &three_quarters, aspect);
        double fraction = nook_view_back_fraction(scene, &camera, aspect);
        if (fraction < 0.5 * least) {
            best = camera;
            least = fraction;
        }
    }
    return best;
}

nook_camera nook_camera_outside(const nook_scene *scene, double aspect)
{
    double framed = fmin(fmax(aspect, 1.0 / aspect_max), aspect_max);
    nook_camera camera = frame_outside(scene, framed);
    if (aspect >
        framed) /* as wide an angle as it was framed for; of a high picture the sides fall away by themselves */
        camera.fov_y_radians = 2.0 * atan(tan(0.5 * camera.fov_y_radians) * framed / aspect);
    return camera;
}

/* How much of what is around `centre` something nearer hides from a view. */
static double hidden_fraction(const nook_scene *scene, const nook_camera *view, const double centre[3], double diagonal)
{
    nook_matrix world_from_view;
    const double origin[3] = { 0.0, 0.0, 0.0 };
    double eye[3];
    int hidden = 0;
    nook_matrix_inverse_affine(&view->view_from_world, &world_from_view);
    nook_matrix_apply_point(&world_from_view, origin, eye);
    for (int i = 0; i < PROBES; i++) {
        double towards[3], aim[3] = { 0.06 * diagonal * (i % 3 - 1), 0.06 * diagonal * (i / 3 - 1), 0.0 };
        nook_matrix_apply_vector(&world_from_view, aim, aim);
        for (int k = 0; k < 3; k++)
            towards[k] = centre[k] + aim[k] - eye[k];
        hidden += nook_scene_cast(scene, eye, towards).distance < 0.9;
    }
    return hidden / (double)PROBES;
}

static void level_direction(int index, double out[3])
{
    double angle = 2.0 * NOOK_PI * index / DIRECTIONS;
    out[0] = cos(angle), out[1] = 0.0, out[2] = sin(angle);
}

/* Looks around on the level. @return the fraction of directions in which a wall shows its front, not too near */
static double look_around(const nook_scene *scene, const double origin[3], double nearest, double far,
                          double free_run[DIRECTIONS])
{
    int walls = 0;
    for (int i = 0; i < DIRECTIONS; i++) {
        double direction[3];
        level_direction(i, direction);
        nook_view_hit hit = nook_scene_cast(scene, origin, direction);
        walls += hit.distance < far && hit.distance > nearest && hit.front;
        free_run[i] = fmin(hit.distance, far);
    }
    return walls / (double)DIRECTIONS;
}

/* A place to look around from: above the floor under the middle, at a person's share of the height. */
static void choose_height(const nook_scene *scene, double point[3])
{
    const double down[3] = { 0.0, -1.0, 0.0 }, up[3] = { 0.0, 1.0, 0.0 };
    double floor = fmin(nook_scene_cast(scene, point, down).distance, point[1] - scene->bounds_min[1]);
    double ceiling = fmin(nook_scene_cast(scene, point, up).distance, scene->bounds_max[1] - point[1]);
    point[1] += 0.35 * (floor + ceiling) - floor;
}

bool nook_camera_inside(const nook_scene *scene, const nook_camera *outside, nook_camera *out_camera)
{
    double diagonal = nook_scene_diagonal(scene), centre[3], free_run[DIRECTIONS];
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5 * (scene->bounds_min[i] + scene->bounds_max[i]);
    if (hidden_fraction(scene, outside, centre, diagonal) < 0.7)
        return false;
    choose_height(scene, centre);
    if (look_around(scene, centre, 0.04 * diagonal, diagonal, free_run) < 0.75)
        return false;
    /* From near one wall towards the farthest one, a little aside of the axis so that it does not look like a plan. */
    int best = 0;
    for (int i = 1; i < DIRECTIONS; i++) {
        if (free_run[i] + free_run[(i + DIRECTIONS / 2) % DIRECTIONS] >
            free_run[best] + free_run[(best + DIRECTIONS / 2) % DIRECTIONS])
            best = i;
    }
    double ahead[3], eye[3], target[3];
    level_direction(best, ahead);
    double back = 0.85 * free_run[(best + DIRECTIONS / 2) % DIRECTIONS];
    nook_vector_add_scaled(centre, -back, ahead, eye);
    nook_vector_add_scaled(centre, 0.5 * free_run[best], ahead, target);
    target[0] -= 0.06 * diagonal * ahead[2];
    target[2] += 0.06 * diagonal * ahead[0];
    return nook_camera_look(eye, target, 60.0 * NOOK_PI / 180.0, outside->z_near, out_camera) == NOOK_OK;
}
