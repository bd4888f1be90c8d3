/**
 * results_fixture.h - results as a sweep would leave them, with made-up numbers and pictures: for what makes tables and reports.
 */
#pragma once
#include "game/measure/results.h"

typedef struct nook_results_fixture {
    const char *const *scenes;
    uint32_t scene_count;
    uint32_t cameras; /**< A scene. */
    uint32_t
        settings; /**< A technique; the first one of each is as it comes. There are three techniques, and the reference. */
    uint32_t width, height;
    const char *folder; /**< Where the pictures are written; NULL: none are, and none are named. */
} nook_results_fixture;

/**
 * Rows for every scene x camera x technique x setting, and one row a site of the reference that sees the screen only. More rays
 * cost more and err less; numbers are the same at every call. Free
 * them with nook_results_free.
 */
void nook_results_fixture_make(const nook_results_fixture *fixture, nook_results *out_results);

/** The same without pictures, of sites of 8 x 8 pixels. */
nook_results nook_results_fixture_numbers(const char *const *scenes, uint32_t scene_count, uint32_t cameras,
                                          uint32_t settings);

/** Visibility of a made-up picture at a pixel, top row first. Settings add to the truth, which is setting 0. */
double nook_results_fixture_visibility(uint32_t camera, uint32_t setting, double x, double y);
