/* nook info: what a scene or a volume file holds, as loaded. */
#include "engine/asset/scene.h"
#include "engine/core/file.h"
#include "engine/core/json.h"
#include "game/commands/commands.h"
#include "game/commands/info_scalar.h"
#include "game/option_rows.h"
#include "modules/ao/residency.h"
#include "modules/bake/volume_file.h"
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/** A number with its name: the same word in the text and in the JSON. */
typedef struct fact {
    const char *name;
    uint64_t value;
} fact;

static uint32_t count_bodies(const nook_scene *scene)
{
    uint32_t bodies = 0;
    for (uint32_t i = 0; i < scene->node_count; i++)
        bodies += scene->nodes[i].moving && scene->nodes[i].mesh != NOOK_NONE;
    return bodies;
}

static void print_numbers(const char *name, const double *values, size_t count)
{
    printf("%-12s", name);
    for (size_t i = 0; i < count; i++)
        printf(" %.6g", values[i]);
    printf("\n");
}

/* What kinds of light there are, by nook_light_kind. */
static const char *const light_kinds[] = { "directional", "point", "spot" };

static void count_lights(const nook_scene *scene, uint32_t out_counts[NOOK_COUNT(light_kinds)])
{
    memset(out_counts, 0, NOOK_COUNT(light_kinds) * sizeof *out_counts);
    for (uint32_t i = 0; i < scene->light_count; i++)
        out_counts[scene->lights[i].kind]++;
}

static void print_lights(const nook_scene *scene)
{
    uint32_t counts[NOOK_COUNT(light_kinds)];
    count_lights(scene, counts);
    printf("%-12s", "light_kinds");
    for (size_t i = 0; i < NOOK_COUNT(light_kinds); i++)
        printf("%s %u %s", i ? "," : "", counts[i], light_kinds[i]);
    printf("\n");
}

/* One line each: what --camera takes. */
static void print_cameras(const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->camera_count; i++)
        printf("%-12s %s%s\n", "camera", *scene->cameras[i].name ? scene->cameras[i].name : "without a name",
               scene->cameras[i].perspective ? "" : " (orthographic: compare cannot use it)");
}

/* One line each: what --clip takes. */
static void print_clips(const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->clip_count; i++)
        printf("%-12s %.6g s, %u tracks, %s\n", "clip", scene->clips[i].duration, scene->clips[i].track_count,
               *scene->clips[i].name ? scene->clips[i].name : "without a name");
}

static void add_clips(nook_json *json, const nook_scene *scene)
{
    nook_json_key(json, "clips");
    nook_json_begin_array(json);
    for (uint32_t i = 0; i < scene->clip_count; i++) {
        nook_json_begin_object(json);
        nook_json_member_string(json, "name", scene->clips[i].name);
        nook_json_member_number(json, "seconds", scene->clips[i].duration);
        nook_json_member_integer(json, "tracks", scene->clips[i].track_count);
        nook_json_end_object(json);
    }
    nook_json_end_array(json);
}

static void add_lights_and_cameras(nook_json *json, const nook_scene *scene)
{
    uint32_t counts[NOOK_COUNT(light_kinds)];
    count_lights(scene, counts);
    nook_json_key(json, "light_kinds");
    nook_json_begin_object(json);
    for (size_t i = 0; i < NOOK_COUNT(light_kinds); i++)
        nook_json_member_integer(json, light_kinds[i], counts[i]);
    nook_json_end_object(json);
    nook_json_key(json, "camera_names");
    nook_json_begin_array(json);
    for (uint32_t i = 0; i < scene->camera_count; i++)
        nook_json_string(json, scene->cameras[i].name);
    nook_json_end_array(json);
}

static int print_json(nook_json *json)
{
    nook_result result = nook_json_print(json, stdout);
    nook_json_free(json);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

static int print_scene_json(const nook_scene *scene, const fact *facts, size_t fact_count, bool empty)
{
    nook_json json = { 0 };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "path", scene->path);
    nook_json_member_string(&json, "kind", "scene");
    for (size_t i = 0; i < fact_count; i++)
        nook_json_member_integer(&json, facts[i].name, (int64_t)facts[i].value);
    add_lights_and_cameras(&json, scene);
    add_clips(&json, scene);
    nook_json_key(&json, "bounds_min");
    empty ? nook_json_null(&json) : nook_json_numbers(&json, scene->bounds_min, 3);
    nook_json_key(&json, "bounds_max");
    empty ? nook_json_null(&json) : nook_json_numbers(&json, scene->bounds_max, 3);
    nook_json_key(&json, "warnings");
    nook_json_begin_array(&json);
    for (uint32_t i = 0; i < scene->warning_count; i++)
        nook_json_string(&json, scene->warnings[i]);
    nook_json_end_array(&json);
    nook_json_end_object(&json);
    return print_json(&json);
}

