#include "engine/asset/scene_join.h"
#include "engine/asset/scene_internal.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

/* Where the arrays of a part begin in the joined ones. */
typedef struct offsets {
    uint32_t primitive, mesh, material, image, node, camera, light, skin, vertex;
} offsets;

static uint32_t moved(uint32_t index, uint32_t by)
{
    return index == NOOK_NONE ? NOOK_NONE : index + by;
}

static size_t sum(const nook_scene_part *parts, uint32_t count, size_t (*size_of)(const nook_scene_part *part))
{
    size_t total = 0;
    for (uint32_t i = 0; i < count; i++)
        total += size_of(&parts[i]);
    return total;
}

#define COUNT_OF(member)                                         \
    static size_t member##_count_of(const nook_scene_part *part) \
    {                                                            \
        return part->scene->member##_count;                      \
    }
COUNT_OF(vertex)
COUNT_OF(index)
COUNT_OF(primitive)
COUNT_OF(mesh)
COUNT_OF(material)
COUNT_OF(image)
#undef COUNT_OF

#define STANDING_OF(member)                                      \
    static size_t member##_count_of(const nook_scene_part *part) \
    {                                                            \
        return part->nodes ? part->scene->member##_count : 0;    \
    }
STANDING_OF(node)
STANDING_OF(camera)
STANDING_OF(light)
#undef STANDING_OF

/* Counters of what is filled rise while it is filled, so that a scene given up half-way can be destroyed. */
static nook_result allocate(nook_scene *scene, const nook_scene_part *parts, uint32_t count, uint32_t instance_count)
{
    const char *path = scene->path;
    size_t vertices = sum(parts, count, vertex_count_of), indices = sum(parts, count, index_count_of);
    if (vertices > UINT32_MAX || indices > UINT32_MAX)
        return nook_fail(NOOK_E_RANGE, "%s: %zu vertices and %zu indices; at most %u of each can be counted", path,
                         vertices, indices, UINT32_MAX);
    scene->vertices = nook_scene_allocate(path, vertices, sizeof *scene->vertices);
    scene->indices = nook_scene_allocate(path, indices, sizeof *scene->indices);
    scene->primitives = nook_scene_allocate(path, sum(parts, count, primitive_count_of), sizeof *scene->primitives);
    scene->meshes = nook_scene_allocate(path, sum(parts, count, mesh_count_of), sizeof *scene->meshes);
    scene->materials = nook_scene_allocate(path, sum(parts, count, material_count_of), sizeof *scene->materials);
    scene->images = nook_scene_allocate(path, sum(parts, count, image_count_of), sizeof *scene->images);
    size_t nodes = sum(parts, count, node_count_of) + instance_count;
    scene->nodes = nook_scene_allocate(path, nodes, sizeof *scene->nodes);
    scene->cameras = nook_scene_allocate(path, sum(parts, count, camera_count_of), sizeof *scene->cameras);
    scene->lights = nook_scene_allocate(path, sum(parts, count, light_count_of), sizeof *scene->lights);
    if (nook_scene_allocate_motion(scene, parts, count, nodes) != NOOK_OK)
        return NOOK_E_MEMORY;
    bool made = scene->vertices && scene->indices && scene->primitives && scene->meshes && scene->materials &&
                scene->images && scene->nodes && scene->cameras && scene->lights;
    return made ? NOOK_OK : NOOK_E_MEMORY;
}

/* Parts made by code may lack whole arrays, and memcpy takes no NULL. */
static void copy(void *to, const void *from, size_t size)
{
    if (size > 0)
        memcpy(to, from, size);
}

