/**
 * line_reader.h - small text files of lines: comments from # to the end of the line, blanks around what stands there, name = value.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>

enum { NOOK_LINE_CAPACITY = 1024, NOOK_LINE_WHERE_SIZE = 4096 + 32 };

/** What parts words of a line. */
#define NOOK_LINE_BLANKS " \t\r"

/** A text being read. Set the first five, zero the rest, but for `verbatim`, which may be set between two lines. */
typedef struct nook_line_reader {
    const char *file; /**< For messages. */
    const char *text;
    size_t size;
    size_t longest;      /**< Bytes of a line without its comment; below NOOK_LINE_CAPACITY. */
    const char *refusal; /**< What is said of a longer one and of one with a zero byte. */
    bool verbatim;       /**< A # only begins a comment where a line begins: for lines that end in a path. */
    size_t at;           /**< Where the next line begins. */
    unsigned line;       /**< Number of the last line read, from 1. */
    char where[NOOK_LINE_WHERE_SIZE]; /**< "file:line" of it. */
    char buffer[NOOK_LINE_CAPACITY];
} nook_line_reader;

/**
 * Goes to the next line that holds something.
 * @param out_line  without comment and blanks around it, in the reader's buffer, to be changed as one likes; NULL at the end
 * @return NOOK_E_FORMAT
 */
nook_result nook_line_next(nook_line_reader *reader, char **out_line);

/** Parts "name = value" in place. @return false when a side is empty, or the name two words */
bool nook_line_split(char *line, char **out_name, char **out_value);
