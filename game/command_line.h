#pragma once
#include <stddef.h>

/**
 * The command line as a shell takes it, for the record: "./nook", the command, its arguments, each in single quotes where a shell would
 * read anything in it.
 * @param out  cut to capacity, > 0, and ended @return out
 */
const char *nook_command_line_join(int argc, char **argv, char *out, size_t capacity);
