#include "game/interrupt.h"
#include "engine/core/result.h"
#include <assert.h>
#include <signal.h>
#include <stddef.h>

static const int signals[] = { SIGINT, SIGTERM, SIGHUP };
static struct sigaction before[NOOK_COUNT(signals)];
static volatile sig_atomic_t caught;
static int holders;

static void remember(int number)
{
    caught = number;
}

void nook_interrupt_hold(void)
{
    if (holders++ > 0)
        return;
    struct sigaction action = { .sa_handler = remember, .sa_flags = SA_RESTART };
    sigemptyset(&action.sa_mask);
    caught = 0;
    for (size_t i = 0; i < NOOK_COUNT(signals); i++) {
        sigaction(signals[i], &action, &before[i]);
        if (signals[i] == SIGHUP && before[i].sa_handler == SIG_IGN)
            sigaction(SIGHUP, &before[i], NULL); /* nohup: it shall outlive its terminal */
    }
}

bool nook_interrupt_asked(void)
{
    return caught != 0;
}

void nook_interrupt_answer(void)
{
    caught = 0;
}

void nook_interrupt_release(void)
{
    assert(holders > 0);
    if (--holders > 0)
        return;
    int number = caught;
    caught = 0;
    for (size_t i = 0; i < NOOK_COUNT(signals); i++)
        sigaction(signals[i], &before[i], NULL);
    if (number)
        raise(number);
}
