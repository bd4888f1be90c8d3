#include "game/extremes/groups.h"
#include "tests/support/test_extremes.h"

int main(void)
{
    return test_extremes_main(&nook_extreme_sampling);
}
