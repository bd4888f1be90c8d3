#pragma once
#include <stdio.h>

/**
 * Prints every parameter that --param takes, one a line: name, initial value, range or choices, unit, help. Those that all
 * techniques share (ao.*) first. The tables are those made from params.def.
 */
void nook_compare_list_params(FILE *stream);
