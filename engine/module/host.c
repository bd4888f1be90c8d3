#include "engine/module/host.h"
#include "engine/core/log.h"
#include "engine/module/host_internal.h"
#include <assert.h>
#include <stdlib.h>

/* A library that stands there already is at most as new as the program: it counts as what runs. */
static void add_slot(nook_module_host *host, const nook_module_builtin *builtin)
{
    char path[NOOK_LIVE_PATH_MAX];
    nook_module_slot *slot = &host->slots[host->slot_count++];
    assert(builtin->module->version == NOOK_MODULE_VERSION);
    slot->builtin = builtin;
    slot->now.module = builtin->module;
    if (host->folder.path[0])
        slot->now.file = nook_file_mark_of(nook_live_folder_library(&host->folder, builtin->module->name, path));
}

nook_result nook_module_host_create(const nook_module_host_desc *desc, nook_module_host **out_host)
{
    *out_host = NULL;
    assert(desc->part_count <= NOOK_MODULE_PARTS_MAX);
    nook_module_host *host = calloc(1, sizeof *host);
    if (!host)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its host", desc->main.module->name);
    host->main = desc->main;
    host->arguments = desc->arguments;
    if (desc->folder)
        nook_live_folder_open(&host->folder, desc->folder);
    add_slot(host, &host->main);
    for (uint32_t i = 0; i < desc->part_count; i++) {
        add_slot(host, &desc->parts[i]);
        host->parts[i] = (nook_module_part){ desc->parts[i].module, false };
    }
    const nook_module *module = desc->main.module;
    nook_module_news news = nook_module_host_news(host);
    host->state = calloc(1, module->state_size ? module->state_size : 1);
    nook_result result = host->state ? module->create(host->state, &news)
                                     : nook_fail(NOOK_E_MEMORY, "%s: no memory for its state", module->name);
    if (result == NOOK_OK) {
        *out_host = host;
        return NOOK_OK;
    }
    free(host->state);
    free(host);
    return result;
}

nook_result nook_module_host_destroy(nook_module_host *host)
{
    nook_result result = NOOK_OK;
    if (!host)
        return result;
    if (host->state) {
        const nook_module *module = host->slots[0].now.module;
        if (module->suspend)
            module->suspend(host->state);
        result = module->destroy(host->state);
        free(host->state);
    }
    free(host->state_before);
    for (uint32_t i = 0; i < host->slot_count; i++) {
        nook_module_image_close(&host->slots[i].now);
        nook_module_image_close(&host->slots[i].before);
    }
    nook_interface_free(host->program);
    free(host);
    return result;
}

void nook_module_host_stop(nook_module_host *host)
{
    host->stop_asked = true;
}

nook_result nook_module_host_frame(nook_module_host *host, bool *out_running)
{
    *out_running = true;
    nook_result result = host->trial == NOOK_TRIAL_NONE ? nook_module_host_look_for_code(host) : NOOK_OK;
    if (result != NOOK_OK)
        return result;
    assert(host->state && "after a failure the host is destroyed");
    if (host->trial != NOOK_TRIAL_NONE)
        return nook_module_host_try_frame(host, out_running);
    nook_module_news news = nook_module_host_news(host);
    return host->slots[0].now.module->frame(host->state, &news, out_running);
}

nook_module_host_view nook_module_host_look(const nook_module_host *host)
{
    return (nook_module_host_view){ .message = host->message,
                                    .swaps = host->swaps,
                                    .refusals = host->refusals,
                                    .kept = host->kept,
                                    .made = host->made,
                                    .swap_ms = host->swap_ms,
                                    .state = host->state,
                                    .main_path = host->slots[0].now.path };
}
