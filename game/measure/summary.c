#include "game/measure/summary.h"
#include "engine/core/log.h"
#include "game/measure/sample_columns.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- order ---- */

static int compare_numbers(double a, double b)
{
    return (a > b) - (a < b);
}

static int compare_views(const nook_result_row *a, const nook_result_row *b)
{
    int order = strcmp(a->scene, b->scene);
    if (order == 0)
        order = strcmp(a->scene_hash, b->scene_hash); /* one name, changed content: another scene */
    if (order == 0)
        order = compare_numbers(a->r_max, b->r_max);
    if (order == 0)
        order = compare_numbers(a->width, b->width);
    if (order == 0)
        order = compare_numbers(a->height, b->height);
    if (order == 0)
        order = strcmp(a->falloff, b->falloff);
    if (order == 0)
        order = strcmp(a->machine, b->machine); /* whose times have nothing to do with each other */
    return order ? order : strcmp(a->build, b->build);
}

static bool is_reference(const nook_result_row *row)
{
    return strcmp(row->technique, NOOK_SUMMARY_REFERENCE) == 0;
}

static int compare_settings(const nook_result_row *a, const nook_result_row *b)
{
    int order = (int)is_reference(a) - (int)is_reference(b);
    if (order == 0)
        order = strcmp(a->technique, b->technique);
    if (order == 0)
        order = (int)b->initial - (int)a->initial;
    return order ? order : strcmp(a->setting, b->setting);
}

static int compare_rows(const void *a, const void *b)
{
    const nook_result_row *const *first = a, *const *second = b;
    int order = compare_views(*first, *second);
    return order ? order : compare_settings(*first, *second);
}

/* ---- fronts ---- */

typedef struct front_point {
    double cost, error;
    size_t index;
} front_point;

static int compare_points(const void *a, const void *b)
{
    const front_point *first = a, *second = b;
    int order = compare_numbers(first->cost, second->cost);
    return order ? order : compare_numbers(first->error, second->error);
}

nook_result nook_front_mark(const double *costs, const double *errors, size_t count, bool *out_on_front)
{
    front_point *points = malloc((count + 1) * sizeof *points);
    if (!points)
        return nook_fail(NOOK_E_MEMORY, "no memory for the front of %zu points", count);
    size_t number = 0;
    for (size_t i = 0; i < count; i++) {
        out_on_front[i] = false;
        if (!isnan(costs[i]) && !isnan(errors[i]))
            points[number++] = (front_point){ costs[i], errors[i], i };
    }
    qsort(points, number, sizeof *points, compare_points);
    const front_point *best =
        NULL; /* from cheap to dear, each must be less wrong than all before, or equal to the last */
    for (size_t i = 0; i < number; i++) {
        bool on_front = !best || points[i].error < best->error || compare_points(&points[i], best) == 0;
        out_on_front[points[i].index] = on_front;
        if (on_front)
            best = &points[i];
    }
    free(points);
    return NOOK_OK;
}

static bool can_be_on_front(const nook_summary_view *view, const nook_summary_row *row)
{
    return row->cameras == view->cameras && !is_reference(row->row);
}

static nook_result mark_front(nook_summary_view *view)
{
    double *numbers = malloc(2 * view->row_count * sizeof *numbers);
    bool *marks = malloc(view->row_count * sizeof *marks);
    nook_result result = NOOK_OK;
    if (!numbers || !marks)
        result = nook_fail(NOOK_E_MEMORY, "no memory for the front of %zu settings", view->row_count);
    for (size_t i = 0; i < view->row_count && result == NOOK_OK; i++) {
        const nook_summary_row *row = &view->rows[i];
        bool counts = can_be_on_front(view, row);
        view->compared += counts;
        numbers[i] = counts ? row->sample.ms_median : NAN;
        numbers[view->row_count + i] = row->sample.truth.rmse;
    }
    if (result == NOOK_OK)
        result = nook_front_mark(numbers, numbers + view->row_count, view->row_count, marks);
    for (size_t i = 0; i < view->row_count && result == NOOK_OK; i++)
        view->rows[i].on_front = marks[i];
    free(numbers);
    free(marks);
    return result;
}

