/* From saving a shader to the picture that shows it: frames are drawn one after the other, as in a window, while files of a
   copy of the shaders are saved. */
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/order.h"
#include "game/commands/bench_stage.h"
#include "game/commands/benches.h"
#include "game/compare/camera.h"
#include "game/live/shader_reload.h"
#include "game/scratch_folder.h"
#include <dirent.h>
#include <stdlib.h>

enum { SAVES_MAX = 1000, PATH_CAPACITY = 4096 };
static const double patience_ms = 60000.0;

/* What is saved. */
static const char *const files[] = { "shaders/render/lighting.frag.glsl", "shaders/ao/volume.comp.glsl",
                                     "shaders/ao/frame.glsl", "shaders/render/frame.glsl" };

typedef struct reload_options {
    nook_bench_stage_options stage;
    int32_t saves;
} reload_options;

typedef struct reload_times {
    double total[SAVES_MAX];    /* ms, from the rename that saves to the finished picture */
    double building[SAVES_MAX]; /* ms, of that in the driver's compiler and linker */
    double work[SAVES_MAX];     /* ms that all threads have computed for the programs and the first picture with them */
    uint32_t programs;          /* of the last save */
} reload_times;

static bool read_options(const nook_app *app, int argc, char **argv, reload_options *out, int *out_exit_code)
{
    out->saves = 20;
    const nook_option options[] = {
        nook_option_row_int("saves", &out->saves, 1, SAVES_MAX, "of each file; default 20"),
    };
    const nook_usage usage = {
        .command = "bench reload",
        .summary =
            "Times how soon a saved shader is in the picture, on the first camera of a scene, default the demo level.",
        .options = options,
        .option_count = NOOK_COUNT(options),
        .details =
            "Milliseconds of wall time, medians over the saves: from the rename that saves to the end of the first\n"
            "picture with the new program; frames follow each other without a pause. Works on a copy of the\n"
            "shaders, with the driver's cache of compiled shaders switched off, as if what is saved were new.\n"
    };
    return nook_bench_stage_read(app, &usage, argc, argv, &out->stage, out_exit_code);
}

/* A folder with all in it that has no dot in front of its name. */
static nook_result copy_folder(const char *from, const char *to)
{
    char inner_from[PATH_CAPACITY], inner_to[PATH_CAPACITY];
    const struct dirent *entry;
    nook_result result = nook_directory_make(to);
    DIR *directory = opendir(from);
    if (!directory)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: cannot be read; set NOOK_ROOT to the folder of Nook's sources", from);
    while (result == NOOK_OK && (entry = readdir(directory)) != NULL) {
        if (entry->d_name[0] == '.')
            continue;
        nook_path_join(inner_from, sizeof inner_from, from, entry->d_name);
        nook_path_join(inner_to, sizeof inner_to, to, entry->d_name);
        result = nook_directory_exists(inner_from) ? copy_folder(inner_from, inner_to)
                                                   : nook_file_copy(inner_from, inner_to);
    }
    closedir(directory);
    return result;
}

static nook_result copy_root(const char *root, const char *to)
{
    static const char *const folders[] = { "shaders", "modules" };
    char inner_from[PATH_CAPACITY], inner_to[PATH_CAPACITY];
    nook_result result = NOOK_OK;
    for (size_t i = 0; i < NOOK_COUNT(folders) && result == NOOK_OK; i++)
        result = copy_folder(nook_path_join(inner_from, sizeof inner_from, root, folders[i]),
                             nook_path_join(inner_to, sizeof inner_to, to, folders[i]));
    return result;
}

static nook_result draw(nook_stage *stage, const nook_camera *camera)
{
    nook_result result = nook_stage_begin(stage, camera);
    if (result == NOOK_OK)
        result = nook_stage_occlude(stage);
    if (result == NOOK_OK)
        result = nook_stage_finish(stage, true, NOOK_VIEW_LIT);
    nook_gpu_finish(stage->gpu);
    stage->frame_index++;
    return result;
}

/* Saves the file with one more line, as an editor does. */
static nook_result save(const char *root, const char *name, int32_t number)
{
    char path[PATH_CAPACITY], *text;
    nook_file file;
    nook_result result = nook_file_read(nook_path_join(path, sizeof path, root, name), &file);
    if (result != NOOK_OK)
        return result;
    size_t size = file.size + 32;
    text = malloc(size);
    if (text) {
        int length = snprintf(text, size, "%s\n// %d\n", (const char *)file.bytes, number);
        result = nook_file_write(path, text, (size_t)length);
    } else {
        result = nook_fail(NOOK_E_MEMORY, "%s: no memory", name);
    }
    free(text);
    nook_file_free(&file);
    return result;
}

