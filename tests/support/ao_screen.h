/** ao_screen.h - scenes for techniques that see only the depth buffer: a camera, shapes that it sees, the mean of what comes back. */
#pragma once
#include "tests/support/ao_view.h"

/**
 * Nothing drawn yet, no occluders, hard falloff, no filter; a camera with the field of view `angle`, radians.
 * @param r_max  metres
 */
void ao_screen_look(nook_fixture_view *view, const double eye[3], const double target[3], double angle, double r_max);

/** Into the G-buffer and, for the reference, as an occluder; frees the mesh. */
void ao_screen_show(nook_fixture_view *view, nook_fixture_mesh *mesh);
/** The plane z = 0, 100 m wide. */
void ao_screen_add_floor(nook_fixture_mesh *mesh);
/** A round pit; the middle of its bottom at the origin, ground around it. */
void ao_screen_add_pit(nook_fixture_mesh *mesh, double radius, double depth);
/** A floor z = 0 that ends at x = `x`, where a wall stands that leans to the inner angle given, radians. */
void ao_screen_add_corner(nook_fixture_mesh *mesh, double x, double angle);
/** A trench along y; the middle of its bottom at the origin, ground on both sides. */
void ao_screen_add_trench(nook_fixture_mesh *mesh, double width, double depth);

/** Records, and the mean A over the pixels with geometry. */
double ao_screen_measure(nook_fixture_view *view, const char *technique);
/** The same over the 4 x 4 pixels in the middle. */
double ao_screen_measure_centre(nook_fixture_view *view, const char *technique);
/** Mean A of the last record over the pixels with geometry of columns [left, right) and rows [bottom, top). */
double ao_screen_mean(const nook_fixture_view *view, uint32_t left, uint32_t bottom, uint32_t right, uint32_t top);
