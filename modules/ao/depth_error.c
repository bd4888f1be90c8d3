#include "modules/ao/ao_internal.h"
#include <math.h>

/** Bits of the mantissa of a float format, the hidden one included. */
static int mantissa_bits(int size)
{
    return size >= 32 ? 24 : 11; /* there are depth and red formats of 32 and 16 bits */
}

/**
 * Device depth d = p14 / z - p10, so z is off by z^2 / |p14| for each 1 that d is off. Floats are off by a share of d, which is at
 * most |p14| / z + |p10|. Integers by up to two steps: drivers round, or cut off (llvmpipe's 24 bits), what was a float before.
 */
void ao_depth_error(nook_gpu *gpu, nook_ao_texture depth, const double clip_from_view[16], double out_error[2])
{
    const double p10 = clip_from_view[10], p14 = clip_from_view[14];
    GLint size = 0, type = 0;
    gpu->gl->GetTextureLevelParameteriv(depth.native, 0, GL_TEXTURE_DEPTH_SIZE, &size);
    gpu->gl->GetTextureLevelParameteriv(depth.native, 0, size > 0 ? GL_TEXTURE_DEPTH_TYPE : GL_TEXTURE_RED_TYPE, &type);
    if (size == 0)
        gpu->gl->GetTextureLevelParameteriv(depth.native, 0, GL_TEXTURE_RED_SIZE, &size);
    if (type == GL_FLOAT) {
        double share = ldexp(1.0, -mantissa_bits(size));
        out_error[0] = share, out_error[1] = share * fabs(p10 / p14);
    } else {
        out_error[0] = 0.0, out_error[1] = 2.0 * ldexp(1.0, -size) / fabs(p14);
    }
}
