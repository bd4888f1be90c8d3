#include "game/tune/tune_progress.h"
#include "engine/core/clock.h"
#include <stdio.h>
#include <unistd.h>

static const double often_ms = 200.0, seldom_ms = 15000.0; /* between lines, on a terminal and elsewhere */
/* Of the time: the search takes about this part when it needs all its tries, the proof the rest. */
static const double search_part = 0.8;

nook_tune_progress nook_tune_progress_begin(const nook_tune_goal *goal, uint32_t tries_max)
{
    double now = nook_clock_ms();
    bool terminal = isatty(STDERR_FILENO) == 1;
    return (nook_tune_progress){ .goal = goal,
                                 .tries_max = tries_max,
                                 .started_ms = now,
                                 .shown_ms = now,
                                 .terminal = terminal,
                                 .whole = { .what = "tuning", .terminal = terminal, .shown = !terminal } };
}

/* The time left, as if the rest went as what is done. */
static void show(nook_tune_progress *progress, double fraction, const char *text)
{
    double now = nook_clock_ms(), spent = now - progress->started_ms;
    if (now - progress->shown_ms < (progress->terminal ? often_ms : seldom_ms))
        return;
    char left[48] = "";
    if (fraction > 0.02) {
        int seconds = (int)(spent * (1.0 - fraction) / fraction / 1000.0 + 0.5);
        snprintf(left, sizeof left, ", at most about %d:%02d left", seconds / 60, seconds % 60);
    }
    fprintf(stderr, "%snook: tune: %s%s%s", progress->terminal ? "\r\033[K" : "", text, left,
            progress->terminal ? "" : "\n");
    progress->shown_ms = now;
    progress->shown = true;
}

void nook_tune_progress_search(nook_tune_progress *progress, const char *doing, uint32_t tried,
                               const nook_tune_trial *best)
{
    char text[256], found[96] = "";
    if (best) {
        nook_tune_estimate estimate = nook_tune_pool(best->views, best->view_count);
        snprintf(found, sizeof found, "; best %.4g at %.3g ms%s", estimate.cost.error, estimate.cost.ms,
                 nook_tune_fits(progress->goal, &estimate.cost) ? "" : ", over budget");
    }
    snprintf(text, sizeof text, "%s, %u settings tried%s", doing, tried, found);
    show(progress, search_part * tried / progress->tries_max, text);
}

void nook_tune_progress_proof(nook_tune_progress *progress, bool held_back, uint32_t view, uint32_t views)
{
    char text[128];
    double done = 0.5 * ((double)view / views + held_back);
    snprintf(text, sizeof text, "%s, %u of %u", held_back ? "proof on held-back cameras" : "timing the winner afresh",
             view + 1, views);
    show(progress, search_part + (1.0 - search_part) * done, text);
}

void nook_tune_progress_end(nook_tune_progress *progress)
{
    if (progress->terminal && progress->shown)
        fprintf(stderr, "\r\033[K");
    progress->shown = false;
}
