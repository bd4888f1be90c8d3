#include "modules/bake/surfel_word.h"
#include "engine/core/vector.h"
#include "modules/bake/surfel_extent.h"
#include <assert.h>
#include <math.h>

enum { STEPS = 127, AT_OFFSET = 16, AT_ALPHA = 24, AT_SIDE = 30 };

static int byte_at(uint32_t word, int bit)
{
    int value = (int)(word >> bit & 255u);
    return value < 128 ? value : value - 256;
}

static uint32_t byte_of(int value, int bit)
{
    return ((uint32_t)value & 255u) << bit;
}

/* Meyer et al. 2010, On floating-point normal vectors: the octahedron, its lower half folded over the upper. */
static void decode(int x, int y, double out[3])
{
    double u = (double)x / STEPS, v = (double)y / STEPS, z = 1.0 - fabs(u) - fabs(v), fold = fmax(-z, 0.0);
    out[0] = u + (u >= 0.0 ? -fold : fold);
    out[1] = v + (v >= 0.0 ? -fold : fold);
    out[2] = z;
    double length = nook_vector_length(out);
    for (int i = 0; i < 3; i++)
        out[i] /= length;
}

static int within(double steps)
{
    return (int)fmax(-STEPS, fmin(STEPS, steps));
}

/* Of the four codes around the exact one the one whose normal is nearest. */
static uint32_t encode(const double normal[3], double out_normal[3])
{
    double sum = fabs(normal[0]) + fabs(normal[1]) + fabs(normal[2]);
    double u = normal[0] / sum, v = normal[1] / sum;
    if (normal[2] < 0.0) {
        double folded = (1.0 - fabs(v)) * (u >= 0.0 ? 1.0 : -1.0);
        v = (1.0 - fabs(u)) * (v >= 0.0 ? 1.0 : -1.0);
        u = folded;
    }
    double best = -2.0;
    uint32_t word = 0;
    for (int corner = 0; corner < 4; corner++) {
        int x = within(floor(u * STEPS) + (corner & 1)), y = within(floor(v * STEPS) + (corner >> 1));
        double found[3];
        decode(x, y, found);
        double cosine = nook_vector_dot(found, normal);
        if (cosine > best) {
            best = cosine;
            word = byte_of(x, 0) | byte_of(y, 8);
            for (int i = 0; i < 3; i++)
                out_normal[i] = found[i];
        }
    }
    return word;
}

uint32_t nook_surfel_pack(const nook_surfel_plane *plane, const double through[3])
{
    uint32_t six = plane->side == NOOK_SIDE_WITHIN ? plane->interval : plane->alpha;
    assert(plane->side == NOOK_SIDE_WITHIN ? six < NOOK_EXTENT_CODES : six >= 1 && six <= NOOK_SURFEL_ALPHA_MAX);
    double normal[3] = { 0.0, 0.0, 1.0 };
    uint32_t word = encode(plane->normal, normal);
    double offset = nook_vector_dot(normal, through);
    return word | byte_of(within(round(offset * (STEPS / NOOK_SURFEL_OFFSET_MAX))), AT_OFFSET) | six << AT_ALPHA |
           (uint32_t)plane->side << AT_SIDE;
}

nook_surfel_plane nook_surfel_unpack(uint32_t word)
{
    nook_surfel_plane plane = { .offset = byte_at(word, AT_OFFSET) * (NOOK_SURFEL_OFFSET_MAX / STEPS),
                                .alpha = word >> AT_ALPHA & NOOK_SURFEL_ALPHA_MAX,
                                .side = (nook_surfel_side)(word >> AT_SIDE) };
    if (plane.side == NOOK_SIDE_WITHIN) {
        plane.interval = plane.alpha;
        plane.alpha = NOOK_SURFEL_ALPHA_MAX;
    }
    decode(byte_at(word, 0), byte_at(word, 8), plane.normal);
    return plane;
}

bool nook_surfel_word_is_plane(uint32_t word)
{
    return word >> AT_ALPHA != 0;
}

static bool is_plane(uint32_t word)
{
    uint32_t six = word >> AT_ALPHA & NOOK_SURFEL_ALPHA_MAX;
    bool ends = word >> AT_SIDE == NOOK_SIDE_WITHIN ? six < NOOK_EXTENT_CODES : six != 0;
    return byte_at(word, 0) >= -STEPS && byte_at(word, 8) >= -STEPS && byte_at(word, AT_OFFSET) >= -STEPS && ends;
}

bool nook_surfel_is_sound(uint32_t first, uint32_t second)
{
    if (!nook_surfel_word_is_plane(second))
        return is_plane(first) && first >> AT_SIDE == NOOK_SIDE_BOTH && nook_surfel_is_box(second);
    return is_plane(first) && is_plane(second);
}
