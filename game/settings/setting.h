/**
 * setting.h - all that a user may choose between speed and accuracy: a technique, the resolution of the volumes, and parameters.
 *
 * As text, in this order:  volume rays=4 ao.scale=half resolution=128
 * The technique's own parameters stand without its name, shared ones with "ao."; what is not named is at its initial value.
 * r_max and falloff are no choice of this kind: they say what is computed, not how well; a setting never holds them.
 */
#pragma once
#include "engine/core/param.h"
#include "modules/ao/nook_ao.h"
#include <stdbool.h>

enum { NOOK_SETTING_PARAMS_MAX = 32, NOOK_SETTING_TEXT_MAX = 1024, NOOK_SETTING_VALUE_MAX = 64 };

typedef struct nook_setting_param {
    const nook_param *param; /**< Of the technique's or the shared table. */
    bool shared;             /**< "ao.name". */
    double value;            /**< In its range. */
} nook_setting_param;

/** Two settings that mean the same print the same text: parameters at their initial value are left out, the rest in table order. */
typedef struct nook_setting {
    const struct nook_ao_technique *technique;
    uint32_t resolution; /**< Of the volumes, voxels; 0: the default. Always 0 for techniques that read no volumes. */
    nook_setting_param params[NOOK_SETTING_PARAMS_MAX]; /**< In table order: the technique's, then the shared ones. */
    uint32_t param_count;
} nook_setting;

/** The technique with everything at its initial value. */
nook_setting nook_setting_initial(const struct nook_ao_technique *technique);

/**
 * Reads the text form.
 * @param where  names the source in the message: "sweep.txt:12"
 * @return NOOK_E_NOT_FOUND unknown technique or parameter (with what is near), NOOK_E_ARG, NOOK_E_RANGE; untouched then
 */
nook_result nook_setting_parse(const char *where, const char *text, nook_setting *out_setting);

/**
 * Sets one parameter by name ("rays", "ao.scale", "resolution") from text.
 * @return as nook_setting_parse; also NOOK_E_ARG for ao.r_max, ao.falloff, ao.falloff_tau and ao.count, and for a resolution
 *         where no volumes are read
 */
nook_result nook_setting_assign(const char *where, nook_setting *setting, const char *name, const char *text);

/** Prints the text form. @param out NOOK_SETTING_TEXT_MAX bytes @return out */
const char *nook_setting_print(const nook_setting *setting, char *out);

/** One value as the text form has it: a choice's name, or the fewest digits that read back as the same number. @return out */
const char *nook_setting_value(const nook_setting_param *entry, char out[NOOK_SETTING_VALUE_MAX]);

/**
 * What a setting of a technique may hold, for menus: the technique's rows, then those of the shared table that are choices.
 * @return NULL past the end
 */
const nook_param *nook_setting_param_at(const struct nook_ao_technique *technique, size_t index, bool *out_shared);

/** The value of a row of the technique's or the shared table: what the setting says, else the initial one. */
double nook_setting_get(const nook_setting *setting, const nook_param *param);

/** Whether several volumes multiply their visibilities (volume.combine, volume.path), as a plan must know. */
bool nook_setting_multiplies(const nook_setting *setting);
/** The same of values of volume.combine and volume.path. */
bool nook_setting_values_multiply(double combine, double path);

/**
 * After code was loaded anew, while the old one is still there: points to the technique and the parameters that have the
 * same names now; those that are gone are left out, and values are brought into their range.
 */
void nook_setting_renew(nook_setting *setting);

/**
 * Chooses the technique and puts every parameter of it and every shared one, but r_max and falloff, to what the setting says.
 * The resolution is not applied: that is nook_stage_fill's.
 */
nook_result nook_setting_apply(nook_ao *ao, const nook_setting *setting);
