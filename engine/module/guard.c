#define _GNU_SOURCE /* REG_RIP */
#include "engine/module/guard.h"
#include "engine/core/jobs.h"
#include "engine/core/result.h"
#include <assert.h>
#include <setjmp.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <ucontext.h>

static const int signals[] = { SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT };
enum { SIGNALS = sizeof signals / sizeof signals[0], STACK_SIZE = 64 * 1024 };

typedef struct guard {
    sigjmp_buf back;
    nook_crash crash;
    struct sigaction before[SIGNALS];
    stack_t stack_before;
} guard;

/* Where the handler, to which nobody can give an argument, finds the call of its own thread. */
static _Thread_local guard *volatile current;

static const void *address_of(const void *context)
{
    const ucontext_t *machine = context;
#if defined(__x86_64__)
    return (const void *)(uintptr_t)machine->uc_mcontext.gregs[REG_RIP];
#elif defined(__aarch64__)
    return (const void *)(uintptr_t)machine->uc_mcontext.pc;
#else
    (void)machine;
    return NULL;
#endif
}

static void end_call(int number, siginfo_t *info, void *context)
{
    (void)info;
    guard *own = current;
    if (!own) { /* another thread, whose call is not ours to end: it crashes again, to the end */
        signal(number, SIG_DFL);
        return;
    }
    own->crash = (nook_crash){ number, address_of(context) };
    siglongjmp(own->back, 1);
}

/* On a stack of its own: a crash may be that of a stack that is full. */
static void listen(guard *own, const stack_t *stack)
{
    struct sigaction action = { .sa_sigaction = end_call, .sa_flags = SA_SIGINFO | SA_ONSTACK };
    sigemptyset(&action.sa_mask);
    sigaltstack(stack, &own->stack_before);
    for (int i = 0; i < SIGNALS; i++)
        sigaction(signals[i], &action, &own->before[i]);
}

static void listen_no_more(const guard *own)
{
    for (int i = 0; i < SIGNALS; i++)
        sigaction(signals[i], &own->before[i], NULL);
    sigaltstack(&own->stack_before, NULL);
}

nook_crash nook_guard_call(void (*action)(void *user), void *user)
{
    assert(!current && "guarded calls are not nested");
    char memory[STACK_SIZE];
    const stack_t stack = { .ss_sp = memory, .ss_size = sizeof memory };
    guard own = { .crash = { 0 } };
    listen(&own, &stack);
    nook_parallel_inline(1);
    current = &own;
    if (sigsetjmp(own.back, 1) == 0)
        action(user);
    current = NULL;
    nook_parallel_inline(0);
    listen_no_more(&own);
    return own.crash;
}

const char *nook_crash_name(nook_crash crash)
{
    switch (crash.number) {
    case SIGSEGV:
        return "SIGSEGV";
    case SIGBUS:
        return "SIGBUS";
    case SIGFPE:
        return "SIGFPE";
    case SIGILL:
        return "SIGILL";
    case SIGABRT:
        return "SIGABRT";
    default:
        return "no crash";
    }
}
