#pragma once
#include "game/play/play_window.h"

/** Starts to watch what may change on disk while one plays; what cannot be watched is a warning each. */
void nook_play_watch(nook_play_window *window);
/** Once a frame, before anything of it is drawn: takes over what was saved, and shows what of it is wrong. */
void nook_play_take_changes(nook_play_window *window);
void nook_play_unwatch(nook_play_window *window);
