#include "game/live/shader_reload.h"
#include "engine/core/clock.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/platform/file_watch.h"
#include <stdlib.h>
#include <string.h>

struct nook_shader_reload {
    nook_gpu *gpu;
    nook_file_watch *watch;
    char **changed; /* owned, as are the paths: of the poll under way */
    size_t changed_count, changed_capacity;
    bool lost; /* a change that there was no memory for: everything is reloaded */
    nook_shader_report report;
    nook_shader_status status;
};

static nook_result open_watch(const char *root, nook_file_watch **out_watch)
{
    char modules[4096];
    static const char *const folders[] = { "shaders", "modules" };
    bool has_modules = nook_directory_exists(nook_path_join(modules, sizeof modules, root, folders[1]));
    const nook_file_watch_desc desc = { .root = root, .folders = folders, .folder_count = has_modules ? 2 : 1 };
    return nook_file_watch_create(&desc, out_watch);
}

nook_result nook_shader_reload_create(nook_gpu *gpu, nook_shader_reload **out_reload)
{
    *out_reload = NULL;
    nook_shader_reload *self = calloc(1, sizeof *self);
    if (!self)
        return nook_fail(NOOK_E_MEMORY, "shaders: no memory to watch them");
    nook_result result = open_watch(nook_gpu_source_root(gpu), &self->watch);
    if (result != NOOK_OK) {
        free(self);
        return result;
    }
    self->gpu = gpu;
    self->status.error = self->report.text;
    *out_reload = self;
    return NOOK_OK;
}

static void forget_changes(nook_shader_reload *self)
{
    for (size_t i = 0; i < self->changed_count; i++)
        free(self->changed[i]);
    self->changed_count = 0;
    self->lost = false;
}

void nook_shader_reload_destroy(nook_shader_reload *self)
{
    if (!self)
        return;
    nook_file_watch_destroy(self->watch);
    forget_changes(self);
    free(self->changed);
    free(self);
}

/* Not of modules: their code is none of our business, and what failed is tried again with every change that is. */
static bool concerns_shaders(const char *path)
{
    return strncmp(path, "shaders", 7) == 0 || strcmp(nook_path_extension(path), ".def") == 0;
}

static bool reserve(nook_shader_reload *self)
{
    if (self->changed_count < self->changed_capacity)
        return true;
    size_t capacity = self->changed_capacity ? 2 * self->changed_capacity : 16;
    char **changed = realloc(self->changed, capacity * sizeof *changed);
    if (!changed)
        return false;
    self->changed = changed;
    self->changed_capacity = capacity;
    return true;
}

static void keep_change(void *user, const char *path)
{
    nook_shader_reload *self = user;
    if (!concerns_shaders(path))
        return;
    char *copy = reserve(self) ? strdup(path) : NULL;
    if (copy)
        self->changed[self->changed_count++] = copy;
    else
        self->lost = true;
}

/* One of the changes, for the log: a shader rather than what an editor leaves beside it. */
static const char *some_change(const nook_shader_reload *self)
{
    for (size_t i = 0; i < self->changed_count; i++)
        if (strcmp(nook_path_extension(self->changed[i]), ".glsl") == 0)
            return self->changed[i];
    return self->changed_count > 0 ? self->changed[0] : "all";
}

static void reload(nook_shader_reload *self)
{
    nook_shader_status *status = &self->status;
    nook_gpu_reload_shaders(self->gpu, self->lost ? NULL : (const char *const *)self->changed, self->changed_count,
                            &self->report);
    status->failures += self->report.failed > 0;
    if (self->report.reloaded == 0)
        return;
    status->reloads += self->report.reloaded;
    status->last_ms = nook_clock_ms() - nook_file_watch_changed_ms(self->watch);
    status->building_ms = self->report.ms;
    nook_log_info("shaders: %u %s reloaded, %.0f ms after the change (%s%s)", self->report.reloaded,
                  self->report.reloaded == 1 ? "program" : "programs", status->last_ms, some_change(self),
                  self->changed_count > 1 ? ", ..." : "");
}

/* What was saved a moment ago is waited for here: shorter than a picture without it. Once, so that changes without end do not stop frames. */
static void take_changes(nook_shader_reload *self)
{
    double left = nook_file_watch_poll(self->watch, keep_change, self) ? 0.0 : nook_file_watch_settling_ms(self->watch);
    if (left <= 0.0)
        return;
    nook_clock_rest(left);
    nook_file_watch_poll(self->watch, keep_change, self);
}

bool nook_shader_reload_poll(nook_shader_reload *self)
{
    uint32_t reloads = self->status.reloads, failed = self->status.failed, failures = self->status.failures;
    take_changes(self);
    if (self->changed_count > 0 || self->lost)
        reload(self);
    else
        nook_gpu_shader_report(self->gpu, &self->report); /* programs that were first asked for since */
    forget_changes(self);
    self->status.failed = self->report.failed;
    return self->status.reloads != reloads || self->status.failed != failed || self->status.failures != failures;
}

const nook_shader_status *nook_shader_reload_status(const nook_shader_reload *self)
{
    return &self->status;
}