/* ---- summing up ---- */

/* One setting's rows, which stand together. `values` has room for a number of each. */
static nook_summary_row sum_up(const nook_result_row *const *rows, size_t count, double *values)
{
    size_t column_count;
    const nook_sample_column *columns = nook_sample_columns(&column_count);
    nook_summary_row row = { .row = rows[0], .cameras = (uint32_t)count };
    for (size_t c = 0; c < column_count; c++) {
        for (size_t i = 0; i < count; i++)
            values[i] = nook_sample_number(&rows[i]->sample, &columns[c]);
        double over = nook_over_cameras_of(columns[c].over, values, count);
        memcpy((char *)&row.sample + columns[c].offset, &over, sizeof over);
    }
    return row;
}

static void extend_view(nook_summary_view *view, const nook_summary_row *row, const nook_result_row *const *rows)
{
    view->row_count++;
    view->cameras = row->cameras > view->cameras ? row->cameras : view->cameras;
    for (uint32_t i = 0; i < row->cameras; i++) {
        view->largest_noise = fmax(view->largest_noise, rows[i]->sample.reference_noise);
        if (!is_reference(row->row))
            view->smallest_rmse = fmin(view->smallest_rmse, rows[i]->sample.truth.rmse);
    }
}

/* Runs of equal settings become rows, runs of equal views views. `summary` has room for as many of each as there are rows. */
static void gather(const nook_result_row *const *sorted, size_t count, double *values, nook_summary *summary)
{
    for (size_t start = 0, end; start < count; start = end) {
        for (end = start + 1; end < count && compare_rows(&sorted[start], &sorted[end]) == 0;)
            end++;
        nook_summary_row *row = &summary->rows[summary->row_count++];
        *row = sum_up(sorted + start, end - start, values);
        if (start == 0 || compare_views(sorted[start - 1], sorted[start]) != 0)
            summary->views[summary->view_count++] =
                (nook_summary_view){ .rows = row, .largest_noise = NAN, .smallest_rmse = NAN };
        extend_view(&summary->views[summary->view_count - 1], row, sorted + start);
    }
}

nook_result nook_summary_create(const nook_results *results, nook_summary *out_summary)
{
    size_t count = results->row_count;
    const nook_result_row **sorted = malloc((count + 1) * sizeof(const nook_result_row *));
    double *values = malloc((count + 1) * sizeof *values);
    nook_summary summary = { .views = calloc(count + 1, sizeof *summary.views),
                             .rows = calloc(count + 1, sizeof *summary.rows) };
    nook_result result = NOOK_OK;
    if (!sorted || !values || !summary.views || !summary.rows)
        result = nook_fail(NOOK_E_MEMORY, "no memory to sum up %zu results", count);
    if (result == NOOK_OK) {
        for (size_t i = 0; i < count; i++)
            sorted[i] = &results->rows[i];
        qsort(sorted, count, sizeof(const nook_result_row *), compare_rows);
        gather(sorted, count, values, &summary);
    }
    for (size_t i = 0; i < summary.view_count && result == NOOK_OK; i++)
        result = mark_front(&summary.views[i]);
    free(sorted);
    free(values);
    if (result == NOOK_OK)
        *out_summary = summary;
    else
        nook_summary_free(&summary);
    return result;
}

static int compare_to_summary(const void *key, const void *element)
{
    const nook_summary_row *summed = element;
    return compare_rows(&key, &summed->row);
}

bool nook_summary_on_front(const nook_summary *summary, const nook_result_row *row)
{
    const nook_summary_row *found =
        bsearch(row, summary->rows, summary->row_count, sizeof *summary->rows, compare_to_summary);
    return found && found->on_front;
}

void nook_summary_free(nook_summary *summary)
{
    free(summary->views);
    free(summary->rows);
    *summary = (nook_summary){ 0 };
}
