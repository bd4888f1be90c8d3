#include "engine/asset/scene.h"
#include "engine/asset/image.h"
#include "engine/asset/scene_internal.h"
#include "engine/core/vector.h"
#include <cglm/cglm.h>
#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WARNINGS_MAX = 100, WARNING_CAPACITY = 1024 };

/* Beyond this the square of a distance is no longer a float. */
static const double coordinate_max = 1e18;

void *nook_scene_allocate(const char *path, size_t count, size_t element_size)
{
    void *memory = calloc(count ? count : 1, element_size);
    if (!memory)
        nook_fail(NOOK_E_MEMORY, "%s: no memory for %zu times %zu bytes", path, count, element_size);
    return memory;
}

char *nook_scene_copy_string(const char *text)
{
    size_t size = text ? strlen(text) + 1 : 1;
    char *copy = nook_scene_allocate("a name", size, 1);
    if (copy && text)
        memcpy(copy, text, size);
    return copy;
}

void nook_scene_warn(nook_scene *scene, const char *format, ...)
{
    char text[WARNING_CAPACITY];
    va_list arguments;
    if (scene && scene->warning_count == WARNINGS_MAX)
        return;
    if (scene && !scene->warnings &&
        !(scene->warnings = nook_scene_allocate(scene->path, WARNINGS_MAX, sizeof(char *))))
        return;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (!scene) {
        nook_log_warning("%s", text);
        return;
    }
    if (scene->warning_count == WARNINGS_MAX - 1)
        snprintf(text, sizeof text, "%s: further warnings are not shown", scene->path);
    if (!scene->silent)
        nook_log_warning("%s", text);
    char *copy = nook_scene_copy_string(text);
    if (copy)
        scene->warnings[scene->warning_count++] = copy;
}

bool nook_scene_add_file(nook_scene *scene, const char *path)
{
    for (uint32_t i = 0; i < scene->file_count; i++)
        if (strcmp(scene->files[i], path) == 0)
            return true;
    char *copy = nook_scene_copy_string(path);
    char **files = copy ? realloc(scene->files, (scene->file_count + 1) * sizeof *files) : NULL;
    if (!files) {
        free(copy);
        nook_fail(NOOK_E_MEMORY, "%s: no memory for the name of a file", path);
        return false;
    }
    scene->files = files;
    scene->files[scene->file_count++] = copy;
    return true;
}

nook_result nook_scene_add_density(nook_scene *scene, const char *name, const nook_medium *medium,
                                   const nook_matrix *world_from_local)
{
    if (scene->density_count == NOOK_SCENE_DENSITIES_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: more than %d densities; join some in one file", scene->path,
                         NOOK_SCENE_DENSITIES_MAX);
    uint64_t cells = nook_medium_cells(medium);
    for (uint32_t i = 0; i < scene->density_count; i++)
        cells += nook_medium_cells(&scene->densities[i].medium);
    if (cells > NOOK_MEDIUM_CELLS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: its densities have more than %llu samples together; make them coarser",
                         scene->path, NOOK_MEDIUM_CELLS_MAX);
    if (!scene->densities)
        scene->densities = nook_scene_allocate(scene->path, NOOK_SCENE_DENSITIES_MAX, sizeof *scene->densities);
    char *copy = scene->densities ? nook_scene_copy_string(name) : NULL;
    if (!copy)
        return NOOK_E_MEMORY;
    scene->densities[scene->density_count++] = (nook_scene_density){ copy, *medium, *world_from_local };
    return NOOK_OK;
}

void nook_scene_default_material(nook_material *out_material)
{
    *out_material = (nook_material){
        .base_colour = { 1.0f, 1.0f, 1.0f, 1.0f },
        .metallic = 1.0f,
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .occlusion_strength = 1.0f,
        .alpha_cutoff = 0.5f,
        .base_colour_image = NOOK_NONE,
        .metallic_roughness_image = NOOK_NONE,
        .normal_image = NOOK_NONE,
        .emissive_image = NOOK_NONE,
        .occlusion_image = NOOK_NONE,
    };
}

