#include "engine/animation/scene_pose.h"
#include "engine/animation/sample.h"
#include "engine/core/log.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct nook_node_parts {
    double translation[3], rotation[4], scale[3];
    bool moved; /* by a clip: else the file's own matrix holds, to the last digit */
} nook_node_parts;

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static uint32_t count_joints(const nook_scene *scene)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < scene->deformable_count; i++)
        count += scene->deformables[i].skin == NOOK_NONE ? 0 : scene->skins[scene->deformables[i].skin].joint_count;
    return count;
}

static void lay_out(nook_scene_pose *pose)
{
    const nook_scene *scene = pose->scene;
    uint32_t joint = 0;
    for (uint32_t n = 0; n < scene->node_count; n++)
        pose->weights_of_node[n] = NOOK_NONE;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_deformable *d = &scene->deformables[i];
        pose->weights_of_node[d->node] = d->target_count ? d->first_weight : NOOK_NONE;
        pose->meshes[i].weights = pose->morph + d->first_weight;
        if (d->skin == NOOK_NONE)
            continue;
        pose->meshes[i].joints = pose->joints + joint;
        joint += scene->skins[d->skin].joint_count;
    }
}

nook_result nook_scene_pose_create(const nook_scene *scene, nook_scene_pose **out_pose)
{
    nook_scene_pose *pose = calloc(1, sizeof *pose);
    *out_pose = NULL;
    if (!pose)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its pose", scene->path);
    size_t nodes = scene->node_count + 1u, weights = scene->morph_weight_count + 1u;
    pose->scene = scene;
    pose->world_from_local = calloc(nodes, sizeof *pose->world_from_local);
    pose->parts = calloc(nodes, sizeof *pose->parts);
    pose->weights_of_node = calloc(nodes, sizeof *pose->weights_of_node);
    pose->meshes = calloc(scene->deformable_count + 1u, sizeof *pose->meshes);
    pose->joints = calloc(count_joints(scene) + 1u, sizeof *pose->joints);
    pose->weights = calloc(weights, sizeof *pose->weights);
    pose->morph = calloc(weights, sizeof *pose->morph);
    if (!pose->world_from_local || !pose->parts || !pose->weights_of_node || !pose->meshes || !pose->joints ||
        !pose->weights || !pose->morph) {
        nook_scene_pose_destroy(pose);
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its pose", scene->path);
    }
    lay_out(pose);
    nook_scene_pose_rest(pose);
    nook_scene_pose_finish(pose);
    *out_pose = pose;
    return NOOK_OK;
}

void nook_scene_pose_destroy(nook_scene_pose *pose)
{
    if (!pose)
        return;
    void *arrays[] = { pose->world_from_local, pose->parts, pose->weights_of_node, pose->meshes, pose->joints,
                       pose->weights,          pose->morph };
    for (size_t i = 0; i < NOOK_COUNT(arrays); i++)
        free(arrays[i]);
    free(pose);
}

/* ---- Clips ------------------------------------------------------------------------------------------------------- */

void nook_scene_pose_rest(nook_scene_pose *pose)
{
    const nook_scene *scene = pose->scene;
    for (uint32_t n = 0; n < scene->node_count && scene->rest; n++) {
        const nook_node_rest *rest = &scene->rest[n];
        nook_node_parts *parts = &pose->parts[n];
        memcpy(parts->translation, rest->translation, sizeof parts->translation);
        memcpy(parts->rotation, rest->rotation, sizeof parts->rotation);
        memcpy(parts->scale, rest->scale, sizeof parts->scale);
        parts->moved = false;
    }
    for (uint32_t i = 0; i < scene->morph_weight_count; i++)
        pose->weights[i] = scene->morph_weights[i];
}

void nook_scene_pose_apply(nook_scene_pose *pose, uint32_t clip, double seconds)
{
    const nook_scene *scene = pose->scene;
    const nook_track *tracks = scene->tracks + scene->clips[clip].first_track;
    for (uint32_t i = 0; i < scene->clips[clip].track_count; i++) {
        const nook_track *track = &tracks[i];
        nook_node_parts *parts = &pose->parts[track->node];
        double *out = track->path == NOOK_TRACK_TRANSLATION ? parts->translation
                      : track->path == NOOK_TRACK_ROTATION  ? parts->rotation
                      : track->path == NOOK_TRACK_SCALE     ? parts->scale
                                                            : pose->weights + pose->weights_of_node[track->node];
        nook_track_sample(track, scene->track_values, seconds, out);
        parts->moved = parts->moved || track->path != NOOK_TRACK_WEIGHTS;
    }
}

/* ---- Composing --------------------------------------------------------------------------------------------------- */

static void compose_nodes(nook_scene_pose *pose)
{
    const nook_scene *scene = pose->scene;
    for (uint32_t n = 0; n < scene->node_count; n++) { /* parents stand before their children */
        const nook_node_parts *parts = &pose->parts[n];
        nook_matrix local = scene->rest[n].parent_from_local;
        uint32_t parent = scene->nodes[n].parent;
        if (parts->moved)
            local = nook_matrix_compose(parts->translation, parts->rotation, parts->scale);
        pose->world_from_local[n] =
            parent == NOOK_NONE ? local : nook_matrix_multiply(&pose->world_from_local[parent], &local);
    }
}

