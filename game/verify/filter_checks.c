/* Row 20: the filter alone, given visibility that a technique of no geometry painted; and what lower scales of the trace change. */
#include "game/verify/verify_run.h"
#include "modules/fixture/painter.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 37, HEIGHT = 23 };

/** What a trace "computes". */
typedef struct picture_to_paint {
    bool by_depth;  /**< 0 nearer than 2 m, 1 beyond. */
    bool by_normal; /**< 0 where the view normal points to the left, 1 elsewhere. */
    float constant; /**< Else this. */
} picture_to_paint;

static float paint(const nook_fixture_painter *painter, uint32_t x, uint32_t y, float depth, const float normal[2])
{
    const picture_to_paint *canvas = painter->user;
    double n[3];
    (void)x, (void)y;
    if (canvas->by_depth)
        return depth < 2.0f ? 0.0f : 1.0f;
    nook_fixture_decode_normal(normal, n);
    if (canvas->by_normal)
        return n[0] < 0.0 ? 0.0f : 1.0f;
    return depth > 0.0f ? canvas->constant : 1.0f;
}

static void be_silent(void *user, double fraction)
{
    (void)user, (void)fraction;
}

typedef struct filter_run {
    nook_fixture_view *view;
    picture_to_paint *canvas;
    nook_verify_rows *rows;
} filter_run;

static nook_result add_row(nook_verify_rows *rows, const char *what, const char *settings, const char *technique,
                           nook_verify_check check, uint64_t outside)
{
    nook_verify_row row = { .number = 20,
                            .fixture = "filter",
                            .what = what,
                            .technique = technique,
                            .target = strcmp(technique, "filter") == 0 ? "own: difference" : "own: at full scale",
                            .check = check,
                            .equation_1 = NAN,
                            .deviation = NAN,
                            .initial = NAN,
                            .outside = outside };
    snprintf(row.point, sizeof row.point, "%.63s", settings);
    snprintf(row.settings, sizeof row.settings, "%s", settings);
    return nook_verify_rows_add(rows, &row);
}

/** Clutter, a step of depth at a column, or an edge of a right angle towards the camera at x = 0. */
static void draw(const filter_run *run)
{
    const double half = sqrt(0.5), sides[2][3] = { { -half, 0, half }, { half, 0, half } };
    nook_fixture_view *view = run->view;
    nook_fixture_view_clear(view);
    for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
        uint32_t x = i % WIDTH, y = i / WIDTH;
        double ray[3], jumble = fmod(i * 0.6180339887, 1.0);
        nook_fixture_view_position(view, x, y, 1.0, ray);
        const double *n = sides[ray[0] >= 0.0];
        if (run->canvas->by_depth)
            nook_fixture_view_set_pixel(view, x, y, x < 17 ? 1.0 : 5.0, (double[]){ 0, 0, 1 });
        else if (run->canvas->by_normal)
            nook_fixture_view_set_pixel(view, x, y, -2.0 * half / (n[0] * ray[0] - half), n);
        else if (i % 7) /* some pixels see nothing */
            nook_fixture_view_set_pixel(view, x, y, 0.1 * pow(1e3, jumble), sides[i % 3 == 0]);
    }
}

static float wanted(const filter_run *run, uint32_t i)
{
    double ray[3];
    nook_fixture_view_position(run->view, i % WIDTH, i / WIDTH, 1.0, ray);
    if (run->canvas->by_depth)
        return i % WIDTH < 17 ? 0.0f : 1.0f;
    if (run->canvas->by_normal)
        return ray[0] < 0.0 ? 0.0f : 1.0f;
    return run->view->device_depth[i] > 0.0f ? run->canvas->constant : 1.0f;
}