static void find_mesh_bounds(const nook_scene *scene, nook_mesh *mesh)
{
    vec3 box[2];
    glm_aabb_invalidate(box);
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
        nook_vertex *vertices = scene->vertices + primitive->first_vertex;
        for (uint32_t v = 0; v < primitive->vertex_count; v++) {
            glm_vec3_minv(box[0], vertices[v].position, box[0]);
            glm_vec3_maxv(box[1], vertices[v].position, box[1]);
        }
    }
    glm_vec3_copy(box[0], mesh->bounds_min);
    glm_vec3_copy(box[1], mesh->bounds_max);
}

static void grow_bounds(nook_scene *scene, const nook_node *node, const nook_primitive *primitive)
{
    const nook_vertex *vertices = scene->vertices + primitive->first_vertex;
    for (uint32_t v = 0; v < primitive->vertex_count; v++) {
        double p[3] = { vertices[v].position[0], vertices[v].position[1], vertices[v].position[2] };
        nook_matrix_apply_point(&node->world_from_local, p, p);
        for (int k = 0; k < 3; k++) {
            scene->bounds_min[k] = fmin(scene->bounds_min[k], p[k]);
            scene->bounds_max[k] = fmax(scene->bounds_max[k], p[k]);
        }
    }
}

static void measure_nodes(nook_scene *scene)
{
    for (int k = 0; k < 3; k++) {
        scene->bounds_min[k] = DBL_MAX;
        scene->bounds_max[k] = -DBL_MAX;
    }
    scene->triangle_count = 0;
    for (uint32_t n = 0; n < scene->node_count; n++) {
        const nook_node *node = &scene->nodes[n];
        if (node->mesh == NOOK_NONE)
            continue;
        const nook_mesh *mesh = &scene->meshes[node->mesh];
        for (uint32_t p = 0; p < mesh->primitive_count; p++) {
            const nook_primitive *primitive = &scene->primitives[mesh->first_primitive + p];
            scene->triangle_count += primitive->index_count / 3;
            grow_bounds(scene, node, primitive);
        }
    }
}

static bool has_area(const nook_scene *scene, const nook_primitive *primitive)
{
    const nook_vertex *v = scene->vertices + primitive->first_vertex;
    const uint32_t *index = scene->indices + primitive->first_index;
    for (uint32_t i = 0; i + 2 < primitive->index_count; i += 3) {
        double ab[3], ac[3], normal[3];
        nook_vector_between(v[index[i]].position, v[index[i + 1]].position, ab);
        nook_vector_between(v[index[i]].position, v[index[i + 2]].position, ac);
        nook_vector_cross(ab, ac, normal);
        if (normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0)
            return true;
    }
    return false;
}

static void warn_when_nothing_shows(nook_scene *scene)
{
    bool shows = false;
    for (uint32_t p = 0; p < scene->primitive_count && !shows; p++)
        shows = has_area(scene, &scene->primitives[p]);
    if (scene->triangle_count == 0)
        nook_scene_warn(scene, "%s: nothing to draw: no triangle in the default scene", scene->path);
    else if (!shows)
        nook_scene_warn(scene, "%s: nothing to draw: all triangles are degenerate", scene->path);
}

nook_result nook_scene_finish(nook_scene *scene)
{
    for (uint32_t m = 0; m < scene->mesh_count; m++)
        find_mesh_bounds(scene, &scene->meshes[m]);
    measure_nodes(scene);
    warn_when_nothing_shows(scene);
    if (scene->triangle_count == 0)
        return NOOK_OK;
    double size = 0.0, largest = 0.0;
    for (int k = 0; k < 3; k++) {
        size = fmax(size, scene->bounds_max[k] - scene->bounds_min[k]);
        largest = fmax(largest, fmax(fabs(scene->bounds_min[k]), fabs(scene->bounds_max[k])));
    }
    if (!(largest <= coordinate_max))
        return nook_fail(NOOK_E_FORMAT, "%s: reaches out to %g m, beyond %g; scale it down", scene->path, largest,
                         coordinate_max);
    if (size < (double)FLT_MIN || size < largest * (double)FLT_EPSILON)
        nook_scene_warn(scene, "%s: its box is only %g m wide, %g m from the origin: no usable size", scene->path, size,
                        largest);
    return NOOK_OK;
}

