#include "game/live/scene_reload.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/platform/file_watch.h"
#include "game/live/scene_loading.h"
#include <assert.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_CAPACITY = PATH_MAX, LINE_CAPACITY = 1024 };

/* Files are known by their full path without the slash in front, as a watch of "/" tells them. */
typedef struct file_list {
    char **paths;
    size_t count;
} file_list;

struct nook_scene_reload {
    nook_stage *stage;
    bool is_level;
    char level[PATH_CAPACITY], cache[PATH_CAPACITY];
    nook_game_world_desc volumes;
    bool multiplies; /* as the volumes are planned */
    file_list files, folders;
    nook_file_watch *watch;   /* of the folders */
    nook_scene_loading *load; /* NULL: nothing is under way */
    nook_loaded_scene waiting;
    bool changed; /* since the load under way began */
    double changed_ms;
    char error[LINE_CAPACITY];
    nook_scene_reload_status status;
};

/* ---- files --------------------------------------------------------------------------------------------------------- */

static void free_list(file_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free(list->paths[i]);
    free(list->paths);
    *list = (file_list){ 0 };
}

static bool has_path(const file_list *list, const char *path)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->paths[i], path) == 0)
            return true;
    return false;
}

static bool add_path(file_list *list, const char *path)
{
    if (has_path(list, path))
        return true;
    char *copy = strdup(path);
    char **paths = copy ? realloc(list->paths, (list->count + 1) * sizeof *paths) : NULL;
    if (!paths) {
        free(copy);
        return false;
    }
    list->paths = paths;
    list->paths[list->count++] = copy;
    return true;
}

/* The full path of a file's folder. @return false: there is none */
static bool find_folder(const char *path, char out[PATH_CAPACITY])
{
    char folder[PATH_CAPACITY];
    size_t length = (size_t)(nook_path_name(path) - path);
    snprintf(folder, sizeof folder, "%.*s", (int)length, path);
    return realpath(length > 0 ? folder : ".", out) != NULL;
}

/* Adds a file as it was opened to one list, and its folder to the other. Folders that are gone are left out. */
static bool add_file(const char *path, file_list *files, file_list *folders)
{
    char folder[PATH_CAPACITY], full[PATH_CAPACITY];
    if (!find_folder(path, folder))
        return true;
    int length = snprintf(full, sizeof full, "%s/%s", folder + 1, nook_path_name(path));
    return length < (int)sizeof full && add_path(files, full) && add_path(folders, folder + 1);
}

static bool same_paths(const file_list *a, const file_list *b)
{
    bool same = a->count == b->count;
    for (size_t i = 0; i < a->count && same; i++)
        same = has_path(b, a->paths[i]);
    return same;
}

/* A watch of other folders. What the old one has not told yet is lost, so that everything counts as changed. */
static nook_result watch_folders(nook_scene_reload *self, const file_list *folders)
{
    nook_file_watch *watch = NULL;
    const nook_file_watch_desc desc = {
        .root = "/", .folders = (const char *const *)folders->paths, .folder_count = folders->count, .flat = true
    };
    if (folders->count == 0)
        return nook_fail(NOOK_E_NOT_FOUND, "%s: was not read from a file that can be watched",
                         self->stage->scene->path);
    nook_result result = nook_file_watch_create(&desc, &watch);
    if (result != NOOK_OK)
        return result;
    self->changed = self->watch != NULL;
    nook_file_watch_destroy(self->watch);
    self->watch = watch;
    return NOOK_OK;
}

/* Watches what the stage's scene is made of now. */
static nook_result watch_files(nook_scene_reload *self)
{
    file_list files = { 0 }, folders = { 0 };
    const nook_scene *scene = self->stage->scene;
    bool listed = !self->is_level || add_file(self->level, &files, &folders);
    for (uint32_t i = 0; i < scene->file_count && listed; i++)
        listed = add_file(scene->files[i], &files, &folders);
    nook_result result = listed ? NOOK_OK : nook_fail(NOOK_E_MEMORY, "%s: no memory to watch it", scene->path);
    if (result == NOOK_OK && !(self->watch && same_paths(&folders, &self->folders)))
        result = watch_folders(self, &folders);
    file_list *rest_files = result == NOOK_OK ? &self->files : &files;
    file_list *rest_folders = result == NOOK_OK ? &self->folders : &folders;
    free_list(rest_files);
    free_list(rest_folders);
    if (result == NOOK_OK) {
        self->files = files;
        self->folders = folders;
    }
    return result;
}

static void on_change(void *user, const char *path)
{
    nook_scene_reload *self = user;
    bool folder_is_gone = false;
    for (size_t i = 0; i < self->files.count; i++) {
        size_t length = strlen(path);
        folder_is_gone =
            folder_is_gone || (strncmp(self->files.paths[i], path, length) == 0 && self->files.paths[i][length] == '/');
    }
    if (!folder_is_gone && !has_path(&self->files, path))
        return;
    self->changed = true;
}

/* ---- life ---------------------------------------------------------------------------------------------------------- */

nook_result nook_scene_reload_create(nook_stage *stage, const char *level, nook_scene_reload **out_reload)
{
    *out_reload = NULL;
    assert(stage->filled);
    nook_scene_reload *self = calloc(1, sizeof *self);
    if (!self)
        return nook_fail(NOOK_E_MEMORY, "scene: no memory to watch it");
    const char *cache = stage->volumes.cache;
    self->stage = stage;
    self->is_level = level != NULL;
    snprintf(self->level, sizeof self->level, "%s", level ? level : "");
    snprintf(self->cache, sizeof self->cache, "%s", cache ? cache : "");
    self->volumes = stage->volumes;
    self->volumes.cache = cache ? self->cache : NULL;
    self->multiplies = nook_game_world_multiplies(stage->ao);
    self->status.error = self->error;
    nook_result result = watch_files(self);
    if (result != NOOK_OK) {
        nook_scene_reload_destroy(self);
        return result;
    }
    *out_reload = self;
    return NOOK_OK;
}

