#include "game/plan/plan_report.h"
#include "engine/core/file.h"
#include "engine/core/mebibyte.h"

static uint64_t bytes_today(const nook_plan_report *r, uint32_t volume)
{
    const nook_plan_volume *described = &r->described->volumes[volume];
    return nook_plan_voxel_bytes(described->sides, described->resolution);
}

/* What all volumes save that are as they are for this reason; the static one is on its own. */
static double saved_by(const nook_plan_report *r, nook_plan_fineness why, uint32_t *out_count)
{
    double saved = 0.0;
    *out_count = 0;
    for (uint32_t i = 0; i < r->plan->volume_count; i++) {
        if (r->plan->volumes[i].why != why || i == r->described->static_volume)
            continue;
        saved += (double)bytes_today(r, i) - (double)r->plan->volumes[i].bytes;
        ++*out_count;
    }
    return saved;
}

static uint32_t count_rule(const nook_plan *plan, nook_plan_rule rule, double *out_bound)
{
    uint32_t count = 0;
    *out_bound = 0.0;
    for (uint32_t i = 0; i < plan->occluder_count; i++) {
        if (plan->occluders[i].rule != rule)
            continue;
        count++;
        if (plan->occluders[i].bound > *out_bound)
            *out_bound = plan->occluders[i].bound;
    }
    return count;
}

static void print_rule(FILE *stream, const char *rule, const char *chosen, double saved, const char *rests_on)
{
    fprintf(stream, "%-16s %-44s %9.3f  %s\n", rule, chosen, saved / NOOK_MIB, rests_on);
}

static void print_bodies(const nook_plan_report *r, FILE *stream)
{
    char chosen[128], rests_on[128];
    double bound, most;
    uint32_t unused, twins, out_of_reach = count_rule(r->plan, NOOK_PLAN_OUT_OF_REACH, &bound);
    uint32_t small = count_rule(r->plan, NOOK_PLAN_TOO_SMALL, &most);
    double saved_by_twins = saved_by(r, NOOK_PLAN_TWIN, &twins), saved = saved_by(r, NOOK_PLAN_UNUSED, &unused);
    snprintf(chosen, sizeof chosen, "%u meshes are copies of another", twins);
    print_rule(stream, "instances", chosen, saved_by_twins, "0, proven: the same triangles");
    snprintf(chosen, sizeof chosen, "%u bodies have no surface in their reach", out_of_reach);
    print_rule(stream, "no volume", chosen, 0.0, "0, proven: rho is 0 from r_max on");
    snprintf(chosen, sizeof chosen, "%u bodies take too little of any surface", small);
    snprintf(rests_on, sizeof rests_on, "%.4f, proven: together, of any point", r->plan->bound);
    print_rule(stream, "left out", chosen, 0.0, rests_on);
    snprintf(chosen, sizeof chosen, "%u volumes of these two are not baked", unused);
    print_rule(stream, "", chosen, saved, "");
}

static void print_static(const nook_plan_report *r, FILE *stream)
{
    char chosen[128];
    uint32_t index = r->described->static_volume;
    double after = 0.0;
    if (index == NOOK_PLAN_NONE)
        return;
    for (uint32_t i = 0; i < r->plan->group_count; i++)
        after += (double)r->plan->groups[i].bytes;
    after += (double)r->plan->volumes[index].bytes;
    snprintf(chosen, sizeof chosen, "%u parts in %u volumes", r->described->part_count,
             r->plan->group_count ? r->plan->group_count : 1);
    print_rule(stream, "static", chosen, (double)bytes_today(r, index) - after,
               r->plan->group_count ? "measured: the same triangles in other voxels" : "");
}

static void print_levels(const nook_plan_report *r, FILE *stream)
{
    static const struct {
        nook_plan_fineness why;
        const char *text;
    } rows[] = { { NOOK_PLAN_BY_ERROR, "volumes as coarse as level_error allows" },
                 { NOOK_PLAN_BY_PIXEL, "volumes with voxels of a pixel" },
                 { NOOK_PLAN_BY_MEMORY, "volumes coarser, for memory" } };
    char rests_on[64];
    snprintf(rests_on, sizeof rests_on, "RMS %.3f, measured", r->plan->level_error);
    for (size_t i = 0; i < NOOK_COUNT(rows); i++) {
        char chosen[128];
        uint32_t count;
        double saved = saved_by(r, rows[i].why, &count);
        snprintf(chosen, sizeof chosen, "%u %s", count, rows[i].text);
        if (count > 0)
            print_rule(stream, "levels", chosen, saved, rests_on);
    }
}

