#include "game/plan/plan_describe.h"
#include "engine/core/log.h"
#include "engine/core/vector.h"
#include "game/plan/plan_surface.h"
#include "modules/ao/sampling.h"
#include "modules/plan/shape.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const nook_plan_box nothing = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };

static void widen(nook_plan_box *box, const double point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        box->min[axis] = fmin(box->min[axis], point[axis]);
        box->max[axis] = fmax(box->max[axis], point[axis]);
    }
}

/* A corner of a volume's triangles, moved. */
static void corner_at(const nook_scene_volume *volume, size_t index, const nook_matrix *matrix, double out[3])
{
    const float *p = volume->positions + (size_t)volume->indices[index] * 3;
    double point[3] = { p[0], p[1], p[2] };
    nook_matrix_apply_point(matrix, point, out);
}

static nook_plan_box box_of(const nook_scene_volume *volume, const nook_matrix *matrix, size_t first, size_t count)
{
    nook_plan_box box = nothing;
    for (size_t i = first; i < first + count; i++) {
        double point[3];
        corner_at(volume, i, matrix, point);
        widen(&box, point);
    }
    return box;
}

/* ---- Volumes and bodies ----------------------------------------------------------------------------------------- */

/* With the same triangles, bit for bit, and opaque: files often hold a mesh once for each node. */
static bool are_twins(const nook_scene_volume *a, const nook_scene_volume *b)
{
    return a->part_count == 0 && b->part_count == 0 && a->index_count > 0 && a->vertex_count == b->vertex_count &&
           a->index_count == b->index_count &&
           memcmp(a->indices, b->indices, a->index_count * sizeof *a->indices) == 0 &&
           memcmp(a->positions, b->positions, (size_t)a->vertex_count * 3 * sizeof *a->positions) == 0;
}

static void describe_volumes(const nook_scene_volumes *volumes, nook_plan_description *out)
{
    const nook_matrix identity = nook_matrix_identity();
    for (uint32_t i = 0; i < volumes->volume_count; i++) {
        const nook_scene_volume *volume = &volumes->volumes[i];
        nook_plan_volume *described = &out->volumes[i];
        nook_plan_box box = box_of(volume, &identity, 0, nook_scene_volume_index_count(volume));
        *described = (nook_plan_volume){ .resolution = volume->resolution, .twin = i };
        for (int axis = 0; axis < 3; axis++)
            described->sides[axis] = box.max[axis] - box.min[axis];
        for (uint32_t k = 0; k < i && described->twin == i; k++)
            if (i != out->scene.static_volume && k != out->scene.static_volume &&
                are_twins(volume, &volumes->volumes[k]))
                described->twin = k;
    }
    for (uint32_t i = 0; i < volumes->occluder_count; i++) {
        const nook_scene_occluder *occluder = &volumes->occluders[i];
        double scale = nook_matrix_longest_axis(&occluder->world_from_mesh);
        nook_plan_volume *twin = &out->volumes[out->volumes[occluder->volume].twin];
        nook_plan_volume *own = &out->volumes[occluder->volume];
        own->scale = fmax(own->scale, scale);
        twin->scale = fmax(twin->scale, scale);
    }
}

static void describe_occluder(const nook_scene_volume *volume, const nook_scene_occluder *occluder, bool convex,
                              nook_plan_occluder *out)
{
    *out = (nook_plan_occluder){ .volume = occluder->volume,
                                 .box = box_of(volume, &occluder->world_from_mesh, 0,
                                               nook_scene_volume_index_count(volume)),
                                 .alone = convex };
    for (int axis = 0; axis < 3; axis++)
        out->centre[axis] = 0.5 * (out->box.min[axis] + out->box.max[axis]);
    for (size_t i = 0; i < nook_scene_volume_index_count(volume); i++) {
        double point[3];
        corner_at(volume, i, &occluder->world_from_mesh, point);
        nook_vector_add_scaled(point, -1.0, out->centre, point);
        out->radius = fmax(out->radius, nook_vector_length(point));
    }
}

static void describe_occluders(const nook_scene_volumes *volumes, nook_plan_description *out)
{
    for (uint32_t v = 0; v < volumes->volume_count; v++) {
        const nook_scene_volume *volume = &volumes->volumes[v];
        bool convex = v != out->scene.static_volume &&
                      nook_plan_is_convex(volume->positions, volume->indices, nook_scene_volume_index_count(volume));
        for (uint32_t i = 0; i < volumes->occluder_count; i++)
            if (volumes->occluders[i].volume == v)
                describe_occluder(volume, &volumes->occluders[i], convex, &out->occluders[i]);
    }
}

static void describe_parts(const nook_scene_volumes *volumes, nook_plan_description *out)
{
    for (uint32_t i = 0; i < volumes->occluder_count; i++) {
        const nook_scene_occluder *occluder = &volumes->occluders[i];
        if (occluder->node != NOOK_NONE)
            continue;
        out->scene.static_volume = occluder->volume;
        for (uint32_t k = 0; k < volumes->part_count; k++) {
            const nook_volumes_part *part = &volumes->parts[k];
            out->parts[k].box = box_of(&volumes->volumes[occluder->volume], &occluder->world_from_mesh,
                                       part->first_index, part->index_count);
        }
        out->scene.part_count = volumes->part_count;
    }
}

/* ---- From where it is seen -------------------------------------------------------------------------------------- */