static void append_geometry(nook_scene *to, const nook_scene *from, const offsets *at)
{
    for (uint32_t i = 0; i < from->primitive_count; i++) {
        nook_primitive *primitive = &to->primitives[to->primitive_count++];
        *primitive = from->primitives[i];
        primitive->first_vertex += (uint32_t)to->vertex_count;
        primitive->first_index += (uint32_t)to->index_count;
        primitive->material += at->material;
    }
    copy(to->vertices + to->vertex_count, from->vertices, from->vertex_count * sizeof *to->vertices);
    copy(to->indices + to->index_count, from->indices, from->index_count * sizeof *to->indices);
    to->vertex_count += from->vertex_count;
    to->index_count += from->index_count;
}

/* A copy of a name, whose owner's counter rises with it. */
static bool name(const char *from, char **out, uint32_t *counter)
{
    *out = nook_scene_copy_string(from);
    *counter += *out != NULL;
    return *out != NULL;
}

static nook_result append_meshes(nook_scene *to, const nook_scene *from, const offsets *at)
{
    for (uint32_t i = 0; i < from->mesh_count; i++) {
        nook_mesh *mesh = &to->meshes[to->mesh_count];
        *mesh = from->meshes[i];
        mesh->first_primitive += at->primitive;
        if (!name(from->meshes[i].name, &mesh->name, &to->mesh_count))
            return NOOK_E_MEMORY;
    }
    return NOOK_OK;
}

static nook_result append_materials(nook_scene *to, nook_scene *from, const offsets *at)
{
    for (uint32_t i = 0; i < from->material_count; i++) {
        nook_material *material = &to->materials[to->material_count];
        *material = from->materials[i];
        uint32_t *images[] = { &material->base_colour_image, &material->metallic_roughness_image,
                               &material->normal_image, &material->emissive_image, &material->occlusion_image };
        for (size_t k = 0; k < NOOK_COUNT(images); k++)
            *images[k] = moved(*images[k], at->image);
        if (!name(from->materials[i].name, &material->name, &to->material_count))
            return NOOK_E_MEMORY;
    }
    for (uint32_t i = 0; i < from->image_count; i++) {
        nook_image *image = &to->images[to->image_count];
        *image = from->images[i];
        if (!name(from->images[i].name, &image->name, &to->image_count))
            return NOOK_E_MEMORY;
        from->images[i].pixels = NULL;
    }
    return NOOK_OK;
}

static nook_result append_nodes(nook_scene *to, const nook_scene *from, const offsets *at)
{
    for (uint32_t i = 0; i < from->node_count; i++) {
        nook_node *node = &to->nodes[to->node_count];
        *node = from->nodes[i];
        node->parent = moved(node->parent, at->node);
        node->mesh = moved(node->mesh, at->mesh);
        node->camera = moved(node->camera, at->camera);
        node->light = moved(node->light, at->light);
        node->skin = moved(node->skin, at->skin);
        if (!name(from->nodes[i].name, &node->name, &to->node_count))
            return NOOK_E_MEMORY;
    }
    for (uint32_t i = 0; i < from->camera_count; i++) {
        nook_scene_camera *camera = &to->cameras[to->camera_count];
        *camera = from->cameras[i];
        if (!name(from->cameras[i].name, &camera->name, &to->camera_count))
            return NOOK_E_MEMORY;
    }
    copy(to->lights + to->light_count, from->lights, from->light_count * sizeof *to->lights);
    to->light_count += from->light_count;
    to->file_node_count += from->file_node_count;
    return nook_scene_append_motion(to, from, at->node, at->mesh, at->vertex);
}

static nook_result append_files(nook_scene *to, const nook_scene *from)
{
    for (uint32_t i = 0; i < from->file_count; i++)
        if (!nook_scene_add_file(to, from->files[i]))
            return NOOK_E_MEMORY;
    return NOOK_OK;
}

/* Takes the cells of a part over, as the pixels of its images. */
static nook_result append_densities(nook_scene *to, nook_scene *from)
{
    for (uint32_t i = 0; i < from->density_count; i++) {
        nook_scene_density *density = &from->densities[i];
        nook_result result = nook_scene_add_density(to, density->name, &density->medium, &density->world_from_local);
        if (result != NOOK_OK)
            return result;
        density->medium.extinction = NULL;
    }
    return NOOK_OK;
}

