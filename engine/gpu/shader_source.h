/**
 * shader_source.h - a shader file with its includes as one text, and the way back from the driver's messages to files.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct nook_shader_file {
    char *path; /**< Owned; relative to the source root, as messages name it. */
    bool once;  /**< `#pragma once` was read in it. */
    bool open;  /**< Being read now: an include of it goes in a circle. */
} nook_shader_file;

/** Where a line of the joined text comes from. */
typedef struct nook_shader_line {
    uint32_t file; /**< Into files. */
    uint32_t line; /**< From 1. */
} nook_shader_line;

/**
 * Zeroed is empty. Release with nook_shader_source_free.
 * The text holds no #line: the driver counts its lines and `lines` tells what they are. Mesa drops the file number of #line
 * for every expression of more than one token, so that messages would name the wrong file.
 */
typedef struct nook_shader_source {
    char *text; /**< Owned, ends in a zero byte: #version, defines, then the file with its includes in place. */
    size_t size, capacity;
    nook_shader_line *lines; /**< Owned; one for each line of the text. */
    uint32_t line_count, line_capacity;
    nook_shader_file *files; /**< Owned; 0 is the defines. */
    uint32_t file_count, file_capacity;
} nook_shader_source;

/**
 * Reads a shader and its includes; paths are looked for under `root`, then under root/shaders.
 * @param defines lines put behind #version
 * @param out_why on failure one line that says why, cut to capacity; nothing is logged
 * @return NOOK_E_NOT_FOUND, NOOK_E_FORMAT, NOOK_E_MEMORY, NOOK_E_IO; *out_source is untouched then
 */
nook_result nook_shader_source_read(const char *root, const char *path, const char *defines,
                                    nook_shader_source *out_source, char *out_why, size_t capacity);
void nook_shader_source_free(nook_shader_source *source);

/**
 * One line of a driver's log with the file's own name and line: "shaders/a.glsl:41: error: ...".
 * Knows the forms of Mesa "0:41(12): error", NVIDIA "0(41) : error" and AMD "ERROR: 0:41:"; others are copied as they are.
 * @param line its end is `length`; cut to capacity
 */
void nook_shader_source_translate(const nook_shader_source *source, const char *line, size_t length, char *out,
                                  size_t capacity);

#ifdef __cplusplus
}
#endif
