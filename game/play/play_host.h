#pragma once
#include "engine/core/result.h"

/**
 * ./nook play in a window: the module "game" and one part for each technique, as they are linked into the program, and what
 * ./nook watch builds of them while they run, in build/<kind>/live or the folder that the environment names in NOOK_LIVE. Ends with
 * the window, or in order on Ctrl-C.
 * @param argv  of the command, which was checked
 * @return why it could not begin or go on
 */
nook_result nook_play_host_run(const char *root, int argc, char **argv);
