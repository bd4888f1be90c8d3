/* Skins: joints, inverse bind matrices, and which joints move which vertex. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { UBYTE = 5121, USHORT = 5123, FLOAT = 5126 };

/* ---- Skins ------------------------------------------------------------------------------------------------------- */

static nook_result check_skin(const nook_gltf *gltf, uint32_t index)
{
    const nook_gltf_skin *skin = &gltf->model->skins[index];
    if (skin->joint_count == 0)
        return nook_fail(NOOK_E_FORMAT, "%s: skins[%u] has no joints", gltf->path, index);
    if (skin->joint_count > NOOK_SKIN_JOINTS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: skins[%u] has %u joints; at most %d are read", gltf->path, index,
                         skin->joint_count, NOOK_SKIN_JOINTS_MAX);
    if (skin->inverse_bind == NOOK_GLTF_NONE)
        return NOOK_OK;
    const nook_gltf_accessor *a = &gltf->model->accessors[skin->inverse_bind];
    if (a->components != 16 || a->component_type != FLOAT)
        return nook_fail(NOOK_E_FORMAT, "%s: skins[%u].inverseBindMatrices are not 4x4 matrices of floats", gltf->path,
                         index);
    if (a->count < skin->joint_count)
        return nook_fail(NOOK_E_FORMAT, "%s: skins[%u] has %u inverseBindMatrices for %u joints", gltf->path, index,
                         a->count, skin->joint_count);
    return NOOK_OK;
}

static nook_result take_matrix(nook_gltf *gltf, uint32_t index, uint32_t joint, const float from[16], nook_matrix *out)
{
    for (int i = 0; i < 16; i++)
        if (!isfinite(from[i]))
            return nook_fail(NOOK_E_FORMAT, "%s: skins[%u].inverseBindMatrices: that of joint %u is not finite",
                             gltf->path, index, joint);
    *out = nook_matrix_from_float(from);
    double *m = out->m;
    if (fabs(m[3]) + fabs(m[7]) + fabs(m[11]) + fabs(m[15] - 1.0) > 1e-6)
        nook_scene_warn(gltf->scene,
                        "%s: skins[%u].inverseBindMatrices: that of joint %u has a bottom row other than 0 0 0 1; "
                        "ignored",
                        gltf->path, index, joint);
    m[3] = m[7] = m[11] = 0.0;
    m[15] = 1.0;
    return NOOK_OK;
}

static nook_result read_matrices(nook_gltf *gltf, uint32_t index, nook_skin_joint *joints)
{
    const nook_gltf_skin *skin = &gltf->model->skins[index];
    for (uint32_t i = 0; i < skin->joint_count; i++)
        joints[i].joint_from_mesh = nook_matrix_identity();
    if (skin->inverse_bind == NOOK_GLTF_NONE)
        return NOOK_OK;
    size_t count = gltf->model->accessors[skin->inverse_bind].count;
    float *values = nook_scene_allocate(gltf->path, count * 16, sizeof *values);
    nook_result result = values ? NOOK_OK : NOOK_E_MEMORY;
    if (values)
        nook_gltf_read_floats(gltf, skin->inverse_bind, values);
    for (uint32_t i = 0; i < skin->joint_count && result == NOOK_OK; i++)
        result = take_matrix(gltf, index, i, values + (size_t)i * 16, &joints[i].joint_from_mesh);
    free(values);
    return result;
}

/* Joints outside of the drawn scene have no place there: what the skin moves stays unposed. */
static void find_joints(nook_gltf *gltf, uint32_t index, nook_skin_joint *joints)
{
    const nook_gltf_skin *skin = &gltf->model->skins[index];
    bool said = false;
    for (uint32_t i = 0; i < skin->joint_count; i++) {
        uint32_t node = gltf->model->children[skin->first_joint + i];
        joints[i].node = gltf->scene_nodes[node];
        if (joints[i].node == NOOK_NONE && !said)
            nook_scene_warn(gltf->scene,
                            "%s: skins[%u]: its joint nodes[%u] is not in the drawn scene; what it moves stays unposed",
                            gltf->path, index, node);
        said = said || joints[i].node == NOOK_NONE;
    }
    for (uint32_t n = 0; said && n < gltf->scene->node_count; n++)
        if (gltf->scene->nodes[n].skin == index)
            gltf->scene->nodes[n].skin = NOOK_NONE;
    for (uint32_t i = 0; said && i < skin->joint_count; i++)
        joints[i].node = 0; /* nobody asks, but it is a node */
}

