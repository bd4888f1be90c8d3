#include "game/play/soak_code.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/play/play_module.h"
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static nook_result create(void *state, const nook_module_news *news)
{
    return nook_play_window_open(news->arguments->root, news->arguments->user, state);
}

/* The folder of the program, when game.so is in it too. */
static void find_built(char out[1024])
{
    char program[900], path[1024];
    ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    out[0] = '\0';
    char *name = strrchr(program, '/');
    if (!name)
        return;
    *name = '\0';
    if (nook_file_exists(nook_path_join(path, sizeof path, program, "game.so")))
        snprintf(out, 1024, "%s", program);
}

nook_result nook_soak_code_open(const char *root, nook_play_window_desc *how, nook_soak_code *out_code)
{
    const nook_module_arguments arguments = { .root = root, .user = how };
    memset(out_code, 0, sizeof *out_code);
    out_code->main_module = nook_play_module;
    out_code->main_module.create = create; /* the libraries go on with what it begins */
    find_built(out_code->built);
    nook_result result = nook_scratch_folder_make(&out_code->folder);
    if (result != NOOK_OK)
        return result;
    result = nook_play_host_create(&out_code->main_module, out_code->folder.path, &arguments, &out_code->play);
    if (result != NOOK_OK)
        nook_scratch_folder_remove(&out_code->folder);
    return result;
}

static nook_result put(const nook_soak_code *code, const char *name)
{
    char file_name[128], from[1200], to[1200];
    snprintf(file_name, sizeof file_name, "%s.so", name);
    return nook_file_copy(nook_path_join(from, sizeof from, code->built, file_name),
                          nook_path_join(to, sizeof to, code->folder.path, file_name));
}

uint32_t nook_soak_code_turns(const nook_soak_code *code)
{
    return code->built[0] ? code->play.part_count + 2 : 0;
}

nook_result nook_soak_code_exchange(nook_soak_code *code)
{
    char path[1200], text[64];
    uint32_t count = code->play.part_count + 1, turn = code->asked % (count + 1); /* the last: all */
    nook_result result = NOOK_OK;
    if (!code->built[0])
        return NOOK_OK;
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++) {
        if (turn == i || turn == count)
            result = put(code, i == 0 ? "game" : code->play.parts[i - 1].name);
    }
    int length = snprintf(text, sizeof text, "%u ok", ++code->asked);
    if (result == NOOK_OK)
        result = nook_file_write(nook_path_join(path, sizeof path, code->folder.path, "build"), text, (size_t)length);
    return result;
}

nook_result nook_soak_code_frame(nook_soak_code *code)
{
    bool goes_on;
    nook_result result = nook_module_host_frame(code->play.host, &goes_on);
    nook_module_host_view view = nook_module_host_look(code->play.host);
    if (result == NOOK_OK && (view.refusals > 0 || view.made > 0 || view.swaps != code->asked))
        return nook_fail(NOOK_E_VERSION, "soak: code was exchanged %u times of %u, its state made anew %u times: %s",
                         view.swaps, code->asked, view.made, view.message);
    return result;
}

nook_result nook_soak_code_close(nook_soak_code *code)
{
    nook_result result = nook_module_host_destroy(code->play.host);
    nook_scratch_folder_remove(&code->folder);
    return result;
}
