#include "engine/core/result.h"
#include "game/commands/benches.h"
#include "game/commands/commands.h"
#include <stdio.h>
#include <string.h>

static const nook_command benches[] = {
    { "frame", "where the milliseconds of a frame go, with bodies that move", nook_bench_run_frame },
    { "play", "every frame of a recorded game, as it is played", nook_bench_run_play },
    { "cost", "occlusion by the number of pixels, by its reach and by the size of the volumes", nook_bench_run_cost },
    { "occluders", "occlusion by 1 to 4096 volumes, apart and piled up, and by one that holds them all",
      nook_bench_run_occluders },
    { "reuse", "what ao.reuse and ao.accumulate save and cost while the camera walks and turns", nook_bench_run_reuse },
    { "character", "what meshes that bend cost in each frame: posed, voxelised", nook_bench_run_character },
    { "physics", "a step of a level's rigid bodies: asleep, awake, thrown about; rays", nook_bench_run_physics },
    { "ecs", "create, change, walk and destroy entities", nook_bench_run_ecs },
    { "bake", "surfels of up to 100 million triangles at four resolutions, and after an edit", nook_bench_run_bake },
    { "reload", "how soon a saved shader is in the picture", nook_bench_run_reload },
};

static void print_usage(FILE *stream)
{
    fprintf(stream, "usage: nook bench PART [OPTIONS]\n\nTimes a part of the engine; nook bench PART --help lists its "
                    "options.\n\n");
    for (size_t i = 0; i < NOOK_COUNT(benches); i++)
        fprintf(stream, "  %-10s %s\n", benches[i].name, benches[i].summary);
}

int nook_command_bench(const nook_app *app, int argc, char **argv)
{
    const nook_command *bench = argc > 1 ? nook_command_find(benches, NOOK_COUNT(benches), argv[1]) : NULL;
    if (bench)
        return bench->run(app, argc - 1, argv + 1);
    if (argc > 1 && (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0)) {
        print_usage(stdout);
        return NOOK_EXIT_OK;
    }
    if (argc > 1)
        fprintf(stderr, "nook: bench %s: there is no such part; ./nook bench --help lists them\n", argv[1]);
    else
        print_usage(stderr);
    return NOOK_EXIT_USAGE;
}
