/* What tests compile into adder_a.so and adder_b.so: ADDER_NAME adds ADDER_STEP. ADDER_CRASHES: by abort(), in the C library;
   ADDER_CRASHES_HERE: in its own code. */
#include "engine/module/module.h"
#include "tests/module/counter.h"
#include <stdlib.h>

#ifndef ADDER_NAME /* for those who look at this file alone */
#define ADDER_NAME "adder_a"
#define ADDER_STEP 1
#endif

static int32_t add(int32_t value)
{
#ifdef ADDER_CRASHES
    abort();
#elif defined ADDER_CRASHES_HERE
    __builtin_trap();
#endif
#ifdef NOOK_SHARED_NOTE
    value += (int32_t)counter_note.note - 1;
#endif
    return value + ADDER_STEP;
}

static const counter_adder adder = { add };
static const nook_module adder_module = {
    .version = NOOK_MODULE_VERSION, .name = ADDER_NAME, .kind = "test.adder", .interface = &adder
};

NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    return &adder_module;
}
