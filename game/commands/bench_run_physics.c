/* What a step of a level's rigid bodies costs, without a picture: all asleep, all awake where they stand, all thrown up, and
   what a ray costs. Crates are added, as levels have more bodies than the demo level. */
#include "engine/core/clock.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/commands/benches.h"
#include "game/option_rows.h"
#include "game/play/play.h"
#include <math.h>
#include <stdlib.h>

enum { STEPS_MAX = 10000, CRATES_MAX = 1000, BODIES_MAX = 4096, RAYS = 256 };

typedef struct physics_options {
    const char *level;
    int32_t steps, crates;
    bool cpu;
    char default_level[NOOK_OPTION_PATH_MAX];
} physics_options;

typedef struct physics_bench {
    const physics_options *options;
    nook_physics *physics;
    nook_body bodies[BODIES_MAX]; /* that are dynamic */
    uint32_t count;
    double centre[3]; /* over which crates are rained and from which rays go out */
    double ms[STEPS_MAX];
} physics_bench;

/* ---- the bodies -------------------------------------------------------------------------------------------------- */

static void collect_bodies(physics_bench *b)
{
    nook_body all[BODIES_MAX];
    uint32_t count = nook_physics_bodies(b->physics, all, BODIES_MAX);
    b->count = 0;
    for (uint32_t i = 0; i < count && i < BODIES_MAX; i++)
        if (nook_physics_mass(b->physics, all[i]) > 0.0)
            b->bodies[b->count++] = all[i];
}

/* In layers of four by four, half a metre apart. */
static nook_result rain_crates(physics_bench *b)
{
    const nook_shape box = { .kind = NOOK_SHAPE_BOX,
                             .half = { 0.2, 0.15, 0.17 },
                             .body_from_shape = nook_pose_identity() };
    nook_result result = NOOK_OK;
    for (int32_t i = 0; i < b->options->crates && result == NOOK_OK; i++) {
        nook_body_desc desc = { .motion = NOOK_BODY_DYNAMIC,
                                .shapes = &box,
                                .shape_count = 1,
                                .mass = 8,
                                .pose = nook_pose_identity(),
                                .friction = 0.6,
                                .restitution = 0.05 };
        desc.pose.position[0] = b->centre[0] + 0.5 * (i % 4 - 1.5);
        desc.pose.position[1] = b->centre[1] + 0.5 + 0.4 * (i / 16);
        desc.pose.position[2] = b->centre[2] + 0.5 * (i / 4 % 4 - 1.5);
        nook_body body;
        result = nook_physics_add(b->physics, &desc, &body);
    }
    return result;
}

static nook_result let_settle(nook_physics *physics)
{
    nook_result result = NOOK_OK;
    for (int i = 0; i < 600 && result == NOOK_OK; i++)
        result = nook_physics_step(physics);
    return result;
}

/* ---- what is done before each step -------------------------------------------------------------------------------- */

static void put_to_sleep(physics_bench *b, int32_t step)
{
    for (uint32_t i = 0; step == 0 && i < b->count; i++)
        nook_physics_sleep(b->physics, b->bodies[i]);
}

static void keep_awake(physics_bench *b, int32_t step)
{
    (void)step;
    for (uint32_t i = 0; i < b->count; i++)
        nook_physics_wake(b->physics, b->bodies[i]);
}

/* Every second, up and a little aside. */
static void throw_up(physics_bench *b, int32_t step)
{
    for (uint32_t i = 0; step % 60 == 0 && i < b->count; i++) {
        double angle = 2.4 * i; /* the golden angle: everyone another way */
        nook_physics_set_velocity(b->physics, b->bodies[i], (double[3]){ cos(angle), 4.0, sin(angle) },
                                  (double[3]){ 2.0, 1.0, -1.0 });
    }
}

/* ---- timing ------------------------------------------------------------------------------------------------------ */

static nook_result time_steps(physics_bench *b, const char *name, void (*prepare)(physics_bench *, int32_t))
{
    const int32_t warm = 5, steps = b->options->steps;
    double (*clock)(void) = b->options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    double contacts = 0.0, awake = 0.0;
    for (int32_t i = -warm; i < steps; i++) {
        prepare(b, i + warm);
        double start = clock();
        nook_result result = nook_physics_step(b->physics);
        if (result != NOOK_OK)
            return result;
        if (i < 0)
            continue;
        b->ms[i] = clock() - start;
        nook_physics_statistics statistics;
        nook_physics_get_statistics(b->physics, &statistics);
        contacts += statistics.contacts;
        awake += statistics.awake;
    }
    nook_order_numbers(b->ms, (size_t)steps);
    printf("  %-10s %10.4f %10.4f %10.4f %10.1f %10.1f\n", name, b->ms[steps / 2], b->ms[steps * 95 / 100],
           b->ms[steps - 1], awake / steps, contacts / steps);
    return NOOK_OK;
}

