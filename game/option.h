#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** Exit codes of every command. */
enum {
    NOOK_EXIT_OK = 0,
    NOOK_EXIT_FAILED = 1, /**< The job could not be done; one line on standard error says why. */
    NOOK_EXIT_USAGE = 2   /**< The command line was wrong; nothing was done. */
};

/** What the text after an option must be, and the type that nook_option.target points to. */
typedef enum nook_option_kind {
    NOOK_OPTION_FLAG,   /**< bool: no text follows; becomes true. */
    NOOK_OPTION_TEXT,   /**< const char *: any text that is not empty. Points into argv. */
    NOOK_OPTION_INT,    /**< int32_t: a whole number in [lowest, highest]. */
    NOOK_OPTION_NUMBER, /**< double: a finite number in [lowest, highest]. */
    NOOK_OPTION_SIZE,   /**< nook_option_size: WxH, each in [lowest, highest]. */
    NOOK_OPTION_CHOICE, /**< int32_t: one of `choices`; becomes its index. */
    NOOK_OPTION_LIST,   /**< nook_option_list: may be given many times; each adds one text. */
    NOOK_OPTION_CUSTOM  /**< Anything: `read` decides. */
} nook_option_kind;

/** Pixels. */
typedef struct nook_option_size {
    int32_t width, height;
} nook_option_size;

enum { NOOK_OPTION_LIST_MAX = 64, NOOK_POSITIONAL_MAX = 8 };

/** Texts of a repeated option, in order of appearance; they point into argv. */
typedef struct nook_option_list {
    const char *items[NOOK_OPTION_LIST_MAX];
    size_t count;
} nook_option_list;

/** One row of a command's table of options. What is not given on the command line leaves *target as it is. */
typedef struct nook_option {
    const char *name; /**< Without dashes: "size" is --size. */
    nook_option_kind kind;
    void *target;            /**< Type by kind. */
    const char *placeholder; /**< "WxH", shown in help; NULL for flags. */
    const char *help;        /**< One line. State the default here. */
    double lowest, highest;  /**< Inclusive; for INT, NUMBER and SIZE. highest 0 with lowest 0 means unbounded. */
    const char *choices;     /**< CHOICE: "first|second|...". */
    /** CUSTOM: reads `text` into `target`. @return false when the text is wrong (nothing is changed then) */
    bool (*read)(void *target, const char *text);
    const char *expects; /**< CUSTOM: completes "--camera x: give ...". */
} nook_option;

/** The command line of one command: what --help prints and what nook_options_parse accepts. */
typedef struct nook_usage {
    const char *command;     /**< "compare" */
    const char *summary;     /**< A sentence or more. */
    const char *positionals; /**< "[SCENE]", "FILE"; NULL when the command takes none. */
    int positional_min, positional_max;
    const nook_option *options;
    size_t option_count;
    const char *details; /**< Printed after the options, lines ended by newlines; NULL for nothing. */
} nook_usage;

/** What was read besides the options. */
typedef struct nook_arguments {
    const char *positionals[NOOK_POSITIONAL_MAX]; /**< Point into argv; NULL from positional_count on. */
    int positional_count;
    char message[512]; /**< The line to print when the result is NOOK_PARSE_WRONG, else "". */
} nook_arguments;

typedef enum nook_parse {
    NOOK_PARSE_RUN,  /**< Everything was understood. */
    NOOK_PARSE_HELP, /**< --help or -h stands somewhere. */
    NOOK_PARSE_WRONG /**< See message. Options before the wrong one are already stored. */
} nook_parse;

/**
 * Reads argv[1] on; argv[0] is ignored. Accepts --name value, --name=value, and `--` before positionals that start with '-'.
 * Prints nothing.
 */
nook_parse nook_options_parse(const nook_usage *usage, int argc, char **argv, nook_arguments *out);

/** Prints what --help prints. */
void nook_options_print_help(const nook_usage *usage, FILE *stream);

/**
 * nook_options_parse and what follows from it: prints help to standard output, or the error to standard error.
 * @return true: go on. false: return *out_exit_code from the command.
 */
bool nook_arguments_read(const nook_usage *usage, int argc, char **argv, nook_arguments *out, int *out_exit_code);

/** Reads a whole text as a finite number. @return false (nothing stored) on trailing text, overflow, inf, nan or "" */
bool nook_text_to_number(const char *text, double *out);
/** Reads a whole text as a whole decimal number that fits int32_t. @return false on anything else */
bool nook_text_to_int(const char *text, int32_t *out);