/** Every scale and filter; the largest difference to what was painted must be 0. */
static nook_result compare(const filter_run *run, const char *what)
{
    nook_result result = NOOK_OK;
    draw(run);
    for (size_t k = 0; k < 9 && result == NOOK_OK; k++) {
        double worst = 0.0;
        char settings[64];
        snprintf(settings, sizeof settings, "ao.scale=%s ao.filter=%s", nook_fixture_scales[k / 3],
                 nook_fixture_filters[k % 3]);
        result = nook_ao_parse_param(run->view->ao, "ao.scale", nook_fixture_scales[k / 3]);
        if (result == NOOK_OK)
            result = nook_ao_parse_param(run->view->ao, "ao.filter", nook_fixture_filters[k % 3]);
        if (result == NOOK_OK)
            result = nook_fixture_view_record(run->view, "painter");
        for (uint32_t i = 0; result == NOOK_OK && i < WIDTH * HEIGHT; i++)
            worst = fmax(worst, fabs((double)run->view->visibility[i] - wanted(run, i)));
        const nook_verify_check check = { .measured = worst, .claimed = true };
        if (result == NOOK_OK)
            result = add_row(run->rows, what, settings, "filter", check, run->view->outside);
    }
    return result;
}

static nook_result check_filter(const nook_verify_desc *desc, nook_verify_rows *rows)
{
    static const nook_ao_technique *const techniques[] = { &nook_fixture_painter_technique };
    picture_to_paint canvas = { .constant = 0.7123456f };
    nook_fixture_painter painter = { .paint = paint, .user = &canvas };
    const nook_fixture_view_desc view_desc = { .gpu = desc->gpu,
                                               .width = WIDTH,
                                               .height = HEIGHT,
                                               .techniques = techniques,
                                               .technique_count = 1,
                                               .progress = be_silent,
                                               .progress_user = &painter };
    filter_run run = { .canvas = &canvas, .rows = rows };
    nook_result result = nook_fixture_view_create(&view_desc, &run.view);
    if (result != NOOK_OK)
        return result;
    /* Narrow: a pixel is 1/100 of its distance wide, as in a common picture of more pixels. */
    run.view->clip_from_view = nook_matrix_perspective_reversed(0.2, (double)WIDTH / HEIGHT, 0.1);
    result = compare(&run, "a constant in, the constant out, bit for bit");
    canvas.by_depth = true;
    if (result == NOOK_OK)
        result = compare(&run, "nothing leaks across a step of depth");
    canvas.by_depth = false, canvas.by_normal = true;
    if (result == NOOK_OK)
        result = compare(&run, "nothing leaks across a right angle");
    nook_fixture_view_destroy(run.view);
    return result;
}

/* ---- The same picture at other scales of the trace --------------------------------------------------------------- */

/** A in a corner at full, half and quarter scale of the trace, filtered. */
static nook_result check_scales(nook_verify_rig *rig, nook_verify_rows *rows, const nook_verify_fixture *wall)
{
    nook_verify_scene scene;
    double full = 0.0;
    nook_verify_scene_make(wall, 0, NOOK_VERIFY_PICTURE, &scene);
    nook_result result = nook_verify_rig_draw(rig, &scene, &scene.cameras[1]);
    if (result == NOOK_OK)
        result = nook_fixture_view_add(rig->picture, &scene.objects[0], scene.resolution, NULL, NULL);
    for (size_t k = 0; k < 3 && result == NOOK_OK; k++) {
        char text[128];
        nook_setting setting;
        nook_verify_reading got = { 0 };
        snprintf(text, sizeof text, "volume rays=64 steps=512 ao.scale=%s", nook_fixture_scales[k]);
        result = nook_setting_parse("verify", text, &setting);
        if (result == NOOK_OK)
            result = nook_verify_rig_look(rig, &scene, &setting, &got);
        full = k == 0 ? got.occlusion.mean : full;
        const nook_verify_check check = {
            .expected = full, .measured = got.occlusion.mean, .tolerance = 0.01, .claimed = true
        };
        if (result == NOOK_OK && k > 0)
            result = add_row(rows, "a lower scale of the trace, in a corner", text, "volume", check, got.outside);
    }
    nook_fixture_view_drop_occluders(rig->picture);
    nook_verify_scene_free(&scene);
    return result;
}

nook_result nook_verify_filter_checks(const nook_verify_desc *desc, nook_verify_rig *rig, nook_verify_rows *rows)
{
    size_t count;
    const nook_verify_fixture *fixtures = nook_verify_fixtures(&count);
    if (!desc->filter || !nook_verify_wants(desc, 20, "filter"))
        return NOOK_OK;
    nook_result result = check_filter(desc, rows);
    for (size_t i = 0; i < count && result == NOOK_OK; i++) {
        if (strcmp(fixtures[i].name, "wall") == 0)
            result = check_scales(rig, rows, &fixtures[i]);
    }
    return result;
}
