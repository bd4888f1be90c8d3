/* What tests compile into counter.so. */
#include "tests/module/counter.inl"

#ifdef COUNTER_OTHER_TYPE /* as if engine/core/file.h had been another one */
struct nook_file {
    long one_more;
    char *bytes;
};
static struct nook_file made_otherwise;
#define COUNTER_USES (void)made_otherwise.one_more
#elif defined COUNTER_OTHER_FUNCTION /* as if engine/core/clock.h had been another one */
double nook_clock_ms(int since);
#define COUNTER_USES (void)nook_clock_ms(1)
#elif defined COUNTER_LACKS
void nook_function_that_nobody_has(void);
#define COUNTER_USES nook_function_that_nobody_has()
#else
#define COUNTER_USES (void)0
#endif

#ifndef COUNTER_NO_ENTRY
NOOK_MODULE_EXPORT const nook_module *nook_module_entry(void);
const nook_module *nook_module_entry(void)
{
    COUNTER_USES;
    return &counter_module;
}
#else
const void *const counter_kept = &counter_module;
#endif
