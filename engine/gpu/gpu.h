/**
 * gpu.h - what Nook asks of OpenGL 4.5 core: textures, buffers, programs with #include, passes and honest times.
 *
 * Functions of GL live in a table (gpu->gl) that belongs to the device: no globals, so that several contexts and
 * reloaded modules can live in one process. Helpers here cover what every pass does; rare calls go to the table.
 * A device is used on the thread on which its context is current.
 *
 * What software GL (llvmpipe, Mesa 22.3) asks of those who write passes:
 * - local_size_x is a multiple of 8, its lanes: 2 or 4 cost 1.4 to 1.7 times, and once 19 to 44 times, the time.
 * - A dispatch runs to its end inside nook_dispatch; draws only start. Time both around nook_gpu_finish. Before that it
 *   waits for all draws.
 * - Each thread gets one contiguous share of a dispatch's groups: background in one half idles a core.
 * - Timer queries lie: 0 ms for a dispatch of 100 ms. See nook_gpu_timer_trusted.
 * - Loads from storage buffers cost twice a texelFetch from a texture buffer; trilinear taps three times a nearest one.
 * - In fragment shaders, and in loops and branches of others, each lane fetches each number of a uniform block on its own: 25 instructions.
 *   What is one for the picture is handed on as flat outputs of its three vertices (shaders/render/by_vertex.glsl).
 * - Linear filtering of 8 bit formats gives whole steps of 1/255: use R16F or R32F where that is too coarse.
 * - The first use of a program compiles it once more (10 to 200 ms): warm up before timing.
 * - Do not redeclare gl_PerVertex in a vertex shader: it then fails to link.
 * - Values too large for an unsigned integer target are clamped, not cut: mask them in the shader.
 */
#pragma once
#include "engine/core/param.h"
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

/**
 * A linked program; stays valid until the device is destroyed, also when its shaders are reloaded: it is not GL's name,
 * which changes then. handle 0 is none.
 */
typedef struct nook_program {
    uint32_t handle;
} nook_program;

/** Where draws go. Borrows its textures: destroy it before them. id 0 is the window's own. */
typedef struct nook_framebuffer {
    uint32_t id;
    uint32_t width, height; /**< Pixels. */
} nook_framebuffer;

/** A pair of time stamps. id 0 is none. */
typedef struct nook_gpu_timer {
    uint32_t begin, end; /**< Query names. */
} nook_gpu_timer;

typedef struct nook_gpu nook_gpu;
struct nook_gpu_cache; /* engine/gpu/gpu_internal.h: the table of functions, and programs by paths and defines */

struct nook_gpu {
    const nook_gl *gl;
    const char *renderer; /**< GL_RENDERER. */
    const char *version;  /**< GL_VERSION. */
    bool
        skips_srgb_decode; /**< Samplers can be told to return sRGB texels as they are stored (GL_EXT_texture_sRGB_decode). */
    bool software;         /**< llvmpipe or softpipe: timer queries lie there (docs/architecture.md). */
    uint32_t max_texture_size, max_texture_3d_size;
    uint32_t max_texture_buffer_size; /**< Texels. */
    struct nook_gpu_cache *cache;
};

typedef struct nook_gpu_desc {
    void (*(*get_proc)(const char *name))(void); /**< nook_context_get_proc. */
    const char
        *source_root;      /**< Folder that holds shaders/ and modules/; every shader path is relative to it. Copied. */
    bool log_debug_output; /**< True: takes GL's debug callback, of which a context has but one, and its filters. */
} nook_gpu_desc;

/**
 * Loads GL and checks the version. With log_debug_output what the driver calls an error or of high severity reaches the log
 * from then on.
 * @return NOOK_E_DEVICE or NOOK_E_MEMORY; *out_gpu is NULL then
 */
nook_result nook_gpu_create(const nook_gpu_desc *desc, nook_gpu **out_gpu);
/** Deletes its programs too; its context must be current. NULL is allowed. */
void nook_gpu_destroy(nook_gpu *gpu);
/** The folder that shaders are looked for in: of the description. */
const char *nook_gpu_source_root(const nook_gpu *gpu);

/**
 * Immutable 2D texture, one level; contents undefined. @param filter GL_NEAREST or GL_LINEAR (clamped to the edge)
 * @return NOOK_E_MEMORY or NOOK_E_RANGE
 */
nook_result nook_texture_create_2d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t filter,
                                   nook_texture *out_texture);
nook_result nook_texture_create_3d(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height, uint32_t depth,
                                   uint32_t filter, nook_texture *out_texture);
/**
 * With a full mip chain, made from `rgba8`, repeated at the edges, trilinear and anisotropic: for materials.
 * @param format GL_RGBA8 or GL_SRGB8_ALPHA8 @param rgba8 width * height * 4 bytes, first row at v = 0
 */
nook_result nook_texture_create_mipped(nook_gpu *gpu, uint32_t format, uint32_t width, uint32_t height,
                                       const void *rgba8, nook_texture *out_texture);
