#include "game/verify/verdict.h"
#include <math.h>

nook_verdict nook_verify_judge(const nook_verify_check *check)
{
    if (!(fabs(check->missing) <= NOOK_VERIFY_MISSING_MAX))
        return NOOK_VERDICT_UNSEEN;
    if (!check->claimed)
        return NOOK_VERDICT_NOT_CLAIMED;
    return fabs(check->measured - check->expected) <= check->tolerance ? NOOK_VERDICT_OK : NOOK_VERDICT_OFF;
}

const char *nook_verdict_name(nook_verdict verdict)
{
    static const char *const names[] = { "ok", "off", "unseen", "not claimed" };
    return names[verdict];
}
