#pragma once
#include <stdbool.h>

/** Calls `misuse` in a child process. @return true when it ended in abort(), as a failed assert does */
bool nook_aborts(void (*misuse)(void));
