#include "game/play/play_module.h"
#include "game/play/play_request.h"
#include "game/play/play_window.h"
#include "game/techniques.h"
#include <stdio.h>
#include <string.h>

/* @return what a part lends, or NULL when it is of another kind */
static const nook_ao_technique *technique_of(const nook_module_part *part)
{
    const char *kind = part->module->kind;
    return kind && strcmp(kind, NOOK_AO_TECHNIQUE_KIND) == 0 ? part->module->interface : NULL;
}

static void list_techniques(const nook_module_news *news)
{
    for (uint32_t i = 0; i < news->part_count; i++) {
        const nook_ao_technique *technique = technique_of(&news->parts[i]);
        if (technique)
            nook_techniques_list(technique);
    }
}

static nook_result create(void *state, const nook_module_news *news)
{
    const nook_module_arguments *arguments = news->arguments;
    nook_play_request request;
    int exit_code;
    list_techniques(news);
    if (!nook_play_request_read(arguments->root, arguments->argc, arguments->argv, &request, &exit_code))
        return NOOK_E_ARG; /* its own line was printed */
    const nook_play_window_desc desc = { .play = request.desc,
                                         .backend = request.backend,
                                         .no_window = request.headless,
                                         .width = (uint32_t)request.size.width,
                                         .height = (uint32_t)request.size.height,
                                         .settings = request.settings,
                                         .cache = request.cache,
                                         .pictures = request.pictures,
                                         .capture = request.capture,
                                         .from_seconds = request.from,
                                         .frames = (uint32_t)request.frames };
    return nook_play_window_open(arguments->root, &desc, state);
}

static nook_result destroy(void *state)
{
    return nook_play_window_close(state);
}

static nook_result frame(void *state, const nook_module_news *news, bool *out_running)
{
    nook_play_window *window = state;
    snprintf(window->trouble, sizeof window->trouble, "%s", news->message);
    window->quit = window->quit || news->stop_asked;
    nook_result result = nook_play_window_frame(window, out_running);
    if (result == NOOK_OK && !*out_running)
        nook_play_print_end(&window->play);
    return result;
}

static void suspend(void *state)
{
    nook_play_window *window = state;
    nook_live_suspend(window->live);
    if (window->scenes)
        nook_scene_reload_wait(window->scenes);
    if (window->stage.stream)
        nook_stream_suspend(window->stage.stream);
}

static nook_result resume(void *state, const nook_module_news *news)
{
    nook_play_window *window = state;
    nook_result result = NOOK_OK;
    list_techniques(news);
    for (uint32_t i = 0; i < news->part_count && result == NOOK_OK; i++) {
        const nook_ao_technique *technique = technique_of(&news->parts[i]);
        if (technique)
            result = nook_ao_replace_technique(window->stage.ao, technique, !news->parts[i].other_layout);
    }
    return result == NOOK_OK ? nook_play_window_renew(window) : result;
}

const nook_module nook_play_module = {
    .version = NOOK_MODULE_VERSION,
    .name = "game",
    .state_size = sizeof(nook_play_window),
    .state_version = 1,
    .create = create,
    .destroy = destroy,
    .frame = frame,
    .suspend = suspend,
    .resume = resume,
};
