#include "engine/core/order.h"
#include "game/play/play_window.h"
#include <string.h>

void nook_frame_pacing_add(nook_frame_pacing *pacing, double ms)
{
    pacing->ms[pacing->next] = (float)ms;
    pacing->next = (pacing->next + 1) % NOOK_PLAY_HISTORY;
    if (pacing->count < NOOK_PLAY_HISTORY)
        pacing->count++;
}

double nook_frame_pacing_quantile(const nook_frame_pacing *pacing, double part)
{
    float sorted[NOOK_PLAY_HISTORY];
    if (pacing->count == 0)
        return 0.0;
    memcpy(sorted, pacing->ms, pacing->count * sizeof *sorted); /* until the ring is full it is filled from its start */
    nook_order_floats(sorted, pacing->count);
    return (double)nook_quantile_floats(sorted, pacing->count, part);
}
