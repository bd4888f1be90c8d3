#include "game/compare/surfaces.h"
#include "engine/core/log.h"
#include "game/stage.h"
#include <math.h>
#include <stdlib.h>

void nook_surfaces_free(nook_surfaces *surfaces)
{
    free(surfaces->distances);
    free(surfaces->normals);
    *surfaces = (nook_surfaces){ 0 };
}

/* As shaders/nook/octahedral.glsl reads it. */
static void decode_normal(const uint16_t stored[2], float out[3])
{
    double x = (stored[0] - 32768.0) / 32767.0, y = (stored[1] - 32768.0) / 32767.0;
    double z = 1.0 - fabs(x) - fabs(y);
    if (z < 0.0) {
        double kept = x;
        x = copysign(1.0 - fabs(y), x);
        y = copysign(1.0 - fabs(kept), y);
    }
    double length = sqrt(x * x + y * y + z * z);
    out[0] = (float)(x / length);
    out[1] = (float)(y / length);
    out[2] = (float)(z / length);
}

static nook_result read_normals(nook_stage *stage, float *out)
{
    size_t pixels = (size_t)stage->width * stage->height;
    uint16_t *stored = malloc(pixels * 2 * sizeof *stored);
    if (!stored)
        return nook_fail(NOOK_E_MEMORY, "no memory to read back %zu normals", pixels);
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).geometric_normal, GL_RG, GL_UNSIGNED_SHORT,
                      stored, pixels * 2 * sizeof *stored);
    for (size_t i = 0; i < pixels; i++)
        decode_normal(&stored[2 * i], &out[3 * i]);
    free(stored);
    return NOOK_OK;
}

nook_result nook_surfaces_draw(nook_stage *stage, const nook_camera *camera, nook_surfaces *out_surfaces)
{
    *out_surfaces = (nook_surfaces){ 0 };
    nook_result result = nook_stage_begin(stage, camera);
    if (result != NOOK_OK)
        return result;
    size_t pixels = (size_t)stage->width * stage->height;
    nook_surfaces g = { malloc(pixels * sizeof(float)), malloc(pixels * 3 * sizeof(float)), { .width = 0 } };
    result = g.distances && g.normals ? read_normals(stage, g.normals)
                                      : nook_fail(NOOK_E_MEMORY, "no memory to read back %zu pixels", pixels);
    if (result != NOOK_OK) {
        nook_surfaces_free(&g);
        return result;
    }
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT,
                      g.distances, pixels * sizeof(float));
    for (size_t i = 0; i < pixels; i++) /* stored: z_near / distance, 0 where nothing is */
        g.distances[i] = g.distances[i] > 0.0f ? (float)(camera->z_near / (double)g.distances[i]) : 0.0f;
    g.seen = (nook_seen){ .view_from_world = camera->view_from_world,
                          .fov_y_radians = camera->fov_y_radians,
                          .width = stage->width,
                          .height = stage->height,
                          .distances = g.distances,
                          .normals = g.normals };
    *out_surfaces = g;
    return NOOK_OK;
}

nook_result nook_geometry_read(nook_stage *stage, uint8_t **out_geometry)
{
    size_t pixels = (size_t)stage->width * stage->height;
    float *depth = malloc(pixels * sizeof *depth);
    uint8_t *geometry = malloc(pixels);
    if (!depth || !geometry) {
        free(depth);
        free(geometry);
        return nook_fail(NOOK_E_MEMORY, "no memory to read back %zu pixels", pixels);
    }
    nook_texture_read(stage->gpu, nook_renderer_gbuffer(stage->renderer).depth, GL_DEPTH_COMPONENT, GL_FLOAT, depth,
                      pixels * sizeof *depth);
    size_t seen = 0;
    for (size_t i = 0; i < pixels; i++) {
        geometry[i] = depth[i] > 0.0f; /* reversed: 0 is infinitely far */
        seen += geometry[i];
    }
    free(depth);
    *out_geometry = geometry; /* whose owner frees it, whatever comes of this */
    if (seen == 0)
        return nook_fail(NOOK_E_NOT_FOUND, "the camera sees nothing of the scene; choose another with --camera");
    return NOOK_OK;
}
