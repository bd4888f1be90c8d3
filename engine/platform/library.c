#define _GNU_SOURCE /* dladdr, dlinfo */
#include "engine/platform/library.h"
#include "engine/core/file.h"
#include <dlfcn.h>
#include <limits.h>
#include <link.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct nook_library {
    void *handle;
};

static nook_result refuse(nook_library_reason *out_reason, nook_result code, const char *path, const char *why)
{
    snprintf(out_reason->text, sizeof out_reason->text, "%s: %s", path, why);
    return code;
}

/* dlopen says "PATH: what is wrong"; the path is in our line already. */
static const char *loader_reason(const char *path)
{
    const char *reason = dlerror();
    size_t length = strlen(path);
    if (!reason)
        return "the loader refuses it and does not say why";
    return strncmp(reason, path, length) == 0 && reason[length] == ':' ? reason + length + 2 : reason;
}

nook_result nook_library_open(const char *path, nook_library_reason *out_reason, nook_library **out_library)
{
    char exact[PATH_MAX]; /* a name without '/' would be looked for among the system's libraries */
    *out_library = NULL;
    if (!nook_file_exists(path))
        return refuse(out_reason, NOOK_E_NOT_FOUND, path, "no such file");
    snprintf(exact, sizeof exact, "%s%s", strchr(path, '/') ? "" : "./", path);
    nook_library *library = calloc(1, sizeof *library);
    if (!library)
        return refuse(out_reason, NOOK_E_MEMORY, path, "no memory");
    library->handle = dlopen(exact, RTLD_NOW | RTLD_LOCAL);
    if (!library->handle) {
        free(library);
        return refuse(out_reason, NOOK_E_FORMAT, path, loader_reason(exact));
    }
    *out_library = library;
    return NOOK_OK;
}

void nook_library_close(nook_library *library)
{
    if (!library)
        return;
    dlclose(library->handle);
    free(library);
}

nook_library_function nook_library_find(const nook_library *library, const char *symbol)
{
    void *address = dlsym(library->handle, symbol);
    nook_library_function function;
    memcpy(&function, &address, sizeof function); /* C has no cast from data to code; POSIX promises that they fit */
    return function;
}

int nook_library_holds(const nook_library *library, const void *address)
{
    Dl_info found;
    struct link_map *map;
    return dladdr(address, &found) != 0 && dlinfo(library->handle, RTLD_DI_LINKMAP, &map) == 0 &&
           (uintptr_t)found.dli_fbase == map->l_addr;
}
