#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/module/host_internal.h"
#include <stdio.h>

static const char *const engine_folders[] = { "engine/", NULL };

static const char *name_of(const nook_module_slot *slot)
{
    return slot->builtin->module->name;
}

/* What a module's code knows of types. */
static nook_interface_view view_of(const nook_module_host *host, const nook_module_slot *slot,
                                   const nook_module_image *image)
{
    if (image->interface)
        return (nook_interface_view){ image->interface, NULL, NULL };
    return (nook_interface_view){ host->program, slot->builtin->folders, slot->builtin->without };
}

/* ---- what was built ---- */

static void load_one(nook_module_host *host, nook_module_slot *slot)
{
    const nook_interface_view engine = { host->program, engine_folders, NULL };
    nook_module_reason reason;
    if (nook_module_image_load(&host->folder, name_of(slot), &engine, &reason, &slot->next) == NOOK_OK)
        return;
    char path[NOOK_LIVE_PATH_MAX];
    slot->refused = nook_file_mark_of(nook_live_folder_library(&host->folder, name_of(slot), path));
    nook_module_host_say(host, &reason);
}

/* Loads what differs from what runs. @param again  also what was refused @return how many */
static uint32_t load_new(nook_module_host *host, bool again)
{
    uint32_t loaded = 0;
    for (uint32_t i = 0; i < host->slot_count; i++) {
        nook_module_slot *slot = &host->slots[i];
        char path[NOOK_LIVE_PATH_MAX];
        nook_file_mark mark = nook_file_mark_of(nook_live_folder_library(&host->folder, name_of(slot), path));
        bool new_file = mark.node != 0 && !nook_file_mark_same(mark, slot->now.file);
        bool wanted = again || !nook_file_mark_same(mark, slot->refused);
        if (!slot->next.module && new_file && wanted)
            load_one(host, slot);
        loaded += slot->next.module != NULL;
    }
    return loaded;
}

static const nook_module_image *image_to_be(const nook_module_slot *slot)
{
    return slot->next.module ? &slot->next : &slot->now;
}

/* The main module and each part must lay out alike what they share. @return false: *out_reason names what is not */
static bool fit_together(const nook_module_host *host, nook_module_reason *out_reason)
{
    const nook_module_slot *main_slot = &host->slots[0];
    nook_interface_view main_view = view_of(host, main_slot, image_to_be(main_slot));
    for (uint32_t i = 1; i < host->slot_count; i++) {
        const nook_module_slot *slot = &host->slots[i];
        if (!slot->next.module && !main_slot->next.module)
            continue; /* they have run together */
        nook_interface_view view = view_of(host, slot, image_to_be(slot));
        const char *name = nook_interface_difference(&main_view, &view, NOOK_INTERFACE_PUBLIC_TYPES);
        if (!name)
            continue;
        nook_module_refuse(out_reason, NOOK_E_VERSION,
                           "%s and %s were built from different headers, %s differs; build both", name_of(main_slot),
                           name_of(slot), name);
        return false;
    }
    return true;
}

/* They wait: the next build may bring what they fit to. */
static void unload_all(nook_module_host *host)
{
    for (uint32_t i = 0; i < host->slot_count; i++)
        nook_module_image_close(&host->slots[i].next);
}

/* ---- putting it in place ---- */

static void put_in_place(nook_module_host *host)
{
    for (uint32_t i = 0; i < host->slot_count; i++) {
        nook_module_slot *slot = &host->slots[i];
        if (!slot->next.module)
            continue;
        nook_interface_view before = view_of(host, slot, &slot->now), after = view_of(host, slot, &slot->next);
        const char *other = nook_interface_difference(&before, &after, NOOK_INTERFACE_ALL_TYPES);
        if (other)
            nook_log_info("%s: %s is laid out otherwise than in the code before", name_of(slot), other);
        if (i == 0)
            host->main_layout_differs = other != NULL;
        else
            host->parts[i - 1] = (nook_module_part){ slot->next.module, other != NULL };
        slot->before = slot->now;
        slot->now = slot->next;
        slot->next = (nook_module_image){ .module = NULL };
        slot->swapped = true;
    }
}

static nook_result exchange(nook_module_host *host)
{
    nook_module_reason reason;
    nook_module_host_suspend(host);
    put_in_place(host);
    host->fate = NOOK_STATE_KEPT;
    bool good = !host->slots[0].swapped || nook_module_host_take_state_over(host, &reason);
    if (good && host->fate != NOOK_STATE_MADE)
        good = nook_module_host_resume(host, &reason);
    if (!good)
        return nook_module_host_put_back(host, &reason);
    host->trial = NOOK_TRIAL_NEW;
    return NOOK_OK;
}

/* ---- every frame ---- */

/* @return true: something was built, and well */
static bool was_built(nook_module_host *host)
{
    nook_live_build build;
    if (nook_live_folder_poll(&host->folder, &build)) {
        host->message[0] = '\0';
        if (build.failed)
            snprintf(host->message, sizeof host->message, "the build failed:\n%.*s", NOOK_LIVE_TEXT_MAX - 32,
                     build.text);
        return !build.failed;
    }
    bool again = host->look_again;
    host->look_again = false;
    return again;
}

nook_result nook_module_host_look_for_code(nook_module_host *host)
{
    nook_module_reason reason;
    if (host->folder.path[0] == '\0' || !was_built(host))
        return NOOK_OK;
    host->swap_start_ms = nook_clock_ms();
    if (!host->program && nook_interface_read("/proc/self/exe", &host->program) != NOOK_OK) {
        nook_module_refuse(&reason, NOOK_E_VERSION, "this program does not tell how it was built; its code stays");
        nook_module_host_say(host, &reason);
        host->folder.path[0] = '\0'; /* it never will */
        return NOOK_OK;
    }
    if (load_new(host, false) == 0)
        return NOOK_OK;
    if (!fit_together(host, &reason)) {
        load_new(host, true); /* what was refused may fit to what is new */
        if (!fit_together(host, &reason)) {
            nook_module_host_say(host, &reason);
            unload_all(host);
            return NOOK_OK;
        }
    }
    return exchange(host);
}
