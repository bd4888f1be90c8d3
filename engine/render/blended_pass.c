#include "engine/core/log.h"
#include "engine/render/internal.h"

/** Farther first; then by number, so that the order never depends on the sort. */
static bool goes_before(const blended_draw *a, const blended_draw *b)
{
    if (a->distance != b->distance)
        return a->distance > b->distance;
    return a->instance != b->instance ? a->instance < b->instance : a->primitive < b->primitive;
}

/** Shell sort: in place, where qsort may allocate. */
static void sort_blended(blended_draw *items, size_t count)
{
    size_t gap = 1;
    while (gap < count / 3)
        gap = gap * 3 + 1;
    for (; gap > 0; gap /= 3) {
        for (size_t i = gap; i < count; i++) {
            blended_draw item = items[i];
            size_t at = i;
            for (; at >= gap && goes_before(&item, &items[at - gap]); at -= gap)
                items[at] = items[at - gap];
            items[at] = item;
        }
    }
}

static bool is_blended(const nook_scene *scene, uint32_t primitive)
{
    return scene->materials[scene->primitives[primitive].material].alpha_mode == NOOK_ALPHA_BLEND;
}

static size_t count_blended(const nook_scene *scene, const draw_set *set)
{
    const batch *batches = set->batches.items;
    size_t count = 0;
    for (uint32_t i = 0; i < set->batch_count; i++) {
        const nook_mesh *mesh = &scene->meshes[batches[i].mesh];
        for (uint32_t k = 0; k < mesh->primitive_count; k++)
            count += is_blended(scene, mesh->first_primitive + k) ? batches[i].instance_count : 0;
    }
    return count;
}

static double view_distance(const float view_from_mesh[16], const float p[3])
{
    return -((double)view_from_mesh[2] * p[0] + (double)view_from_mesh[6] * p[1] + (double)view_from_mesh[10] * p[2] +
             (double)view_from_mesh[14]);
}

nook_result nook_collect_blended(nook_renderer *renderer, const nook_frame *frame)
{
    const nook_scene *scene = frame->scene->scene;
    const draw_set *set = &renderer->visible;
    const batch *batches = set->batches.items;
    const instance_data *instances = set->instances.items;
    size_t count = count_blended(scene, set), at = 0;
    if (!nook_grow(&renderer->blended, count * sizeof(blended_draw)))
        return nook_fail(NOOK_E_MEMORY, "%zu blended surfaces: no memory to sort them", count);
    blended_draw *items = renderer->blended.items;
    for (uint32_t i = 0; i < set->batch_count; i++) {
        const nook_mesh *mesh = &scene->meshes[batches[i].mesh];
        for (uint32_t k = 0; k < mesh->primitive_count; k++) {
            uint32_t primitive = mesh->first_primitive + k;
            for (uint32_t n = 0; is_blended(scene, primitive) && n < batches[i].instance_count; n++) {
                uint32_t instance = batches[i].first_instance + n;
                const float *centre = frame->scene->primitives[primitive].centre;
                double distance = view_distance(instances[instance].view_from_mesh, centre);
                items[at++] = (blended_draw){ distance, primitive, instance, batches[i].mirrored };
            }
        }
    }
    sort_blended(items, count);
    renderer->blended_count = count;
    return NOOK_OK;
}

void nook_pass_blended(nook_renderer *renderer, const nook_frame *frame, nook_rectangle part)
{
    if (renderer->blended_count == 0)
        return;
    const nook_gl *gl = renderer->gpu->gl;
    const nook_scene *scene = frame->scene->scene;
    nook_raster_begin(renderer->gpu, renderer->targets.blended_target,
                      (raster_state){ .depth_compare = GL_GEQUAL, .cull = true, .blend = true, .part = part });
    nook_bind_geometry(renderer, frame->scene, &renderer->visible);
    nook_bind_texture(renderer->gpu, UNIT_SHADOW, renderer->shadow_map);
    nook_program_use(renderer->gpu, renderer->blended_program);
    const blended_draw *items = renderer->blended.items;
    for (size_t i = 0; i < renderer->blended_count; i++) {
        const blended_draw *item = &items[i];
        uint32_t material = frame->scene->primitives[item->primitive].material;
        nook_bind_material(renderer, frame->scene, material);
        gl->FrontFace(item->mirrored ? GL_CW : GL_CCW);
        if (scene->materials[material].double_sided || !frame->cull_back_faces) { /* the side that lies behind first */
            gl->CullFace(GL_FRONT);
            nook_draw_primitive(renderer, frame->scene, item->primitive, item->instance, 1);
            gl->CullFace(GL_BACK);
        }
        nook_draw_primitive(renderer, frame->scene, item->primitive, item->instance, 1);
    }
    nook_raster_end(renderer->gpu);
}
