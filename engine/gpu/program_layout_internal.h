/**
 * program_layout_internal.h - what C code relies on in a program and GLSL can change: the layout of blocks, the types at
 * locations and bindings, the local size. Told as lines of text, to be compared and shown:
 *
 *   uniform=1 rays int at 0          a row of the uniform block at binding 1
 *   storage=3 size vec4 at 64
 *   location=0 ivec4
 *   texture=2 sampler3D
 *   image=0 image2D
 *   output=1 uvec4
 *   local_size 8 8 1
 *
 * The first word is the group. A group that only one of two programs has is no difference: C code fills what it always has.
 */
#pragma once
#include "engine/gpu/gpu_internal.h"

/** @param computes a compute program @param out_locations as in program_entry @return owned by the caller; NULL without memory */
char *nook_program_layout_read(const nook_gl *gl, GLuint program, bool computes, uint32_t *out_locations);

/**
 * Whether a program can take the place of one that C code works with.
 * @param files   what the program is made of: rows that the code expects of one of them count more than `before`
 * @param before  NULL: there was none
 * @param out_why on failure the line that differs
 */
bool nook_program_layout_fits(const nook_gpu *gpu, char *const *files, uint32_t file_count, const char *layout,
                              const char *before, char *out_why, size_t capacity);

/** `layout` and the groups that only `before` has (NULL: none). @return owned by the caller; NULL without memory */
char *nook_program_layout_join(const char *layout, const char *before);
