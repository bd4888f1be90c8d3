#include "game/play/soak_run.h"
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/process.h"
#include "game/interrupt.h"
#include "game/play/soak_code.h"
#include "game/progress.h"
#include <math.h>
#include <stdlib.h>

/* How often what happens, in frames: numbers without a common factor, so that everything meets everything. */
enum {
    THROW_EVERY = 23,
    THROWN_AT_ONCE = 4,
    EXCHANGE_EVERY = 307,
    RELOAD_EVERY = 499,
    RESIZE_EVERY = 1201,
    RESTART_EVERY = 4999,
    LOOK_EVERY = 37,
    COUNT_EVERY = 7 /* several times in a tenth of the shortest run */
};
static const double throw_speed = 9.0; /* metres per second */

typedef struct soak {
    nook_soak_code *code;
    nook_play_window *window; /**< Its state, which is kept. */
    nook_soak_report *report;
    uint32_t random;
    uint32_t frames, warm; /**< Of the whole run; of its first part, in which everything happens once. */
    float *visibility;
    size_t visibility_count;
} soak;

static uint32_t random_bits(soak *s)
{
    s->random = s->random * 1664525u + 1013904223u;
    return s->random >> 8;
}

static double random_between(soak *s, double low, double high)
{
    return low + (high - low) * random_bits(s) / 16777216.0;
}

/* Throws what a node draws in any direction, upwards more than down, when it is a body that can be thrown. */
static void throw_body(soak *s, const nook_node *node)
{
    nook_session *session = s->window->play.session;
    nook_physics *physics = nook_session_physics(session);
    nook_body body = nook_session_body_of(session, node->name);
    if (body.id == 0 || nook_physics_mass(physics, body) == 0.0)
        return;
    const double linear[3] = { random_between(s, -throw_speed, throw_speed),
                               random_between(s, -0.3 * throw_speed, throw_speed),
                               random_between(s, -throw_speed, throw_speed) };
    const double angular[3] = { random_between(s, -6, 6), random_between(s, -6, 6), random_between(s, -6, 6) };
    nook_physics_set_velocity(physics, body, linear, angular);
    s->report->throws++;
}

/* All of the level's bodies at first, then some of them. */
static void throw_bodies(soak *s, uint32_t frame)
{
    const nook_scene *scene = s->window->stage.scene;
    uint32_t count = frame == 1 ? scene->node_count : frame % THROW_EVERY == 0 ? THROWN_AT_ONCE : 0;
    for (uint32_t i = 0; i < count; i++)
        throw_body(s, &scene->nodes[frame == 1 ? i : random_bits(s) % scene->node_count]);
}

/* The player walks, looks around, jumps, takes and throws as chance has it. */
static nook_play_input random_input(soak *s)
{
    static const uint16_t pressed[] = { 0, NOOK_PLAY_JUMP,   NOOK_PLAY_TAKE, NOOK_PLAY_THROW, NOOK_PLAY_RUN,
                                        0, NOOK_PLAY_CROUCH, NOOK_PLAY_TURN };
    return (nook_play_input){ .right = (int8_t)random_between(s, -127, 127),
                              .forward = (int8_t)random_between(s, -60, 127),
                              .buttons = pressed[random_bits(s) % NOOK_COUNT(pressed)],
                              .yaw = (int16_t)random_between(s, -900, 900),
                              .pitch = (int16_t)random_between(s, -400, 400) };
}

static nook_result look_at_pixels(soak *s)
{
    nook_texture texture = nook_stage_visibility(&s->window->stage);
    size_t count = (size_t)texture.width * texture.height;
    if (count > s->visibility_count) {
        float *bigger = realloc(s->visibility, count * sizeof *bigger);
        if (!bigger)
            return nook_fail(NOOK_E_MEMORY, "soak: no memory for a picture");
        s->visibility = bigger;
        s->visibility_count = count;
    }
    nook_texture_read(s->window->stage.gpu, texture, GL_RED, GL_FLOAT, s->visibility, count * sizeof(float));
    for (size_t i = 0; i < count; i++)
        s->report->wrong += !(s->visibility[i] >= 0.0f && s->visibility[i] <= 1.0f); /* NaN is neither */
    s->report->pixels += count;
    return NOOK_OK;
}

static nook_result look_at_process(soak *s, uint32_t frame)
{
    nook_process process;
    nook_result result = nook_process_read(&process);
    if (result != NOOK_OK)
        return result;
    nook_soak_report *report = s->report;
    nook_soak_memory_add(&report->resident, frame, s->frames, process.resident);
    if (process.heap > 0)
        nook_soak_memory_add(&report->heap, frame, s->frames, process.heap);
    if (frame <= s->warm)
        report->files[0] = process.files;
    report->files[1] = process.files;
    return NOOK_OK;
}

static nook_result reload(soak *s)
{
    nook_shader_report shaders;
    nook_gpu_reload_shaders(s->window->stage.gpu, NULL, 0, &shaders);
    s->report->reloads++;
    return shaders.failed == 0 ? NOOK_OK : nook_fail(NOOK_E_DEVICE, "soak: a shader does not build any more");
}

