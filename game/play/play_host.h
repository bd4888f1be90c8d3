/** play_host.h - the module "game" and one part for each technique, as they are linked into the program, and their host. */
#pragma once
#include "engine/module/host.h"

enum { NOOK_PLAY_NAME_MAX = 64 };

/** A technique that is linked in, as the part of its name. */
typedef struct nook_play_part {
    char name[NOOK_PLAY_NAME_MAX], folder[NOOK_PLAY_NAME_MAX]; /**< "ao_gtao", "modules/ao_gtao/". */
    const char *folders[3];                                    /**< That and what techniques share. */
    nook_module module;
} nook_play_part;

/** It must stay where it was made. */
typedef struct nook_play_host {
    nook_play_part parts[NOOK_MODULE_PARTS_MAX];
    nook_module_builtin builtins[NOOK_MODULE_PARTS_MAX];
    uint32_t part_count;
    nook_module_host *host;
} nook_play_host;

/**
 * Begins a game.
 * @param main_module  nook_play_module, or one like it
 * @param folder       where libraries are built; NULL: nothing is exchanged
 * @return as nook_module_host_create; out_host->host is NULL then
 */
nook_result nook_play_host_create(const nook_module *main_module, const char *folder,
                                  const nook_module_arguments *arguments, nook_play_host *out_host);

/**
 * ./nook play in a window: what ./nook watch builds, in build/<kind>/live or the folder that the environment names in NOOK_LIVE, is
 * exchanged. Ends with the window, or in order on Ctrl-C.
 * @param argv  of the command, which was checked
 * @return why it could not begin or go on
 */
nook_result nook_play_host_run(const char *root, int argc, char **argv);
