#include "game/verify/verdict.h"
#include <math.h>

double nook_verify_spread_max(double tolerance, double expected, double samples)
{
    double noise = samples > 0.0 ? expected * (1.0 - expected) / samples : 0.0;
    return sqrt(tolerance * tolerance + noise);
}

nook_verdict nook_verify_judge(const nook_verify_check *check)
{
    if (!(fabs(check->missing) <= NOOK_VERIFY_MISSING_MAX))
        return NOOK_VERDICT_UNSEEN;
    if (!(check->unresolved <= NOOK_VERIFY_UNRESOLVED_MAX))
        return NOOK_VERDICT_UNRESOLVED;
    if (!check->claimed)
        return NOOK_VERDICT_NOT_CLAIMED;
    bool near = fabs(check->measured - check->expected) <= check->tolerance, even = check->spread <= check->spread_max;
    return near && even ? NOOK_VERDICT_OK : NOOK_VERDICT_OFF;
}

bool nook_verify_is_checked(nook_verdict verdict)
{
    return verdict == NOOK_VERDICT_OK || verdict == NOOK_VERDICT_OFF;
}

const char *nook_verdict_name(nook_verdict verdict)
{
    static const char *const names[] = { "ok", "off", "unseen", "unresolved", "not claimed" };
    return names[verdict];
}
