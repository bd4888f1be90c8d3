#include "engine/core/log.h"
#include "engine/module/host_internal.h"
#include <stdio.h>
#include <stdlib.h>

static const nook_module *main_module(const nook_module_host *host)
{
    return host->slots[0].now.module;
}

nook_module_news nook_module_host_news(const nook_module_host *host)
{
    return (nook_module_news){ .arguments = &host->arguments,
                               .parts = host->parts,
                               .part_count = host->slot_count - 1,
                               .message = host->message,
                               .swaps = host->swaps,
                               .stop_asked = host->stop_asked };
}

/* ---- calls that may crash or fail ---- */

typedef struct guarded {
    nook_module_host *host;
    nook_result (*call)(struct guarded *guarded);
    nook_result result;
    bool running; /* of a frame */
} guarded;

static void run_guarded(void *user)
{
    guarded *call = user;
    call->result = call->call(call);
}

/* The names of what is new: one of them is to blame. Without anything new, the main module. */
static void name_suspects(const nook_module_host *host, const void *address, char *out, size_t capacity)
{
    size_t used = 0;
    out[0] = '\0';
    for (uint32_t i = 0; i < host->slot_count && used < capacity; i++) {
        const nook_module_slot *slot = &host->slots[i];
        if (slot->swapped && slot->now.library && nook_library_holds(slot->now.library, address)) {
            snprintf(out, capacity, "%s", slot->now.module->name);
            return;
        }
        if (slot->swapped)
            used += (size_t)snprintf(out + used, capacity - used, "%s%s", used ? ", " : "", slot->now.module->name);
    }
    if (used == 0)
        snprintf(out, capacity, "%s", main_module(host)->name);
}

/* @param what  completes "crashed in" */
static bool survives(guarded *call, const char *what, nook_module_reason *out_reason)
{
    char suspects[256];
    nook_crash crash = nook_guard_call(run_guarded, call);
    if (crash.number != 0)
        nook_log_keep_errors(NULL, 0); /* into what may have been on the stack of the call */
    name_suspects(call->host, crash.address, suspects, sizeof suspects);
    if (crash.number != 0) {
        nook_module_refuse(out_reason, NOOK_E_FORMAT, "%s: crashed in %s (%s)", suspects, what, nook_crash_name(crash));
        out_reason->address = crash.address;
        return false;
    }
    if (call->result != NOOK_OK)
        nook_module_refuse(out_reason, call->result, "%s: %s failed, with result %d; the lines before say why",
                           suspects, what, (int)call->result);
    return call->result == NOOK_OK;
}

static nook_result call_create(guarded *call)
{
    nook_module_news news = nook_module_host_news(call->host);
    return main_module(call->host)->create(call->host->state, &news);
}

static nook_result call_destroy(guarded *call)
{
    return main_module(call->host)->destroy(call->host->state);
}

static nook_result call_suspend(guarded *call)
{
    main_module(call->host)->suspend(call->host->state);
    return NOOK_OK;
}

static nook_result call_resume(guarded *call)
{
    nook_module_news news = nook_module_host_news(call->host);
    return main_module(call->host)->resume(call->host->state, &news);
}

static nook_result call_migrate(guarded *call)
{
    const nook_module *old = call->host->slots[0].before.module;
    return main_module(call->host)
        ->migrate(call->host->state_before, old->state_version, old->state_size, call->host->state);
}

static nook_result call_frame(guarded *call)
{
    nook_module_news news = nook_module_host_news(call->host);
    return main_module(call->host)->frame(call->host->state, &news, &call->running);
}

/* ---- the state ---- */

static void *allocate_state(const nook_module *module)
{
    return calloc(1, module->state_size ? module->state_size : 1);
}

bool nook_module_host_create_state(nook_module_host *host, nook_module_reason *out_reason)
{
    guarded call = { .host = host, .call = call_create };
    host->state = allocate_state(main_module(host));
    if (!host->state) {
        nook_module_refuse(out_reason, NOOK_E_MEMORY, "%s: no memory for its state", main_module(host)->name);
        return false;
    }
    if (survives(&call, "its create", out_reason))
        return true;
    free(host->state);
    host->state = NULL;
    return false;
}

void nook_module_host_drop_state(nook_module_host *host)
{
    guarded call = { .host = host, .call = call_destroy };
    nook_module_reason reason;
    if (host->state && host->state_before) { /* migrated: what it points to belongs to both */
        free(host->state);
        host->state = host->state_before;
        host->state_before = NULL;
        return;
    }
    if (host->state && !survives(&call, "its destroy", &reason))
        nook_log_warning("%s; what it had is lost", reason.text);
    free(host->state);
    host->state = NULL;
}

/* @return false: neither kept nor migrated; the state is as it was */
static bool migrate(nook_module_host *host)
{
    const nook_module *old = host->slots[0].before.module, *module = main_module(host);
    guarded call = { .host = host, .call = call_migrate };
    nook_module_reason reason;
    if (old->state_version == module->state_version || !module->migrate)
        return false;
    void *state = allocate_state(module);
    if (!state)
        return false;
    host->state_before = host->state;
    host->state = state;
    if (survives(&call, "its migrate", &reason))
        return true;
    nook_log_warning("%s; its state is made anew", reason.text);
    host->state = host->state_before;
    host->state_before = NULL;
    free(state);
    return false;
}

bool nook_module_host_take_state_over(nook_module_host *host, nook_module_reason *out_reason)
{
    const nook_module *old = host->slots[0].before.module, *module = main_module(host);
    bool same = old->state_version == module->state_version && old->state_size == module->state_size;
    host->fate = NOOK_STATE_KEPT;
    if (same && !host->main_layout_differs)
        return true;
    host->fate = NOOK_STATE_MIGRATED;
    if (migrate(host))
        return true;
    host->fate = NOOK_STATE_MADE;
    if (old->destroy(host->state) != NOOK_OK)
        nook_log_warning("%s: not all of its old state was written; the lines before say why", old->name);
    free(host->state);
    host->state = NULL;
    return nook_module_host_create_state(host, out_reason);
}

void nook_module_host_suspend(nook_module_host *host)
{
    guarded call = { .host = host, .call = call_suspend };
    nook_module_reason reason;
    if (host->state && main_module(host)->suspend && !survives(&call, "its suspend", &reason))
        nook_log_warning("%s", reason.text);
}

bool nook_module_host_resume(nook_module_host *host, nook_module_reason *out_reason)
{
    guarded call = { .host = host, .call = call_resume };
    return !main_module(host)->resume || survives(&call, "its resume", out_reason);
}

bool nook_module_host_guarded_frame(nook_module_host *host, bool *out_running, nook_module_reason *out_reason)
{
    guarded call = { .host = host, .call = call_frame, .running = true };
    bool survived = survives(&call, "its first frame", out_reason);
    *out_running = survived ? call.running : true;
    return survived;
}
