#include "game/cameras/rays.h"
#include "engine/core/log.h"
#include <embree3/rtcore.h>
#include <math.h>
#include <stdlib.h>

struct nook_rays {
    RTCDevice device;
    RTCScene scene;
    double centre[3]; /* rays are traced relative to it: far from the origin floats would be coarse */
};

/* The triangles of one node; mirrored ones turned, so that a front stays a front. */
static size_t put_indices(const nook_scene *scene, const nook_primitive *primitive, bool mirrored, uint32_t *out)
{
    const uint32_t *indices = scene->indices + primitive->first_index;
    size_t count = primitive->index_count / 3 * 3;
    for (size_t i = 0; i < count; i += 3) {
        out[i] = indices[i];
        out[i + 1] = indices[i + 1 + mirrored];
        out[i + 2] = indices[i + 2 - mirrored];
    }
    return count;
}

static bool add_primitive(nook_rays *rays, const nook_scene *scene, const nook_node *node,
                          const nook_primitive *primitive)
{
    RTCGeometry geometry = rtcNewGeometry(rays->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *positions = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                               3 * sizeof(float), primitive->vertex_count);
    uint32_t *indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                3 * sizeof(uint32_t), primitive->index_count / 3);
    bool made = positions && indices;
    for (uint32_t i = 0; made && i < primitive->vertex_count; i++) {
        const float *from = scene->vertices[primitive->first_vertex + i].position;
        double at[3] = { (double)from[0], (double)from[1], (double)from[2] };
        nook_matrix_apply_point(&node->world_from_local, at, at);
        for (int k = 0; k < 3; k++)
            positions[3 * i + (uint32_t)k] = (float)(at[k] - rays->centre[k]);
    }
    if (made) {
        put_indices(scene, primitive, nook_matrix_determinant3(&node->world_from_local) < 0.0, indices);
        rtcSetGeometryUserData(geometry, (void *)&scene->materials[primitive->material].double_sided);
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(rays->scene, geometry);
    }
    rtcReleaseGeometry(geometry);
    return made;
}

static bool add_node(nook_rays *rays, const nook_scene *scene, const nook_node *node)
{
    const nook_mesh *mesh = &scene->meshes[node->mesh];
    for (uint32_t i = 0; i < mesh->primitive_count; i++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + i];
        bool seen = scene->materials[primitive->material].alpha_mode != NOOK_ALPHA_BLEND;
        if (seen && primitive->index_count >= 3 && !add_primitive(rays, scene, node, primitive))
            return false;
    }
    return true;
}

nook_result nook_rays_create(const nook_scene *scene, nook_rays **out_rays)
{
    *out_rays = NULL;
    nook_rays *rays = calloc(1, sizeof *rays);
    if (!rays)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to cast rays", scene->path);
    for (int i = 0; i < 3; i++)
        rays->centre[i] = 0.5 * (scene->bounds_min[i] + scene->bounds_max[i]);
    rays->device = rtcNewDevice(NULL);
    rays->scene = rays->device ? rtcNewScene(rays->device) : NULL;
    bool made = rays->scene != NULL;
    for (uint32_t i = 0; i < scene->node_count && made; i++)
        made = scene->nodes[i].mesh == NOOK_NONE || add_node(rays, scene, &scene->nodes[i]);
    if (made)
        rtcCommitScene(rays->scene);
    if (!made || rtcGetDeviceError(rays->device) != RTC_ERROR_NONE) {
        nook_rays_destroy(rays);
        return nook_fail(NOOK_E_DEVICE, "%s: Embree takes not all of its triangles; it needs memory", scene->path);
    }
    *out_rays = rays;
    return NOOK_OK;
}

void nook_rays_destroy(nook_rays *rays)
{
    if (!rays)
        return;
    if (rays->scene)
        rtcReleaseScene(rays->scene);
    if (rays->device)
        rtcReleaseDevice(rays->device);
    free(rays);
}

static struct RTCRay ray_from(const nook_rays *rays, const double origin[3], const double direction[3])
{
    return (struct RTCRay){ .org_x = (float)(origin[0] - rays->centre[0]),
                            .org_y = (float)(origin[1] - rays->centre[1]),
                            .org_z = (float)(origin[2] - rays->centre[2]),
                            .dir_x = (float)direction[0],
                            .dir_y = (float)direction[1],
                            .dir_z = (float)direction[2],
                            .tfar = INFINITY,
                            .mask = ~0u };
}

nook_view_hit nook_rays_cast(const nook_rays *rays, const double origin[3], const double direction[3])
{
    struct RTCIntersectContext context;
    struct RTCRayHit hit = { .ray = ray_from(rays, origin, direction) };
    rtcInitIntersectContext(&context);
    hit.hit.geomID = hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(rays->scene, &context, &hit);
    if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return (nook_view_hit){ INFINITY, false };
    const bool *double_sided = rtcGetGeometryUserData(rtcGetGeometry(rays->scene, hit.hit.geomID));
    float facing = hit.hit.Ng_x * hit.ray.dir_x + hit.hit.Ng_y * hit.ray.dir_y + hit.hit.Ng_z * hit.ray.dir_z;
    return (nook_view_hit){ (double)hit.ray.tfar, *double_sided || facing < 0.0f };
}

bool nook_rays_see(const nook_rays *rays, const double from[3], const double to[3])
{
    struct RTCIntersectContext context;
    const double towards[3] = { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
    struct RTCRay ray = ray_from(rays, from, towards);
    rtcInitIntersectContext(&context);
    ray.tfar = 1.0f;
    rtcOccluded1(rays->scene, &context, &ray);
    return ray.tfar >= 0.0f; /* Embree makes it negative where something stands */
}
