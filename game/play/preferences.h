#pragma once
#include "engine/core/param.h"
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define NOOK_PARAM_STRUCT nook_preferences
#define NOOK_PARAM_TABLE nook_preferences_table
#define NOOK_PARAM_FILE "game/play/preferences.def"
#include "engine/core/param_block.inl"

void nook_preferences_reset(nook_preferences *out);
/**
 * Reads "name = value" lines over the initial values. What cannot be read of it is one warning each, with file and line, and stays as
 * it comes: a damaged file of likings must not keep anyone from playing. No file at all is no warning.
 */
void nook_preferences_read(const char *path, nook_preferences *out);
/** Whole or not at all; what cannot be kept is one warning, and no failure of the game. @return whether they were kept */
bool nook_preferences_write(const char *path, const nook_preferences *preferences);
