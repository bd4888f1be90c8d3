#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/gltf_vertex_internal.h"
#include "engine/asset/scene_internal.h"
#include <cglm/cglm.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, FLOAT = 5126 };

/* The types KHR_mesh_quantization adds are taken whether or not the file names the extension: they are unambiguous. */
static bool is_type(const nook_gltf_accessor *a, bool integers_as_they_are)
{
    if (a->component_type == FLOAT)
        return true;
    bool small = a->component_type == BYTE || a->component_type == UBYTE || a->component_type == SHORT ||
                 a->component_type == USHORT;
    return small && (integers_as_they_are || a->normalized);
}

static nook_result check_attribute(const nook_gltf *gltf, uint32_t accessor, const char *place, const char *name,
                                   uint32_t components_min, uint32_t components_max, uint32_t count)
{
    if (accessor == NOOK_GLTF_NONE)
        return NOOK_OK;
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    bool integers = strcmp(name, "POSITION") == 0 || strncmp(name, "TEXCOORD", 8) == 0;
    if (a->components < components_min || a->components > components_max)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %s has %u components; expected %u", gltf->path, place, name,
                         a->components, components_min);
    if (!is_type(a, integers))
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %s has componentType %d%s", gltf->path, place, name, a->component_type,
                         a->normalized ? "" : ", not normalized");
    if (a->count != count)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %u of %s, %u of POSITION", gltf->path, place, a->count, name, count);
    return NOOK_OK;
}

nook_result nook_gltf_check_attributes(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place)
{
    uint32_t count = gltf->model->accessors[from->position].count;
    nook_result result;
    if ((result = check_attribute(gltf, from->position, place, "POSITION", 3, 3, count)) ||
        (result = check_attribute(gltf, from->normal, place, "NORMAL", 3, 3, count)) ||
        (result = check_attribute(gltf, from->tangent, place, "TANGENT", 4, 4, count)) ||
        (result = check_attribute(gltf, from->texcoord[0], place, "TEXCOORD_0", 2, 2, count)) ||
        (result = check_attribute(gltf, from->texcoord[1], place, "TEXCOORD_1", 2, 2, count)))
        return result;
    return check_attribute(gltf, from->colour, place, "COLOR_0", 3, 4, count);
}

/** Where in a vertex an attribute goes. */
typedef struct target {
    size_t offset;
    uint32_t components; /**< At most; an accessor with fewer leaves the rest as it is. */
} target;

static nook_result read_attribute(const nook_gltf *gltf, uint32_t accessor, target to, nook_vertex *vertices)
{
    if (accessor == NOOK_GLTF_NONE)
        return NOOK_OK;
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    float *values = nook_scene_allocate(gltf->path, (size_t)a->count * a->components, sizeof *values);
    if (!values)
        return NOOK_E_MEMORY;
    uint32_t components = a->components < to.components ? a->components : to.components;
    nook_gltf_read_floats(gltf, accessor, values);
    for (size_t i = 0; i < a->count; i++)
        memcpy((char *)&vertices[i] + to.offset, values + i * a->components, components * sizeof *values);
    free(values);
    return NOOK_OK;
}

static nook_result check_positions(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                                   const nook_vertex *vertices, uint32_t count)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[from->position];
    vec3 box[2];
    glm_aabb_invalidate(box);
    for (uint32_t i = 0; i < count; i++) {
        vec3 position;
        memcpy(position, vertices[i].position, sizeof position);
        if (!glm_vec3_isvalid(position))
            return nook_fail(NOOK_E_FORMAT, "%s: %s: the position of vertex %u is not finite", gltf->path, place, i);
        glm_vec3_minv(box[0], position, box[0]);
        glm_vec3_maxv(box[1], position, box[1]);
    }
    bool lies = false;
    for (int k = 0; a->has_bounds && a->component_type == FLOAT && k < 3; k++) {
        double low = (double)box[0][k], high = (double)box[1][k];
        double allowed = 1e-3 * (high - low) + 1e-5 * fmax(fabs(low), fabs(high));
        lies = lies || !(fabs(a->min[k] - low) <= allowed) || !(fabs(a->max[k] - high) <= allowed);
    }
    if (lies)
        nook_scene_warn(gltf->scene, "%s: %s: the min and max of POSITION are wrong; not used", gltf->path, place);
    if (!a->has_bounds)
        nook_scene_warn(gltf->scene, "%s: %s: POSITION has no min and max; not needed", gltf->path, place);
    return NOOK_OK;
}

