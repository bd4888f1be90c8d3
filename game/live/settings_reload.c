#include "game/live/settings_reload.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/platform/file_watch.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PATH_SIZE = 1024 };

struct nook_settings_reload {
    nook_file_watch *watch;
    char path[PATH_SIZE], error[PATH_SIZE];
    bool changed; /* in this poll */
    bool asked;   /* for the next */
};

/* The folder of a path: "." when it has none. */
static void folder_of(const char *path, char out[PATH_SIZE])
{
    const char *name = nook_path_name(path);
    size_t length = (size_t)(name - path);
    snprintf(out, PATH_SIZE, "%.*s", (int)length, path);
    if (length == 0)
        snprintf(out, PATH_SIZE, ".");
}

nook_result nook_settings_reload_create(const char *path, nook_settings_reload **out_reload)
{
    char folder[PATH_SIZE];
    *out_reload = NULL;
    nook_settings_reload *reload = calloc(1, sizeof *reload);
    if (!reload)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to watch it", path);
    snprintf(reload->path, sizeof reload->path, "%s", path);
    folder_of(path, folder);
    const nook_file_watch_desc watch = { .root = folder, .flat = true };
    nook_result result = nook_file_watch_create(&watch, &reload->watch);
    if (result != NOOK_OK) {
        free(reload);
        return result;
    }
    *out_reload = reload;
    return NOOK_OK;
}

void nook_settings_reload_destroy(nook_settings_reload *reload)
{
    if (!reload)
        return;
    nook_file_watch_destroy(reload->watch);
    free(reload);
}

static void look_for(void *user, const char *changed)
{
    nook_settings_reload *reload = user;
    reload->changed = reload->changed || strcmp(changed, nook_path_name(reload->path)) == 0;
}

void nook_settings_reload_ask(nook_settings_reload *reload)
{
    reload->asked = true;
}

bool nook_settings_reload_poll(nook_settings_reload *reload, nook_settings_file *out)
{
    reload->changed = reload->asked;
    reload->asked = false;
    nook_file_watch_poll(reload->watch, look_for, reload);
    if (!reload->changed)
        return false;
    reload->error[0] = '\0'; /* of the save before */
    nook_log_keep_errors(reload->error, sizeof reload->error);
    nook_result result = nook_settings_file_read(reload->path, out);
    nook_log_keep_errors(NULL, 0);
    return result == NOOK_OK;
}

const char *nook_settings_reload_error(const nook_settings_reload *reload)
{
    return reload->error;
}
