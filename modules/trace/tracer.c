#include "modules/trace/tracer.h"
#include "engine/core/log.h"
#include "modules/trace/ray_filter.h"
#include "modules/trace/ray_medium.h"
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct traced_mesh {
    uint32_t id;
    RTCScene scene;
    nook_ray_filter *filter; /* NULL: all is opaque */
    nook_ray_medium *medium; /* NULL: triangles */
} traced_mesh;

struct nook_tracer {
    RTCDevice device;
    traced_mesh *meshes;
    uint32_t mesh_count, mesh_capacity;
    RTCScene world; /**< NULL before the first update. */
};

nook_result nook_tracer_create(unsigned threads, nook_tracer **out_tracer)
{
    char config[32] = "";
    *out_tracer = NULL;
    nook_tracer *t = calloc(1, sizeof *t);
    if (!t)
        return nook_fail(NOOK_E_MEMORY, "ray tracer: no memory");
    if (threads)
        snprintf(config, sizeof config, "threads=%u", threads);
    t->device = rtcNewDevice(config);
    if (!t->device) {
        int code = (int)rtcGetDeviceError(NULL);
        free(t);
        return nook_fail(NOOK_E_DEVICE, "ray tracer: Embree does not start (error %d); it needs SSE2 and memory", code);
    }
    *out_tracer = t;
    return NOOK_OK;
}

static void release_mesh(traced_mesh *mesh)
{
    rtcReleaseScene(mesh->scene);
    nook_ray_filter_destroy(mesh->filter);
    nook_ray_medium_destroy(mesh->medium);
}

void nook_tracer_destroy(nook_tracer *t)
{
    if (!t)
        return;
    if (t->world)
        rtcReleaseScene(t->world);
    for (uint32_t i = 0; i < t->mesh_count; i++)
        release_mesh(&t->meshes[i]);
    free(t->meshes);
    rtcReleaseDevice(t->device);
    free(t);
}

static nook_result check_device(const nook_tracer *t)
{
    enum RTCError error = rtcGetDeviceError(t->device);
    if (error == RTC_ERROR_NONE)
        return NOOK_OK;
    return nook_fail(error == RTC_ERROR_OUT_OF_MEMORY ? NOOK_E_MEMORY : NOOK_E_DEVICE, "ray tracer: Embree error %d",
                     (int)error);
}

static RTCScene find_mesh(const nook_tracer *t, uint32_t id)
{
    for (uint32_t i = 0; i < t->mesh_count; i++) {
        if (t->meshes[i].id == id)
            return t->meshes[i].scene;
    }
    return NULL;
}

/** Robust: no ray slips between two triangles of one edge. */
static RTCScene new_scene(const nook_tracer *t)
{
    RTCScene scene = rtcNewScene(t->device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    return scene;
}

static void put_world(nook_tracer *t, RTCScene world)
{
    if (t->world)
        rtcReleaseScene(t->world);
    t->world = world;
}

/* A scene of one geometry, which it takes over. */
static RTCScene scene_of(const nook_tracer *t, RTCGeometry geometry)
{
    RTCScene scene = new_scene(t);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
    return scene;
}

/** Embree reads 16 bytes at each vertex, so positions get one float of padding: they are copied into its own buffer. */
static RTCScene build_triangles(const nook_tracer *t, const float *positions, uint32_t vertex_count,
                                const uint32_t *indices, uint32_t index_count, nook_ray_filter *filter)
{
    RTCGeometry geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    float *vertex_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                   3 * sizeof(float), vertex_count);
    uint32_t *index_buffer = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                                     3 * sizeof(uint32_t), index_count / 3);
    if (!vertex_buffer || !index_buffer) {
        rtcReleaseGeometry(geometry);
        return NULL;
    }
    memcpy(vertex_buffer, positions, (size_t)vertex_count * 3 * sizeof *positions);
    memcpy(index_buffer, indices, (size_t)index_count * sizeof *indices);
    if (filter)
        nook_ray_filter_apply(filter, geometry);
    return scene_of(t, geometry);
}

/* @param out_medium  what the scene refers to, yours to destroy after it */
static RTCScene build_medium(const nook_tracer *t, const nook_ao_mesh_view *mesh, nook_ray_medium **out_medium)
{
    nook_ray_medium *medium = nook_ray_medium_create(mesh->medium, mesh->id);
    RTCGeometry geometry = medium ? nook_ray_medium_geometry(t->device, medium) : NULL;
    *out_medium = medium;
    return geometry ? scene_of(t, geometry) : NULL;
}

static nook_result add_mesh(nook_tracer *t, const nook_ao_mesh_view *mesh)
{
    if (find_mesh(t, mesh->id))
        return NOOK_OK;
    if (t->mesh_count == t->mesh_capacity) {
        uint32_t capacity = t->mesh_capacity ? t->mesh_capacity * 2 : 16;
        traced_mesh *grown = realloc(t->meshes, capacity * sizeof *grown);
        if (!grown)
            return nook_fail(NOOK_E_MEMORY, "ray tracer: no memory");
        t->meshes = grown;
        t->mesh_capacity = capacity;
    }
    nook_ray_filter *filter = mesh->alphas ? nook_ray_filter_create(mesh) : NULL;
    nook_ray_medium *medium = NULL;
    RTCScene scene = NULL;
    if (mesh->medium)
        scene = build_medium(t, mesh, &medium);
    else if (filter || !mesh->alphas)
        scene = build_triangles(t, mesh->positions, mesh->vertex_count, mesh->indices, mesh->index_count, filter);
    if (!scene) {
        nook_ray_filter_destroy(filter);
        nook_ray_medium_destroy(medium);
        return mesh->medium ? nook_fail(NOOK_E_MEMORY, "ray tracer: no memory for a medium")
                            : nook_fail(NOOK_E_MEMORY, "ray tracer: no memory for %u triangles", mesh->index_count / 3);
    }
    t->meshes[t->mesh_count++] = (traced_mesh){ mesh->id, scene, filter, medium };
    return check_device(t);
}

