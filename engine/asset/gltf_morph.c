/* Morph targets: what each adds to the vertices of a mesh. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

/* Where one attribute of one target goes. */
typedef struct destination {
    nook_morph_delta *deltas; /* of the primitive's vertices */
    size_t offset;            /* in a delta */
    bool must_be_finite;
} destination;

static nook_result read_attribute(nook_gltf *gltf, uint32_t accessor, const nook_primitive *to,
                                  const nook_gltf_origin *origin, destination out)
{
    if (accessor == NOOK_GLTF_NONE)
        return NOOK_OK;
    float *values = nook_scene_allocate(gltf->path, (size_t)gltf->model->accessors[accessor].count * 3, sizeof *values);
    if (!values)
        return NOOK_E_MEMORY;
    nook_result result = NOOK_OK;
    nook_gltf_read_floats(gltf, accessor, values);
    for (uint32_t v = 0; v < to->vertex_count && result == NOOK_OK; v++) {
        uint32_t source = origin->source_vertices ? origin->source_vertices[v] : v;
        const float *value = values + (size_t)source * 3;
        bool finite = isfinite(value[0]) && isfinite(value[1]) && isfinite(value[2]);
        if (finite)
            memcpy((char *)&out.deltas[v] + out.offset, value, 3 * sizeof *value);
        else if (out.must_be_finite)
            result = nook_fail(NOOK_E_FORMAT, "%s: accessors[%u]: what a morph target adds to vertex %u is not finite",
                               gltf->path, accessor, source);
    }
    free(values);
    return result;
}

static void find_target_box(const nook_morph_delta *deltas, uint32_t count, nook_box *box)
{
    for (uint32_t v = 0; v < count; v++)
        for (int k = 0; k < 3; k++) {
            box->min[k] = fminf(box->min[k], deltas[v].position[k]);
            box->max[k] = fmaxf(box->max[k], deltas[v].position[k]);
        }
}

static nook_result read_target(nook_gltf *gltf, const nook_deformable *d, uint32_t t)
{
    nook_scene *scene = gltf->scene;
    const nook_mesh *mesh = &scene->meshes[d->mesh];
    nook_morph_delta *deltas = scene->morph_deltas + d->first_delta + (size_t)t * d->vertex_count;
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        uint32_t primitive = mesh->first_primitive + p;
        const nook_primitive *to = &scene->primitives[primitive];
        const nook_gltf_origin *origin = &gltf->origins[primitive];
        const nook_gltf_target *target = &gltf->model->targets[origin->primitive->first_target + t];
        nook_morph_delta *out = deltas + (to->first_vertex - d->first_vertex);
        nook_result result =
            read_attribute(gltf, target->position, to, origin,
                           (destination){ out, offsetof(nook_morph_delta, position), .must_be_finite = true });
        if (result == NOOK_OK && !to->flat)
            result = read_attribute(gltf, target->normal, to, origin,
                                    (destination){ out, offsetof(nook_morph_delta, normal), .must_be_finite = false });
        if (result != NOOK_OK)
            return result;
    }
    find_target_box(deltas, d->vertex_count, &scene->target_boxes[d->first_target_box + t]);
    return NOOK_OK;
}

nook_result nook_gltf_read_targets(nook_gltf *gltf, const nook_deformable *d)
{
    nook_result result = NOOK_OK;
    for (uint32_t t = 0; t < d->target_count && result == NOOK_OK; t++)
        result = read_target(gltf, d, t);
    return result;
}