bool nook_primitive_is_opaque(const nook_scene *scene, const nook_primitive *primitive)
{
    return primitive->index_count > 0 && scene->materials[primitive->material].alpha_mode != NOOK_ALPHA_BLEND;
}

uint32_t nook_scene_deformable_of_node(const nook_scene *scene, uint32_t node)
{
    for (uint32_t i = 0; i < scene->deformable_count; i++)
        if (scene->deformables[i].node == node)
            return i;
    return NOOK_NONE;
}

void nook_scene_forget_motion(nook_scene *scene)
{
    for (uint32_t i = 0; i < scene->skin_count; i++)
        free(scene->skins[i].name);
    for (uint32_t i = 0; i < scene->clip_count; i++)
        free(scene->clips[i].name);
    for (uint32_t i = 0; scene->nodes && i < scene->node_count; i++) {
        scene->nodes[i].animated = false;
        scene->nodes[i].skin = NOOK_NONE;
    }
    void *arrays[] = { scene->rest,         scene->skins,        scene->joints,        scene->deformables,
                       scene->influences,   scene->morph_deltas, scene->morph_weights, scene->joint_boxes,
                       scene->target_boxes, scene->clips,        scene->tracks,        scene->track_values,
                       scene->rest_vertices };
    for (size_t i = 0; i < NOOK_COUNT(arrays); i++)
        free(arrays[i]);
    scene->rest = NULL;
    scene->rest_vertices = NULL;
    scene->rest_vertex_count = 0;
    scene->skins = NULL;
    scene->joints = NULL;
    scene->deformables = NULL;
    scene->influences = NULL;
    scene->morph_deltas = NULL;
    scene->morph_weights = NULL;
    scene->joint_boxes = scene->target_boxes = NULL;
    scene->clips = NULL;
    scene->tracks = NULL;
    scene->track_values = NULL;
    scene->skin_count = scene->joint_count = scene->deformable_count = scene->morph_weight_count = 0;
    scene->influence_count = scene->morph_delta_count = 0;
    scene->joint_box_count = scene->target_box_count = 0;
    scene->clip_count = scene->track_count = scene->track_value_count = 0;
}

void nook_scene_destroy(nook_scene *scene)
{
    if (!scene)
        return;
    for (uint32_t i = 0; scene->meshes && i < scene->mesh_count; i++)
        free(scene->meshes[i].name);
    for (uint32_t i = 0; scene->materials && i < scene->material_count; i++)
        free(scene->materials[i].name);
    for (uint32_t i = 0; scene->images && i < scene->image_count; i++) {
        free(scene->images[i].name);
        nook_image_free(scene->images[i].pixels);
    }
    for (uint32_t i = 0; scene->nodes && i < scene->node_count; i++)
        free(scene->nodes[i].name);
    for (uint32_t i = 0; scene->cameras && i < scene->camera_count; i++)
        free(scene->cameras[i].name);
    nook_scene_forget_motion(scene);
    for (uint32_t i = 0; i < scene->density_count; i++) {
        free(scene->densities[i].name);
        free((void *)(uintptr_t)scene->densities[i].medium.extinction);
    }
    free(scene->densities);
    for (uint32_t i = 0; i < scene->warning_count; i++)
        free(scene->warnings[i]);
    for (uint32_t i = 0; i < scene->file_count; i++)
        free(scene->files[i]);
    void *arrays[] = { scene->vertices,  scene->indices,  scene->primitives, scene->meshes,
                       scene->materials, scene->images,   scene->nodes,      scene->cameras,
                       scene->lights,    scene->warnings, scene->files,      scene->path };
    for (size_t i = 0; i < NOOK_COUNT(arrays); i++)
        free(arrays[i]);
    free(scene);
}
