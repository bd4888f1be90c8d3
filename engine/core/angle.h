#pragma once

/** Half a turn, radians: C11 has no name for it. */
#define NOOK_PI 3.14159265358979323846
/** Radians of a degree. */
#define NOOK_DEGREE (NOOK_PI / 180.0)
