/** pixel.h - what a pixel of a pass shows: its point and its normal, in double. */
#pragma once
#include "modules/ao/technique.h"

#ifdef __cplusplus
extern "C" {
#endif

/** View position of the centre of a pixel. @param depth  metres along -Z */
void nook_pixel_position(const nook_ao_pass *pass, uint32_t x, uint32_t y, double depth, double out[3]);

/** As nook_octahedral_decode of shaders/nook/octahedral.glsl. In double: the sign of z chooses the frame. @param out  of length 1 */
void nook_pixel_normal(const uint16_t code[2], double out[3]);

#ifdef __cplusplus
}
#endif
