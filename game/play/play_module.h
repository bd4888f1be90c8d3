#pragma once
#include "engine/module/module.h"

/**
 * ./nook play in a window as a module: "game". Its state is a nook_play_window, its arguments the command line, and its parts of
 * kind "ao.technique" lend a nook_ao_technique each.
 */
extern const nook_module nook_play_module;
