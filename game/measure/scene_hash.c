#include "game/measure/scene_hash.h"
#include <string.h>
#include <xxhash.h>

/* Chained: the hash so far seeds the next. Only arrays of plain numbers go in, never structs with holes or pointers. */
static uint64_t add(uint64_t hash, const void *bytes, size_t size)
{
    return size > 0 ? XXH3_64bits_withSeed(bytes, size, hash) : XXH3_64bits_withSeed("", 0, hash);
}

static uint64_t add_images(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->image_count; i++) {
        const nook_image *image = &scene->images[i];
        const uint32_t size[2] = { image->width, image->height };
        hash = add(hash, size, sizeof size);
        hash = add(hash, image->pixels, image->pixels ? (size_t)image->width * image->height * 4 : 0);
    }
    return hash;
}

static uint64_t add_materials(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->material_count; i++) {
        const nook_material *m = &scene->materials[i];
        const float numbers[] = { m->base_colour[0], m->base_colour[1], m->base_colour[2],     m->base_colour[3],
                                  m->metallic,       m->roughness,      m->emissive[0],        m->emissive[1],
                                  m->emissive[2],    m->normal_scale,   m->occlusion_strength, m->alpha_cutoff };
        const uint32_t choices[] = {
            (uint32_t)m->alpha_mode,     m->double_sided, m->unlit,         m->base_colour_image,
            m->metallic_roughness_image, m->normal_image, m->emissive_image
        };
        hash = add(hash, numbers, sizeof numbers);
        hash = add(hash, choices, sizeof choices);
        if (m->alpha_mode != NOOK_ALPHA_OPAQUE) /* older truths took masked ones whole and left blended ones out */
            hash = add(hash, "alpha", 5);
    }
    return hash;
}

static uint64_t add_meshes(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->primitive_count; i++) {
        const nook_primitive *p = &scene->primitives[i];
        const uint32_t numbers[] = { p->first_vertex, p->vertex_count, p->first_index, p->index_count, p->material };
        hash = add(hash, numbers, sizeof numbers);
    }
    for (uint32_t i = 0; i < scene->mesh_count; i++) {
        const uint32_t numbers[] = { scene->meshes[i].first_primitive, scene->meshes[i].primitive_count };
        hash = add(hash, numbers, sizeof numbers);
    }
    return hash;
}

static uint64_t add_nodes(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->node_count; i++) {
        const nook_node *node = &scene->nodes[i];
        const uint32_t numbers[] = { node->mesh, node->moving };
        hash = add(hash, numbers, sizeof numbers);
        hash = add(hash, node->world_from_local.m, sizeof node->world_from_local.m);
    }
    return hash;
}

/* Nothing where there are none: truths that were kept stay valid. */
static uint64_t add_densities(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->density_count; i++) {
        const nook_medium *medium = &scene->densities[i].medium;
        hash = add(hash, medium->size, sizeof medium->size);
        hash = add(hash, medium->spacing, sizeof medium->spacing);
        hash = add(hash, medium->extinction, (size_t)nook_medium_cells(medium) * sizeof *medium->extinction);
        hash = add(hash, scene->densities[i].world_from_local.m, sizeof scene->densities[i].world_from_local.m);
    }
    return hash;
}

static uint64_t add_cameras(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->camera_count; i++) {
        const nook_scene_camera *camera = &scene->cameras[i];
        const double numbers[] = { camera->fov_y_radians, camera->z_near, camera->perspective };
        hash = add(hash, numbers, sizeof numbers);
        hash = add(hash, camera->world_from_view.m, sizeof camera->world_from_view.m);
    }
    return hash;
}

static uint64_t add_lights(uint64_t hash, const nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const nook_light *light = &scene->lights[i];
        const float numbers[] = { (float)light->kind, light->colour[0], light->colour[1],  light->colour[2],
                                  light->intensity,   light->range,     light->inner_cone, light->outer_cone };
        hash = add(hash, numbers, sizeof numbers);
        hash = add(hash, light->world_from_light.m, sizeof light->world_from_light.m);
    }
    return hash;
}

uint64_t nook_scene_hash(const nook_scene *scene)
{
    _Static_assert(sizeof(nook_vertex) == 16 * sizeof(float), "a vertex is floats without holes");
    uint64_t hash = add(1, scene->vertices, scene->vertex_count * sizeof *scene->vertices);
    hash = add(hash, scene->indices, scene->index_count * sizeof *scene->indices);
    hash = add_meshes(hash, scene);
    hash = add_nodes(hash, scene);
    hash = add_densities(hash, scene);
    hash = add_materials(hash, scene);
    hash = add_images(hash, scene);
    hash = add_cameras(hash, scene);
    return add_lights(hash, scene);
}