nook_result nook_gltf_convert_skins(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_model *model = gltf->model;
    size_t joints = 0;
    for (uint32_t i = 0; i < model->skin_count; i++) {
        nook_result result = check_skin(gltf, i);
        if (result != NOOK_OK)
            return result;
        joints += model->skins[i].joint_count;
    }
    scene->skins = nook_scene_allocate(gltf->path, model->skin_count, sizeof *scene->skins);
    scene->joints = nook_scene_allocate(gltf->path, joints, sizeof *scene->joints);
    if (!scene->skins || !scene->joints)
        return NOOK_E_MEMORY;
    for (uint32_t i = 0; i < model->skin_count; i++) {
        nook_skin *skin = &scene->skins[i];
        *skin = (nook_skin){ .first_joint = scene->joint_count, .joint_count = model->skins[i].joint_count };
        skin->name = nook_scene_copy_string(model->skins[i].name);
        if (!skin->name)
            return NOOK_E_MEMORY;
        scene->skin_count++;
        find_joints(gltf, i, scene->joints + skin->first_joint);
        nook_result result = read_matrices(gltf, i, scene->joints + skin->first_joint);
        if (result != NOOK_OK)
            return result;
        scene->joint_count += skin->joint_count;
    }
    return NOOK_OK;
}

/* ---- Influences -------------------------------------------------------------------------------------------------- */

static nook_result check_set(const nook_gltf *gltf, uint32_t accessor, const char *place, const char *name, bool type,
                             uint32_t count)
{
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    if (a->components != NOOK_INFLUENCES || !type)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %s has %u components of type %d%s", gltf->path, place, name,
                         a->components, a->component_type, a->normalized ? ", normalized" : "");
    if (a->count != count)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %u of %s, %u of POSITION", gltf->path, place, a->count, name, count);
    return NOOK_OK;
}

static nook_result check_joints(const nook_gltf *gltf, const nook_gltf_primitive *from, const char *place)
{
    uint32_t count = gltf->model->accessors[from->position].count;
    if (from->joints == NOOK_GLTF_NONE && from->weights == NOOK_GLTF_NONE)
        return NOOK_OK;
    if (from->joints == NOOK_GLTF_NONE || from->weights == NOOK_GLTF_NONE)
        return nook_fail(NOOK_E_FORMAT, "%s: %s has one of JOINTS_0 and WEIGHTS_0; expected both", gltf->path, place);
    const nook_gltf_accessor *joints = &gltf->model->accessors[from->joints];
    const nook_gltf_accessor *weights = &gltf->model->accessors[from->weights];
    bool indices = (joints->component_type == UBYTE || joints->component_type == USHORT) && !joints->normalized;
    bool fractions = weights->component_type == FLOAT ||
                     ((weights->component_type == UBYTE || weights->component_type == USHORT) && weights->normalized);
    nook_result result = check_set(gltf, from->joints, place, "JOINTS_0", indices, count);
    return result == NOOK_OK ? check_set(gltf, from->weights, place, "WEIGHTS_0", fractions, count) : result;
}

static nook_result check_target(const nook_gltf *gltf, uint32_t accessor, const char *place, const char *name,
                                uint32_t count)
{
    if (accessor == NOOK_GLTF_NONE)
        return NOOK_OK;
    const nook_gltf_accessor *a = &gltf->model->accessors[accessor];
    bool number = a->component_type == FLOAT || a->component_type <= USHORT; /* KHR_mesh_quantization has integers */
    if (a->components != 3 || !number)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %s of a morph target has %u components of type %d", gltf->path, place,
                         name, a->components, a->component_type);
    if (a->count != count)
        return nook_fail(NOOK_E_FORMAT, "%s: %s: %u of %s of a morph target, %u of POSITION", gltf->path, place,
                         a->count, name, count);
    return NOOK_OK;
}

nook_result nook_gltf_check_deformation(const nook_gltf *gltf, const nook_gltf_primitive *from, const char *place)
{
    uint32_t count = gltf->model->accessors[from->position].count;
    nook_result result = check_joints(gltf, from, place);
    if (result == NOOK_OK && from->target_count > NOOK_MORPH_TARGETS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: %s has %u morph targets; at most %d are read", gltf->path, place,
                         from->target_count, NOOK_MORPH_TARGETS_MAX);
    for (uint32_t t = 0; t < from->target_count && result == NOOK_OK; t++) {
        const nook_gltf_target *target = &gltf->model->targets[from->first_target + t];
        result = check_target(gltf, target->position, place, "POSITION", count);
        if (result == NOOK_OK)
            result = check_target(gltf, target->normal, place, "NORMAL", count);
    }
    return result;
}

