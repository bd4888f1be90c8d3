#include "game/play/preferences.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/settings/line_reader.h"
#include <stdio.h>
#include <string.h>

void nook_preferences_reset(nook_preferences *out)
{
    nook_param_reset(nook_preferences_table, NOOK_COUNT(nook_preferences_table), out);
}

static void read_line(const nook_line_reader *reader, char *line, nook_preferences *out)
{
    char *name, *value;
    if (!nook_line_split(line, &name, &value)) {
        nook_log_warning("%s: expected name = value; left out", reader->where);
        return;
    }
    const nook_param *param = nook_param_find(nook_preferences_table, NOOK_COUNT(nook_preferences_table), name);
    if (!param)
        nook_log_warning("%s: there is no preference '%s'; left out", reader->where, name);
    else if (nook_param_parse(param, "preferences", out, value) != NOOK_OK)
        nook_log_warning("%s: '%s' stays as it comes", reader->where, name);
}

void nook_preferences_read(const char *path, nook_preferences *out)
{
    nook_preferences_reset(out);
    nook_file file;
    if (!nook_file_exists(path) || nook_file_read(path, &file) != NOOK_OK)
        return;
    nook_line_reader reader = { .file = path,
                                .text = (const char *)file.bytes,
                                .size = file.size,
                                .longest = 256,
                                .refusal = "no line of preferences is that long" };
    char *line = NULL;
    while (nook_line_next(&reader, &line) == NOOK_OK && line)
        read_line(&reader, line, out);
    nook_file_free(&file);
}

bool nook_preferences_write(const char *path, const nook_preferences *preferences)
{
    char text[4096];
    size_t used = (size_t)snprintf(text, sizeof text, "# Nook: what the player likes. ./nook play writes this.\n");
    for (size_t i = 0; i < NOOK_COUNT(nook_preferences_table) && used < sizeof text; i++) {
        char value[64];
        const nook_param *param = &nook_preferences_table[i];
        used += (size_t)snprintf(text + used, sizeof text - used, "%s = %s\n", param->name,
                                 nook_param_print(param, preferences, value, sizeof value));
    }
    int reason = nook_file_try_write(path, text, strlen(text));
    if (reason != 0)
        nook_log_warning("%s: cannot write: %s; the next game begins with the preferences of before", path,
                         strerror(reason));
    return reason == 0;
}