/* As a shade asks: from one point over the upper half of all directions, 1.5 m far. */
static void time_rays(physics_bench *b)
{
    double (*clock)(void) = b->options->cpu ? nook_clock_cpu_ms : nook_clock_ms;
    const nook_body nobody[2] = { { 0 }, { 0 } };
    const double origin[3] = { b->centre[0], b->centre[1] + 0.3, b->centre[2] };
    int32_t hits = 0, rounds = 20;
    double start = clock();
    for (int32_t i = 0; i < rounds * RAYS; i++) {
        double up = (i % RAYS + 0.5) / RAYS, flat = sqrt(1.0 - up * up), angle = 2.399963 * i;
        nook_ray_hit hit;
        hits += nook_physics_ray(b->physics, origin, (double[3]){ flat * cos(angle), up, flat * sin(angle) }, 1.5,
                                 nobody, &hit);
    }
    printf("\n  %d rays of 1.5 m: %.4f ms, %d of them hit\n", RAYS, (clock() - start) / rounds, hits / rounds);
}

static nook_result run(physics_bench *b)
{
    nook_result result = rain_crates(b);
    if (result == NOOK_OK)
        result = let_settle(b->physics);
    collect_bodies(b);
    printf("%s, %u bodies that move, %d of them crates added, %d steps, one thread\nmilliseconds of %s a step\n\n"
           "  %-10s %10s %10s %10s %10s %10s\n",
           b->options->level, b->count, b->options->crates, b->options->steps,
           b->options->cpu ? "computing" : "wall time", "bodies", "median", "95 %", "highest", "awake", "contacts");
    if (result == NOOK_OK)
        result = time_steps(b, "asleep", put_to_sleep);
    if (result == NOOK_OK)
        result = time_steps(b, "awake", keep_awake);
    if (result == NOOK_OK)
        result = time_steps(b, "thrown", throw_up);
    if (result == NOOK_OK)
        time_rays(b);
    return result;
}

static bool read_options(const nook_app *app, int argc, char **argv, physics_options *out, int *out_exit_code)
{
    *out = (physics_options){ .steps = 600, .crates = 16 };
    out->level = nook_option_default_scene(app, out->default_level);
    const nook_option options[] = {
        nook_option_row_int("steps", &out->steps, 1, STEPS_MAX, "of each kind; default 600"),
        nook_option_row_int("crates", &out->crates, 0, CRATES_MAX, "added to the level's own bodies; default 16"),
        nook_option_row_flag("cpu", &out->cpu, "time that was computed, which a busy machine stretches less"),
    };
    const nook_usage usage = { .command = "bench physics",
                               .summary = "Times a step of the rigid bodies of a level, default the demo level.",
                               .positionals = "[LEVEL]",
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options),
                               .details = "asleep: nothing moves; awake: all lie where they are but must not sleep;\n"
                                          "thrown: all are thrown 0.8 m up every second.\n" };
    nook_arguments arguments;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, out_exit_code))
        return false;
    if (arguments.positional_count > 0)
        out->level = arguments.positionals[0];
    return true;
}

int nook_bench_run_physics(const nook_app *app, int argc, char **argv)
{
    physics_options options;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    physics_bench *bench = calloc(1, sizeof *bench);
    if (!bench) {
        (void)nook_fail(NOOK_E_MEMORY, "bench: no memory for %zu bytes", sizeof *bench);
        return NOOK_EXIT_FAILED;
    }
    const nook_play_desc desc = { .root = app->root, .level = options.level, .skip_images = true };
    nook_play play;
    nook_result result = nook_play_open(&desc, &play);
    if (result == NOOK_OK)
        result = nook_play_begin(&play, NULL, NULL);
    if (result == NOOK_OK) {
        bench->options = &options;
        bench->physics = nook_session_physics(play.session);
        for (int i = 0; i < 3; i++)
            bench->centre[i] = play.level->start[i];
        result = run(bench);
    }
    nook_result closed = nook_play_close(&play);
    free(bench);
    return result == NOOK_OK && closed == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
