#include "game/extremes/oracle_matrix.h"
#include <math.h>

nook_oracle nook_oracle_of(const nook_matrix *matrix)
{
    nook_oracle r;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            r.m[row][column] = matrix->m[column * 4 + row];
    }
    return r;
}

nook_oracle nook_oracle_multiply(const nook_oracle *a, const nook_oracle *b)
{
    nook_oracle r;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++) {
            r.m[row][column] = column == 3 ? a->m[row][3] : 0.0L;
            for (int k = 0; k < 3; k++)
                r.m[row][column] += a->m[row][k] * b->m[k][column];
        }
    }
    return r;
}

/** The row from `k` on whose k-th entry is largest. */
static int pivot_row(long double rows[3][7], int k)
{
    int best = k;
    for (int row = k + 1; row < 3; row++)
        best = fabsl(rows[row][k]) > fabsl(rows[best][k]) ? row : best;
    return best;
}

nook_oracle nook_oracle_inverse(const nook_oracle *a)
{
    long double rows[3][7] = { { 0 } }; /* linear part, identity, minus the translation */
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 3; column++)
            rows[row][column] = a->m[row][column];
        rows[row][3 + row] = 1.0L;
        rows[row][6] = -a->m[row][3];
    }
    for (int k = 0; k < 3; k++) {
        int pivot = pivot_row(rows, k);
        for (int column = 0; column < 7; column++) {
            long double swapped = rows[k][column];
            rows[k][column] = rows[pivot][column];
            rows[pivot][column] = swapped;
        }
        for (int row = 0; row < 3; row++) {
            long double factor = row == k ? 0.0L : rows[row][k] / rows[k][k];
            for (int column = k; column < 7 && factor != 0.0L; column++)
                rows[row][column] -= factor * rows[k][column];
        }
    }
    nook_oracle r;
    for (int row = 0; row < 3; row++) {
        for (int column = 0; column < 4; column++)
            r.m[row][column] = rows[row][3 + column] / rows[row][row];
    }
    return r;
}

void nook_oracle_apply(const nook_oracle *a, const double p[3], long double out[3])
{
    for (int row = 0; row < 3; row++)
        out[row] = a->m[row][0] * p[0] + a->m[row][1] * p[1] + a->m[row][2] * p[2] + a->m[row][3];
}
