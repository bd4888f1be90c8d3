#pragma once
#include "engine/core/result.h"
#include "game/compare/options.h"
#include "modules/ao/technique.h"

enum { NOOK_COMPARE_TECHNIQUES_MAX = 16 };

/** Which techniques a comparison runs: the exact one first, then those of a list. */
typedef struct nook_compare_choice {
    const nook_ao_technique *techniques[NOOK_COMPARE_TECHNIQUES_MAX];
    uint32_t count;
} nook_compare_choice;

/** @param list  "volume,ssao"; NULL: all @return NOOK_E_NOT_FOUND an unknown name (the line lists them) */
nook_result nook_compare_choose(const char *list, nook_compare_choice *out_choice);

/**
 * Checks a parameter without setting it anywhere.
 * @param name   "technique.name", length bytes of it; technique ao: those that all share
 * @param value  a number, or a choice's name
 * @return NOOK_E_NOT_FOUND no such technique or parameter, NOOK_E_ARG, NOOK_E_RANGE; one line says what is right
 */
nook_result nook_compare_check_param(const char *name, size_t length, const char *value);

/** Checks all of the options that needs neither scene nor device. @return why not; *out_choice is untouched then */
nook_result nook_compare_options_check(const nook_compare_options *options, nook_compare_choice *out_choice);

/**
 * Reads the settings file, where one is given, and takes from it what the command line leaves open: technique, resolution, r_max
 * and falloff. Its other parameters are options->file's.
 * @return why the file cannot be read; both are untouched then
 */
nook_result nook_compare_options_settle(nook_compare_options *options, nook_compare_choice *choice);
