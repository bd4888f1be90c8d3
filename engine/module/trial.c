#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/module/host_internal.h"
#include <stdio.h>
#include <stdlib.h>

void nook_module_host_say(nook_module_host *host, const nook_module_reason *reason)
{
    nook_log_at(__FILE__, __LINE__, NOOK_LOG_ERROR, "%s", reason->text);
    snprintf(host->message, sizeof host->message, "%s", reason->text);
    host->refusals++;
}

/* The exchange is over: what ran before, or what was put in its place, is unloaded. */
static void end_exchange(nook_module_host *host)
{
    for (uint32_t i = 0; i < host->slot_count; i++) {
        nook_module_image_close(&host->slots[i].before);
        host->slots[i].swapped = false;
    }
    for (uint32_t i = 0; i + 1 < host->slot_count; i++)
        host->parts[i].other_layout = false;
    free(host->state_before);
    host->state_before = NULL;
    host->main_layout_differs = false;
}

/* ---- it lasts ---- */

static void accept(nook_module_host *host)
{
    static const char *const fates[] = { "state kept", "state migrated", "state made anew" };
    char names[256] = "";
    size_t used = 0;
    host->swap_ms = nook_clock_ms() - host->swap_start_ms;
    for (uint32_t i = 0; i < host->slot_count; i++) {
        if (host->slots[i].swapped && used < sizeof names)
            used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "",
                                     host->slots[i].now.module->name);
    }
    nook_log_info("new code runs: %s (%s, %.0f ms)", names, fates[host->fate], host->swap_ms);
    host->swaps++;
    if (host->slots[0].swapped && host->fate == NOOK_STATE_MADE)
        host->made++;
    else if (host->slots[0].swapped)
        host->kept++;
    end_exchange(host);
}

/* ---- it does not ---- */

/* Whose code the crash was in is refused until it is built again; when nobody knows whose, all that was new. */
static void refuse_suspects(nook_module_host *host, const void *address)
{
    bool found = false;
    for (int pass = 0; pass < 2 && !found; pass++) {
        for (uint32_t i = 0; i < host->slot_count; i++) {
            nook_module_slot *slot = &host->slots[i];
            if (!slot->swapped || (pass == 0 && !(slot->now.library && nook_library_holds(slot->now.library, address))))
                continue;
            slot->refused = slot->now.file;
            host->look_again = found = pass == 0;
        }
    }
}

static void swap_images_back(nook_module_host *host)
{
    for (uint32_t i = 0; i < host->slot_count; i++) {
        nook_module_slot *slot = &host->slots[i];
        if (!slot->swapped)
            continue;
        nook_module_image bad = slot->now;
        slot->now = slot->before;
        slot->before = bad; /* loaded until the state no longer points into it */
        if (i > 0)
            host->parts[i - 1].module = slot->now.module;
    }
}

/* The last resort: the last good code with a state of its own. */
static nook_result start_again(nook_module_host *host)
{
    nook_module_reason reason;
    nook_module_host_drop_state(host);
    nook_log_warning("%s: starts anew", host->slots[0].now.module->name);
    if (!nook_module_host_create_state(host, &reason))
        return nook_fail(NOOK_E_VERSION, "%s; nothing is left that runs", reason.text);
    return NOOK_OK;
}

nook_result nook_module_host_put_back(nook_module_host *host, const nook_module_reason *reason)
{
    nook_module_reason again, said;
    nook_result result = NOOK_OK;
    bool made = host->slots[0].swapped && host->fate == NOOK_STATE_MADE;
    nook_module_refuse(&said, NOOK_OK, "%s; the code before it goes on", reason->text);
    nook_module_host_say(host, &said);
    refuse_suspects(host, reason->address);
    nook_module_host_suspend(host);
    if (made || host->state_before)
        nook_module_host_drop_state(host);
    swap_images_back(host);
    if (!made && !nook_module_host_resume(host, &again)) {
        nook_module_host_say(host, &again);
        made = true;
    }
    if (made)
        result = start_again(host);
    end_exchange(host);
    host->trial = NOOK_TRIAL_OLD;
    return result;
}

nook_result nook_module_host_try_frame(nook_module_host *host, bool *out_running)
{
    nook_module_reason reason;
    nook_module_trial trial = host->trial;
    host->trial = NOOK_TRIAL_NONE;
    if (nook_module_host_guarded_frame(host, out_running, &reason)) {
        if (trial == NOOK_TRIAL_NEW)
            accept(host);
        return NOOK_OK;
    }
    *out_running = true;
    if (trial == NOOK_TRIAL_NEW)
        return nook_module_host_put_back(host, &reason);
    nook_module_host_say(host, &reason); /* the state is broken */
    return start_again(host);
}
