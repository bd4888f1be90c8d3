/**
 * gpu.h - what Nook asks of OpenGL 4.5 core: textures, buffers, programs with #include, passes and honest times.
 *
 * Functions of GL live in a table (gpu->gl) that belongs to the device: no globals, so that several contexts and
 * reloaded modules can live in one process. Helpers here cover what every pass does; rare calls go to the table.
 */
#pragma once
#include "engine/core/result.h"
#include "engine/gpu/gl_functions.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A texture by its GL name. A value: copy it freely; the maker destroys it once. id 0 is none. */
typedef struct nook_texture {
    uint32_t id;
    uint32_t target;               /**< GL_TEXTURE_2D, GL_TEXTURE_3D, ... */
    uint32_t width, height, depth; /**< Texels of level 0; depth is 1 for 2D. */
    uint32_t format;               /**< Sized internal format, GL_R32F, ... */
} nook_texture;

typedef struct nook_buffer {
    uint32_t id;
    size_t size; /**< Bytes. */
} nook_buffer;

/** A linked program; stays valid until the device is destroyed. id 0 is none. */
typedef struct nook_program {
    uint32_t id;
} nook_program;

typedef struct nook_gpu nook_gpu;
struct nook_gpu_cache; /* programs by path and defines */

struct nook_gpu {
    const nook_gl *gl;
    const char *renderer; /**< GL_RENDERER. */
    const char *version;  /**< GL_VERSION. */
    bool software;        /**< llvmpipe or softpipe: timer queries lie there (docs/architecture.md). */
    uint32_t max_texture_size, max_texture_3d_size;
    struct nook_gpu_cache *cache;
};

typedef struct nook_gpu_desc {
    void (*(*get_proc)(const char *name))(void); /**< nook_context_get_proc. */
    const char
        *source_root; /**< Folder that holds shaders/ and modules/; every shader path is relative to it. Copied. */
} nook_gpu_desc;

/** Loads GL and checks the version. @return NOOK_E_DEVICE; *out_gpu is NULL then */
nook_result nook_gpu_create(const nook_gpu_desc *desc, nook_gpu **out_gpu);
void nook_gpu_destroy(nook_gpu *gpu); /**< Deletes its programs too. NULL is allowed. */

/**
 * Immutable 2D texture, one level; contents undefined. @param filter GL_NEAREST or GL_LINEAR (clamped to the edge)
 * @return NOOK_E_MEMORY or NOOK_E_RANGE
 */
nook_result nook_texture_create_2d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t filter,
                                   nook_texture *out_texture);
nook_result nook_texture_create_3d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t depth,
                                   uint32_t filter, nook_texture *out_texture);
/** With a full mip chain, made from `pixels`, repeated at the edges, trilinear and anisotropic: for materials. */
nook_result nook_texture_create_mipped(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height,
                                       const void *rgba8, nook_texture *out_texture);
void nook_texture_destroy(nook_gpu *gpu, nook_texture *texture); /**< id 0 is allowed; becomes zero. */
/** Waits for the GPU and reads level 0 of a 2D texture, bottom row first, tightly packed. */
void nook_texture_read(nook_gpu *gpu, nook_texture texture, uint32_t gl_format, uint32_t gl_type, void *out,
                       size_t out_size);

/** @param data NULL leaves it undefined */
nook_result nook_buffer_create(nook_gpu *gpu, const void *data, size_t size, nook_buffer *out_buffer);
void nook_buffer_destroy(nook_gpu *gpu, nook_buffer *buffer);
/** Replaces bytes from `offset`; must fit. */
void nook_buffer_update(nook_gpu *gpu, nook_buffer buffer, size_t offset, const void *data, size_t size);

/**
 * A program from shader files, compiled once per (paths, defines) and then found again.
 *
 * Files may #include "path" relative to source_root or to shaders/; errors name file and line through includes.
 * @param defines   lines put after #version, for example "#define RAYS 8\n"; "" for none. Part of the identity.
 * @return NOOK_E_NOT_FOUND a file; NOOK_E_DEVICE it does not compile or link (the driver's lines are in the log)
 */
nook_result nook_program_compute(nook_gpu *gpu, const char *path, const char *defines, nook_program *out_program);
nook_result nook_program_raster(nook_gpu *gpu, const char *vertex_path, const char *fragment_path, const char *defines,
                                nook_program *out_program);

/** Binds for the next dispatch or draw. `unit` is the binding number in the shader. */
void nook_bind_texture(nook_gpu *gpu, uint32_t unit, nook_texture texture);
void nook_bind_image(nook_gpu *gpu, uint32_t unit, nook_texture texture, uint32_t access); /**< GL_READ_ONLY, ... */
void nook_bind_uniform(nook_gpu *gpu, uint32_t unit, nook_buffer buffer);
void nook_bind_storage(nook_gpu *gpu, uint32_t unit, nook_buffer buffer);

/**
 * Runs a compute program on groups x, y, z, then makes its writes visible to texture fetches, image loads and buffers.
 */
void nook_dispatch(nook_gpu *gpu, nook_program program, uint32_t x, uint32_t y, uint32_t z);
/** Groups of `local` that cover `size`. */
static inline uint32_t nook_groups(uint32_t size, uint32_t local)
{
    return (size + local - 1) / local;
}

/** Waits until the GPU has done everything. */
void nook_gpu_finish(nook_gpu *gpu);
/** True, once, when GL has raised an error since the last call; the log then names it and `where`. */
bool nook_gpu_check(nook_gpu *gpu, const char *where);

#ifdef __cplusplus
}
#endif
