#include "engine/asset/image.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/measure/measure_pictures.h"
#include "game/measure/report_internal.h"
#include "game/measure/summary.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* ---- which ones ---- */

/* In which order pictures are taken while there is room. */
enum { RANK_TRUTH, RANK_INITIAL, RANK_FRONT, RANK_OTHER };

typedef struct wanted_picture {
    const char *name; /* Of the file, in the folder. */
    int rank;
    size_t index; /* Of the results: keeps equal ranks in order. */
} wanted_picture;

static int compare_names(const void *a, const void *b)
{
    const wanted_picture *first = a, *second = b;
    int order = strcmp(first->name, second->name);
    return order ? order : first->rank - second->rank;
}

static int compare_ranks(const void *a, const void *b)
{
    const wanted_picture *first = a, *second = b;
    int order = first->rank - second->rank;
    return order ? order : (first->index > second->index) - (first->index < second->index);
}

static void want(wanted_picture *list, size_t *count, const char *name, int rank)
{
    if (name[0]) {
        list[*count] = (wanted_picture){ .name = name, .rank = rank, .index = *count };
        (*count)++;
    }
}

/* Whether that row's setting is on its view's front. */
static bool *mark_front_rows(const nook_results *results)
{
    nook_summary summary;
    bool *marks = calloc(results->row_count + 1, sizeof *marks);
    if (!marks || nook_summary_create(results, &summary) != NOOK_OK) {
        free(marks);
        return NULL;
    }
    for (size_t i = 0; i < results->row_count; i++)
        marks[i] = nook_summary_on_front(&summary, &results->rows[i]);
    nook_summary_free(&summary);
    return marks;
}

static size_t list_wanted(const nook_results *results, const bool *on_front, wanted_picture *list)
{
    size_t count = 0, unique = 0;
    for (size_t i = 0; i < results->site_count; i++) {
        const nook_result_site *site = &results->sites[i];
        want(list, &count, site->truth, RANK_TRUTH);
        want(list, &count, site->screen, RANK_TRUTH);
        want(list, &count, site->geometry, RANK_TRUTH);
        want(list, &count, site->lit, RANK_TRUTH);
    }
    for (size_t i = 0; i < results->row_count; i++) {
        const nook_result_row *row = &results->rows[i];
        want(list, &count, row->picture, row->initial ? RANK_INITIAL : on_front[i] ? RANK_FRONT : RANK_OTHER);
    }
    qsort(list, count, sizeof *list, compare_names);
    for (size_t i = 0; i < count; i++) {
        if (i == 0 || strcmp(list[i].name, list[unique - 1].name) != 0)
            list[unique++] = list[i];
    }
    qsort(list, unique, sizeof *list, compare_ranks);
    return unique;
}

/* ---- writing ---- */

static void put_base64(FILE *out, const uint8_t *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        uint32_t left = size - i > 2 ? 3 : (uint32_t)(size - i), bits = (uint32_t)bytes[i] << 16;
        if (left > 1)
            bits |= (uint32_t)bytes[i + 1] << 8;
        if (left > 2)
            bits |= bytes[i + 2];
        char four[] = { digits[bits >> 18], digits[bits >> 12 & 63], '=', '=' };
        if (left > 1)
            four[2] = digits[bits >> 6 & 63];
        if (left > 2)
            four[3] = digits[bits & 63];
        fwrite(four, 1, sizeof four, out);
    }
}

static void put_picture(FILE *out, const char *name, const nook_file *file)
{
    fputs("<script type=\"text/plain\" data-picture=\"", out);
    nook_report_put_html(out, name);
    fputs("\">", out);
    put_base64(out, file->bytes, file->size);
    fputs("</script>\n", out);
}

typedef struct picture_count {
    size_t missing, over; /* Not there, no PNG or out of the folder; beyond the room there is. */
    size_t bytes;         /* Of those written. */
    const char *first;    /* Missing one. */
} picture_count;

static void put_file(FILE *out, const char *folder, const char *name, picture_count *count)
{
    char path[PATH_MAX];
    nook_file file = { 0 };
    nook_path_join(path, sizeof path, folder, name);
    if (!nook_measure_picture_is_inside(name) || !nook_file_exists(path) || nook_file_read(path, &file) != NOOK_OK ||
        nook_image_detect(file.bytes, file.size) != NOOK_IMAGE_PNG) {
        count->first = count->first ? count->first : name;
        count->missing++;
    } else if (file.size > NOOK_REPORT_PICTURES_MAX - count->bytes) {
        count->over++;
    } else {
        put_picture(out, name, &file);
        count->bytes += file.size;
    }
    nook_file_free(&file);
}

nook_result nook_report_put_pictures(FILE *out, const nook_results *results, const char *folder)
{
    wanted_picture *list = malloc((4 * results->site_count + results->row_count + 1) * sizeof *list);
    bool *on_front = mark_front_rows(results);
    picture_count count = { 0 };
    nook_result result = NOOK_OK;
    if (!list || !on_front)
        result = nook_fail(NOOK_E_MEMORY, "no memory for the pictures of the report");
    size_t wanted = result == NOOK_OK ? list_wanted(results, on_front, list) : 0;
    for (size_t i = 0; i < wanted; i++)
        put_file(out, folder, list[i].name, &count);
    if (count.missing)
        nook_log_warning("%s: %zu of %zu pictures are missing, no PNG or out of the folder (%s); the report shows "
                         "their numbers only",
                         folder, count.missing, wanted, count.first);
    if (count.over)
        nook_log_warning(
            "%s: %zu of %zu pictures are left out of the report, which holds %zu MiB of them; they are in the folder",
            folder, count.over, wanted, NOOK_REPORT_PICTURES_MAX >> 20);
    free(list);
    free(on_front);
    return result;
}