static const char *const reasons[] = {
    [NOOK_PLAN_AS_EVER] = "as without a plan", [NOOK_PLAN_BY_ERROR] = "level_error", [NOOK_PLAN_BY_PIXEL] = "pixel",
    [NOOK_PLAN_BY_MEMORY] = "memory",          [NOOK_PLAN_UNUSED] = "left out",      [NOOK_PLAN_TWIN] = "copy of"
};

static void print_volume(const nook_plan_report *r, uint32_t index, FILE *stream)
{
    const nook_plan_volume_choice *choice = &r->plan->volumes[index];
    bool split = index == r->described->static_volume && r->plan->group_count > 0;
    fprintf(stream, "%-28.28s %5u %6u %6u %9.3f %9.3f  %s", r->volumes->volumes[index].name,
            r->volumes->volumes[index].instances, r->described->volumes[index].resolution, choice->resolution,
            (double)bytes_today(r, index) / NOOK_MIB, (double)choice->bytes / NOOK_MIB,
            split ? "split" : reasons[choice->why]);
    if (choice->why == NOOK_PLAN_TWIN)
        fprintf(stream, " %s", r->volumes->volumes[choice->volume].name);
    fputc('\n', stream);
}

static void print_volumes(const nook_plan_report *r, FILE *stream)
{
    fprintf(stream, "\n%-28s %5s %6s %6s %9s %9s  %s\n", "volume", "uses", "voxels", "plan", "MiB", "plan", "why");
    for (uint32_t i = 0; i < r->plan->volume_count; i++)
        print_volume(r, i, stream);
    for (uint32_t i = 0; i < r->plan->group_count; i++) {
        const nook_plan_group *group = &r->plan->groups[i];
        char name[32];
        snprintf(name, sizeof name, "static %u", i);
        fprintf(stream, "%-28s %5u %6s %6u %9s %9.3f  %u parts\n", name, 1u, "", group->resolution, "",
                (double)group->bytes / NOOK_MIB, group->parts);
    }
}

static void print_left_out(const nook_plan_report *r, FILE *stream)
{
    bool any = false;
    for (uint32_t i = 0; i < r->plan->occluder_count; i++) {
        const nook_plan_occluder_choice *choice = &r->plan->occluders[i];
        uint32_t node = r->volumes->occluders[i].node;
        if (choice->rule == NOOK_PLAN_KEPT)
            continue;
        if (!any)
            fprintf(stream, "\n%-28s %8s  %s\n", "left out", "bound", "why");
        any = true;
        fprintf(stream, "%-28.28s %8.5f  %s\n", node == NOOK_NONE ? "static" : r->scene->nodes[node].name,
                choice->bound,
                choice->rule == NOOK_PLAN_OUT_OF_REACH ? "no surface in reach" : "solid angle from every surface");
    }
}

void nook_plan_report_print(const nook_plan_report *r, FILE *stream)
{
    const nook_plan_params *p = &r->plan->params;
    fprintf(stream, "%s: %u bodies, %u volumes, r_max %.4g m, seen from %s\n", nook_path_name(r->scene->path),
            r->plan->occluder_count, r->plan->volume_count, r->described->r_max, r->from);
    fprintf(stream, "asked for: error %g of %s, level_error %g, memory %g MiB\n\n", (double)p->error,
            p->rays > 0 ? "a picture's rays" : "the integral", (double)p->level_error, (double)p->memory);
    fprintf(stream, "%-16s %-44s %9s  %s\n", "rule", "chosen", "saves MiB", "error that it rests on");
    print_bodies(r, stream);
    print_static(r, stream);
    print_levels(r, stream);
    print_volumes(r, stream);
    print_left_out(r, stream);
    fprintf(stream, "\n%.3f MiB of voxels instead of %.3f. Proven: no point changes by more than %.4f%s. ",
            (double)r->plan->bytes / NOOK_MIB, (double)r->plan->bytes_before / NOOK_MIB, r->plan->bound,
            p->mode == NOOK_PLAN_MEASURED ? " by what is left out" : "");
    fprintf(stream, "Measured: voxels of this size have an RMS of %.3f.\n", r->plan->level_error);
}
