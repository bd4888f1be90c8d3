#include "game/measure/site_time.h"
#include "engine/core/clock.h"
#include "engine/core/order.h"
#include "game/compare/frame_times.h"
#include "game/measure/site_internal.h"
#include "game/stage.h"
#include "modules/ao/technique.h"
#include <assert.h>
#include <math.h>

/* Frames of a round: as many as fit into its milliseconds. Slow frames are means over enough of a machine's moods to need fewer rounds. */
enum { FRAMES_MIN = 1, FRAMES_MAX = 3, ROUND_MS = 80, SLOW_FRAME_MS = 120 };

nook_result nook_site_show(nook_site *site)
{
    site->stage->frame_index = 0;
    return nook_stage_begin(site->stage, &site->camera);
}

static nook_result warm_up(nook_site *site, double *out_ms)
{
    nook_gpu_finish(site->stage->gpu);
    double start = nook_clock_ms();
    nook_result result = nook_stage_occlude(site->stage);
    nook_gpu_finish(site->stage->gpu);
    *out_ms = nook_clock_ms() - start;
    return result;
}

/* A setting's very first frame links and compiles: what a frame takes is told from its second. */
static nook_result warm_up_first(nook_site *site, nook_site_times *times)
{
    double ms = NAN;
    nook_result result = warm_up(site, &ms);
    if (result == NOOK_OK)
        result = warm_up(site, &ms);
    times->frames = (uint32_t)fmin(fmax(ROUND_MS / fmax(ms, 1e-3), FRAMES_MIN), FRAMES_MAX);
    times->wanted = ms > SLOW_FRAME_MS ? NOOK_SITE_ROUNDS_SLOW : NOOK_SITE_ROUNDS;
    return result;
}

nook_result nook_site_time_round(nook_site *site, const nook_setting *setting, nook_site_times *times)
{
    assert(times->rounds < NOOK_SITE_ROUNDS && !setting->technique->exact);
    nook_frame_times frames;
    if (times->rounds > 0 && times->rounds >= times->wanted)
        return NOOK_OK;
    double ms;
    nook_result result = nook_setting_apply(site->stage->ao, setting);
    if (result == NOOK_OK)
        result = times->rounds == 0 ? warm_up_first(site, times) : warm_up(site, &ms);
    if (result == NOOK_OK)
        result = nook_frame_times_measure(site->stage, times->frames, INFINITY, &frames);
    if (result != NOOK_OK)
        return result;
    times->ms[times->rounds] = frames.median;
    times->gpu_ms[times->rounds++] = frames.gpu_median;
    return NOOK_OK;
}

void nook_site_times_put(const nook_site_times *times, nook_sample *sample)
{
    assert(times->rounds > 0);
    nook_site_times sorted = *times;
    sample->ms_median = nook_median(sorted.ms, times->rounds);
    sample->ms_min = sorted.ms[0];
    sample->ms_max = sorted.ms[times->rounds - 1];
    sample->gpu_ms_median = nook_median(sorted.gpu_ms, times->rounds);
    sample->frames = times->rounds * times->frames;
}
