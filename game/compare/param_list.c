#include "game/compare/param_list.h"
#include "game/techniques.h"
#include "modules/ao/nook_ao.h"
#include "modules/plan/plan_params.h"
#include <string.h>

/* "hard, linear" of "hard|linear". */
static void print_choices(const nook_param *param, char *out, size_t capacity)
{
    size_t used = 0;
    for (const char *at = param->choices; *at && used + 3 < capacity; at++) {
        if (*at == '|') {
            out[used++] = ',';
            out[used++] = ' ';
        } else {
            out[used++] = *at;
        }
    }
    out[used] = '\0';
}

static void print_param(const char *owner, const nook_param *param, FILE *stream)
{
    char name[64], initial[32], range[128];
    snprintf(name, sizeof name, "%s.%s", owner, param->name);
    nook_param_print_value(param, param->initial, initial, sizeof initial);
    if (param->type == NOOK_PARAM_CHOICE)
        print_choices(param, range, sizeof range);
    else
        snprintf(range, sizeof range, "%g to %g%s", param->lowest, param->highest,
                 param->type == NOOK_PARAM_INT ? ", whole" : "");
    fprintf(stream, "%-20s %-10s %-48s %-7s %s\n", name, initial, range, nook_unit_name(param->unit), param->help);
}

static void print_table(const char *owner, const nook_param *params, size_t count, FILE *stream)
{
    for (size_t i = 0; i < count; i++)
        print_param(owner, &params[i], stream);
}

void nook_compare_list_params(FILE *stream)
{
    size_t shared_count, count;
    const nook_param *shared = nook_ao_shared_params(&shared_count);
    const nook_ao_technique *const *techniques = nook_techniques(&count);
    fprintf(stream, "%-20s %-10s %-48s %-7s %s\n", "parameter", "initial", "range or choices", "unit", "meaning");
    print_table("ao", shared, shared_count, stream);
    for (size_t i = 0; i < count; i++)
        print_table(techniques[i]->name, techniques[i]->params, techniques[i]->param_count, stream);
    const nook_param *plan = nook_plan_param_table(&count);
    print_table("plan", plan, count, stream);
    fprintf(stream, "\nOf ao.r_max, compare's own default is a tenth of the scene's diagonal.\n");
}
