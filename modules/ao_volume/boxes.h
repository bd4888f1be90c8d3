/**
 * boxes.h - the technique "volume" as the papers draw it: the box of each occluder, blended by multiplication; path = raster.
 *
 * visibility = 1 -> one instanced draw, an instance an occluder: its box, extended by r_max, back faces only, no depth test
 * (Menexi 2008, section 3.4) -> shaders/ao/volume_box.glsl: the rays of each pixel in it -> visibility *= what they leave
 *
 * Rasterising does what the lists of tiles do for path = compute: what lies outside of all boxes costs nothing.
 */
#pragma once
#include "modules/ao/technique.h"
#include "modules/ao_volume/cut_internal.h"

/** Zero before the first use. */
typedef struct volume_boxes {
    uint32_t framebuffer, vertex_array; /**< GL names. */
} volume_boxes;

void volume_boxes_release(volume_boxes *boxes, nook_gpu *gpu);
/**
 * Multiplies what each occluder leaves into the wanted pixels of pass->visibility. GL's state is as it was, but for the program in use.
 * The rays of an occluder that are too many loop turns for one draw are cut: one draw for each occluder and part then, whose sum waits in
 * the image that the caller has bound. Occluders blend in the order in which they were submitted: same frame, same bits.
 * @param program  volume_box.vert.glsl and KIND.frag.glsl, all that it reads bound @param cut  volume_cut_careful: rays are looked at
 * @return NOOK_E_DEVICE the driver cannot blend the visibility's format
 */
nook_result volume_boxes_draw(volume_boxes *boxes, const nook_ao_pass *pass, nook_program program,
                              const volume_work *work, const volume_cut *cut);