/* Ends the load under way, whatever it gives. */
static void drop_load(nook_scene_reload *self)
{
    nook_loaded_scene loaded;
    char why[LINE_CAPACITY];
    if (!self->load)
        return;
    if (nook_scene_loading_finish(self->load, &loaded, why, sizeof why) == NOOK_OK)
        nook_loaded_scene_free(&loaded);
    self->load = NULL;
}

void nook_scene_reload_destroy(nook_scene_reload *self)
{
    if (!self)
        return;
    drop_load(self);
    nook_loaded_scene_free(&self->waiting);
    nook_file_watch_destroy(self->watch);
    free_list(&self->files);
    free_list(&self->folders);
    free(self);
}

void nook_scene_reload_wait(nook_scene_reload *self)
{
    if (!self->load)
        return;
    drop_load(self);
    self->changed = true; /* the next poll begins again */
    self->status.loading = false;
}

const nook_scene_reload_status *nook_scene_reload_status_of(const nook_scene_reload *self)
{
    return &self->status;
}

/* ---- frames -------------------------------------------------------------------------------------------------------- */

void nook_scene_reload_plan_for(nook_scene_reload *self, bool multiplies)
{
    if (self->multiplies == multiplies)
        return;
    self->multiplies = multiplies;
    if (self->stage->plan.mode != NOOK_PLAN_MEASURED || self->stage->live_scene)
        return; /* what is proven holds for both */
    self->changed = true;
    self->changed_ms = nook_clock_ms();
}

static void start_load(nook_scene_reload *self)
{
    const nook_scene_loading_desc desc = { .path = self->is_level ? self->level : self->stage->scene->path,
                                           .is_level = self->is_level,
                                           .moment = self->stage->moment,
                                           .resolution = self->volumes.resolution,
                                           .r_max = self->volumes.r_max,
                                           .kinds = nook_game_world_kinds(self->stage->world),
                                           .cache = self->volumes.cache,
                                           .shown = self->stage->scene,
                                           .plan = { self->stage->plan, self->stage->plays, self->multiplies },
                                           .live = self->stage->live_scene,
                                           .streams = self->stage->stream != NULL,
                                           .unreadable_most = nook_scene_unreadable_images(self->stage->scene) };
    nook_loaded_scene_free(&self->waiting);
    self->changed = false;
    nook_log_keep_errors(self->error, sizeof self->error);
    if (nook_scene_loading_start(&desc, &self->load) != NOOK_OK)
        self->status.failures++;
    nook_log_keep_errors(NULL, 0);
}

static void finish_load(nook_scene_reload *self)
{
    nook_scene_loading *load = self->load;
    self->load = NULL;
    if (nook_scene_loading_finish(load, &self->waiting, self->error, sizeof self->error) != NOOK_OK)
        self->status.failures++;
}

bool nook_scene_reload_poll(nook_scene_reload *self)
{
    bool was_changed = self->changed;
    nook_file_watch_poll(self->watch, on_change, self);
    if (self->changed && !was_changed)
        self->changed_ms = nook_file_watch_changed_ms(self->watch);
    if (self->load && nook_scene_loading_is_done(self->load)) {
        if (self->changed)
            drop_load(self); /* what it read is not what is there now */
        else
            finish_load(self);
    }
    if (self->changed && !self->load)
        start_load(self);
    self->status.loading = self->load != NULL;
    return self->waiting.scene != NULL;
}

static nook_result swap(nook_scene_reload *self, nook_scene_go_on go_on, void *game)
{
    nook_stage_scene made, before;
    double start = nook_clock_ms();
    nook_result result = nook_stage_scene_upload(self->stage, self->waiting.scene, &self->waiting.volumes, &made);
    if (result != NOOK_OK)
        return result;
    self->waiting.scene = NULL;
    if (go_on) {
        assert(self->is_level);
        result = go_on(game, self->waiting.level, made.scene, made.world);
        self->waiting.level = NULL;
    }
    if (result != NOOK_OK) {
        nook_stage_scene_destroy(&made);
        return result;
    }
    before = nook_stage_exchange_scene(self->stage, &made);
    nook_stage_scene_destroy(&before);
    self->error[0] = '\0';
    self->status.reloads++;
    self->status.swap_ms = nook_clock_ms() - start;
    self->status.last_ms = nook_clock_ms() - self->changed_ms;
    nook_log_info("scene: %s reloaded, %.0f ms after the change", self->stage->scene->path, self->status.last_ms);
    return NOOK_OK;
}

nook_result nook_scene_reload_swap(nook_scene_reload *self, nook_scene_go_on go_on, void *game)
{
    assert(self->waiting.scene);
    nook_log_keep_errors(self->error, sizeof self->error);
    nook_result result = swap(self, go_on, game);
    nook_log_keep_errors(NULL, 0);
    nook_loaded_scene_free(&self->waiting);
    if (result != NOOK_OK)
        self->status.failures++;
    else if (watch_files(self) != NOOK_OK) /* the old watch goes on */
        nook_log_warning("scene: files that are new in it are not watched");
    return result;
}
