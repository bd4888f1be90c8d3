#include "game/option_rows.h"
#include "engine/core/file.h"
#include "game/techniques.h"
#include "modules/bake/voxelize.h"

enum { SIDE_MAX = 16384, RAYS_MAX = 65536 };

const char nook_option_r_max_help[] = "reach of the occlusion in metres; default: a tenth of the scene's diagonal";

static bool read_backend(void *target, const char *text)
{
    return nook_backend_parse(text, target);
}

nook_option nook_option_row_int(const char *name, int32_t *target, int32_t lowest, int32_t highest, const char *help)
{
    return (nook_option){ .name = name,
                          .kind = NOOK_OPTION_INT,
                          .target = target,
                          .placeholder = "N",
                          .help = help,
                          .lowest = lowest,
                          .highest = highest };
}

nook_option nook_option_row_flag(const char *name, bool *target, const char *help)
{
    return (nook_option){ .name = name, .kind = NOOK_OPTION_FLAG, .target = target, .help = help };
}

nook_option nook_option_row_text(const char *name, const char **target, const char *placeholder, const char *help)
{
    return (nook_option){
        .name = name, .kind = NOOK_OPTION_TEXT, .target = target, .placeholder = placeholder, .help = help
    };
}

nook_option nook_option_row_cpu(bool *target)
{
    return nook_option_row_flag(
        "cpu", target, "time that all threads have computed, which a busy machine stretches less; software GL only");
}

nook_option nook_option_row_from(double *target, const char *help)
{
    return (nook_option){ .name = "from",
                          .kind = NOOK_OPTION_NUMBER,
                          .target = target,
                          .placeholder = "SECONDS",
                          .lowest = 0.0,
                          .highest = 86400.0,
                          .help = help };
}

nook_option nook_option_row_backend(nook_backend *target)
{
    return (nook_option){ .name = "backend",
                          .kind = NOOK_OPTION_CUSTOM,
                          .target = target,
                          .placeholder = "NAME",
                          .read = read_backend,
                          .expects = "window, osmesa, egl or auto",
                          .help = "window, osmesa or egl; default: what this machine has" };
}

nook_option nook_option_row_size(nook_option_size *target, const char *help)
{
    return (nook_option){ .name = "size",
                          .kind = NOOK_OPTION_SIZE,
                          .target = target,
                          .placeholder = "WxH",
                          .help = help,
                          .lowest = 1,
                          .highest = SIDE_MAX };
}

nook_option nook_option_row_r_max(double *target, const char *help)
{
    const nook_param *r_max = nook_shared_param("r_max");
    return (nook_option){ .name = "r-max",
                          .kind = NOOK_OPTION_NUMBER,
                          .target = target,
                          .placeholder = "M",
                          .help = help,
                          .lowest = r_max->lowest,
                          .highest = r_max->highest };
}

nook_option nook_option_row_falloff(const char **target)
{
    return nook_option_row_text("falloff", target, "NAME", "hard, linear, quadratic, wendland or exponential");
}

nook_option nook_option_row_techniques(const char **target, const char *help)
{
    return nook_option_row_text("techniques", target, "a,b,c", help);
}

nook_option nook_option_row_settings(const char **target, const char *help)
{
    return nook_option_row_text("settings", target, "FILE", help);
}

nook_option nook_option_row_reference_rays(int32_t *target, int32_t lowest, const char *help)
{
    return nook_option_row_int("reference-rays", target, lowest, RAYS_MAX, help);
}

nook_option nook_option_row_resolution(int32_t *target, const char *help)
{
    return nook_option_row_int("resolution", target, 1, NOOK_VOXELIZE_RESOLUTION_MAX, help);
}

nook_option nook_option_row_cache(const char **target, const char *help)
{
    return nook_option_row_text("cache", target, "DIR", help);
}

nook_option nook_option_row_json_file(const char **target)
{
    return nook_option_row_text("out", target, "FILE", "also write everything as JSON");
}

nook_option nook_option_row_json(bool *target, const char *help)
{
    return nook_option_row_flag("json", target, help);
}

const char *nook_option_default_scene(const nook_app *app, char out[NOOK_OPTION_PATH_MAX])
{
    return nook_path_join(out, NOOK_OPTION_PATH_MAX, app->root, "content/hall/hall.glb");
}

const char *nook_option_default_cache(const nook_app *app, char out[NOOK_OPTION_PATH_MAX])
{
    return nook_path_join(out, NOOK_OPTION_PATH_MAX, app->root, "cache");
}
