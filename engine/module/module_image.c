#include "engine/core/log.h"
#include "engine/module/module_image_internal.h"
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

nook_result nook_module_refuse(nook_module_reason *out_reason, nook_result code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(out_reason->text, sizeof out_reason->text, format, arguments);
    va_end(arguments);
    out_reason->address = NULL;
    return code;
}

/* Before any of its code runs: what it takes for granted about the engine must be so. */
static nook_result check_interface(const char *name, const nook_interface_view *engine, nook_module_reason *out_reason,
                                   nook_module_image *image)
{
    char why[512] = "";
    nook_log_keep_errors(why, sizeof why);
    nook_result result = nook_interface_read(image->path, &image->interface);
    nook_log_keep_errors(NULL, 0);
    if (result != NOOK_OK)
        return nook_module_refuse(out_reason, result, "%s: what it was built against cannot be told: %s", name, why);
    const nook_interface_view own = { image->interface, NULL, NULL };
    const char *other = nook_interface_difference(engine, &own, NOOK_INTERFACE_PUBLIC_TYPES | NOOK_INTERFACE_FUNCTIONS);
    if (other)
        return nook_module_refuse(out_reason, NOOK_E_VERSION,
                                  "%s: built for another engine than this one, %s differs; start the program again",
                                  name, other);
    return NOOK_OK;
}

static nook_result check_module(const char *name, nook_module_reason *out_reason, nook_module_image *image)
{
    nook_module_entry_function entry = (nook_module_entry_function)nook_library_find(image->library, NOOK_MODULE_ENTRY);
    if (!entry)
        return nook_module_refuse(out_reason, NOOK_E_FORMAT, "%s: exports no %s, so it is no module", name,
                                  NOOK_MODULE_ENTRY);
    const nook_module *module = entry();
    if (module->version != NOOK_MODULE_VERSION)
        return nook_module_refuse(out_reason, NOOK_E_VERSION, "%s: a module of version %u, this program takes %u", name,
                                  module->version, NOOK_MODULE_VERSION);
    if (strcmp(module->name, name) != 0)
        return nook_module_refuse(out_reason, NOOK_E_FORMAT, "%s.so: holds the module %s", name, module->name);
    image->module = module;
    return NOOK_OK;
}

nook_result nook_module_image_load(nook_live_folder *folder, const char *name, const nook_interface_view *engine,
                                   nook_module_reason *out_reason, nook_module_image *out_image)
{
    nook_module_image image = { .module = NULL };
    nook_library_reason loader;
    char path[NOOK_LIVE_PATH_MAX];
    *out_image = image;
    image.file = nook_file_mark_of(nook_live_folder_library(folder, name, path));
    nook_result result = nook_live_folder_copy(folder, name, image.path);
    if (result != NOOK_OK)
        return nook_module_refuse(out_reason, result, "%s: cannot be copied; see the log", path);
    result = check_interface(name, engine, out_reason, &image);
    if (result == NOOK_OK) {
        result = nook_library_open(image.path, &loader, &image.library);
        if (result != NOOK_OK)
            nook_module_refuse(out_reason, result, "%s: cannot be loaded: %s", name, loader.text);
    }
    if (result == NOOK_OK)
        result = check_module(name, out_reason, &image);
    if (result == NOOK_OK)
        *out_image = image;
    else
        nook_module_image_close(&image);
    return result;
}

void nook_module_image_close(nook_module_image *image)
{
    nook_library_close(image->library);
    nook_interface_free(image->interface);
    if (image->path[0])
        unlink(image->path);
    *image = (nook_module_image){ .module = NULL };
}
