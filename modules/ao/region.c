#include "engine/core/log.h"
#include "modules/ao/ao_internal.h"
#include <math.h>

/* GROUP pixels: the largest group whose invocations share something, shaders/ao/tile_list.glsl. MARGIN_MIN trace pixels: the
   tile filter and upscaling read up to 3 away, shaders/ao/filter.comp.glsl. */
enum { GROUP = 8, MARGIN_MIN = 4 };

static int whole(const nook_rectangle *part)
{
    return part->x == 0 && part->y == 0 && part->width == 0 && part->height == 0;
}

nook_result ao_region_check(const nook_ao *ao, const nook_rectangle *part)
{
    int inside = part->width > 0 && part->height > 0 && part->x < ao->width && part->y < ao->height &&
                 part->width <= ao->width - part->x && part->height <= ao->height - part->y;
    if (whole(part) || inside)
        return NOOK_OK;
    return nook_fail(NOOK_E_RANGE, "nook_ao_record: a part of %ux%u pixels at %u, %u of a picture of %ux%u",
                     part->width, part->height, part->x, part->y, ao->width, ao->height);
}

/** How far from a pixel the filter reads, trace pixels. */
static int32_t filter_margin(const nook_ao *ao)
{
    int32_t disc = (int32_t)ceil((double)ao->shared.filter_radius) + 2;
    return disc > MARGIN_MIN ? disc : MARGIN_MIN;
}

ao_region ao_region_make(const nook_ao *ao, const nook_rectangle *part, uint32_t scale, int32_t passes)
{
    const int32_t size[2] = { (int32_t)ao->width, (int32_t)ao->height };
    ao_region region = { .full_end = { size[0], size[1] } };
    if (!whole(part)) {
        region = (ao_region){ .full_begin = { (int32_t)part->x, (int32_t)part->y },
                              .full_end = { (int32_t)(part->x + part->width), (int32_t)(part->y + part->height) } };
    }
    int32_t margin = passes > 0 ? filter_margin(ao) + (passes - 1) * MARGIN_MIN : 0, step = (int32_t)scale;
    for (int i = 0; i < 2; i++) {
        int32_t last = (size[i] + step - 1) / step;
        int32_t begin = region.full_begin[i] / step - margin, end = (region.full_end[i] + step - 1) / step + margin;
        region.begin[i] = begin > 0 ? begin : 0;
        region.end[i] = end < last ? end : last;
        region.origin[i] = region.begin[i] / GROUP * GROUP;
    }
    return region;
}
