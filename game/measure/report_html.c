#include "engine/core/file.h"
#include "game/measure/report.h"
#include "game/measure/report_internal.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

/* The template names its parts: {{style.css}} is that file, {{title}}, {{results}} and {{pictures}} are made. */
#define PARTS_FOLDER "game/measure/report"
enum { PART_NAME_MAX = 64 };

typedef struct report_source {
    const char *root, *folder, *command;
    const nook_results *results;
} report_source;

void nook_report_put_html(FILE *out, const char *text)
{
    for (; *text; text++) {
        switch (*text) {
        case '&':
            fputs("&amp;", out);
            break;
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        default:
            fputc(*text, out);
        }
    }
}

static bool is_new_scene(const nook_results *results, size_t index)
{
    for (size_t i = 0; i < index; i++) {
        if (strcmp(results->rows[i].scene, results->rows[index].scene) == 0)
            return false;
    }
    return true;
}

/* "Nook measurements: hall, sponza" */
static void put_title(FILE *out, const nook_results *results)
{
    fputs("Nook measurements", out);
    for (size_t i = 0, scenes = 0; i < results->row_count; i++) {
        if (!is_new_scene(results, i))
            continue;
        fputs(scenes++ ? ", " : ": ", out);
        nook_report_put_html(out, results->rows[i].scene);
    }
}

static nook_result read_part(const char *root, const char *name, nook_file *out_file)
{
    char folder[PATH_MAX], path[PATH_MAX];
    nook_path_join(folder, sizeof folder, root, PARTS_FOLDER);
    return nook_file_read(nook_path_join(path, sizeof path, folder, name), out_file);
}

static nook_result put_part_file(FILE *out, const char *root, const char *name)
{
    nook_file file;
    nook_result result = read_part(root, name, &file);
    if (result != NOOK_OK)
        return result;
    fwrite(file.bytes, 1, file.size, out);
    nook_file_free(&file);
    return NOOK_OK;
}

static nook_result put_part(FILE *out, const report_source *source, const char *name)
{
    if (strcmp(name, "results") == 0)
        return nook_report_put_data(out, source->results, source->command);
    if (strcmp(name, "pictures") == 0)
        return nook_report_put_pictures(out, source->results, source->folder);
    if (strcmp(name, "title") != 0)
        return put_part_file(out, source->root, name);
    put_title(out, source->results);
    return NOOK_OK;
}

static nook_result expand(FILE *out, const report_source *source, const char *text)
{
    const char *open, *close;
    while ((open = strstr(text, "{{")) && (close = strstr(open, "}}"))) {
        char name[PART_NAME_MAX];
        fwrite(text, 1, (size_t)(open - text), out);
        snprintf(name, sizeof name, "%.*s", (int)(close - open - 2), open + 2);
        nook_result result = put_part(out, source, name);
        if (result != NOOK_OK)
            return result;
        text = close + 2;
    }
    fputs(text, out);
    return NOOK_OK;
}

/* A template, and what it is filled with. */
typedef struct filled_template {
    const report_source *source;
    const char *text;
} filled_template;

static nook_result print(const void *user, FILE *stream)
{
    const filled_template *filled = user;
    return expand(stream, filled->source, filled->text);
}

nook_result nook_report_html_write(const char *root, const nook_results *results, const char *folder,
                                   const char *command)
{
    const report_source source = { .root = root, .folder = folder, .command = command, .results = results };
    char path[PATH_MAX];
    nook_file template;
    nook_result result = read_part(root, "template.html", &template);
    if (result != NOOK_OK)
        return result;
    result = nook_file_write_text(nook_path_join(path, sizeof path, folder, "report.html"), print,
                                  &(filled_template){ &source, (const char *)template.bytes });
    nook_file_free(&template);
    return result;
}
