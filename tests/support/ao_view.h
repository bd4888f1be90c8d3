/**
 * ao_view.h - modules/fixture/view.h for tests: with a device of its own, and failing the test when anything fails.
 *
 * Its context knows the techniques of game/techniques.c, and "probe": a technique that keeps the depth and the
 * normals it was given and writes what the test paints, so that the stages before and after a technique are tested alone.
 */
#pragma once
#include "modules/fixture/draw.h"
#include "modules/fixture/view.h"

/** A camera at the origin, looking along -Z; nothing is drawn yet. */
nook_fixture_view *ao_view_create(uint32_t width, uint32_t height);
void ao_view_destroy(nook_fixture_view *view);
void ao_view_resize(nook_fixture_view *view, uint32_t width, uint32_t height);
void ao_view_param(nook_fixture_view *view, const char *name, const char *value);
void ao_view_draw(nook_fixture_view *view, const nook_fixture_mesh *mesh);
/** Adds an occluder with the identity as its matrix. @return metres per voxel, 0 without a volume */
double ao_view_add(nook_fixture_view *view, const nook_fixture_mesh *mesh, uint32_t resolution);
/**
 * A floor, a wall that stands on it and a box before the wall, drawn and added, and a camera that looks at them from above.
 * @param reach  how far floor and wall go from the box @param resolution  as of ao_view_add
 */
void ao_view_add_yard(nook_fixture_view *view, double reach, uint32_t resolution);
/** Records with a technique and reads the visibility, which must be in [0, 1]. */
void ao_view_record(nook_fixture_view *view, const char *technique);

/** For cmocka: of a test whose *state is a view. */
int ao_view_teardown(void **state);
/** RMS of the difference between two pictures that hold something. */
double ao_view_rmse(const float *picture, const float *truth, size_t pixels);

/** What the technique "probe" of a view shares with the test. */
typedef struct ao_probe ao_probe;
struct ao_probe {
    const nook_fixture_view *view;
    /** Called for every pixel of the trace. NULL paints 1. */
    float (*paint)(const ao_probe *probe, uint32_t x, uint32_t y);
    float painted; /**< For `paint` to use. */
    /** What the probe was given in the last record; width * height. */
    float *depth;
    float (*normals)[2];
    uint32_t width, height;
};

ao_probe *ao_view_probe(const nook_fixture_view *view);
