#include "engine/asset/gltf_internal.h"
#include "engine/asset/scene_internal.h"
#include <string.h>

static float clamp01(double x)
{
    return x >= 0.0 ? (float)(x < 1.0 ? x : 1.0) : 0.0f;
}

static uint32_t slot_image(const nook_gltf *gltf, const nook_gltf_slot *slot)
{
    return slot->texture == NOOK_GLTF_NONE ? NOOK_NONE : gltf->model->texture_images[slot->texture];
}

/* The slots in the order in which they decide about the texture coordinates: what is seen most comes first. */
static void list_slots(const nook_gltf_material *material, const nook_gltf_slot *out_slots[5])
{
    out_slots[0] = &material->base_colour_slot;
    out_slots[1] = &material->normal_slot;
    out_slots[2] = &material->metallic_roughness_slot;
    out_slots[3] = &material->occlusion_slot;
    out_slots[4] = &material->emissive_slot;
}

const nook_gltf_slot *nook_gltf_material_uv_slot(const nook_gltf *gltf, uint32_t material)
{
    const nook_gltf_slot *slots[5];
    if (material == NOOK_GLTF_NONE)
        return NULL;
    list_slots(&gltf->model->materials[material], slots);
    for (int i = 0; i < 5; i++)
        if (slots[i]->texture != NOOK_GLTF_NONE)
            return slots[i];
    return NULL;
}

static bool same_coordinates(const nook_gltf_slot *a, const nook_gltf_slot *b)
{
    return a->texcoord == b->texcoord && a->rotation == b->rotation && a->offset[0] == b->offset[0] &&
           a->offset[1] == b->offset[1] && a->scale[0] == b->scale[0] && a->scale[1] == b->scale[1];
}

/* A vertex carries one pair of coordinates; say so when a material wants two. */
static void check_coordinates(nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_slot *slots[5], *first = nook_gltf_material_uv_slot(gltf, index);
    list_slots(&gltf->model->materials[index], slots);
    for (int i = 0; i < 5 && !gltf->uv_sets_differ_said; i++) {
        if (slots[i]->texture == NOOK_GLTF_NONE || same_coordinates(slots[i], first))
            continue;
        nook_scene_warn(gltf->scene, "%s: materials[%u] maps its textures in different ways; all use the first's",
                        gltf->path, index);
        gltf->uv_sets_differ_said = true;
    }
    if (first && first->texcoord > 1)
        nook_scene_warn(gltf->scene, "%s: materials[%u] uses TEXCOORD_%u; only sets 0 and 1 are read", gltf->path,
                        index, first->texcoord);
}

static nook_alpha_mode alpha_mode(nook_gltf *gltf, uint32_t index, const char *text)
{
    if (strcmp(text, "MASK") == 0)
        return NOOK_ALPHA_MASK;
    if (strcmp(text, "BLEND") == 0)
        return NOOK_ALPHA_BLEND;
    if (strcmp(text, "OPAQUE") != 0)
        nook_scene_warn(gltf->scene, "%s: materials[%u] has the unknown alphaMode '%.20s'; drawn opaque", gltf->path,
                        index, text);
    return NOOK_ALPHA_OPAQUE;
}

static nook_result convert_material(nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_material *from = &gltf->model->materials[index];
    nook_material *to = &gltf->scene->materials[index];
    nook_scene_default_material(to);
    to->name = nook_scene_copy_string(from->name);
    for (int i = 0; i < 4; i++)
        to->base_colour[i] = clamp01(from->base_colour[i]);
    for (int i = 0; i < 3; i++)
        to->emissive[i] =
            clamp01(from->emissive[i]) * (float)(from->emissive_strength > 0 ? from->emissive_strength : 0);
    to->metallic = clamp01(from->metallic);
    to->roughness = clamp01(from->roughness);
    to->normal_scale = (float)from->normal_scale;
    to->occlusion_strength = clamp01(from->occlusion_strength);
    to->alpha_cutoff = (float)from->alpha_cutoff;
    to->alpha_mode = alpha_mode(gltf, index, from->alpha_mode);
    to->double_sided = from->double_sided;
    to->unlit = from->unlit;
    to->base_colour_image = slot_image(gltf, &from->base_colour_slot);
    to->metallic_roughness_image = slot_image(gltf, &from->metallic_roughness_slot);
    to->normal_image = slot_image(gltf, &from->normal_slot);
    to->emissive_image = slot_image(gltf, &from->emissive_slot);
    to->occlusion_image = slot_image(gltf, &from->occlusion_slot);
    check_coordinates(gltf, index);
    return to->name ? NOOK_OK : NOOK_E_MEMORY;
}

nook_result nook_gltf_convert_materials(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    uint32_t count = gltf->model->material_count;
    scene->materials = nook_scene_allocate(gltf->path, (size_t)count + 1, sizeof *scene->materials);
    if (!scene->materials)
        return NOOK_E_MEMORY;
    scene->material_count = count + 1;
    nook_scene_default_material(&scene->materials[count]);
    scene->materials[count].name = nook_scene_copy_string("default");
    for (uint32_t i = 0; i < gltf->model->texture_count; i++)
        if (gltf->model->texture_images[i] == NOOK_GLTF_NONE)
            nook_scene_warn(gltf->scene, "%s: textures[%u] has no PNG or JPEG image; left out", gltf->path, i);
    nook_result result = scene->materials[count].name ? NOOK_OK : NOOK_E_MEMORY;
    for (uint32_t i = 0; result == NOOK_OK && i < count; i++)
        result = convert_material(gltf, i);
    return result;
}
