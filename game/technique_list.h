/**
 * technique_list.h - the variable behind techniques.h. Each binary defines it once: the program with all techniques, which are linked
 * into it (linked_techniques.c); game.so without any (entry/game_entry.c), so that it holds none of their code: its host
 * lends them to it (play/play_module.c), each from its own library.
 */
#pragma once
#include "modules/ao/technique.h"

enum { NOOK_TECHNIQUES_MAX = 16 /* as an AO context takes */ };

typedef struct nook_technique_list {
    const nook_ao_technique *items[NOOK_TECHNIQUES_MAX]; /**< The first `count`. */
    size_t count;
} nook_technique_list;

#if defined(__GNUC__)
__attribute__((visibility("hidden"))) /* nobody takes the one of the program that loads him */
#endif
extern nook_technique_list nook_listed_techniques;
