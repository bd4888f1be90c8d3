#include "modules/trace/pixel.h"
#include "engine/core/vector.h"

void nook_pixel_position(const nook_ao_pass *pass, uint32_t x, uint32_t y, double depth, double out[3])
{
    double ndc_x = 2.0 * (x + 0.5) / pass->width - 1.0, ndc_y = 2.0 * (y + 0.5) / pass->height - 1.0;
    out[0] = (ndc_x * pass->ray_scale[0] + pass->ray_offset[0]) * depth;
    out[1] = (ndc_y * pass->ray_scale[1] + pass->ray_offset[1]) * depth;
    out[2] = -depth;
}

void nook_pixel_normal(const uint16_t code[2], double out[3])
{
    double x = (code[0] - 32768.0) / 32767.0, y = (code[1] - 32768.0) / 32767.0;
    double z = 1.0 - fabs(x) - fabs(y), fold = z < 0.0 ? -z : 0.0;
    out[0] = x + (x >= 0.0 ? -fold : fold), out[1] = y + (y >= 0.0 ? -fold : fold), out[2] = z;
    nook_vector_normalize(out, out);
}
