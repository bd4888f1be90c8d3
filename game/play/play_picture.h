/** play_picture.h - the size of a game's picture: that of the window, as preferences have it, and as its frames come in time. */
#pragma once
#include "game/play/play_window.h"

/**
 * Takes in how long the last frame was. Only frames of a game that goes on and that shows one lit picture count; where techniques are
 * compared, pictures are whole. @param frame_ms  of the last frame @param goes_on  it was drawn and had ticks
 */
void nook_play_picture_learn(nook_play_window *window, double frame_ms, bool goes_on);
/** Gives the stage the size that its picture has now. @return NOOK_E_MEMORY, NOOK_E_DEVICE, NOOK_E_RANGE */
nook_result nook_play_picture_fit(nook_play_window *window);
