#include "engine/core/order.h"
#include <math.h>
#include <stdlib.h>

static int compare_numbers(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void nook_order_numbers(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare_numbers);
}

double nook_median(double *values, size_t count)
{
    nook_order_numbers(values, count);
    return 0.5 * (values[(count - 1) / 2] + values[count / 2]);
}

static size_t nearest_rank(size_t count, double part)
{
    double rank = ceil(fmin(fmax(part, 0.0), 1.0) * (double)count);
    return rank < 1.0 ? 0 : (size_t)rank - 1;
}

double nook_quantile(const double *ordered, size_t count, double part)
{
    return ordered[nearest_rank(count, part)];
}

float nook_quantile_floats(const float *ordered, size_t count, double part)
{
    return ordered[nearest_rank(count, part)];
}

/* Puts a value into the heap whose place at `hole` is free: no parent is below its children. */
static void sift_down(float *heap, size_t count, size_t hole, float value)
{
    for (size_t child = 2 * hole + 1; child < count; child = 2 * hole + 1) {
        child += child + 1 < count && heap[child + 1] > heap[child];
        if (heap[child] <= value)
            break;
        heap[hole] = heap[child];
        hole = child;
    }
    heap[hole] = value;
}

/* Heapsort: qsort takes memory for what it orders. */
void nook_order_floats(float *values, size_t count)
{
    for (size_t i = count / 2; i > 0; i--)
        sift_down(values, count, i - 1, values[i - 1]);
    for (size_t end = count; end > 1; end--) {
        float last = values[end - 1];
        values[end - 1] = values[0];
        sift_down(values, end - 1, 0, last);
    }
}
