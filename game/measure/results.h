/**
 * results.h - everything measured so far: rows of where, what and how much. The journal, the tables and the report are made from
 * these rows and from nothing else.
 */
#pragma once
#include "game/measure/site.h"
#include <stddef.h>

/** One setting at one site. Texts are owned by the results. */
typedef struct nook_result_row {
    char *scene;      /**< As reports call it: the file's name without folders. */
    char *scene_hash; /**< Of its content, 16 hexadecimal digits. */
    char *camera;     /**< Its name. */
    uint32_t width, height;
    double r_max;      /**< Metres. */
    double r_max_part; /**< Of the scene's diagonal; 0 when it was given in metres. */
    char *falloff;
    char *setting;      /**< nook_setting_print. */
    char *technique;    /**< Its first word. */
    bool initial;       /**< The technique as it comes: every parameter at its initial value. */
    char *build;        /**< What measured it: hash of the program and its shaders. */
    char *machine;      /**< Renderer and processor. */
    char *date;         /**< ISO 8601, UTC. */
    char *picture;      /**< File of the visibility as 8-bit grey PNG, relative to the folder; "" for none. */
    nook_sample sample; /**< Without its visibility. */
} nook_result_row;

/** Pictures and numbers of a site that no setting changes. */
typedef struct nook_result_site {
    char *scene, *scene_hash, *camera;
    uint32_t width, height;
    double r_max;
    char *falloff;
    double reference_noise;
    uint32_t reference_rays;
    char *truth, *screen, *geometry, *lit; /**< PNG files relative to the folder; "" for none. */
} nook_result_site;

typedef struct nook_results {
    nook_result_row *rows;
    size_t row_count, row_capacity;
    nook_result_site *sites;
    size_t site_count, site_capacity;
} nook_results;

/**
 * Reads a folder's journal; a line cut short by an interruption is left out (and said). Pictures that are not there any more are "".
 * @return NOOK_E_FORMAT a line that is no row, NOOK_E_IO, NOOK_E_MEMORY; a folder without one is no failure
 */
nook_result nook_results_read(const char *folder, nook_results *out_results);
void nook_results_free(nook_results *results); /**< Zeroed ones are allowed. */

/**
 * Whether both were measured at one site by one machine: the same scene content, camera, size, r_max and falloff. Rows of two
 * machines are two rows: their times have nothing to do with each other.
 */
bool nook_result_row_same_site(const nook_result_row *a, const nook_result_row *b);

/** A row of the same scene content, camera, size, r_max, falloff, setting and machine, of whatever build; or NULL. */
const nook_result_row *nook_results_find(const nook_results *results, const nook_result_row *like);
/** A site of the same scene content, camera, size, r_max and falloff; or NULL. */
const nook_result_site *nook_results_find_site(const nook_results *results, const nook_result_site *like);

/** Adds a row, in the place of one that find would give. @param row  its texts are copied @return NOOK_E_MEMORY */
nook_result nook_results_put(nook_results *results, const nook_result_row *row);
nook_result nook_results_put_site(nook_results *results, const nook_result_site *site);

/** Writes measure.csv and measure.json, each whole. @param command  the command line, for the record */
nook_result nook_results_write(const nook_results *results, const char *folder, const char *command);
