// Include right before a params.def inside a uniform block: the same numbers as in C (engine/core/param_block.inl).
#define NOOK_FLOAT(name, initial, lowest, highest, unit, help) float name;
#define NOOK_INT(name, initial, lowest, highest, unit, help) int name;
#define NOOK_CHOICE(name, initial, highest, choices, help) int name;
