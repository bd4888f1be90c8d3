/**
 * ao_view.h - a small host of the AO core: a G-buffer of any size that a test fills, occluders, and what comes back.
 *
 * Its context knows the techniques volume, ssao, hsao and reference, and "probe": a technique that keeps the depth and the
 * normals it was given and writes what the test paints, so that the stages before and after a technique are tested alone.
 */
#pragma once
#include "engine/core/matrix.h"
#include "modules/ao/nook_ao.h"
#include "tests/support/fixture_mesh.h"
#include "tests/support/test_gpu.h"

enum { AO_VIEW_OCCLUDERS = 320 };

typedef struct ao_view ao_view;
struct ao_view {
    test_gpu gpu;
    nook_ao *ao;
    uint32_t width, height;
    nook_texture depth, normal; /**< R32F and RG16, written by ao_view_record. */
    nook_matrix view_from_world, clip_from_view;
    uint32_t index;         /**< Of the frame. */
    int without_normals;    /**< 1: the host gives none. */
    float *device_depth;    /**< width * height, as the depth buffer would hold it. */
    uint16_t (*normals)[2]; /**< width * height, octahedral codes, world space. */
    float *visibility;      /**< width * height; filled by ao_view_record. */

    nook_ao_occluder occluders[AO_VIEW_OCCLUDERS];
    uint32_t occluder_count;

    /** The probe: called for every pixel of the trace. NULL paints 1. */
    float (*paint)(const ao_view *view, uint32_t x, uint32_t y);
    float painted; /**< For `paint` to use. */
    /** What the probe was given in the last record; trace_width * trace_height. */
    float *trace_depth;
    uint16_t (*trace_normals)[2];
    uint32_t trace_width, trace_height;
};

/** Fails the test when anything fails. The camera sits at the origin, looking along -Z; nothing is drawn yet. */
ao_view *ao_view_create(uint32_t width, uint32_t height);
void ao_view_destroy(ao_view *view);
void ao_view_resize(ao_view *view, uint32_t width, uint32_t height);
/** Sets a parameter or fails the test. */
void ao_view_param(ao_view *view, const char *name, const char *value);

/** Device depth everywhere where nothing was drawn, for the clip matrix as it is now. */
void ao_view_clear(ao_view *view);
/** View position of a pixel at a distance along -Z, by the clip matrix; `pixel` may have fractions. */
void ao_view_position(const ao_view *view, double x, double y, double distance, double out[3]);
/** Device depth of a distance along -Z, by the clip matrix. */
float ao_view_device_depth(const ao_view *view, double distance);
/** @param normal world space, unit */
void ao_view_set_pixel(ao_view *view, uint32_t x, uint32_t y, double distance, const double normal[3]);
/** Ray casts world-space triangles into the buffers: nearest hit, geometric normal turned to the camera. */
void ao_view_draw(ao_view *view, const fixture_mesh *mesh);

/**
 * Adds triangles as an occluder with the identity as its matrix, for the reference and, when resolution > 0, baked.
 * @return metres per voxel, 0 without a volume
 */
double ao_view_add(ao_view *view, const fixture_mesh *mesh, uint32_t resolution);
void ao_view_drop_occluders(ao_view *view);

/** Submits, records with a technique and reads the visibility, which must be in [0, 1]. */
void ao_view_record(ao_view *view, const char *technique);

/** As shaders/nook/octahedral.glsl. */
void ao_encode_normal(const double n[3], uint16_t out[2]);
void ao_decode_normal(const uint16_t code[2], double out[3]);