/**
 * A buffer as a row of texels, for texelFetch of a samplerBuffer or usamplerBuffer: on software GL half the time of a load from storage.
 * Shows what the buffer holds whenever it is read; destroy it before the buffer.
 * @param format GL_RGBA32F, GL_RGBA32UI, GL_RG32UI or GL_R8UI
 * @return NOOK_E_RANGE more texels than the device takes: max_texture_buffer_size; NOOK_E_MEMORY
 */
nook_result nook_texture_create_buffer(nook_gpu *gpu, uint32_t format, nook_buffer buffer, nook_texture *out_texture);
void nook_texture_destroy(nook_gpu *gpu, nook_texture *texture); /**< id 0 is allowed; becomes zero. */
/**
 * Replaces level 0 whole: rows tightly packed, bottom row (for 3D: slice 0) first.
 * @param size bytes at `data`; must be what the format and the type ask for
 */
void nook_texture_write(nook_gpu *gpu, nook_texture texture, uint32_t gl_format, uint32_t gl_type, const void *data,
                        size_t size);
/** The same for a box of texels that lies inside the texture; z 0 and depth 1 for 2D. */
void nook_texture_write_box(nook_gpu *gpu, nook_texture texture, const uint32_t origin[3], const uint32_t extent[3],
                            uint32_t gl_format, uint32_t gl_type, const void *data, size_t size);
/** Waits for the GPU and reads level 0, bottom row (for 3D: slice 0) first, tightly packed. `out_size` must be enough. */
void nook_texture_read(nook_gpu *gpu, nook_texture texture, uint32_t gl_format, uint32_t gl_type, void *out,
                       size_t out_size);

/** @param data NULL leaves it undefined @return NOOK_E_MEMORY; NOOK_E_RANGE for no bytes */
nook_result nook_buffer_create(nook_gpu *gpu, const void *data, size_t size, nook_buffer *out_buffer);
void nook_buffer_destroy(nook_gpu *gpu, nook_buffer *buffer);
/** Replaces bytes from `offset`; must fit. */
void nook_buffer_update(nook_gpu *gpu, nook_buffer buffer, size_t offset, const void *data, size_t size);
/** Waits for the GPU and reads bytes from `offset`; must fit. */
void nook_buffer_read(nook_gpu *gpu, nook_buffer buffer, size_t offset, void *out, size_t size);

/**
 * A program from shader files, compiled once per (paths, defines) and then found again, which allocates nothing.
 *
 * Files may #include "path" relative to source_root or to shaders/, as often as they like; a file with a line
 * `#pragma once` counts once. An #include is obeyed also inside #if. Errors name file and line through includes.
 * A file without #version gets `#version 450 core`. __LINE__ counts lines of the joined text.
 * @param defines   lines put after #version, for example "#define RAYS 8\n"; "" for none. Part of the identity.
 * @return NOOK_E_NOT_FOUND a file; NOOK_E_FORMAT includes go in a circle, too deep or are misspelt; NOOK_E_MEMORY;
 *         NOOK_E_DEVICE it does not compile or link (the driver's lines are in the log); NOOK_E_VERSION it does not fit
 *         the code (nook_gpu_expect_params). *out_program is untouched then. A program that failed is built again by
 *         nook_gpu_reload_shaders, and fails until then without another line in the log.
 */
nook_result nook_program_compute(nook_gpu *gpu, const char *path, const char *defines, nook_program *out_program);
nook_result nook_program_raster(nook_gpu *gpu, const char *vertex_path, const char *fragment_path, const char *defines,
                                nook_program *out_program);

/** The program of draws and of nook_uniform_* from now on; nook_dispatch does the same. */
void nook_program_use(nook_gpu *gpu, nook_program program);
/** GL's name of it until the next nook_gpu_reload_shaders. */
uint32_t nook_program_native(const nook_gpu *gpu, nook_program program);
/** How often it has been built: what keeps pictures that it made compares that, and makes them anew after a reload. */
uint32_t nook_program_version(const nook_gpu *gpu, nook_program program);

/** How many programs have taken the place of others, by reloads: for who keeps what programs of others have made. */
uint32_t nook_gpu_replaced_programs(const nook_gpu *gpu);

/**
 * Sets a uniform of the program in use, `layout(location = ...)` below 32. Set all of them for every use: a reloaded program
 * starts with zeros. Nothing happens when the shader does not need it (any more).
 * @param count of its components, 1 to 4
 */
void nook_uniform_int(nook_gpu *gpu, uint32_t location, const int32_t *values, uint32_t count);
void nook_uniform_uint(nook_gpu *gpu, uint32_t location, const uint32_t *values, uint32_t count);
void nook_uniform_float(nook_gpu *gpu, uint32_t location, const float *values, uint32_t count);

