/** plan_report.h - a plan as text: what was chosen, why, what it saves, what that rests on. */
#pragma once
#include "game/plan/plan_describe.h"
#include <stdio.h>

typedef struct nook_plan_report {
    const nook_scene *scene;
    const nook_scene_volumes *volumes; /**< As collected; the plan has not been applied to them. */
    const nook_plan_scene *described;
    const nook_plan *plan;
    const char *from; /**< "anywhere", or a camera's name. */
} nook_plan_report;

/** The rules with what each saves, the volumes, and the bodies that are left out. */
void nook_plan_report_print(const nook_plan_report *report, FILE *stream);