/* Draws until the saved file is in the picture. */
static nook_result time_save(nook_stage *stage, const nook_camera *camera, nook_shader_reload *reload, int32_t index,
                             reload_times *times)
{
    const nook_shader_status *status = nook_shader_reload_status(reload);
    double start = nook_clock_ms();
    uint32_t before = status->reloads;
    nook_result result = NOOK_OK;
    while (status->reloads == before && result == NOOK_OK) {
        if (nook_clock_ms() - start > patience_ms || status->failed > 0)
            return nook_fail(NOOK_E_DEVICE, "bench reload: the saved shader was not taken (%s)",
                             status->failed > 0 ? status->error : "nothing was seen");
        double cpu = nook_clock_cpu_ms();
        nook_shader_reload_poll(reload);
        result = draw(stage, camera);
        times->work[index] = nook_clock_cpu_ms() - cpu;
    }
    times->total[index] = nook_clock_ms() - start;
    times->building[index] = status->building_ms;
    times->programs = status->reloads - before;
    return result;
}

static void print_times(const char *name, reload_times *times, int32_t count)
{
    size_t saves = (size_t)count;
    double building = nook_median(times->building, saves), work = nook_median(times->work, saves);
    double total = nook_median(times->total, saves); /* leaves them ordered */
    printf("  %-34s %9u %9.0f %9.0f %9.0f %9.0f %9.0f\n", name, times->programs, building, work, total, times->total[0],
           times->total[count - 1]);
}

static nook_result time_files(nook_stage *stage, const nook_camera *camera, const char *root,
                              nook_shader_reload *reload, int32_t saves)
{
    reload_times *times = calloc(1, sizeof *times);
    nook_result result = times ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "bench reload: no memory");
    for (size_t i = 0; i < NOOK_COUNT(files) && result == NOOK_OK; i++) {
        for (int32_t k = 0; k < saves && result == NOOK_OK; k++) {
            result = save(root, files[i], k);
            if (result == NOOK_OK)
                result = time_save(stage, camera, reload, k, times);
        }
        if (result == NOOK_OK)
            print_times(files[i], times, saves);
    }
    free(times);
    return result;
}

/* With what a frame takes without any reload: drivers compile for the first two of them, too. */
static nook_result print_head(const reload_options *options, nook_stage *stage, const nook_camera *camera)
{
    enum { WARM = 2, FRAMES = 5 };
    double ms[WARM + FRAMES], cpu_ms[WARM + FRAMES];
    for (int i = 0; i < WARM + FRAMES; i++) {
        double start = nook_clock_ms(), cpu = nook_clock_cpu_ms();
        nook_result result = draw(stage, camera);
        if (result != NOOK_OK)
            return result;
        ms[i] = nook_clock_ms() - start;
        cpu_ms[i] = nook_clock_cpu_ms() - cpu;
    }
    printf("%s, %u x %u, %s, a frame takes %.0f ms, %.0f ms of processor\n\n"
           "  %-34s %9s %9s %9s %9s %9s %9s\n",
           options->stage.scene, stage->width, stage->height, stage->gpu->renderer, nook_median(ms + WARM, FRAMES),
           nook_median(cpu_ms + WARM, FRAMES), "saved", "programs", "building", "processor", "to screen", "lowest",
           "highest");
    return NOOK_OK;
}

static nook_result run(const reload_options *options, const char *root)
{
    nook_stage stage;
    nook_camera camera;
    nook_shader_reload *reload = NULL;
    char label[128];
    nook_result result = nook_bench_stage_open(&options->stage, root, false, &stage, NULL);
    if (result != NOOK_OK)
        return result;
    result = nook_camera_choose(stage.scene, NULL, (double)stage.width / stage.height, &camera, label, sizeof label);
    if (result == NOOK_OK)
        result = print_head(options, &stage, &camera);
    if (result == NOOK_OK)
        result = nook_shader_reload_create(stage.gpu, &reload);
    if (result == NOOK_OK)
        result = time_files(&stage, &camera, root, reload, options->saves);
    nook_shader_reload_destroy(reload);
    nook_stage_close(&stage);
    return result;
}

int nook_bench_run_reload(const nook_app *app, int argc, char **argv)
{
    reload_options options;
    nook_scratch_folder folder;
    int exit_code;
    if (!read_options(app, argc, argv, &options, &exit_code))
        return exit_code;
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 0); /* read by the driver when its context is made */
    if (nook_scratch_folder_make(&folder) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    nook_result result = copy_root(app->root, folder.path);
    if (result == NOOK_OK)
        result = run(&options, folder.path);
    nook_scratch_folder_remove(&folder);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}
