#include "game/cameras/sample.h"
#include "engine/core/log.h"
#include "game/cameras/glance.h"
#include "game/cameras/places.h"
#include <math.h>
#include <stdlib.h>

enum { TRIALS_MAX = 400 }; /* in a row without a view, after which a place has none left */

/* What a view must show; lengths are parts of the scene's diagonal. */
typedef struct demands {
    double geometry; /* part of the pixels, at least */
    double near;     /* nearer than this is before its nose ... */
    double crowd;    /* ... and of the pixels at most this part may be */
    double median;   /* at least */
    double spread;   /* at least: a flat wall, head on, has 1 */
    double backs;    /* at most */
} demands;

/* A place, how far its sequence has been tried, and what its views must show. */
typedef struct source {
    nook_place place;
    uint32_t trial;
    bool spent;
    demands demands;
} source;

/* A scene's own cameras say what is worth looking at: theirs are held against what they see themselves. */
static demands demands_of(const nook_place *place, const nook_glance *own)
{
    const double outside_backs = 0.1, least_backs = 0.02;
    double median = own->median / place->diagonal;
    switch (place->kind) {
    case NOOK_PLACE_CAMERA:
        return (demands){ .geometry = fmin(0.7, 0.8 * own->geometry),
                          .near = fmin(0.02, 0.2 * median),
                          .crowd = 0.03,
                          .median = fmin(0.06, 0.5 * median),
                          .spread = fmin(1.6, 0.8 * own->spread),
                          .backs = fmax(least_backs, 1.25 * own->backs) };
    case NOOK_PLACE_ROOM:
        return (demands){
            .geometry = 0.7, .near = 0.03, .crowd = 0.03, .median = 0.1, .spread = 1.6, .backs = least_backs
        };
    case NOOK_PLACE_AROUND:
        break;
    }
    return (demands){ .geometry = fmin(0.15, 0.5 * own->geometry),
                      .near = 0.05,
                      .crowd = 0.03,
                      .median = 0.1,
                      .spread = 1.0,
                      .backs = fmax(outside_backs, 1.25 * own->backs) };
}

static bool meets(const demands *wanted, const nook_glance *seen, double diagonal)
{
    return seen->geometry > 0.0 && seen->geometry >= wanted->geometry && seen->near <= wanted->crowd &&
           seen->median >= wanted->median * diagonal && seen->spread >= wanted->spread && seen->backs <= wanted->backs;
}

/* The next view of a place. @return false when it has none left: it is spent */
static bool next_view(source *s, double aspect, nook_camera *out)
{
    for (uint32_t tries = 0; tries < TRIALS_MAX; tries++) {
        if (!nook_place_try(&s->place, s->trial++, out))
            continue;
        nook_glance seen = nook_glance_at(s->place.rays, out, aspect, s->demands.near * s->place.diagonal);
        if (meets(&s->demands, &seen, s->place.diagonal))
            return true;
    }
    s->spent = true;
    return false;
}

/* In turn from every place, so that any run of views has as many from each as another. @return how many there are */
static uint32_t collect(source *sources, uint32_t source_count, double aspect, uint32_t first, uint32_t count,
                        nook_camera *out)
{
    uint32_t found = 0, spent = 0;
    for (uint32_t at = 0; found < first + count && spent < source_count; at = (at + 1) % source_count) {
        nook_camera camera;
        if (sources[at].spent)
            continue;
        bool seen = next_view(&sources[at], aspect, &camera);
        spent += !seen;
        if (seen && found++ >= first)
            out[found - 1 - first] = camera;
    }
    return found;
}

static nook_result sample(const nook_scene *scene, const nook_rays *rays, double aspect, uint32_t first, uint32_t count,
                          nook_camera *out)
{
    uint32_t source_count = nook_places_count(scene), found = 0;
    source *sources = calloc(source_count, sizeof *sources);
    if (!sources)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u cameras", source_count);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < source_count && result == NOOK_OK; i++) {
        source *s = &sources[i];
        result = nook_place_find(scene, rays, i, aspect, &s->place);
        if (result != NOOK_OK)
            continue;
        const nook_glance own = nook_glance_at(rays, &s->place.camera, aspect, 0.0);
        s->demands = demands_of(&s->place, &own);
    }
    if (result == NOOK_OK)
        found = collect(sources, source_count, aspect, first, count, out);
    for (uint32_t i = 0; i < source_count; i++)
        nook_place_free(&sources[i].place);
    free(sources);
    if (result != NOOK_OK || found == first + count)
        return result;
    return nook_fail(NOOK_E_NOT_FOUND,
                     "%s: %u views were wanted and %u found that show enough of it, from far enough and not from "
                     "behind; give the scene a camera",
                     scene->path, first + count, found);
}

nook_result nook_cameras_sample(const nook_scene *scene, double aspect, uint32_t first, uint32_t count,
                                nook_camera *out_cameras)
{
    nook_rays *rays;
    nook_camera *cameras = calloc(count + 1, sizeof *cameras);
    if (!cameras)
        return nook_fail(NOOK_E_MEMORY, "no memory for %u cameras", count);
    nook_result result = nook_rays_create(scene, &rays);
    if (result == NOOK_OK)
        result = sample(scene, rays, aspect, first, count, cameras);
    nook_rays_destroy(rays);
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++)
        out_cameras[i] = cameras[i];
    free(cameras);
    return result;
}

uint32_t nook_cameras_period(const nook_scene *scene)
{
    return nook_places_count(scene);
}
