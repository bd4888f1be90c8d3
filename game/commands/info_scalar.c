#include "game/commands/info_scalar.h"
#include "engine/asset/scalar_volume.h"
#include "engine/core/json.h"
#include "game/option.h"
#include <stdio.h>

static size_t count_bytes(const nook_scalar_volume *volume)
{
    return volume->sample_count * nook_sample_type_size(volume->type);
}

static void print_text(const char *path, const nook_scalar_volume *volume)
{
    const uint32_t *size = volume->size;
    const double *spacing = volume->spacing;
    printf("%-12s %s\n%-12s scalar volume\n", "path", path, "kind");
    printf("%-12s %u %u %u\n", "size", size[0], size[1], size[2]);
    printf("%-12s %u\n%-12s %s\n", "components", volume->components, "type", nook_sample_type_name(volume->type));
    printf("%-12s %zu\n", "bytes", count_bytes(volume));
    printf("%-12s %.6g %.6g %.6g\n", "spacing", spacing[0], spacing[1], spacing[2]);
    printf("%-12s %.8g\n%-12s %.8g\n", "minimum", volume->minimum, "maximum", volume->maximum);
    printf("%-12s %zu\n", "not_finite", volume->not_finite);
}

static int print_json(const char *path, const nook_scalar_volume *volume)
{
    nook_json json = { 0 };
    const double size[3] = { volume->size[0], volume->size[1], volume->size[2] };
    nook_json_begin_object(&json);
    nook_json_member_string(&json, "path", path);
    nook_json_member_string(&json, "kind", "scalar volume");
    nook_json_key(&json, "size");
    nook_json_numbers(&json, size, 3);
    nook_json_member_integer(&json, "components", volume->components);
    nook_json_member_string(&json, "type", nook_sample_type_name(volume->type));
    nook_json_member_integer(&json, "bytes", (int64_t)count_bytes(volume));
    nook_json_key(&json, "spacing");
    nook_json_numbers(&json, volume->spacing, 3);
    nook_json_member_number(&json, "minimum", volume->minimum);
    nook_json_member_number(&json, "maximum", volume->maximum);
    nook_json_member_integer(&json, "not_finite", (int64_t)volume->not_finite);
    nook_json_end_object(&json);
    nook_result result = nook_json_print(&json, stdout);
    nook_json_free(&json);
    return result == NOOK_OK ? NOOK_EXIT_OK : NOOK_EXIT_FAILED;
}

int nook_info_scalar_volume(const char *path, bool as_json)
{
    nook_scalar_volume volume;
    if (nook_scalar_volume_load(path, &volume) != NOOK_OK)
        return NOOK_EXIT_FAILED;
    int exit_code = NOOK_EXIT_OK;
    if (as_json)
        exit_code = print_json(path, &volume);
    else
        print_text(path, &volume);
    nook_scalar_volume_free(&volume);
    return exit_code;
}
