#include "engine/core/json.h"
#include "game/commands/bench_ecs.h"
#include "game/commands/benches.h"
#include "game/option_rows.h"

typedef struct bench_settings {
    int32_t entities, repeat;
    bool json;
} bench_settings;

static void print_table(const bench_settings *settings, const nook_bench_times *times)
{
    printf("ECS: %d entities, %d rounds, one thread; nanoseconds per entity\n\n", (int)settings->entities,
           (int)settings->repeat);
    printf("  %-12s %8s %8s %8s\n", "step", "median", "lowest", "highest");
    for (nook_bench_ecs_step step = 0; step < NOOK_BENCH_STEP_COUNT; step++)
        printf("  %-12s %8.2f %8.2f %8.2f\n", nook_bench_ecs_name(step), times[step].median, times[step].lowest,
               times[step].highest);
}

static nook_result print_json(const bench_settings *settings, const nook_bench_times *times)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "bench", "ecs");
    nook_json_member_integer(&json, "entities", settings->entities);
    nook_json_member_integer(&json, "repeat", settings->repeat);
    nook_json_key(&json, "ns_per_entity");
    nook_json_begin_object(&json);
    for (nook_bench_ecs_step step = 0; step < NOOK_BENCH_STEP_COUNT; step++) {
        nook_json_key(&json, nook_bench_ecs_name(step));
        nook_json_begin_object(&json);
        nook_json_member_number(&json, "median", times[step].median);
        nook_json_member_number(&json, "lowest", times[step].lowest);
        nook_json_member_number(&json, "highest", times[step].highest);
        nook_json_end_object(&json);
    }
    nook_json_end_object(&json);
    nook_json_end_object(&json);
    nook_result result = nook_json_print(&json, stdout);
    nook_json_free(&json);
    return result;
}

int nook_bench_run_ecs(const nook_app *app, int argc, char **argv)
{
    (void)app;
    bench_settings settings = { .entities = 1000000, .repeat = 7 };
    const nook_option options[] = {
        nook_option_row_int("entities", &settings.entities, 1, 50000000, "default 1000000"),
        nook_option_row_int("repeat", &settings.repeat, 1, NOOK_BENCH_ROUNDS_MAX,
                            "rounds to take the median of, after one to warm up; default 7"),
        nook_option_row_json(&settings.json, "print JSON"),
    };
    const nook_usage usage = { .command = "bench ecs",
                               .summary =
                                   "Times the entity-component system: create, change, walk and destroy entities.",
                               .options = options,
                               .option_count = NOOK_COUNT(options) };
    nook_arguments arguments;
    int exit_code;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, &exit_code))
        return exit_code;
    nook_bench_times times[NOOK_BENCH_STEP_COUNT];
    nook_result result = nook_bench_ecs((uint32_t)settings.entities, (uint32_t)settings.repeat, times);
    if (result == NOOK_OK && settings.json)
        result = print_json(&settings, times);
    else if (result == NOOK_OK)
        print_table(&settings, times);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