static void set_plane(const nook_matrix *view_from_world, const double normal[3], double offset, double out[4])
{
    const double *m = view_from_world->m;
    out[3] = offset;
    for (int axis = 0; axis < 3; axis++) {
        out[axis] = normal[0] * m[axis * 4] + normal[1] * m[axis * 4 + 1] + normal[2] * m[axis * 4 + 2];
        out[3] += normal[axis] * m[12 + axis];
    }
}

static void describe_view(const nook_plan_situation *situation, nook_plan_view *out)
{
    const nook_camera *camera = situation->camera;
    double y = tan(0.5 * camera->fov_y_radians), x = y * situation->aspect;
    const double normals[5][3] = {
        { 1.0, 0.0, -x }, { -1.0, 0.0, -x }, { 0.0, 1.0, -y }, { 0.0, -1.0, -y }, { 0.0, 0.0, -1.0 }
    };
    for (int i = 0; i < 5; i++)
        set_plane(&camera->view_from_world, normals[i], i == 4 ? -camera->z_near : 0.0, out->planes[i]);
    const double *m = camera->view_from_world.m;
    for (int axis = 0; axis < 3; axis++)
        out->eye[axis] = -(m[axis * 4] * m[12] + m[axis * 4 + 1] * m[13] + m[axis * 4 + 2] * m[14]);
    out->pixel_metres = 2.0 * y / situation->height;
}

/* ---- Of a picture's rays ---------------------------------------------------------------------------------------- */

/* From the table's next place upwards. */
static double ray_share(void *user, double sine)
{
    const nook_plan_description *description = user;
    return description->ray_shares[(size_t)ceil(fmin(fmax(sine, 0.0), 1.0) * NOOK_PLAN_SINES)];
}

/* Of frames with index 0, which are those that are measured. */
static nook_result describe_rays(uint32_t rays, nook_plan_description *out)
{
    float *directions = malloc((size_t)NOOK_DIRECTION_BLOCKS * rays * 4 * sizeof *directions);
    if (!directions)
        return nook_fail(NOOK_E_MEMORY, "plan: no memory for %u rays", rays);
    nook_fill_directions(rays, 0, 0, directions);
    for (int i = 0; i <= NOOK_PLAN_SINES; i++) {
        double below = i > 0 ? out->ray_shares[i - 1] : 0.0; /* once all rays are in, they stay in */
        out->ray_shares[i] =
            below >= 1.0 ? 1.0
                         : nook_plan_ray_share(directions, NOOK_DIRECTION_BLOCKS, rays, (double)i / NOOK_PLAN_SINES);
    }
    free(directions);
    out->scene.ray_share = ray_share;
    out->scene.user = out;
    return NOOK_OK;
}

/* ---- All of it -------------------------------------------------------------------------------------------------- */

static nook_result make_room(const nook_scene_volumes *volumes, nook_plan_description *out)
{
    out->volumes = calloc((size_t)volumes->volume_count + 1, sizeof *out->volumes);
    out->occluders = calloc((size_t)volumes->occluder_count + 1, sizeof *out->occluders);
    out->parts = calloc((size_t)volumes->part_count + 1, sizeof *out->parts);
    if (!out->volumes || !out->occluders || !out->parts)
        return nook_fail(NOOK_E_MEMORY, "plan: no memory for %u bodies", volumes->occluder_count);
    out->scene = (nook_plan_scene){ .volumes = out->volumes,
                                    .volume_count = volumes->volume_count,
                                    .occluders = out->occluders,
                                    .occluder_count = volumes->occluder_count,
                                    .parts = out->parts,
                                    .static_volume = NOOK_PLAN_NONE,
                                    .r_max = volumes->r_max };
    return NOOK_OK;
}

static nook_result describe_surface(const nook_scene *scene, const nook_scene_volumes *volumes,
                                    nook_plan_description *out)
{
    uint32_t *of_node = malloc(((size_t)scene->node_count + 1) * sizeof *of_node);
    if (!of_node)
        return nook_fail(NOOK_E_MEMORY, "plan: no memory for %u nodes", scene->node_count);
    for (uint32_t i = 0; i < scene->node_count; i++)
        of_node[i] = NOOK_PLAN_NONE;
    for (uint32_t i = 0; i < volumes->occluder_count; i++)
        if (volumes->occluders[i].node != NOOK_NONE)
            of_node[volumes->occluders[i].node] = i;
    nook_result result = nook_plan_surface(scene, of_node, volumes->r_max, &out->receivers, &out->scene.receiver_count);
    out->scene.receivers = out->receivers;
    free(of_node);
    return result;
}

nook_result nook_plan_describe(const nook_scene *scene, const nook_scene_volumes *volumes, uint32_t rays,
                               const nook_plan_situation *situation, nook_plan_description *out)
{
    *out = (nook_plan_description){ .volumes = NULL };
    nook_result result = make_room(volumes, out);
    if (result != NOOK_OK)
        return result;
    out->scene.moves = situation->moves;
    out->scene.exact_union = !situation->multiplies;
    describe_parts(volumes, out);
    describe_volumes(volumes, out);
    describe_occluders(volumes, out);
    if (situation->camera) {
        describe_view(situation, &out->view);
        out->scene.view = &out->view;
    }
    if (!situation->moves)
        result = describe_surface(scene, volumes, out);
    return result == NOOK_OK && rays > 0 && !situation->moves ? describe_rays(rays, out) : result;
}

void nook_plan_description_free(nook_plan_description *description)
{
    free(description->volumes);
    free(description->occluders);
    free(description->receivers);
    free(description->parts);
    *description = (nook_plan_description){ .volumes = NULL };
}
