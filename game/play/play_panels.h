#pragma once
#include "game/play/play_window.h"

/** What stands over the picture while one plays: cross, what can be taken, what is to do, time, frames. */
void nook_play_draw_hud(nook_play_window *window, nook_overlay *overlay);
/** The menu of the pause: go on, from the start, preferences, quit. */
void nook_play_draw_menu(nook_play_window *window, nook_overlay *overlay);
/** Keys and buttons. */
void nook_play_draw_help(const nook_play_window *window, nook_overlay *overlay);
