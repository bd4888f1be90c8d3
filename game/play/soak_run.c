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
    uint32_t frames, warm; /**< Of the whole run; until the process is first looked at. */
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

/* Throws some of the level's bodies in any direction, upwards more than down. */
static void throw_bodies(soak *s)
{
    const nook_scene *scene = s->window->stage.scene;
    nook_session *session = s->window->play.session;
    for (int i = 0; i < 4; i++) {
        const nook_node *node = &scene->nodes[random_bits(s) % scene->node_count];
        nook_body body = nook_session_body_of(session, node->name);
        nook_physics *physics = nook_session_physics(session);
        if (body.id == 0 || nook_physics_mass(physics, body) == 0.0)
            continue;
        const double linear[3] = { random_between(s, -throw_speed, throw_speed),
                                   random_between(s, -0.3 * throw_speed, throw_speed),
                                   random_between(s, -throw_speed, throw_speed) };
        const double angular[3] = { random_between(s, -6, 6), random_between(s, -6, 6), random_between(s, -6, 6) };
        nook_physics_set_velocity(physics, body, linear, angular);
        s->report->throws++;
    }
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
    nook_soak_memory_add(&report->memory, frame, s->frames, process.resident);
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

/* What happens in this frame beside the game. */
static nook_result disturb(soak *s, uint32_t frame)
{
    nook_play_window *w = s->window;
    nook_result result = NOOK_OK;
    if (frame % THROW_EVERY == 0)
        throw_bodies(s);
    if (frame % RESTART_EVERY == 0) {
        s->report->returned += nook_session_look(w->play.session).returned;
        w->restart = true;
        s->report->restarts++;
    }
    if (frame % EXCHANGE_EVERY == 0)
        result = nook_soak_code_exchange(s->code);
    if (result == NOOK_OK && frame % RELOAD_EVERY == 0)
        result = reload(s);
    if (result == NOOK_OK && frame % RESIZE_EVERY == 0)
        result = resize(s);
    return result;
}

static nook_result run_frame(soak *s, uint32_t frame)
{
    nook_result result = disturb(s, frame);
    s->window->controls.held = random_input(s);
    if (result == NOOK_OK)
        result = nook_soak_code_frame(s->code);
    if (result == NOOK_OK && frame % LOOK_EVERY == 0)
        result = look_at_pixels(s);
    if (result == NOOK_OK && (frame == s->warm || (frame > s->warm && frame % COUNT_EVERY == 0)))
        result = look_at_process(s, frame);
    s->report->frames = frame;
    return result;
}

nook_result nook_soak_run(const char *root, const nook_soak_desc *desc, nook_soak_report *out_report)
{
    nook_soak_code code;
    nook_play_window_desc how = desc->window;
    how.driven = true;
    how.frame_seconds = NOOK_PHYSICS_STEP * (1.0 + 1e-9); /* so that rounding makes no frame without a tick */
    *out_report = (nook_soak_report){ .frames = 0 };
    nook_result result = nook_soak_code_open(root, &how, &code);
    if (result != NOOK_OK)
        return result;
    nook_play_window *window = nook_module_host_look(code.play.host).state;
    soak s = { .code = &code,
               .window = window,
               .report = out_report,
               .random = desc->seed,
               .frames = desc->frames,
               .warm = desc->frames / 10 };
    nook_progress progress = nook_progress_begin("soak");
    double start = nook_clock_ms();
    nook_interrupt_hold();
    for (uint32_t frame = 1; frame <= desc->frames && result == NOOK_OK && !nook_interrupt_asked(); frame++) {
        result = run_frame(&s, frame);
        nook_progress_update(&progress, (double)frame / desc->frames);
    }
    nook_progress_end(&progress);
    out_report->returned += nook_session_look(window->play.session).returned;
    out_report->exchanges = code.asked;
    out_report->seconds = (nook_clock_ms() - start) / 1000.0;
    free(s.visibility);
    nook_result closed = nook_soak_code_close(&code);
    nook_interrupt_answer(); /* the report says how far it came */
    nook_interrupt_release();
    return result == NOOK_OK ? closed : result;
}

bool nook_soak_holds(const nook_soak_report *report)
{
    return report->wrong == 0 && report->returned == 0 && report->pixels > 0 && report->files[1] <= report->files[0] &&
           nook_soak_memory_holds(&report->memory);
}
