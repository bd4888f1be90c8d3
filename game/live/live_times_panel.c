/* Times, counts and memory. */
#include "game/live/live_internal.h"
#include "game/stream_volumes.h"
#include "modules/ao/nook_ao.h"
#include <stdio.h>

static const char *const pass_names[LIVE_PASS_AO] = { "world", "shadow map", "G-buffer" };
static const double plot_height = 4.0, number_column = 8.0; /* letters' heights */
static const float plot_times = 3.0f;                       /* of the median: the top of the graph */

static void show_pass(nook_live *live, const char *name, live_pass pass)
{
    char line[96];
    if (live->times.ms[pass] <= 0.0)
        return;
    snprintf(line, sizeof line, "%.2f ms", live->times.ms[pass]);
    nook_overlay_text(live->overlay, name);
    nook_overlay_same_line_at(live->overlay, number_column);
    nook_overlay_text(live->overlay, line);
}

static void show_passes(nook_live *live)
{
    char name[32];
    for (uint32_t i = 0; i < LIVE_PASS_AO; i++)
        show_pass(live, pass_names[i], (live_pass)i);
    for (uint32_t i = 0; i < live->views.count; i++) {
        snprintf(name, sizeof name, "AO %u", i + 1);
        show_pass(live, name, (live_pass)(LIVE_PASS_AO + i));
    }
    show_pass(live, "light", LIVE_PASS_LIGHT);
    show_pass(live, "overlay", LIVE_PASS_OVERLAY);
    nook_overlay_text(live->overlay, nook_gpu_timer_trusted(live->stage->gpu)
                                         ? "times of the GPU"
                                         : "waited for pass by pass while this is shown");
}

static void show_pacing(nook_live *live)
{
    const live_times *times = &live->times;
    live_pacing pacing = live_times_pacing(times);
    char line[128];
    snprintf(line, sizeof line, "median %.1f ms, p99 %.1f, worst %.1f; %u slow", (double)pacing.median_ms,
             (double)pacing.p99_ms, (double)pacing.worst_ms, pacing.slow);
    uint32_t oldest = times->frame_count < LIVE_TICKS ? 0 : times->frame_next;
    nook_overlay_plot(live->overlay, "##frames", times->frames, times->frame_count, oldest, 0.0f,
                      plot_times * pacing.median_ms, plot_height, "ms from frame to frame");
    nook_overlay_text(live->overlay, line);
}

static void show_counts(nook_live *live)
{
    nook_stage *stage = live->stage;
    nook_ao_statistics statistics;
    size_t draws;
    uint32_t occluders;
    char line[160];
    nook_game_world_draws(stage->world, &draws);
    nook_game_world_occluders(stage->world, &occluders);
    nook_ao_get_statistics(stage->ao, &statistics);
    snprintf(line, sizeof line, "%zu draws, %u occluders, %u x %u pixels", draws, occluders, stage->width,
             stage->height);
    nook_overlay_text(live->overlay, line);
    snprintf(line, sizeof line, "scene %.1f MB, volumes %.1f MB, AO textures %.1f MB",
             (double)nook_render_scene_bytes(stage->render_scene) * 1e-6, (double)statistics.volume_bytes * 1e-6,
             (double)statistics.texture_bytes * 1e-6);
    nook_overlay_text(live->overlay, line);
    if (stage->stream)
        nook_overlay_text(live->overlay, nook_stream_print(stage->stream, line, sizeof line));
}

static void show_all(nook_live *live)
{
    show_pacing(live);
    show_passes(live);
    show_counts(live);
    live->times_shown = true;
}

void live_times_section(nook_live *live)
{
    if (nook_overlay_section(live->overlay, "times and memory", false))
        show_all(live);
}

void live_panel_times(nook_live *live)
{
    const nook_overlay_panel panel = {
        .title = "Times", .x = 8.0 * live->scale, .y = 80.0 * live->scale, .width = 25.0, .height = 22.0
    };
    if (nook_overlay_panel_begin(live->overlay, &panel))
        show_all(live);
    nook_overlay_panel_end(live->overlay);
}