static int print_scene(const nook_scene *scene, bool as_json)
{
    const fact facts[] = {
        { "triangles", scene->triangle_count },
        { "vertices", scene->vertex_count },
        { "nodes", scene->file_node_count },
        { "nodes_drawn", scene->node_count },
        { "meshes", scene->mesh_count },
        { "primitives", scene->primitive_count },
        { "materials", scene->material_count - 1 }, /* without glTF's default one */
        { "images", scene->image_count },
        { "lights", scene->light_count },
        { "cameras", scene->camera_count },
        { "skins", scene->skin_count },
        { "animations", scene->clip_count },
        { "deformables", scene->deformable_count },
        { "bodies", count_bodies(scene) },
        { "densities", scene->density_count },
    };
    bool empty = scene->bounds_min[0] > scene->bounds_max[0];
    if (as_json)
        return print_scene_json(scene, facts, NOOK_COUNT(facts), empty);
    printf("%-12s %s\n", "path", scene->path);
    for (size_t i = 0; i < NOOK_COUNT(facts); i++)
        printf("%-12s %" PRIu64 "\n", facts[i].name, facts[i].value);
    print_lights(scene);
    print_cameras(scene);
    print_clips(scene);
    if (empty) {
        printf("%-12s %s\n", "bounds", "nothing is drawn");
    } else {
        print_numbers("bounds_min", scene->bounds_min, 3);
        print_numbers("bounds_max", scene->bounds_max, 3);
    }
    printf("%-12s %u\n", "warnings", scene->warning_count); /* their lines were logged as they came up */
    return NOOK_EXIT_OK;
}

static int show_scene(const char *path, bool as_json)
{
    nook_scene *scene;
    if (nook_scene_load(path, NULL, &scene) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    int exit_code = print_scene(scene, as_json);
    nook_scene_destroy(scene);
    return exit_code;
}

static int print_volume(const char *path, const nook_volume_info *info, size_t file_size, bool as_json)
{
    const uint64_t bytes = nook_volume_gpu_bytes(info);
    char kind[32];
    snprintf(kind, sizeof kind, "%s volume", nook_volume_kind_name(info->kind));
    if (!as_json) {
        printf("%-12s %s\n%-12s %s\n", "path", path, "kind", kind);
        printf("%-12s %u %u %u\n", "size", info->width, info->height, info->depth);
        printf("%-12s %" PRIu64 "\n%-12s %zu\n", "bytes", bytes, "file_bytes", file_size);
        printf("%-12s %.6g m\n", "voxel_size", info->voxel_size);
        print_numbers("origin", info->origin, 3);
        printf("%-12s %" PRIu64 "\n", "occupied", info->occupied);
        return NOOK_EXIT_OK;
    }
    nook_json json = { 0 };
    const double size[3] = { info->width, info->height, info->depth };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "path", path);
    nook_json_member_string(&json, "kind", kind);
    nook_json_key(&json, "size");
    nook_json_numbers(&json, size, 3);
    nook_json_member_integer(&json, "bytes", (int64_t)bytes);
    nook_json_member_integer(&json, "file_bytes", (int64_t)file_size);
    nook_json_member_number(&json, "voxel_size", info->voxel_size);
    nook_json_key(&json, "origin");
    nook_json_numbers(&json, info->origin, 3);
    nook_json_member_integer(&json, "occupied", (int64_t)info->occupied);
    nook_json_end_object(&json);
    return print_json(&json);
}

/* Decodes it whole: a header alone would call a damaged file good. */
static int show_volume(const char *path, bool as_json)
{
    nook_file file;
    nook_volume volume = { 0 };
    if (nook_file_read(path, &file) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    nook_result result = nook_volume_decode(path, file.bytes, file.size, &volume);
    int exit_code = result == NOOK_OK ? print_volume(path, &volume.info, file.size, as_json) : NOOK_EXIT_FAILED;
    nook_volume_free(&volume);
    nook_file_free(&file);
    return exit_code;
}

int nook_command_info(const nook_app *app, int argc, char **argv)
{
    (void)app;
    bool as_json = false;
    const nook_option options[] = {
        nook_option_row_json(&as_json, "print one JSON object"),
    };
    const nook_usage usage = { .command = "info",
                               .summary =
                                   "Says what a scene (.gltf, .glb), a baked volume (.nkv) or a scalar volume (.nrrd,\n"
                                   ".nhdr) holds, as loaded. "
                                   "Fails with the reason when the file is refused.",
                               .positionals = "FILE",
                               .positional_min = 1,
                               .positional_max = 1,
                               .options = options,
                               .option_count = NOOK_COUNT(options) };
    nook_arguments arguments;
    int exit_code;
    if (!nook_arguments_read(&usage, argc, argv, &arguments, &exit_code))
        return exit_code;
    const char *path = arguments.positionals[0];
    const char *extension = nook_path_extension(path);
    if (strcasecmp(extension, ".nkv") == 0)
        return show_volume(path, as_json);
    if (strcasecmp(extension, ".nrrd") == 0 || strcasecmp(extension, ".nhdr") == 0)
        return nook_info_scalar_volume(path, as_json);
    return show_scene(path, as_json);
}