static void drop_removed(nook_tracer *t, const nook_ao_pass *pass)
{
    for (uint32_t i = 0; i < t->mesh_count;) {
        uint32_t k = 0;
        while (k < pass->mesh_count && pass->meshes[k].id != t->meshes[i].id)
            k++;
        if (k < pass->mesh_count) {
            i++;
            continue;
        }
        release_mesh(&t->meshes[i]);
        t->meshes[i] = t->meshes[--t->mesh_count];
    }
}

static void add_instance(nook_tracer *t, uint32_t number, RTCScene mesh, const nook_matrix *view_from_mesh)
{
    float transform[16];
    RTCGeometry geometry = rtcNewGeometry(t->device, RTC_GEOMETRY_TYPE_INSTANCE);
    nook_matrix_to_float(view_from_mesh, transform);
    rtcSetGeometryInstancedScene(geometry, mesh);
    rtcSetGeometryTimeStepCount(geometry, 1);
    rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR, transform);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(t->world, geometry, number); /* hits tell it */
    rtcReleaseGeometry(geometry);
}

nook_result nook_tracer_update(nook_tracer *t, const nook_ao_pass *pass)
{
    drop_removed(t, pass);
    for (uint32_t i = 0; i < pass->mesh_count; i++) {
        bool stops = pass->meshes[i].index_count || pass->meshes[i].medium;
        nook_result result = stops ? add_mesh(t, &pass->meshes[i]) : NOOK_OK;
        if (result != NOOK_OK)
            return result;
    }
    put_world(t, new_scene(t));
    for (uint32_t i = 0; i < pass->instance_count; i++) {
        RTCScene mesh = find_mesh(t, pass->meshes[pass->instances[i].mesh].id);
        if (mesh)
            add_instance(t, i, mesh, &pass->instances[i].view_from_mesh);
    }
    rtcCommitScene(t->world);
    return check_device(t);
}

nook_result nook_tracer_update_triangles(nook_tracer *t, const float *positions, uint32_t vertex_count,
                                         const uint32_t *indices, uint32_t index_count)
{
    RTCScene world =
        index_count ? build_triangles(t, positions, vertex_count, indices, index_count, NULL) : new_scene(t);
    if (!world)
        return nook_fail(NOOK_E_MEMORY, "ray tracer: no memory for %u triangles", index_count / 3);
    rtcCommitScene(world);
    put_world(t, world);
    return check_device(t);
}

/* A question to Embree. */
typedef struct packet {
    struct RTCIntersectContext context;
    struct RTCRayHit8 rays;
    _Alignas(32) int valid[NOOK_TRACER_PACKET]; /* -1: asked for */
} packet;

static void fill_packet(const float origin[3], const float directions[3][NOOK_TRACER_PACKET], uint32_t count,
                        float limit, packet *out)
{
    *out = (packet){ .valid = { 0 } };
    rtcInitIntersectContext(&out->context);
    for (uint32_t i = 0; i < NOOK_TRACER_PACKET; i++) {
        struct RTCRay8 *ray = &out->rays.ray;
        ray->org_x[i] = origin[0], ray->org_y[i] = origin[1], ray->org_z[i] = origin[2];
        ray->dir_x[i] = directions[0][i], ray->dir_y[i] = directions[1][i], ray->dir_z[i] = directions[2][i];
        ray->tfar[i] = limit;
        ray->mask[i] = ~0u;
        out->rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        out->rays.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
        out->valid[i] = i < count ? -1 : 0;
    }
}

void nook_tracer_distances(const nook_tracer *t, const float origin[3], const float directions[3][NOOK_TRACER_PACKET],
                           uint32_t count, float limit, int any, float *out)
{
    packet p;
    fill_packet(origin, directions, count, limit, &p);
    if (any)
        rtcOccluded8(p.valid, t->world, &p.context, &p.rays.ray);
    else
        rtcIntersect8(p.valid, t->world, &p.context, &p.rays);
    for (uint32_t i = 0; i < count; i++) {
        if (any)
            out[i] = p.rays.ray.tfar[i] < 0.0f ? 0.0f : INFINITY;
        else
            out[i] = p.rays.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? INFINITY : p.rays.ray.tfar[i];
    }
}

void nook_tracer_hits(const nook_tracer *t, const float origin[3], const float directions[3][NOOK_TRACER_PACKET],
                      uint32_t count, float limit, float *out_distances, uint32_t *out_instances)
{
    packet p;
    fill_packet(origin, directions, count, limit, &p);
    rtcIntersect8(p.valid, t->world, &p.context, &p.rays);
    for (uint32_t i = 0; i < count; i++) {
        bool hit = p.rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        out_distances[i] = hit ? p.rays.ray.tfar[i] : INFINITY;
        out_instances[i] = hit ? p.rays.hit.instID[0][i] : UINT32_MAX;
    }
}