/* KHR_texture_transform: scale, then rotate counter-clockwise as seen in the image (v points down), then move. */
static void transform_uv(const nook_gltf_slot *slot, nook_vertex *vertices, uint32_t count)
{
    double c = cos(slot->rotation), s = sin(slot->rotation);
    for (uint32_t i = 0; i < count; i++) {
        double u = (double)vertices[i].uv[0] * slot->scale[0], v = (double)vertices[i].uv[1] * slot->scale[1];
        vertices[i].uv[0] = (float)(c * u + s * v + slot->offset[0]);
        vertices[i].uv[1] = (float)(-s * u + c * v + slot->offset[1]);
    }
}

static void clean_up(nook_vertex *vertices, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        for (int k = 0; k < 2; k++)
            if (!isfinite(vertices[i].uv[k]))
                vertices[i].uv[k] = 0.0f;
        for (int k = 0; k < 4; k++)
            if (!isfinite(vertices[i].colour[k]))
                vertices[i].colour[k] = 1.0f;
    }
}

static nook_result read_all(nook_gltf *gltf, const nook_gltf_primitive *from, nook_vertex *vertices, uint32_t count)
{
    const nook_gltf_slot *slot = nook_gltf_material_uv_slot(gltf, from->material);
    uint32_t set = slot && slot->texcoord < 2 ? slot->texcoord : 0;
    nook_result result;
    for (uint32_t i = 0; i < count; i++)
        vertices[i] = (nook_vertex){ .colour = { 1.0f, 1.0f, 1.0f, 1.0f } };
    if ((result = read_attribute(gltf, from->position, (target){ offsetof(nook_vertex, position), 3 }, vertices)) ||
        (result = read_attribute(gltf, from->normal, (target){ offsetof(nook_vertex, normal), 3 }, vertices)) ||
        (result = read_attribute(gltf, from->tangent, (target){ offsetof(nook_vertex, tangent), 4 }, vertices)) ||
        (result = read_attribute(gltf, from->texcoord[set], (target){ offsetof(nook_vertex, uv), 2 }, vertices)) ||
        (result = read_attribute(gltf, from->colour, (target){ offsetof(nook_vertex, colour), 4 }, vertices)))
        return result;
    if (slot)
        transform_uv(slot, vertices, count);
    clean_up(vertices, count);
    return NOOK_OK;
}

/* What moves the vertices is read later, and asks where they come from. */
static nook_result remember_sources(nook_gltf *gltf, const nook_primitive *to)
{
    nook_gltf_origin *origin = &gltf->origins[to - gltf->scene->primitives];
    const uint32_t *indices = gltf->scene->indices + to->first_index;
    if (origin->primitive->joints == NOOK_GLTF_NONE && origin->primitive->target_count == 0)
        return NOOK_OK;
    origin->source_vertices = nook_scene_allocate(gltf->path, to->index_count, sizeof *indices);
    if (!origin->source_vertices)
        return NOOK_E_MEMORY;
    memcpy(origin->source_vertices, indices, to->index_count * sizeof *indices);
    return NOOK_OK;
}

/* Gives every corner its own vertex, in place of the shared ones, which are the last of the scene. */
static nook_result unshare(nook_gltf *gltf, nook_primitive *to)
{
    nook_scene *scene = gltf->scene;
    nook_result result = remember_sources(gltf, to);
    if (result != NOOK_OK)
        return result;
    nook_vertex *shared = nook_scene_allocate(gltf->path, to->vertex_count, sizeof *shared);
    if (!shared)
        return NOOK_E_MEMORY;
    memcpy(shared, scene->vertices + to->first_vertex, to->vertex_count * sizeof *shared);
    scene->vertex_count = to->first_vertex;
    nook_vertex *vertices = nook_gltf_add_vertices(gltf, to->index_count);
    uint32_t *indices = scene->indices + to->first_index;
    for (uint32_t i = 0; vertices && i < to->index_count; i++) {
        vertices[i] = shared[indices[i]];
        indices[i] = i;
    }
    free(shared);
    if (!vertices)
        return NOOK_E_MEMORY;
    to->vertex_count = to->index_count;
    nook_scene_make_flat_normals(vertices, to->vertex_count);
    return NOOK_OK;
}

