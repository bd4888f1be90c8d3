/* A module that counts, and the ways in which one can be wrong. Linked into the test as it stands; its libraries are compiled
   from the same text with some of these defined:
     COUNTER_STEP n, COUNTER_VERSION n, COUNTER_MODULE_VERSION n, COUNTER_GROWN, COUNTER_INNER_GROWN, COUNTER_MIGRATES,
     COUNTER_IN_FRAME statement, COUNTER_IN_CREATE statement, COUNTER_IN_RESUME statement, COUNTER_IN_MIGRATE statement */
#include "engine/core/jobs.h"
#include "engine/module/module.h"
#include "tests/module/counter.h"
#include <stdlib.h>
#include <string.h>

#ifndef COUNTER_STEP
#define COUNTER_STEP 1
#endif
#ifndef COUNTER_VERSION
#define COUNTER_VERSION 1
#endif
#ifndef COUNTER_MODULE_VERSION
#define COUNTER_MODULE_VERSION NOOK_MODULE_VERSION
#endif
#ifndef COUNTER_IN_FRAME
#define COUNTER_IN_FRAME (void)0
#endif
#ifndef COUNTER_IN_CREATE
#define COUNTER_IN_CREATE (void)0
#endif
#ifndef COUNTER_IN_RESUME
#define COUNTER_IN_RESUME (void)0
#endif
#ifndef COUNTER_IN_MIGRATE
#define COUNTER_IN_MIGRATE (void)0
#endif

static nook_result counter_create(void *state, const nook_module_news *news)
{
    counter_state *s = state;
    const counter_arguments *arguments = news->arguments->user;
    COUNTER_IN_CREATE;
    s->heap = calloc(1, sizeof *s->heap);
    if (!s->heap)
        return NOOK_E_MEMORY;
    s->value = arguments->start;
    ++*arguments->alive;
    return NOOK_OK;
}

static nook_result counter_destroy(void *state)
{
    counter_state *s = state;
    free(s->heap);
    s->heap = NULL;
    return NOOK_OK;
}

static int32_t add_parts(const nook_module_news *news, int32_t value)
{
    for (uint32_t i = 0; i < news->part_count; i++) {
        const counter_adder *adder = news->parts[i].module->interface;
        if (news->parts[i].module->kind && strcmp(news->parts[i].module->kind, "test.adder") == 0)
            value = adder->add(value);
    }
    return value;
}

static nook_result counter_frame(void *state, const nook_module_news *news, bool *out_running)
{
    counter_state *s = state;
    COUNTER_IN_FRAME;
    if (!s->heap)
        abort();
    s->value = add_parts(news, s->value + COUNTER_STEP);
    s->heap->frames++;
#ifdef NOOK_SHARED_NOTE
    s->value += (int32_t)counter_note.note - 1;
#endif
    *out_running = s->value < 1000000 && !news->stop_asked;
    return NOOK_OK;
}

static void counter_suspend(void *state)
{
    counter_state *s = state;
    s->suspended++;
}

static nook_result counter_resume(void *state, const nook_module_news *news)
{
    counter_state *s = state;
    (void)news;
    COUNTER_IN_RESUME;
    s->resumed++;
    return NOOK_OK;
}

#ifdef COUNTER_MIGRATES
static nook_result counter_migrate(const void *old, uint32_t old_version, size_t old_size, void *new_state)
{
    counter_state_1 before;
    counter_state *s = new_state;
    COUNTER_IN_MIGRATE;
    if (old_version != 1 || old_size != sizeof before)
        return NOOK_E_VERSION;
    memcpy(&before, old, sizeof before);
    s->value = before.value;
    s->heap = before.heap;
    return NOOK_OK;
}
#endif

static const nook_module counter_module = {
    .version = COUNTER_MODULE_VERSION,
    .name = "counter",
    .state_size = sizeof(counter_state),
    .state_version = COUNTER_VERSION,
    .create = counter_create,
    .destroy = counter_destroy,
    .frame = counter_frame,
    .suspend = counter_suspend,
    .resume = counter_resume,
#ifdef COUNTER_MIGRATES
    .migrate = counter_migrate,
#endif
};