static nook_result resize(soak *s)
{
    nook_play_window *w = s->window;
    uint32_t width = w->width, height = w->height;
    nook_result result = nook_stage_set_size(&w->stage, width + 9, height + 5);
    if (result == NOOK_OK)
        result = nook_stage_set_size(&w->stage, width, height);
    s->report->resizes++;
    return result;
}

/* Those that happen once while it warms up, in this order: each library exchanged and all of them, then the others. */
enum { WARM_RELOAD = 1, WARM_RESIZE, WARM_RESTART, WARM_OTHERS = WARM_RESTART };

/* Whether one of `count` in a row of warming up is due, beginning with `first`: they are spread evenly over that time. */
static bool warms_up(const soak *s, uint32_t frame, uint32_t first, uint32_t count)
{
    const uint64_t slots = nook_soak_code_turns(s->code) + WARM_OTHERS + 1;
    for (uint32_t i = first; i < first + count; i++) {
        if (frame == (uint64_t)(i + 1) * s->warm / slots)
            return true;
    }
    return false;
}

/* What happens in this frame beside the game. */
static nook_result disturb(soak *s, uint32_t frame)
{
    const uint32_t turns = nook_soak_code_turns(s->code);
    nook_result result = NOOK_OK;
    throw_bodies(s, frame);
    if (frame % RESTART_EVERY == 0 || warms_up(s, frame, turns + WARM_RESTART - 1, 1)) {
        s->window->restart = true;
        s->report->restarts++;
    }
    if (frame % EXCHANGE_EVERY == 0 || warms_up(s, frame, 0, turns))
        result = nook_soak_code_exchange(s->code);
    if (result == NOOK_OK && (frame % RELOAD_EVERY == 0 || warms_up(s, frame, turns + WARM_RELOAD - 1, 1)))
        result = reload(s);
    if (result == NOOK_OK && (frame % RESIZE_EVERY == 0 || warms_up(s, frame, turns + WARM_RESIZE - 1, 1)))
        result = resize(s);
    return result;
}

static nook_result run_frame(soak *s, uint32_t frame)
{
    nook_result result = disturb(s, frame);
    s->window->controls.held = random_input(s);
    if (result == NOOK_OK)
        result = nook_soak_code_frame(s->code);
    if (result == NOOK_OK)
        result = nook_soak_bodies_look(&s->report->bodies, s->window->play.session);
    if (result == NOOK_OK && frame % LOOK_EVERY == 0)
        result = look_at_pixels(s);
    if (result == NOOK_OK && (frame == s->warm || frame % COUNT_EVERY == 0))
        result = look_at_process(s, frame);
    s->report->frames = frame;
    return result;
}

/*
 * Mesa's llvmpipe keeps a list of what is to be drawn for each pass that its threads have not come to, up to 64, and what these lists
 * have grown to: 147.9 MiB of heap become anything up to 190, as the machine is busy. Without threads there is one list, and memory is
 * the same from frame to frame to a few kilobytes.
 */
static void draw_without_threads(void)
{
    setenv("LP_NUM_THREADS", "0", 0);
}

nook_result nook_soak_run(const char *root, const nook_soak_desc *desc, nook_soak_report *out_report)
{
    nook_soak_code code;
    nook_play_window_desc how = desc->window;
    how.driven = true;
    how.frame_seconds = NOOK_PHYSICS_STEP * (1.0 + 1e-9); /* so that rounding makes no frame without a tick */
    *out_report = (nook_soak_report){ .frames = 0 };
    draw_without_threads();
    nook_result result = nook_soak_code_open(root, &how, &code);
    if (result != NOOK_OK)
        return result;
    nook_play_window *window = nook_module_host_look(code.play.host).state;
    soak s = { .code = &code,
               .window = window,
               .report = out_report,
               .random = desc->seed,
               .frames = desc->frames,
               .warm = desc->frames / NOOK_SOAK_PARTS };
    nook_progress progress = nook_progress_begin("soak");
    double start = nook_clock_ms();
    nook_interrupt_hold();
    for (uint32_t frame = 1; frame <= desc->frames && result == NOOK_OK && !nook_interrupt_asked(); frame++) {
        result = run_frame(&s, frame);
        nook_progress_update(&progress, (double)frame / desc->frames);
    }
    nook_progress_end(&progress);
    out_report->exchanges = code.asked;
    out_report->seconds = (nook_clock_ms() - start) / 1000.0;
    free(s.visibility);
    nook_soak_bodies_free(&out_report->bodies);
    nook_result closed = nook_soak_code_close(&code);
    nook_interrupt_answer(); /* the report says how far it came */
    nook_interrupt_release();
    return result == NOOK_OK ? closed : result;
}

bool nook_soak_holds(const nook_soak_report *report)
{
    bool heap_is_known = report->heap.most > 0;
    return report->wrong == 0 && report->bodies.through == 0 && report->pixels > 0 &&
           report->files[1] <= report->files[0] &&
           (!heap_is_known || nook_soak_memory_holds(&report->heap, NOOK_SOAK_HEAP_ALLOWED)) &&
           nook_soak_memory_holds(&report->resident, nook_soak_resident_allowed(&report->resident));
}
