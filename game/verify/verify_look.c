/* Techniques that know the depth buffer only, before the pictures of cameras. */
#include "game/verify/oracle.h"
#include "game/verify/verify_work.h"
#include <math.h>
#include <stdio.h>

enum { RAYS_OF_A_PIXEL = 256 };

/** One camera before one scene, and what rays in double know of its picture; each is cast when it is first asked for. */
typedef struct sighting {
    const nook_verify_scene *scene;
    const nook_verify_camera *camera;
    nook_verify_sight sights[2]; /**< By nook_form_weight. */
    bool has_sight[2];
    double truths[3][NOOK_VERIFY_LOOKED_AT]; /**< Of each pixel that is looked at, by nook_verify_target. */
    bool has_truths[3];
} sighting;

static nook_form_weight weight_of(nook_verify_target target)
{
    return target == NOOK_VERIFY_SOLID_ANGLE ? NOOK_FORM_SOLID_ANGLE : NOOK_FORM_COSINE;
}

static nook_result find_sight(sighting *s, nook_verify_target target, nook_verify_check *check)
{
    nook_form_weight weight = weight_of(target);
    nook_result result = NOOK_OK;
    if (!s->has_sight[weight])
        result = nook_verify_look_through(s->scene, weight, s->camera, NOOK_VERIFY_RAYS_SEEN, &s->sights[weight]);
    s->has_sight[weight] = result == NOOK_OK;
    check->missing = s->sights[weight].missing;
    check->unresolved = s->sights[weight].unresolved;
    return result;
}

/** The same rays in every pixel, so that what they leave uncertain is in all and in no difference. */
static const double *find_truths(sighting *s, nook_verify_target target)
{
    for (uint32_t i = 0; i < NOOK_VERIFY_LOOKED_AT && !s->has_truths[target]; i++) {
        nook_verify_receiver receiver =
            nook_verify_receiver_of(s->scene, s->camera, NOOK_VERIFY_LOOKED_AT_FROM + i % NOOK_VERIFY_LOOKED_AT_SIDE,
                                    NOOK_VERIFY_LOOKED_AT_FROM + i / NOOK_VERIFY_LOOKED_AT_SIDE);
        s->truths[target][i] =
            target == NOOK_VERIFY_HALF_BALL
                ? nook_verify_cast_half_ball(s->scene, s->camera, &receiver, 0.01, RAYS_OF_A_PIXEL)
                : nook_verify_cast_occlusion(s->scene, weight_of(target), &receiver, RAYS_OF_A_PIXEL);
    }
    s->has_truths[target] = true;
    return s->truths[target];
}

/** Standard deviation of the pixels' errors. */
static double spread_of(const nook_verify_reading *reading, const double *truths)
{
    double mean = 0.0, squares = 0.0;
    for (uint32_t i = 0; i < NOOK_VERIFY_LOOKED_AT; i++)
        mean += (reading->pixels[i] - truths[i]) / NOOK_VERIFY_LOOKED_AT;
    for (uint32_t i = 0; i < NOOK_VERIFY_LOOKED_AT; i++)
        squares += pow(reading->pixels[i] - truths[i] - mean, 2.0) / NOOK_VERIFY_LOOKED_AT;
    return sqrt(squares);
}

static nook_result end_look(const nook_verify_work *w, sighting *s, nook_verify_target target, double samples,
                            nook_verify_row *row, const nook_verify_readings *readings)
{
    row->camera = s->camera->name;
    nook_result result = find_sight(s, target, &row->check);
    if (result != NOOK_OK)
        return result;
    row->check.spread_max = nook_verify_spread_max(row->check.tolerance, row->check.expected, samples);
    if (nook_verify_is_checked(nook_verify_judge(&row->check)))
        row->check.spread = spread_of(&readings->of_judged, find_truths(s, target));
    return nook_verify_end_row(w, row, readings);
}

static nook_result look(const nook_verify_work *w, const nook_ao_technique *technique, sighting *s)
{
    nook_verify_claim claim = nook_verify_claim_for(technique);
    nook_verify_readings readings;
    nook_verify_row row;
    nook_result result = nook_verify_begin_row(w, &claim, s->scene, &readings, &row);
    if (result == NOOK_OK)
        result = nook_verify_rig_look(w->rig, s->scene, &readings.judged, &readings.of_judged);
    if (result == NOOK_OK)
        result = nook_verify_rig_look(w->rig, s->scene, &readings.initial, &readings.of_initial);
    if (result != NOOK_OK)
        return result;
    if (claim.target == NOOK_VERIFY_HALF_BALL)
        row.check.expected =
            nook_verify_cast_half_ball(s->scene, s->camera, &nook_verify_origin, 0.01, NOOK_VERIFY_POINTS_HIDDEN);
    return end_look(w, s, claim.target, claim.samples, &row, &readings);
}

/**
 * The truth of what the picture shows, from the picture itself: what the techniques beside it can reach at the best. Nobody is given
 * it as it comes, so that it has no initial value.
 */
static nook_result look_through_screen(const nook_verify_work *w, sighting *s)
{
    const nook_verify_scene *scene = s->scene;
    nook_verify_readings readings = { .of_initial.occlusion = { NAN, NAN, NAN, NAN } };
    nook_verify_row row = { .number = w->fixture->row,
                            .fixture = w->fixture->name,
                            .what = w->fixture->what,
                            .technique = "reference",
                            .target = nook_verify_target_name(NOOK_VERIFY_EQUATION_1),
                            .equation_1 = scene->truth[NOOK_FORM_COSINE],
                            .settings = "reference rays=64 sees=screen",
                            .reason = scene->height_field ? NULL : "silhouettes end short by a pixel" };
    row.check.expected = scene->truth[NOOK_FORM_COSINE];
    row.check.tolerance = NOOK_VERIFY_SCREEN_TOLERANCE;
    row.check.claimed = scene->height_field;
    snprintf(row.point, sizeof row.point, "%s", scene->point);
    nook_result result = nook_setting_parse("verify", row.settings, &readings.judged);
    if (result == NOOK_OK)
        result = nook_verify_rig_look(w->rig, scene, &readings.judged, &readings.of_judged);
    return result == NOOK_OK ? end_look(w, s, NOOK_VERIFY_EQUATION_1, 0.0, &row, &readings) : result;
}

nook_result nook_verify_look_at(const nook_verify_work *w, uint32_t point)
{
    nook_verify_scene scene;
    nook_result result = NOOK_OK;
    const size_t cameras = point < w->fixture->camera_points ? NOOK_VERIFY_CAMERAS_MAX : 1;
    nook_verify_scene_make(w->fixture, point, NOOK_VERIFY_PICTURE, &scene);
    for (size_t k = 0; k < cameras && scene.cameras[k].name && result == NOOK_OK; k++) {
        sighting s = { .scene = &scene, .camera = &scene.cameras[k] };
        result = nook_verify_rig_draw(w->rig, &scene, s.camera);
        for (size_t i = 0; result == NOOK_OK && i < w->desc->technique_count; i++) {
            if (nook_verify_claim_for(w->desc->techniques[i]).reads_picture)
                result = look(w, w->desc->techniques[i], &s);
            else if (w->desc->techniques[i]->exact)
                result = look_through_screen(w, &s);
        }
    }
    nook_verify_scene_free(&scene);
    return result;
}
