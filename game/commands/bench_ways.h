/** bench_ways.h - the ways in which `volume` joins several volumes, for benches that time them beside each other. */
#pragma once
#include "modules/ao/technique.h"

typedef struct nook_bench_way {
    const char *name;
    const char *combine, *path; /**< Values of these parameters. NULL: as they are set. */
} nook_bench_way;

enum { NOOK_BENCH_WAYS_MAX = 3 };

/** Union, product and rasterised boxes of a technique that can do all of them; else the one way that it has. @return how many */
size_t nook_bench_ways(const nook_ao_technique *technique, const nook_bench_way **out_ways);
/** Sets what the way says; the technique is the chosen one. @return as nook_ao_parse_param */
nook_result nook_bench_way_apply(nook_ao *ao, const nook_ao_technique *technique, const nook_bench_way *way);
