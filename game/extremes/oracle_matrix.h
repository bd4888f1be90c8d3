/** oracle_matrix.h - affine matrices in long double, by other roads than engine/core/matrix.c: what that one is held against. */
#pragma once
#include "engine/core/matrix.h"

/** Three rows of an affine matrix; the fourth is 0 0 0 1. */
typedef struct nook_oracle {
    long double m[3][4];
} nook_oracle;

/** The same numbers; nothing is rounded. */
nook_oracle nook_oracle_of(const nook_matrix *matrix);
/** a * b */
nook_oracle nook_oracle_multiply(const nook_oracle *a, const nook_oracle *b);
/** By elimination with pivots. @param a  not singular */
nook_oracle nook_oracle_inverse(const nook_oracle *a);
/** a * (p, 1) */
void nook_oracle_apply(const nook_oracle *a, const double p[3], long double out[3]);
