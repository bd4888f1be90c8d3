/** order.h - numbers in ascending order, and the one in the middle. With NaN among them the order is any. */
#pragma once
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

void nook_order_numbers(double *values, size_t count);
/** Allocates nothing, for work in a frame. */
void nook_order_floats(float *values, size_t count);

/** Orders them. @param count  at least 1 @return the one in the middle; of an even number, the mean of the two there */
double nook_median(double *values, size_t count);

/** By the nearest rank. @param ordered at least 1, ascending @param part of them, [0, 1], that are at most as large */
double nook_quantile(const double *ordered, size_t count, double part);
/** The same. */
float nook_quantile_floats(const float *ordered, size_t count, double part);

#ifdef __cplusplus
}
#endif
