#include "game/measure/sweep.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "game/measure/sweep_block.h"
#include "game/option.h"
#include "game/settings/line_reader.h"
#include "game/techniques.h"
#include "game/volumes.h"
#include "modules/ao/technique.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE_MAX = 16384, CAMERAS_MAX = 256 };

/* A file being read. */
typedef struct reading {
    nook_line_reader lines;
    nook_sweep sweep;
    nook_sweep_block block;
    unsigned block_line; /* 0: before the first block */
    bool seen[8];        /* of the general lines: each may stand once */
} reading;

/* ---- Before the blocks ------------------------------------------------------------------------------------------ */

static nook_result read_size(reading *r, char *text)
{
    int width, height, end = 0;
    if (sscanf(text, "%5dx%5d%n", &width, &height, &end) != 2 || text[end] || width < 1 || height < 1 ||
        width > SIDE_MAX || height > SIDE_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: size %s; give WxH, each 1 to %d", r->lines.where, text, SIDE_MAX);
    r->sweep.width = (uint32_t)width;
    r->sweep.height = (uint32_t)height;
    return NOOK_OK;
}

static nook_result read_r_max(reading *r, char *text)
{
    r->sweep.r_max_count = 0;
    for (char *word = strtok(text, NOOK_LINE_BLANKS); word; word = strtok(NULL, NOOK_LINE_BLANKS)) {
        nook_sweep_r_max entry = { 0 };
        size_t length = strlen(word);
        entry.metres = word[length - 1] == 'm';
        if (entry.metres)
            word[length - 1] = '\0';
        if (!nook_text_to_number(word, &entry.value) || !(entry.value >= 1e-9) || !(entry.value <= 1e9))
            return nook_fail(NOOK_E_FORMAT,
                             "%s: r_max %s; give parts of the scene's diagonal above 0, or metres with an m behind",
                             r->lines.where, word);
        if (r->sweep.r_max_count == NOOK_SWEEP_R_MAX_COUNT)
            return nook_fail(NOOK_E_FORMAT, "%s: more than %d of r_max", r->lines.where, NOOK_SWEEP_R_MAX_COUNT);
        r->sweep.r_max[r->sweep.r_max_count++] = entry;
    }
    return NOOK_OK;
}

static nook_result read_falloff(reading *r, char *text)
{
    r->sweep.falloff_count = 0;
    for (char *word = strtok(text, NOOK_LINE_BLANKS); word; word = strtok(NULL, NOOK_LINE_BLANKS)) {
        nook_param param = *nook_shared_param("falloff");
        int32_t choice = 0;
        param.offset = 0;
        if (nook_param_parse(&param, r->lines.where, &choice, word) != NOOK_OK)
            return NOOK_E_FORMAT;
        if (r->sweep.falloff_count == NOOK_SWEEP_FALLOFF_COUNT)
            return nook_fail(NOOK_E_FORMAT, "%s: more than %d falloffs", r->lines.where, NOOK_SWEEP_FALLOFF_COUNT);
        r->sweep.falloffs[r->sweep.falloff_count++] = (uint32_t)choice;
    }
    return NOOK_OK;
}

static nook_result read_cameras(reading *r, char *text)
{
    int32_t count = 0;
    char *kind = strtok(text, NOOK_LINE_BLANKS), *number = strtok(NULL, NOOK_LINE_BLANKS);
    bool sampled = strcmp(kind, "sampled") == 0;
    if ((!sampled && strcmp(kind, "scene") != 0) || !number || strtok(NULL, NOOK_LINE_BLANKS) ||
        !nook_text_to_int(number, &count) || count < 1 || count > CAMERAS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: cameras; give \"scene N\" or \"sampled N\" with N from 1 to %d",
                         r->lines.where, CAMERAS_MAX);
    r->sweep.camera_count = (uint32_t)count;
    r->sweep.cameras_sampled = sampled;
    return NOOK_OK;
}

static nook_result read_noise(reading *r, char *text)
{
    double noise;
    if (!nook_text_to_number(text, &noise) || !(noise > 0.0) || !(noise <= 1.0))
        return nook_fail(NOOK_E_FORMAT, "%s: noise %s; give a number above 0, at most 1", r->lines.where, text);
    r->sweep.noise = noise;
    return NOOK_OK;
}

static nook_result read_rays_max(reading *r, char *text)
{
    int32_t rays;
    if (!nook_text_to_int(text, &rays) || rays < 2 || rays > 1 << 24)
        return nook_fail(NOOK_E_FORMAT, "%s: rays_max %s; give a whole number from 2 to %d", r->lines.where, text,
                         1 << 24);
    r->sweep.rays_max = (uint32_t)rays;
    return NOOK_OK;
}

static nook_result read_pictures(reading *r, char *text)
{
    r->sweep.all_pictures = strcmp(text, "all") == 0;
    if (!r->sweep.all_pictures && strcmp(text, "front") != 0)
        return nook_fail(NOOK_E_FORMAT, "%s: pictures %s; give all or front", r->lines.where, text);
    return NOOK_OK;
}

static nook_result read_general(reading *r, const char *name, char *value)
{
    static const struct {
        const char *name;
        nook_result (*read)(reading *r, char *text);
    } lines[] = { { "size", read_size },        { "r_max", read_r_max }, { "falloff", read_falloff },
                  { "cameras", read_cameras },  { "noise", read_noise }, { "rays_max", read_rays_max },
                  { "pictures", read_pictures } };
    for (size_t i = 0; i < NOOK_COUNT(lines); i++) {
        if (strcmp(lines[i].name, name) != 0)
            continue;
        if (r->seen[i])
            return nook_fail(NOOK_E_FORMAT, "%s: %s stands there twice; leave one of them", r->lines.where, name);
        r->seen[i] = true;
        return lines[i].read(r, value);
    }
    return nook_fail(NOOK_E_FORMAT,
                     "%s: %s is nothing of a sweep before its first [technique]; there are size, r_max, falloff, "
                     "cameras, noise, rays_max, pictures",
                     r->lines.where, name);
}

/* ---- Lines ------------------------------------------------------------------------------------------------------ */

static nook_result end_block(reading *r)
{
    return r->block_line > 0 ? nook_sweep_block_expand(&r->block, &r->sweep) : NOOK_OK;
}

static nook_result begin_block(reading *r, char *text)
{
    size_t length = strlen(text);
    if (length < 3 || text[length - 1] != ']')
        return nook_fail(NOOK_E_FORMAT, "%s: give [technique]", r->lines.where);
    nook_result result = end_block(r);
    if (result != NOOK_OK)
        return result;
    text[length - 1] = '\0';
    const nook_ao_technique *technique = nook_technique_find(text + 1);
    if (!technique) {
        nook_technique_refuse(r->lines.where, text + 1);
        return NOOK_E_FORMAT;
    }
    r->block = (nook_sweep_block){ .file = r->lines.file, .technique = technique };
    r->block_line = r->lines.line;
    return NOOK_OK;
}

static nook_result read_entry(reading *r, char *text)
{
    if (text[0] == '[')
        return begin_block(r, text);
    char *name, *values;
    if (!strchr(text, '='))
        return nook_fail(NOOK_E_FORMAT, "%s: give name = values, or [technique]", r->lines.where);
    if (!nook_line_split(text, &name, &values))
        return nook_fail(NOOK_E_FORMAT, "%s: give name = values", r->lines.where);
    return r->block_line > 0 ? nook_sweep_block_add(&r->block, r->lines.line, name, values)
                             : read_general(r, name, values);
}

static nook_result read_lines(reading *r)
{
    char *line;
    nook_result result = nook_line_next(&r->lines, &line);
    while (result == NOOK_OK && line) {
        result = read_entry(r, line);
        if (result == NOOK_OK)
            result = nook_line_next(&r->lines, &line);
    }
    if (result == NOOK_OK)
        result = end_block(r);
    if (result == NOOK_OK && r->sweep.setting_count == 0)
        result = nook_fail(NOOK_E_FORMAT, "%s: no setting in it; add a line such as [volume]", r->lines.file);
    return result;
}

nook_result nook_sweep_parse(const char *name, const char *text, size_t size, nook_sweep *out_sweep)
{
    reading *r = calloc(1, sizeof *r);
    if (!r)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory to read it", name);
    r->lines = (nook_line_reader){ .file = name,
                                   .text = text,
                                   .size = size,
                                   .longest = NOOK_SWEEP_LINE_MAX - 1,
                                   .refusal = "no sweep: a line of it is no text, or too long" };
    r->sweep = (nook_sweep){ .width = 480,
                             .height = 270,
                             .r_max = { { NOOK_VOLUMES_R_MAX_DEFAULT, false } },
                             .r_max_count = 1,
                             .falloffs = { (uint32_t)nook_shared_param("falloff")->initial },
                             .falloff_count = 1,
                             .camera_count = 1,
                             .noise = 0.004,
                             .rays_max = 1 << 14 };
    nook_result result = read_lines(r);
    if (result == NOOK_OK)
        *out_sweep = r->sweep;
    else
        nook_sweep_free(&r->sweep);
    free(r);
    return result;
}

nook_result nook_sweep_read(const char *path, nook_sweep *out_sweep)
{
    nook_file file;
    nook_result result = nook_file_read(path, &file);
    if (result != NOOK_OK)
        return result;
    result = nook_sweep_parse(path, (const char *)file.bytes, file.size, out_sweep);
    nook_file_free(&file);
    return result;
}

void nook_sweep_free(nook_sweep *sweep)
{
    free(sweep->settings);
    *sweep = (nook_sweep){ 0 };
}
