#pragma once
#include "game/command.h"

/* The parts that ./nook bench times; rows of the table in bench.c. argv[0] is the part's name. @return a NOOK_EXIT_* code */
int nook_bench_run_frame(const nook_app *app, int argc, char **argv);
int nook_bench_run_play(const nook_app *app, int argc, char **argv);
int nook_bench_run_cost(const nook_app *app, int argc, char **argv);
int nook_bench_run_occluders(const nook_app *app, int argc, char **argv);
int nook_bench_run_reuse(const nook_app *app, int argc, char **argv);
int nook_bench_run_character(const nook_app *app, int argc, char **argv);
int nook_bench_run_physics(const nook_app *app, int argc, char **argv);
int nook_bench_run_ecs(const nook_app *app, int argc, char **argv);
int nook_bench_run_bake(const nook_app *app, int argc, char **argv);
int nook_bench_run_reload(const nook_app *app, int argc, char **argv);