/* @return false: no weight of it is a number above 0 */
static bool normalise(const float weights[NOOK_INFLUENCES], nook_influence *out)
{
    double sum = 0.0;
    for (int i = 0; i < NOOK_INFLUENCES; i++)
        sum += weights[i] > 0.0f && isfinite(weights[i]) ? (double)weights[i] : 0.0;
    for (int i = 0; i < NOOK_INFLUENCES; i++) {
        bool counts = sum > 0.0 && weights[i] > 0.0f && isfinite(weights[i]);
        out->weights[i] = counts ? (float)((double)weights[i] / sum) : 0.0f;
    }
    if (!(sum > 0.0))
        out->weights[0] = 1.0f;
    return sum > 0.0;
}

/* The influence of a vertex of the file. */
static nook_result take_influence(const nook_gltf *gltf, const nook_deformable *d, const float *joints,
                                  const float *weights, nook_influence *out, uint32_t *broken)
{
    const nook_skin *skin = &gltf->scene->skins[d->skin];
    *broken += !normalise(weights, out);
    for (int i = 0; i < NOOK_INFLUENCES; i++) {
        bool valid = joints[i] < (float)skin->joint_count;
        if (!valid && out->weights[i] > 0.0f)
            return nook_fail(NOOK_E_FORMAT, "%s: JOINTS_0 of %s names joint %.0f, its skin has %u", gltf->path,
                             gltf->scene->meshes[d->mesh].name, (double)joints[i], skin->joint_count);
        out->joints[i] = valid ? (uint16_t)joints[i] : 0;
    }
    return NOOK_OK;
}

static nook_result read_primitive(nook_gltf *gltf, const nook_deformable *d, const nook_primitive *to,
                                  const nook_gltf_origin *origin, nook_influence *out)
{
    const nook_gltf_primitive *from = origin->primitive;
    if (from->joints == NOOK_GLTF_NONE) { /* a warning was given: the first joint carries it */
        for (uint32_t v = 0; v < to->vertex_count; v++)
            out[v] = (nook_influence){ .weights = { 1.0f } };
        return NOOK_OK;
    }
    size_t numbers = (size_t)gltf->model->accessors[from->joints].count * NOOK_INFLUENCES;
    uint32_t broken = 0;
    float *joints = nook_scene_allocate(gltf->path, numbers, sizeof *joints);
    float *weights = nook_scene_allocate(gltf->path, numbers, sizeof *weights);
    nook_result result = joints && weights ? NOOK_OK : NOOK_E_MEMORY;
    if (result == NOOK_OK) {
        nook_gltf_read_floats(gltf, from->joints, joints);
        nook_gltf_read_floats(gltf, from->weights, weights);
    }
    for (uint32_t v = 0; v < to->vertex_count && result == NOOK_OK; v++) {
        size_t at = (size_t)(origin->source_vertices ? origin->source_vertices[v] : v) * NOOK_INFLUENCES;
        result = take_influence(gltf, d, joints + at, weights + at, &out[v], &broken);
    }
    free(joints);
    free(weights);
    if (broken)
        nook_scene_warn(gltf->scene, "%s: %s: %u vertices have no weights; their first joint moves them", gltf->path,
                        gltf->scene->meshes[d->mesh].name, broken);
    if (from->more_joints != NOOK_GLTF_NONE)
        nook_scene_warn(gltf->scene, "%s: %s: only the first four joints of a vertex are read", gltf->path,
                        gltf->scene->meshes[d->mesh].name);
    return result;
}

static void grow(nook_box *box, const float p[3])
{
    for (int k = 0; k < 3; k++) {
        box->min[k] = fminf(box->min[k], p[k]);
        box->max[k] = fmaxf(box->max[k], p[k]);
    }
}

/* What each joint moves at rest. */
static void find_joint_boxes(nook_scene *scene, const nook_deformable *d)
{
    for (uint32_t v = 0; v < d->vertex_count; v++) {
        const float *position = scene->vertices[d->first_vertex + v].position;
        const nook_influence *influence = &scene->influences[d->first_influence + v];
        for (int i = 0; i < NOOK_INFLUENCES; i++)
            if (influence->weights[i] > 0.0f)
                grow(&scene->joint_boxes[d->first_box + influence->joints[i]], position);
    }
}

nook_result nook_gltf_read_influences(nook_gltf *gltf, const nook_deformable *d)
{
    nook_scene *scene = gltf->scene;
    const nook_mesh *mesh = &scene->meshes[d->mesh];
    for (uint32_t p = 0; p < mesh->primitive_count; p++) {
        uint32_t primitive = mesh->first_primitive + p;
        const nook_primitive *to = &scene->primitives[primitive];
        nook_influence *out = scene->influences + d->first_influence + (to->first_vertex - d->first_vertex);
        nook_result result = read_primitive(gltf, d, to, &gltf->origins[primitive], out);
        if (result != NOOK_OK)
            return result;
    }
    find_joint_boxes(scene, d);
    return NOOK_OK;
}
