#include "game/tune/space.h"
#include "game/techniques.h"
#include "game/volumes.h"
#include "modules/bake/voxelize.h"
#include <assert.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Counts: from a sixteenth of the initial one to eight times as many, by the square root of two. */
enum { RUNGS_DOWN = 8, RUNGS_UP = 6, RESOLUTION_MIN = 32 };

static void add_rung(nook_tune_axis *axis, double value)
{
    char text[16];
    snprintf(text, sizeof text, "%.0f", value);
    bool repeated = axis->rung_count > 0 && strcmp(axis->rungs[axis->rung_count - 1], text) == 0;
    if (!repeated && axis->rung_count < NOOK_TUNE_RUNGS_MAX)
        memcpy(axis->rungs[axis->rung_count++], text, sizeof text);
}

static nook_tune_axis *new_axis(nook_tune_ladders *ladders, const char *name)
{
    assert(ladders->axis_count < NOOK_TUNE_AXES_MAX);
    nook_tune_axis *axis = &ladders->axes[ladders->axis_count++];
    *axis = (nook_tune_axis){ .ordered = true };
    snprintf(axis->name, sizeof axis->name, "%s", name);
    return axis;
}

static void add_count(nook_tune_ladders *ladders, const nook_param *param)
{
    nook_tune_axis *axis = new_axis(ladders, param->name);
    if (param->lowest == 0.0)
        add_rung(axis, 0.0);
    for (int k = -RUNGS_DOWN; k <= RUNGS_UP; k++) {
        double value = round(fmax(param->initial, 1.0) * pow(2.0, 0.5 * k));
        if (value >= fmax(param->lowest, 1.0) && value <= param->highest)
            add_rung(axis, value);
        if (value <= param->initial)
            axis->initial = axis->rung_count - 1;
    }
}

static void add_resolution(nook_tune_ladders *ladders)
{
    nook_tune_axis *axis = new_axis(ladders, "resolution");
    for (uint32_t side = RESOLUTION_MIN; side <= NOOK_VOXELIZE_RESOLUTION_MAX; side *= 2) {
        add_rung(axis, side);
        if (side == NOOK_VOLUMES_RESOLUTION_DEFAULT)
            axis->initial = axis->rung_count - 1;
        if (3 * side / 2 <= NOOK_VOXELIZE_RESOLUTION_MAX)
            add_rung(axis, 3 * side / 2);
    }
}

/* Every choice of a shared parameter; its table has the dear ones first where they have an order. */
static void add_choices(nook_tune_ladders *ladders, const char *name, bool ordered)
{
    const nook_param *param = nook_shared_param(name);
    char full[64];
    snprintf(full, sizeof full, "ao.%s", name);
    nook_tune_axis *axis = new_axis(ladders, full);
    axis->ordered = ordered;
    for (double value = param->highest; value >= param->lowest; value -= 1.0) {
        if (value == param->initial)
            axis->initial = axis->rung_count;
        nook_param_print_value(param, value, axis->rungs[axis->rung_count++], sizeof axis->rungs[0]);
    }
}

void nook_tune_space_add(nook_tune_space *space, const nook_ao_technique *technique)
{
    assert(space->technique_count < NOOK_TUNE_TECHNIQUES_MAX);
    nook_tune_ladders *ladders = &space->techniques[space->technique_count++];
    *ladders = (nook_tune_ladders){ .technique = technique };
    for (uint32_t i = 0; i < technique->param_count; i++) {
        const nook_param *param = &technique->params[i];
        if (param->type == NOOK_PARAM_INT && param->unit == NOOK_UNIT_COUNT)
            add_count(ladders, param);
    }
    if (technique->inputs & NOOK_AO_IN_VOLUMES)
        add_resolution(ladders);
    add_choices(ladders, "scale", true);
    add_choices(ladders, "filter", false);
}

double nook_tune_space_size(const nook_tune_space *space)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < space->technique_count; i++) {
        double product = 1.0;
        for (uint32_t k = 0; k < space->techniques[i].axis_count; k++)
            product *= space->techniques[i].axes[k].rung_count;
        sum += product;
    }
    return sum;
}

nook_tune_point nook_tune_initial(const nook_tune_space *space, uint32_t technique)
{
    const nook_tune_ladders *ladders = &space->techniques[technique];
    nook_tune_point point = { .technique = technique };
    for (uint32_t i = 0; i < ladders->axis_count; i++)
        point.rungs[i] = (uint8_t)ladders->axes[i].initial;
    return point;
}

bool nook_tune_step(const nook_tune_space *space, nook_tune_point *point, uint32_t axis, int rungs)
{
    int to = point->rungs[axis] + rungs;
    if (to < 0 || to >= (int)space->techniques[point->technique].axes[axis].rung_count)
        return false;
    point->rungs[axis] = (uint8_t)to;
    return true;
}

bool nook_tune_same(const nook_tune_point *a, const nook_tune_point *b)
{
    return a->technique == b->technique && memcmp(a->rungs, b->rungs, sizeof a->rungs) == 0;
}

nook_setting nook_tune_setting(const nook_tune_space *space, const nook_tune_point *point)
{
    const nook_tune_ladders *ladders = &space->techniques[point->technique];
    nook_setting setting = nook_setting_initial(ladders->technique);
    for (uint32_t i = 0; i < ladders->axis_count; i++) {
        const nook_tune_axis *axis = &ladders->axes[i];
        nook_result result = nook_setting_assign("tune", &setting, axis->name, axis->rungs[point->rungs[i]]);
        assert(result == NOOK_OK && "a rung is a value that its parameter takes");
        (void)result;
    }
    return setting;
}
