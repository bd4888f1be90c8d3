#include "game/compare/output.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/interrupt.h"
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- Folders ---------------------------------------------------------------------------------------------------- */

typedef nook_result (*visit_file)(const nook_output *output, const char *name, void *user);

static int is_entry(const struct dirent *entry)
{
    return strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
}

/* Calls `visit` for every entry until it fails. The list is whole before the first call, which may change the folder. */
static nook_result visit_folder(const nook_output *output, const char *folder, visit_file visit, void *user)
{
    struct dirent **entries;
    int count = scandir(folder, &entries, is_entry, NULL);
    if (count < 0)
        return nook_fail(NOOK_E_IO, "%s: cannot read: %s", folder, strerror(errno));
    nook_result result = NOOK_OK;
    for (int i = 0; i < count; i++) {
        if (result == NOOK_OK)
            result = visit(output, entries[i]->d_name, user);
        free(entries[i]);
    }
    free(entries);
    return result;
}

static const char *final_path(const nook_output *output, const char *name, char out[NOOK_OUTPUT_PATH_MAX])
{
    return nook_path_join(out, NOOK_OUTPUT_PATH_MAX, output->folder, name);
}

const char *nook_output_path(const nook_output *output, const char *name, char out[NOOK_OUTPUT_PATH_MAX])
{
    return nook_path_join(out, NOOK_OUTPUT_PATH_MAX, output->staging, name);
}

bool nook_output_interrupted(void)
{
    return nook_interrupt_asked();
}

nook_result nook_output_prepare(const char *folder)
{
    char probe[NOOK_OUTPUT_PATH_MAX];
    nook_result result = nook_directory_make(folder);
    if (result != NOOK_OK)
        return result;
    FILE *file = fopen(nook_path_join(probe, sizeof probe, folder, ".nook_probe"), "wb");
    if (!file)
        return nook_fail(NOOK_E_IO, "%s: no file can be made in it (%s); give another folder by --out", folder,
                         strerror(errno));
    fclose(file);
    unlink(probe);
    return NOOK_OK;
}

nook_result nook_output_open(const char *folder, nook_output *out_output)
{
    nook_output output;
    char hidden[32];
    if (strlen(folder) >= sizeof output.folder - 300) /* room for the names of files */
        return nook_fail(NOOK_E_IO, "%s: the path is too long", folder);
    snprintf(output.folder, sizeof output.folder, "%s", folder);
    snprintf(hidden, sizeof hidden, ".tmp-%ld", (long)getpid());
    nook_path_join(output.staging, sizeof output.staging, folder, hidden);
    nook_result result = nook_directory_make(output.staging);
    if (result != NOOK_OK)
        return result;
    nook_interrupt_hold();
    *out_output = output;
    return NOOK_OK;
}

/* ---- Putting in place ------------------------------------------------------------------------------------------- */

static nook_result check_place(const nook_output *output, const char *name, void *user)
{
    (void)user;
    char path[NOOK_OUTPUT_PATH_MAX];
    if (nook_directory_exists(final_path(output, name, path)))
        return nook_fail(NOOK_E_IO, "%s: is a directory where a file belongs; move it away or give another --out",
                         path);
    return NOOK_OK;
}

/* What decides over a file of the run before. */
typedef struct old_run {
    bool (*ours)(void *user, const char *name);
    void *user;
} old_run;

static nook_result remove_old(const nook_output *output, const char *name, void *user)
{
    const old_run *old = user;
    char path[NOOK_OUTPUT_PATH_MAX];
    if (!old->ours(old->user, name) || nook_file_exists(nook_output_path(output, name, path)))
        return NOOK_OK;
    if (nook_file_exists(final_path(output, name, path)) && unlink(path) != 0)
        return nook_fail(NOOK_E_IO, "%s: cannot remove: %s", path, strerror(errno));
    return NOOK_OK;
}

static nook_result place(const nook_output *output, const char *name)
{
    char from[NOOK_OUTPUT_PATH_MAX], to[NOOK_OUTPUT_PATH_MAX];
    if (rename(nook_output_path(output, name, from), final_path(output, name, to)) != 0)
        return nook_fail(NOOK_E_IO, "%s: cannot write: %s", to, strerror(errno));
    return NOOK_OK;
}

static nook_result place_unless_index(const nook_output *output, const char *name, void *user)
{
    return strcmp(name, user) == 0 ? NOOK_OK : place(output, name);
}

static nook_result place_all(const nook_output *output, const char *index, old_run *old)
{
    char path[NOOK_OUTPUT_PATH_MAX], last[256];
    nook_result result = visit_folder(output, output->staging, check_place, NULL);
    if (result == NOOK_OK && nook_file_exists(final_path(output, index, path))) {
        if (unlink(path) != 0)
            return nook_fail(NOOK_E_IO, "%s: cannot replace: %s", path, strerror(errno));
        if (old->ours)
            result = visit_folder(output, output->folder, remove_old, old);
    }
    snprintf(last, sizeof last, "%s", index);
    if (result == NOOK_OK)
        result = visit_folder(output, output->staging, place_unless_index, last);
    return result == NOOK_OK ? place(output, index) : result;
}

nook_result nook_output_commit(nook_output *output, const char *index, bool (*ours)(void *user, const char *name),
                               void *user)
{
    old_run old = { ours, user };
    nook_result result = place_all(output, index, &old);
    nook_output_discard(output);
    return result;
}

static nook_result remove_staged(const nook_output *output, const char *name, void *user)
{
    (void)user;
    char path[NOOK_OUTPUT_PATH_MAX];
    unlink(nook_output_path(output, name, path));
    return NOOK_OK;
}

void nook_output_discard(nook_output *output)
{
    visit_folder(output, output->staging, remove_staged, NULL);
    rmdir(output->staging);
    *output = (nook_output){ .folder = "" };
    nook_interrupt_release();
}
