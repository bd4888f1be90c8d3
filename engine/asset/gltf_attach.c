/* Cameras and lights: they sit on nodes, and only the place and the direction of those matter to them. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/scene_internal.h"
#include "engine/core/angle.h"
#include "engine/core/vector.h"
#include <math.h>
#include <string.h>

/* Axis-aligned when there is no direction. */
nook_matrix nook_scene_without_scale(const nook_matrix *m)
{
    nook_matrix out = nook_matrix_translation(m->m[12], m->m[13], m->m[14]);
    double y[3], z[3];
    if (!nook_vector_normalize(m->m + 8, z))
        return out;
    nook_vector_add_scaled(m->m + 4, -nook_vector_dot(m->m + 4, z), z, y);
    if (!nook_vector_normalize(y, y))
        return out;
    nook_vector_cross(y, z, out.m);
    memcpy(out.m + 4, y, sizeof y);
    memcpy(out.m + 8, z, sizeof z);
    return out;
}

static nook_result attach_camera(nook_gltf *gltf, const nook_gltf_node *from, const nook_matrix *world, nook_node *to)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_camera *camera = &gltf->model->cameras[from->camera];
    bool usable = camera->fov_y_radians > 0.0 && camera->fov_y_radians < NOOK_PI && camera->z_near > 0.0;
    if (camera->perspective && !usable)
        nook_scene_warn(scene,
                        "%s: cameras[%u] has a field of view of %g and a near plane at %g; 60 degrees and 0.01 m"
                        " are used",
                        gltf->path, from->camera, camera->fov_y_radians, camera->z_near);
    nook_scene_camera *out = &scene->cameras[scene->camera_count];
    *out = (nook_scene_camera){ .fov_y_radians = usable ? camera->fov_y_radians : NOOK_PI / 3.0,
                                .z_near = usable ? camera->z_near : 0.01,
                                .perspective = camera->perspective,
                                .world_from_view = nook_scene_without_scale(world) };
    out->name = nook_scene_copy_string(camera->name[0] ? camera->name : from->name);
    if (!out->name)
        return NOOK_E_MEMORY;
    to->camera = scene->camera_count++;
    return NOOK_OK;
}

static float positive(double x)
{
    return x > 0.0 ? (float)x : 0.0f;
}

static void attach_light(nook_gltf *gltf, const nook_gltf_node *from, const nook_matrix *world, nook_node *to)
{
    static const char *const types[] = { "directional", "point", "spot" };
    nook_scene *scene = gltf->scene;
    const nook_gltf_light *light = &gltf->model->lights[from->light];
    size_t kind = 0;
    while (kind < NOOK_COUNT(types) && strcmp(light->type, types[kind]) != 0)
        kind++;
    if (kind == NOOK_COUNT(types)) {
        nook_scene_warn(scene, "%s: a light of the unknown type '%.20s' is left out", gltf->path, light->type);
        return;
    }
    double outer = fmin(positive(light->outer_cone), NOOK_PI / 2.0);
    nook_light *out = &scene->lights[scene->light_count];
    *out = (nook_light){ .kind = (nook_light_kind)kind,
                         .intensity = positive(light->intensity),
                         .range = positive(light->range),
                         .inner_cone = (float)fmin(positive(light->inner_cone), outer),
                         .outer_cone = (float)outer,
                         .world_from_light = nook_scene_without_scale(world) };
    for (int k = 0; k < 3; k++)
        out->colour[k] = positive(light->colour[k]);
    to->light = scene->light_count++;
}

nook_result nook_gltf_attach(nook_gltf *gltf, const nook_gltf_node *from, const nook_matrix *world_from_local,
                             nook_node *to)
{
    if (from->light != NOOK_GLTF_NONE)
        attach_light(gltf, from, world_from_local, to);
    return from->camera == NOOK_GLTF_NONE ? NOOK_OK : attach_camera(gltf, from, world_from_local, to);
}