/* The least and the most of an affine image of a box, entry by entry instead of corner by corner; wider by more than rounding can be. */
static void add_moved_box(nook_box *out, const nook_joint_matrix *matrix, const nook_box *box)
{
    for (int r = 0; r < 3; r++) {
        const float *row = matrix->row[r];
        float low = row[3], high = row[3], sum = fabsf(row[3]);
        for (int k = 0; k < 3; k++) {
            float a = row[k] * box->min[k], b = row[k] * box->max[k];
            low += fminf(a, b);
            high += fmaxf(a, b);
            sum += fabsf(a) + fabsf(b);
        }
        out->min[r] = fminf(out->min[r], low - 2e-6f * sum);
        out->max[r] = fmaxf(out->max[r], high + 2e-6f * sum);
    }
}

/* What morph targets add at most to any vertex. */
static nook_box morphed_by(const nook_scene_pose *pose, const nook_deformable *d)
{
    nook_box by = { { 0 }, { 0 } };
    for (uint32_t t = 0; t < d->target_count; t++) {
        const nook_box *box = &pose->scene->target_boxes[d->first_target_box + t];
        float weight = pose->morph[d->first_weight + t];
        for (int k = 0; k < 3 && box->min[0] <= box->max[0]; k++) {
            by.min[k] += fminf(weight * box->min[k], weight * box->max[k]);
            by.max[k] += fmaxf(weight * box->min[k], weight * box->max[k]);
        }
    }
    return by;
}

static void find_box(nook_scene_pose *pose, uint32_t index)
{
    static const nook_joint_matrix still = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
    const nook_deformable *d = &pose->scene->deformables[index];
    nook_mesh_pose *mesh = &pose->meshes[index];
    nook_box by = morphed_by(pose, d);
    uint32_t count = d->skin == NOOK_NONE ? 1 : pose->scene->skins[d->skin].joint_count;
    mesh->box = (nook_box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (uint32_t i = 0; i < count; i++) {
        nook_box box = pose->scene->joint_boxes[d->first_box + i];
        if (!(box.min[0] <= box.max[0]))
            continue; /* it moves no vertex */
        for (int k = 0; k < 3; k++) {
            box.min[k] += by.min[k];
            box.max[k] += by.max[k];
        }
        add_moved_box(&mesh->box, mesh->joints ? &mesh->joints[i] : &still, &box);
    }
}

static void compose_joints(nook_scene_pose *pose, const nook_deformable *d, nook_joint_matrix *out)
{
    const nook_scene *scene = pose->scene;
    const nook_skin *skin = &scene->skins[d->skin];
    nook_matrix mesh_from_world;
    if (!nook_matrix_inverse_affine(&pose->world_from_local[d->node], &mesh_from_world))
        pose->world_from_local[d->node] = nook_matrix_identity(); /* the inverse is the identity then */
    for (uint32_t i = 0; i < skin->joint_count; i++) {
        const nook_skin_joint *joint = &scene->joints[skin->first_joint + i];
        nook_matrix m = nook_matrix_multiply(&mesh_from_world, &pose->world_from_local[joint->node]);
        m = nook_matrix_multiply(&m, &joint->joint_from_mesh);
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 4; column++)
                out[i].row[row][column] = (float)m.m[column * 4 + row];
    }
}

void nook_scene_pose_finish(nook_scene_pose *pose)
{
    const nook_scene *scene = pose->scene;
    for (uint32_t n = 0; n < scene->node_count && !scene->rest; n++)
        pose->world_from_local[n] = scene->nodes[n].world_from_local;
    if (scene->rest)
        compose_nodes(pose);
    for (uint32_t i = 0; i < scene->morph_weight_count; i++)
        pose->morph[i] = (float)pose->weights[i];
    nook_joint_matrix *joints = pose->joints;
    for (uint32_t i = 0; i < scene->deformable_count; i++) {
        const nook_deformable *d = &scene->deformables[i];
        if (d->skin != NOOK_NONE) {
            compose_joints(pose, d, joints);
            joints += scene->skins[d->skin].joint_count;
        }
        find_box(pose, i);
    }
}

double nook_clip_time(double duration, double seconds, bool loop)
{
    if (!(duration > 0.0))
        return 0.0;
    if (!loop)
        return fmin(fmax(seconds, 0.0), duration);
    double inside = fmod(seconds, duration);
    if (inside < 0.0)
        inside += duration;
    return inside < duration ? inside : 0.0; /* a tiny negative one may have been rounded up to it */
}

uint32_t nook_clip_find(const nook_scene *scene, const char *name)
{
    for (uint32_t i = 0; i < scene->clip_count; i++)
        if (strcmp(scene->clips[i].name, name) == 0)
            return i;
    return NOOK_NONE;
}