static bool tangents_are_good(const nook_vertex *vertices, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        vec3 tangent;
        memcpy(tangent, vertices[i].tangent, sizeof tangent);
        float square = glm_vec3_norm2(tangent);
        if (!(square > 0.5f && square < 2.0f) || fabsf(vertices[i].tangent[3]) != 1.0f)
            return false;
    }
    return true;
}

/* @return whether they had to be made from the triangles */
static bool complete_tangents(nook_gltf *gltf, const nook_gltf_primitive *from, const nook_primitive *to)
{
    nook_vertex *vertices = gltf->scene->vertices + to->first_vertex;
    bool wanted = gltf->scene->materials[to->material].normal_image != NOOK_NONE;
    bool given = from->tangent != NOOK_GLTF_NONE && from->normal != NOOK_GLTF_NONE;
    if (wanted && given && tangents_are_good(vertices, to->vertex_count))
        return false;
    for (uint32_t i = 0; i < to->vertex_count; i++)
        memset(vertices[i].tangent, 0, sizeof vertices[i].tangent);
    if (wanted)
        nook_scene_make_tangents(vertices, to->vertex_count, gltf->scene->indices + to->first_index, to->index_count);
    return wanted;
}

/* @return whether normals or tangents were made, so that the vertices fit these triangles only */
static bool complete_surface(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                             const nook_primitive *to)
{
    uint32_t broken = 0;
    if (from->normal != NOOK_GLTF_NONE)
        broken = nook_scene_repair_normals(gltf->scene->vertices + to->first_vertex, to->vertex_count,
                                           gltf->scene->indices + to->first_index, to->index_count);
    if (broken)
        nook_scene_warn(gltf->scene, "%s: %s: %u broken normals are made from the triangles", gltf->path, place,
                        broken);
    return complete_tangents(gltf, from, to) || broken > 0;
}

/* Whether two primitives have the same vertices, whatever their triangles. */
static bool same_vertices(const nook_gltf *gltf, const nook_gltf_primitive *a, const nook_gltf_primitive *b)
{
    return a && a->position == b->position && a->normal == b->normal && a->tangent == b->tangent &&
           a->colour == b->colour && a->joints == b->joints && a->weights == b->weights && a->target_count == 0 &&
           b->target_count == 0 && a->texcoord[0] == b->texcoord[0] && a->texcoord[1] == b->texcoord[1] &&
           (a->material == b->material ||
            (!nook_gltf_material_uv_slot(gltf, a->material) && !nook_gltf_material_uv_slot(gltf, b->material)));
}

nook_result nook_gltf_read_vertices(nook_gltf *gltf, const nook_gltf_primitive *from, const char *place,
                                    nook_primitive *to, nook_gltf_vertex_source *previous)
{
    uint32_t count = gltf->model->accessors[from->position].count;
    to->vertex_count = count;
    if (same_vertices(gltf, previous->primitive, from)) {
        to->first_vertex = previous->first_vertex;
        return NOOK_OK;
    }
    to->first_vertex = (uint32_t)gltf->scene->vertex_count;
    nook_vertex *vertices = nook_gltf_add_vertices(gltf, count);
    if (!vertices)
        return NOOK_E_MEMORY;
    nook_result result = read_all(gltf, from, vertices, count);
    if (result == NOOK_OK)
        result = check_positions(gltf, from, place, vertices, count);
    bool flat = from->normal == NOOK_GLTF_NONE;
    if (result == NOOK_OK && flat)
        result = unshare(gltf, to);
    if (result != NOOK_OK)
        return result;
    bool changed = complete_surface(gltf, from, place, to);
    *previous = (nook_gltf_vertex_source){ flat || changed ? NULL : from, to->first_vertex };
    return NOOK_OK;
}