/** What came of a reload. */
typedef struct nook_shader_report {
    uint32_t reloaded; /**< Programs that were replaced. */
    uint32_t
        failed; /**< Programs of the device that do not build as their files are now; of this reload or an earlier one. */
    double ms;       /**< That it took. */
    char text[4096]; /**< Why: lines that name file and line through includes, each once; "" when none has failed. */
} nook_shader_report;

/**
 * Builds the programs that are made of changed files anew, includes among them, and those that failed before. Each is
 * built aside: it takes the old one's place only when it compiles, links and fits the code that uses it, which is so when
 * uniform and storage blocks, types at locations and bindings, and the local size of a compute shader are as they were
 * (what only one of the two has may differ). Else the old one stays, and the reason is logged unless it is the same as the last time.
 * Takes as long as the driver needs; call it between frames.
 * @param changed paths relative to source_root, of files or of folders that are gone; NULL: all are built anew
 */
void nook_gpu_reload_shaders(nook_gpu *gpu, const char *const *changed, size_t count, nook_shader_report *out_report);
/** What does not build now, without building anything: `reloaded` and `ms` are 0. */
void nook_gpu_shader_report(const nook_gpu *gpu, nook_shader_report *out_report);

/**
 * Programs built from now on that include this params.def are refused with NOOK_E_VERSION unless they have a uniform block of just
 * the rows that the code writes: a saved params.def never meets code that was built with another. Replaces what was expected
 * of that path before. After code with another table was loaded: expect it, then reload the path.
 * @param path relative to source_root @param table copied
 * @return NOOK_E_MEMORY
 */
nook_result nook_gpu_expect_params(nook_gpu *gpu, const char *path, const nook_param *table, size_t count);

/** Binds for the next dispatch or draw. `unit` is the binding number in the shader. */
void nook_bind_texture(nook_gpu *gpu, uint32_t unit, nook_texture texture);
void nook_bind_image(nook_gpu *gpu, uint32_t unit, nook_texture texture, uint32_t access); /**< GL_READ_ONLY, ... */
void nook_bind_uniform(nook_gpu *gpu, uint32_t unit, nook_buffer buffer);
void nook_bind_storage(nook_gpu *gpu, uint32_t unit, nook_buffer buffer);

/**
 * Runs a compute program on groups x, y, z, then makes its writes visible to texture fetches, image loads and buffers.
 */
void nook_dispatch(nook_gpu *gpu, nook_program program, uint32_t x, uint32_t y, uint32_t z);
/** The same with x, y, z from three GLuint at the start of a buffer, which an earlier dispatch may have written; 0 does nothing. */
void nook_dispatch_indirect(nook_gpu *gpu, nook_program program, nook_buffer groups);
/** Groups of `local` that cover `size`. */
static inline uint32_t nook_groups(uint32_t size, uint32_t local)
{
    return (size + local - 1) / local;
}

/**
 * A target of draws: colour textures in the order of the shader's outputs, then depth.
 * @param colours level 0, all of one size; colour_count 0 to 8 @param depth id 0: none
 * @return NOOK_E_RANGE no texture, too many, or sizes that differ; NOOK_E_DEVICE the driver cannot draw to these formats
 */
nook_result nook_framebuffer_create(nook_gpu *gpu, const nook_texture *colours, uint32_t colour_count,
                                    nook_texture depth, nook_framebuffer *out_framebuffer);
/** The same with the slices of a 3D texture, 1 to 8, as colours, and without depth. @return as above */
nook_result nook_framebuffer_create_slices(nook_gpu *gpu, nook_texture colours, nook_framebuffer *out_framebuffer);
void nook_framebuffer_destroy(nook_gpu *gpu, nook_framebuffer *framebuffer); /**< id 0 is allowed; becomes zero. */
/** Draws go there from now on, and the viewport covers it. */
void nook_framebuffer_bind(nook_gpu *gpu, nook_framebuffer framebuffer);

/** False on software GL, where timer queries lie: measure wall time around nook_gpu_finish there. */
bool nook_gpu_timer_trusted(const nook_gpu *gpu);
void nook_gpu_timer_create(nook_gpu *gpu, nook_gpu_timer *out_timer);
void nook_gpu_timer_destroy(nook_gpu *gpu, nook_gpu_timer *timer); /**< Zeroed timers are allowed; becomes zero. */
void nook_gpu_timer_begin(nook_gpu *gpu, nook_gpu_timer timer);
void nook_gpu_timer_end(nook_gpu *gpu, nook_gpu_timer timer);
/** Waits for the end and gives milliseconds between begin and end on the GPU. */
double nook_gpu_timer_ms(nook_gpu *gpu, nook_gpu_timer timer);

/** Waits until the GPU has done everything. */
void nook_gpu_finish(nook_gpu *gpu);
/** True, once, when GL has raised an error since the last call; the log then names it and `where`. */
bool nook_gpu_check(nook_gpu *gpu, const char *where);

#ifdef __cplusplus
}
#endif
