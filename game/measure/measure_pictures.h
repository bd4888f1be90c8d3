#pragma once
#include "game/measure/results.h"
#include "game/stage.h"

enum { NOOK_MEASURE_PICTURE_MAX = 512 };

/**
 * The path of a picture, relative to the folder of the results: pictures/<scene, camera, reach, ...>/<name>.png. Other than
 * letters and digits become '-'; a hash keeps apart what that makes the same.
 * @param name  a setting, or "truth", "screen", "geometry", "lit" @return out
 */
const char *nook_measure_picture_path(const nook_result_row *row, const char *name, char out[NOOK_MEASURE_PICTURE_MAX]);

/** Whether a path that a journal names stays in the folder: it may be a foreign one. "" does. */
bool nook_measure_picture_is_inside(const char *path);

/** Writes visibility as grey, and makes the folders. @return NOOK_E_IO, NOOK_E_MEMORY */
nook_result nook_measure_picture_write(const char *folder, const char *path, const float *values, uint32_t width,
                                       uint32_t height);

/** Where a site's pictures are, relative to the folder. */
typedef struct nook_measure_site_paths {
    char truth[NOOK_MEASURE_PICTURE_MAX], screen[NOOK_MEASURE_PICTURE_MAX], geometry[NOOK_MEASURE_PICTURE_MAX],
        lit[NOOK_MEASURE_PICTURE_MAX];
} nook_measure_site_paths;

/**
 * Writes what of a site no setting changes: truths, geometry, and the picture lit without occlusion. The stage's frame is the
 * site's afterwards.
 * @param row       names the site
 * @param out_site  its texts point into `paths`
 */
nook_result nook_measure_site_write(nook_stage *stage, const nook_site *site, const nook_camera *camera,
                                    const nook_result_row *row, const char *folder, nook_measure_site_paths *paths,
                                    nook_result_site *out_site);

/**
 * Removes the pictures of a site's rows that nobody looks for: all but those of initial settings, of the reference, and of what is on
 * the front of error against time or against fetches. Their rows then have none.
 * @param like  names the site
 * @return NOOK_E_MEMORY
 */
nook_result nook_measure_pictures_prune(nook_results *results, const nook_result_row *like, const char *folder);
