#include "game/extremes/edge_pictures.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

nook_result nook_edge_pictures_take(nook_edge_scene *scene, nook_extreme_found *found, const char *where,
                                    nook_edge_pictures *out_pictures)
{
    nook_edge_pictures pictures = { .pixels = scene->pixels };
    pictures.count = nook_edge_estimators(pictures.estimators);
    pictures.visibility = calloc(pictures.count * pictures.pixels, sizeof *pictures.visibility);
    if (!pictures.visibility)
        return nook_fail(NOOK_E_MEMORY, "extremes: no room for %zu pictures", pictures.count);
    for (size_t i = 0; i < pictures.count; i++) {
        nook_result result = nook_edge_scene_record(scene, pictures.estimators[i].name, found, "%s", where);
        if (result != NOOK_OK) {
            nook_edge_pictures_free(&pictures);
            return result;
        }
        memcpy(pictures.visibility + i * pictures.pixels, scene->view->visibility,
               pictures.pixels * sizeof *pictures.visibility);
    }
    *out_pictures = pictures;
    return NOOK_OK;
}

void nook_edge_pictures_free(nook_edge_pictures *pictures)
{
    free(pictures->visibility);
    *pictures = (nook_edge_pictures){ 0 };
}

void nook_edge_pictures_compare(const nook_edge_pictures *a, const nook_edge_pictures *b, nook_edge_compare compare,
                                nook_extreme_found *found, const char *where)
{
    for (size_t i = 0; i < a->count; i++) {
        size_t first = i * a->pixels;
        nook_extreme_worst(found, compare(a->visibility + first, b->visibility + first, a->pixels), "%s, %s",
                           a->estimators[i].name, where);
    }
}

void nook_edge_pictures_compare_joined(const nook_edge_pictures *a, const nook_edge_pictures *b,
                                       nook_edge_compare compare, nook_extreme_found *found, const char *where)
{
    for (size_t i = 0; i < a->count; i++) {
        size_t first = i * a->pixels;
        if (!a->estimators[i].hangs)
            nook_extreme_worst(found, compare(a->visibility + first, b->visibility + first, a->pixels), "%s, %s",
                               a->estimators[i].name, where);
    }
}

void nook_edge_pictures_compare_elsewhere(const nook_edge_pictures *a, const nook_edge_pictures *b,
                                          nook_edge_compare compare, nook_extreme_found *found, const char *where)
{
    for (size_t i = 0; i < a->count; i++) {
        size_t first = i * a->pixels;
        double measured = compare(a->visibility + first, b->visibility + first, a->pixels);
        double rms = nook_edge_rms(a->visibility + first, b->visibility + first, a->pixels);
        if (a->estimators[i].hangs && rms <= NOOK_EDGE_HANGING)
            measured = 0.0;
        nook_extreme_worst(found, measured, "%s, %s", a->estimators[i].name, where);
    }
}

double nook_edge_rms(const float *a, const float *b, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += ((double)a[i] - b[i]) * ((double)a[i] - b[i]);
    return sqrt(sum / (double)count);
}

double nook_edge_bias(const float *a, const float *b, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += (double)a[i] - b[i];
    return sum / (double)count;
}

double nook_edge_different(const float *a, const float *b, size_t count)
{
    double different = 0.0;
    for (size_t i = 0; i < count; i++)
        different += memcmp(&a[i], &b[i], sizeof *a) != 0;
    return different;
}

double nook_edge_occlusion(const float *visibility, size_t count)
{
    double sum = 0.0;
    for (size_t i = 0; i < count; i++)
        sum += 1.0 - visibility[i];
    return sum / (double)count;
}
