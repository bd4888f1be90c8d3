#include "engine/animation/sample.h"
#include <math.h>

/* The last key at or before a time, of those that have one behind them. */
static uint32_t find_key(const float *times, uint32_t count, double seconds)
{
    uint32_t low = 0, high = count - 1; /* times[low] <= seconds < times[high] */
    while (high - low > 1) {
        uint32_t middle = low + (high - low) / 2;
        if ((double)times[middle] <= seconds)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static void normalise(double q[4])
{
    double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4 && length > 0.0; i++)
        q[i] /= length;
    if (!(length > 0.0)) /* a spline through the origin has no direction there */
        q[0] = q[1] = q[2] = 0.0, q[3] = 1.0;
}

void nook_rotation_slerp(const double a[4], const double b[4], double t, double out[4])
{
    double cosine = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double side = cosine < 0.0 ? -1.0 : 1.0; /* q and -q are one rotation: the nearer of the two */
    double angle = acos(fmin(side * cosine, 1.0)), sine = sin(angle);
    double of_a = 1.0 - t, of_b = t; /* where the arc is straight to the last digit */
    if (sine > 1e-9) {
        of_a = sin((1.0 - t) * angle) / sine;
        of_b = sin(t * angle) / sine;
    }
    for (int i = 0; i < 4; i++)
        out[i] = of_a * a[i] + side * of_b * b[i];
    normalise(out);
}

/* Numbers of the value of one key; of splines it lies between its tangents. */
static const float *value_of(const nook_track *track, const float *values, uint32_t key)
{
    const float *first = values + track->first_value;
    if (track->interpolation == NOOK_CUBIC_SPLINE)
        return first + ((size_t)key * 3 + 1) * track->width;
    return first + (size_t)key * track->width;
}

static void hold(const nook_track *track, const float *values, uint32_t key, double *out)
{
    const float *value = value_of(track, values, key);
    for (uint32_t i = 0; i < track->width; i++)
        out[i] = value[i];
}

static void sample_linear(const nook_track *track, const float *values, uint32_t key, double t, double *out)
{
    const float *a = value_of(track, values, key), *b = value_of(track, values, key + 1);
    if (track->path == NOOK_TRACK_ROTATION) {
        const double from[4] = { a[0], a[1], a[2], a[3] }, to[4] = { b[0], b[1], b[2], b[3] };
        nook_rotation_slerp(from, to, t, out);
        return;
    }
    for (uint32_t i = 0; i < track->width; i++)
        out[i] = (double)a[i] + t * ((double)b[i] - (double)a[i]);
}

/* Hermite's: tangents are per second, so that they are scaled by the distance of the keys. */
static void sample_spline(const nook_track *track, const float *values, uint32_t key, double t, double between,
                          double *out)
{
    const float *a = value_of(track, values, key), *b = value_of(track, values, key + 1);
    const float *leaves = a + track->width, *arrives = b - track->width;
    double t2 = t * t, t3 = t2 * t;
    for (uint32_t i = 0; i < track->width; i++)
        out[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * (double)a[i] + between * (t3 - 2.0 * t2 + t) * (double)leaves[i] +
                 (3.0 * t2 - 2.0 * t3) * (double)b[i] + between * (t3 - t2) * (double)arrives[i];
}

static void sample(const nook_track *track, const float *values, double seconds, double *out)
{
    const float *times = values + track->first_time;
    uint32_t last = track->key_count - 1;
    if (!(seconds > (double)times[0])) {
        hold(track, values, 0, out);
        return;
    }
    if (seconds >= (double)times[last]) {
        hold(track, values, last, out);
        return;
    }
    uint32_t key = find_key(times, track->key_count, seconds);
    double between = (double)times[key + 1] - (double)times[key]; /* above 0: seconds lies in it */
    double t = (seconds - (double)times[key]) / between;
    if (track->interpolation == NOOK_STEP)
        hold(track, values, key, out);
    else if (track->interpolation == NOOK_LINEAR)
        sample_linear(track, values, key, t, out);
    else
        sample_spline(track, values, key, t, between, out);
}

void nook_track_sample(const nook_track *track, const float *values, double seconds, double *out)
{
    sample(track, values, seconds, out);
    if (track->path == NOOK_TRACK_ROTATION)
        normalise(out);
}
