/**
 * nrrd_internal.h - the three steps of reading NRRD, for scalar_volume.c: header, where the data are, decoding.
 *
 * Own code rather than teem's: that follows data files anywhere, keeps its errors globally, leaks on damaged data, and refuses
 * headers in use (space directions without a space).
 */
#pragma once
#include "engine/asset/scalar_volume.h"
#include "engine/asset/scene.h"
#include <stdbool.h>

typedef enum nook_nrrd_encoding {
    NOOK_NRRD_RAW,
    NOOK_NRRD_TEXT,
    NOOK_NRRD_HEX,
    NOOK_NRRD_GZIP,
    NOOK_NRRD_BZIP2,
    NOOK_NRRD_ENCODING_COUNT
} nook_nrrd_encoding;

enum { NOOK_NRRD_DIMENSION_MAX = 4, NOOK_NRRD_VALUE_CAPACITY = 1024 };

typedef struct nook_nrrd_header {
    nook_sample_type type;
    nook_nrrd_encoding encoding;
    bool swapped;                             /**< Samples are in the other byte order than this machine's. */
    uint32_t dimension;                       /**< [1, 4] */
    uint32_t sizes[NOOK_NRRD_DIMENSION_MAX];  /**< Each > 0. */
    double spacing[NOOK_NRRD_DIMENSION_MAX];  /**< Each finite, > 0; 1 where not known. */
    uint64_t data_bytes;                      /**< All samples, decoded; at most NOOK_SCALAR_BYTES_MAX. */
    int64_t line_skip, byte_skip;             /**< At the start of each data file; byte_skip -1: the last bytes. */
    bool detached;                            /**< The data are in other files: */
    char data_file[NOOK_NRRD_VALUE_CAPACITY]; /**< A name, "pattern first last step" or "LIST"; not checked yet. */
    size_t rest; /**< Where the header's file goes on behind the header: with the data, or with the list of names. */
} nook_nrrd_header;

/**
 * @param name   used in messages only
 * @param scene  keeps warnings; NULL: they are logged only
 * @return NOOK_E_FORMAT, NOOK_E_MEMORY; *out_header is untouched on failure
 */
nook_result nook_nrrd_header_read(const char *name, nook_scene *scene, const uint8_t *bytes, size_t size,
                                  nook_nrrd_header *out_header);

/** Takes one line off [*at, end), without its end, which may be \n or \r\n. @return false when nothing is left */
bool nook_nrrd_next_line(const char **at, const char *end, const char **out_line, size_t *out_length);
/** Copies a text with its outer blanks cut off. @return false when it is too long or holds a NUL */
bool nook_nrrd_copy_trimmed(const char *text, size_t length, char *out, size_t capacity);
/** Reads a whole decimal number and moves on behind it and the blanks that follow. */
bool nook_nrrd_take_number(const char **text, int64_t *out);

/** Paths of data files, in the order of their samples. */
typedef struct nook_nrrd_files {
    char **paths;
    size_t count;
} nook_nrrd_files;

/**
 * Finds the data files of a detached header. Only regular files at or below the header's folder are accepted.
 * @param name   used in messages only
 * @param path   the header's file
 * @param bytes  the header's file, for a list of names behind the header
 * @return NOOK_E_FORMAT, NOOK_E_NOT_FOUND, NOOK_E_MEMORY; *out_files is untouched on failure
 */
nook_result nook_nrrd_files_find(const char *name, const char *path, const nook_nrrd_header *header,
                                 const uint8_t *bytes, size_t size, nook_nrrd_files *out_files);
void nook_nrrd_files_free(nook_nrrd_files *files);

/** Who asks for a scalar volume. All zero: nobody that messages name. */
typedef struct nook_nrrd_owner {
    const char *
        name; /**< Stands before a file's name in messages: "room.gltf: nodes[1].extras.nook_density". NULL: nothing does. */
    nook_scene *scene; /**< Keeps warnings; NULL: they are logged only. */
} nook_nrrd_owner;

/**
 * nook_scalar_volume_load, and which data files it read besides `path`.
 * @param out_files  none of an attached header; yours to free, also where this fails
 */
nook_result nook_scalar_volume_load_files(const char *path, const nook_nrrd_owner *owner,
                                          nook_scalar_volume *out_volume, nook_nrrd_files *out_files);

/**
 * Decodes what one data file stores, skips included, into exactly out_size bytes in this machine's byte order. Never reads or
 * makes more than it must: a stream that inflates to more is stopped there.
 * @param name    used in messages only
 * @param scene   keeps warnings; NULL: they are logged only
 * @param stored  followed by a zero byte that stored_size does not count
 * @return NOOK_E_FORMAT cut short or damaged; NOOK_E_MEMORY; `out` then holds anything
 */
nook_result nook_nrrd_decode(const char *name, nook_scene *scene, const nook_nrrd_header *header, const uint8_t *stored,
                             size_t stored_size, uint8_t *out, size_t out_size);
/** The most bytes that `stored_size` bytes can decode to: for refusing absurd sizes before memory is taken. */
uint64_t nook_nrrd_most_decoded(const nook_nrrd_header *header, uint64_t stored_size);
