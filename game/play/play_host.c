#include "game/play/play_host.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/module/host.h"
#include "game/interrupt.h"
#include "game/play/play_module.h"
#include "game/techniques.h"
#include <assert.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char *const game_folders[] = { "game/", "modules/", NULL };
static const char *const technique_folders[] = { "modules/ao_", NULL };

static nook_module_builtin describe_technique(const nook_ao_technique *technique, nook_play_part *part)
{
    snprintf(part->name, sizeof part->name, "ao_%s", technique->name);
    snprintf(part->folder, sizeof part->folder, "modules/ao_%s/", technique->name);
    part->folders[0] = part->folder;
    part->folders[1] = "modules/trace/";
    part->module = (nook_module){
        .version = NOOK_MODULE_VERSION, .name = part->name, .kind = NOOK_AO_TECHNIQUE_KIND, .interface = technique
    };
    return (nook_module_builtin){ &part->module, part->folders, NULL };
}

nook_result nook_play_host_create(const nook_module *main_module, const char *folder,
                                  const nook_module_arguments *arguments, nook_play_host *out_host)
{
    size_t count;
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    assert(count <= NOOK_MODULE_PARTS_MAX);
    memset(out_host, 0, sizeof *out_host);
    out_host->part_count = (uint32_t)count;
    for (size_t i = 0; i < count; i++)
        out_host->builtins[i] = describe_technique(techniques[i], &out_host->parts[i]);
    const nook_module_host_desc desc = { .folder = folder,
                                         .main = { main_module, game_folders, technique_folders },
                                         .parts = out_host->builtins,
                                         .part_count = out_host->part_count,
                                         .arguments = *arguments };
    return nook_module_host_create(&desc, &out_host->host);
}

/* NOOK_LIVE, else build/<kind>/live beside the bin/ that the program is in; "" when it is not where ./nook builds it. */
static void find_live_folder(char *out, size_t capacity)
{
    char program[PATH_MAX];
    const char *given = getenv("NOOK_LIVE");
    if (given && *given) {
        snprintf(out, capacity, "%s", given);
        return;
    }
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    char *name = strstr(program, "/bin/nook");
    out[0] = '\0';
    if (!name || strcmp(name, "/bin/nook") != 0)
        return;
    *name = '\0';
    nook_path_join(out, capacity, program, "live");
    if (!nook_directory_exists(out))
        out[0] = '\0';
}

static nook_result run(nook_module_host *host)
{
    nook_result result = NOOK_OK;
    bool running = true;
    nook_interrupt_hold();
    while (result == NOOK_OK && running) {
        if (nook_interrupt_asked())
            nook_module_host_stop(host);
        result = nook_module_host_frame(host, &running);
    }
    if (nook_interrupt_asked())
        nook_interrupt_answer(); /* as if the window had been closed */
    nook_result closed = nook_module_host_destroy(host);
    nook_interrupt_release();
    return result == NOOK_OK ? closed : result;
}

nook_result nook_play_host_run(const char *root, int argc, char **argv)
{
    char folder[PATH_MAX];
    nook_play_host play;
    const nook_module_arguments arguments = { .root = root, .argc = argc, .argv = argv };
    find_live_folder(folder, sizeof folder);
    nook_result result = nook_play_host_create(&nook_play_module, folder[0] ? folder : NULL, &arguments, &play);
    if (result != NOOK_OK)
        return result;
    if (folder[0])
        nook_log_info("play: code that ./nook watch builds is taken over from %s", folder);
    return run(play.host);
}
