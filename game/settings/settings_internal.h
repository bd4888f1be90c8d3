/** settings_internal.h - what the files of game/settings share. */
#pragma once
#include "game/settings/settings_file.h"
#include <stdio.h>

/** One "name = value" a line, technique first; what is as it comes is left out, as nook_settings_file_write says. */
void settings_print(const nook_settings_file *file, FILE *stream);