static nook_result append_part(nook_scene *to, const nook_scene_part *part, uint32_t *out_first_mesh)
{
    const offsets at = { .primitive = to->primitive_count,
                         .mesh = to->mesh_count,
                         .material = to->material_count,
                         .image = to->image_count,
                         .node = to->node_count,
                         .camera = to->camera_count,
                         .light = to->light_count,
                         .skin = to->skin_count,
                         .vertex = (uint32_t)to->vertex_count };
    *out_first_mesh = at.mesh;
    append_geometry(to, part->scene, &at);
    nook_result result = append_meshes(to, part->scene, &at);
    if (result == NOOK_OK)
        result = append_materials(to, part->scene, &at);
    if (result == NOOK_OK)
        result = append_files(to, part->scene);
    if (result == NOOK_OK && part->nodes)
        result = append_nodes(to, part->scene, &at);
    return result == NOOK_OK && part->nodes ? append_densities(to, part->scene) : result;
}

static nook_result append_instance(nook_scene *to, const nook_scene_part *part, uint32_t first_mesh,
                                   const nook_scene_instance *instance)
{
    assert(instance->node < part->scene->node_count);
    const nook_node *from = &part->scene->nodes[instance->node];
    nook_node *node = &to->nodes[to->node_count];
    assert(from->mesh != NOOK_NONE);
    *node = (nook_node){ .parent = NOOK_NONE,
                         .mesh = from->mesh + first_mesh,
                         .camera = NOOK_NONE,
                         .light = NOOK_NONE,
                         .skin = NOOK_NONE,
                         .world_from_local = instance->world_from_local,
                         .moving = instance->moving,
                         .mass = from->mass,
                         .hung = from->hung };
    to->file_node_count++;
    to->rest[to->node_count] = (nook_node_rest){ .is_matrix = true, .parent_from_local = instance->world_from_local };
    return name(instance->name, &node->name, &to->node_count) ? NOOK_OK : NOOK_E_MEMORY;
}

static nook_result fill(nook_scene *scene, const nook_scene_part *parts, uint32_t part_count,
                        const nook_scene_instance *instances, uint32_t instance_count)
{
    uint32_t *first_mesh = nook_scene_allocate(scene->path, part_count, sizeof *first_mesh);
    nook_result result = first_mesh ? NOOK_OK : NOOK_E_MEMORY;
    for (uint32_t i = 0; i < part_count && result == NOOK_OK; i++)
        result = append_part(scene, &parts[i], &first_mesh[i]);
    for (uint32_t i = 0; i < instance_count && result == NOOK_OK; i++) {
        assert(instances[i].part < part_count);
        result = append_instance(scene, &parts[instances[i].part], first_mesh[instances[i].part], &instances[i]);
    }
    free(first_mesh);
    return result;
}

nook_result nook_scene_join(const char *path, const nook_scene_part *parts, uint32_t part_count,
                            const nook_scene_instance *instances, uint32_t instance_count, nook_scene **out_scene)
{
    assert(part_count > 0);
    *out_scene = NULL;
    nook_scene *scene = nook_scene_allocate(path, 1, sizeof *scene);
    if (!scene)
        return NOOK_E_MEMORY;
    scene->path = nook_scene_copy_string(path);
    nook_result result = scene->path ? allocate(scene, parts, part_count, instance_count) : NOOK_E_MEMORY;
    if (result == NOOK_OK)
        result = fill(scene, parts, part_count, instances, instance_count);
    if (result == NOOK_OK)
        result = nook_scene_finish(scene);
    if (result != NOOK_OK) {
        nook_scene_destroy(scene);
        return result;
    }
    *out_scene = scene;
    return NOOK_OK;
}
