/* Turns NOOK_PARAM_FILE, a params.def, into struct NOOK_PARAM_STRUCT and the table NOOK_PARAM_TABLE[].
   Only 4-byte scalars, so the C layout and the GLSL std140 layout of consecutive scalars are the same.
   A params.def holds rows of
       NOOK_FLOAT(name, initial, lowest, highest, unit, help)
       NOOK_INT(name, initial, lowest, highest, unit, help)
       NOOK_CHOICE(name, initial index, highest index, choices, help)
   where help and choices are bare words (GLSL has no strings): choices as NOOK_OR2(a, b) .. NOOK_OR6(a, b, c, d, e, f). */
#ifndef NOOK_PARAM_TABLE
#define NOOK_PARAM_TABLE param_table
#endif

typedef struct NOOK_PARAM_STRUCT {
#define NOOK_FLOAT(name, initial, lowest, highest, unit, help) float name;
#define NOOK_INT(name, initial, lowest, highest, unit, help) int32_t name;
#define NOOK_CHOICE(name, initial, highest, choices, help) int32_t name;
#include NOOK_PARAM_FILE
#undef NOOK_FLOAT
#undef NOOK_INT
#undef NOOK_CHOICE
} NOOK_PARAM_STRUCT;

#define NOOK_OR2(a, b) #a "|" #b
#define NOOK_OR3(a, b, c) #a "|" #b "|" #c
#define NOOK_OR4(a, b, c, d) #a "|" #b "|" #c "|" #d
#define NOOK_OR5(a, b, c, d, e) #a "|" #b "|" #c "|" #d "|" #e
#define NOOK_OR6(a, b, c, d, e, f) #a "|" #b "|" #c "|" #d "|" #e "|" #f

static const nook_param NOOK_PARAM_TABLE[] = {
#define NOOK_FLOAT(name, initial, lowest, highest, unit, help) \
    { #name, NOOK_PARAM_FLOAT, unit, offsetof(NOOK_PARAM_STRUCT, name), initial, lowest, highest, NULL, #help },
#define NOOK_INT(name, initial, lowest, highest, unit, help) \
    { #name, NOOK_PARAM_INT, unit, offsetof(NOOK_PARAM_STRUCT, name), initial, lowest, highest, NULL, #help },
#define NOOK_CHOICE(name, initial, highest, choices, help) \
    { #name, NOOK_PARAM_CHOICE, NOOK_UNIT_NONE, offsetof(NOOK_PARAM_STRUCT, name), initial, 0, highest, choices, #help },
#include NOOK_PARAM_FILE
#undef NOOK_FLOAT
#undef NOOK_INT
#undef NOOK_CHOICE
};
#undef NOOK_OR2
#undef NOOK_OR3
#undef NOOK_OR4
#undef NOOK_OR5
#undef NOOK_OR6
#undef NOOK_PARAM_STRUCT
#undef NOOK_PARAM_FILE
#undef NOOK_PARAM_TABLE
