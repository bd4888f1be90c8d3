#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/** A whole file in memory. `bytes` is followed by one zero byte that `size` does not count. */
typedef struct nook_file {
    uint8_t *bytes; /**< Owned; release with nook_file_free. */
    size_t size;    /**< Bytes. */
} nook_file;

/**
 * Reads a regular file whole.
 * @return NOOK_E_NOT_FOUND no such path; NOOK_E_IO a directory, device or unreadable; NOOK_E_MEMORY larger than 4 GiB or
 *         than memory. *out_file is untouched on failure.
 */
nook_result nook_file_read(const char *path, nook_file *out_file);
/** The same without a line in the log: on failure `out_why` holds it, cut to capacity. */
nook_result nook_file_try_read(const char *path, nook_file *out_file, char *out_why, size_t capacity);
void nook_file_free(nook_file *file); /**< NULL and zeroed files are allowed. */

/**
 * Writes a whole file: to a temporary name beside it, then renamed over `path`, or over what that links to. Nothing is left half
 * written. Devices and pipes are refused: they would be gone.
 * @return NOOK_E_IO; then `path` is as it was before.
 */
nook_result nook_file_write(const char *path, const void *bytes, size_t size);
/** The same without a line in the log, for what may fail. @return 0, or the errno that says why not */
int nook_file_try_write(const char *path, const void *bytes, size_t size);

/** Prints a text. @return as it likes, logged */
typedef nook_result (*nook_file_print)(const void *user, FILE *stream);
/**
 * Writes what is printed, as nook_file_write does. Printing into memory first (open_memstream) would not do: glibc's does not tell when
 * it has run out of it, and a text that broke off would take the file's place.
 * @return what `print` returns; NOOK_E_IO. `path` is as it was before then
 */
nook_result nook_file_write_text(const char *path, nook_file_print print, const void *user);

/** Copies a file, as nook_file_read and nook_file_write do. @return as these */
nook_result nook_file_copy(const char *from, const char *to);

/**
 * Whether a file of that name can be written, for who would else find out after hours of work: writes one beside it and removes it.
 * @return NOOK_E_IO no, and why
 */
nook_result nook_file_probe(const char *path);

bool nook_file_exists(const char *path); /**< A regular file. */
bool nook_directory_exists(const char *path);
/** Makes a directory and its parents. @return NOOK_E_IO */
nook_result nook_directory_make(const char *path);
/** The same without a line in the log, for what may fail. @return 0, or the errno that says why not */
int nook_directory_try_make(const char *path);

/** Joins with one '/'; cuts to capacity. @return out */
char *nook_path_join(char *out, size_t capacity, const char *folder, const char *name);
/** The part after the last '/'. Points into `path`. */
const char *nook_path_name(const char *path);
/** The extension with its dot, lower or upper case as written; "" when there is none. Points into `path`. */
const char *nook_path_extension(const char *path);

#ifdef __cplusplus
}
#endif
