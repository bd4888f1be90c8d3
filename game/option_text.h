#pragma once
#include "game/option.h"

/** Reads `text` into option->target. @return false when the text is not what the option takes; nothing is stored then */
bool nook_option_store(const nook_option *option, const char *text);

/** What the option takes, completing "give ...": "WxH, each from 1 to 16384". */
void nook_option_describe(const nook_option *option, char *out, size_t capacity);
