/* What can move, of scenes that are joined. */
#include "engine/asset/scene_internal.h"
#include <string.h>

/* Everything that is counted, of the parts whose nodes come. */
typedef struct motion_counts {
    size_t skins, joints, deformables, influences, deltas, weights, joint_boxes, target_boxes, clips, tracks, values;
} motion_counts;

static motion_counts count_motion(const nook_scene_part *parts, uint32_t count)
{
    motion_counts sum = { 0 };
    for (uint32_t i = 0; i < count; i++) {
        const nook_scene *scene = parts[i].scene;
        if (!parts[i].nodes)
            continue;
        sum.skins += scene->skin_count;
        sum.joints += scene->joint_count;
        sum.deformables += scene->deformable_count;
        sum.influences += scene->influence_count;
        sum.deltas += scene->morph_delta_count;
        sum.weights += scene->morph_weight_count;
        sum.joint_boxes += scene->joint_box_count;
        sum.target_boxes += scene->target_box_count;
        sum.clips += scene->clip_count;
        sum.tracks += scene->track_count;
        sum.values += scene->track_value_count;
    }
    return sum;
}

nook_result nook_scene_allocate_motion(nook_scene *scene, const nook_scene_part *parts, uint32_t count, size_t nodes)
{
    const motion_counts sum = count_motion(parts, count);
    const char *path = scene->path;
    scene->rest = nook_scene_allocate(path, nodes, sizeof *scene->rest);
    scene->skins = nook_scene_allocate(path, sum.skins, sizeof *scene->skins);
    scene->joints = nook_scene_allocate(path, sum.joints, sizeof *scene->joints);
    scene->deformables = nook_scene_allocate(path, sum.deformables, sizeof *scene->deformables);
    scene->influences = nook_scene_allocate(path, sum.influences, sizeof *scene->influences);
    scene->morph_deltas = nook_scene_allocate(path, sum.deltas, sizeof *scene->morph_deltas);
    scene->morph_weights = nook_scene_allocate(path, sum.weights, sizeof *scene->morph_weights);
    scene->joint_boxes = nook_scene_allocate(path, sum.joint_boxes, sizeof *scene->joint_boxes);
    scene->target_boxes = nook_scene_allocate(path, sum.target_boxes, sizeof *scene->target_boxes);
    scene->clips = nook_scene_allocate(path, sum.clips, sizeof *scene->clips);
    scene->tracks = nook_scene_allocate(path, sum.tracks, sizeof *scene->tracks);
    scene->track_values = nook_scene_allocate(path, sum.values, sizeof *scene->track_values);
    bool made = scene->rest && scene->skins && scene->joints && scene->deformables && scene->influences &&
                scene->morph_deltas && scene->morph_weights && scene->joint_boxes && scene->target_boxes &&
                scene->clips && scene->tracks && scene->track_values;
    return made ? NOOK_OK : NOOK_E_MEMORY;
}

/* Parts made by code lack these arrays, and memcpy takes no NULL. */
static void append(void *to, size_t at, const void *from, size_t count, size_t element_size)
{
    if (count > 0)
        memcpy((char *)to + at * element_size, from, count * element_size);
}

/* A node that no file gave a rest stands where it stands. */
static void append_rest(nook_scene *to, const nook_scene *from, uint32_t node)
{
    for (uint32_t i = 0; i < from->node_count; i++)
        to->rest[node + i] =
            from->rest ? from->rest[i]
                       : (nook_node_rest){ .is_matrix = true, .parent_from_local = from->nodes[i].world_from_local };
}

static nook_result append_skins(nook_scene *to, const nook_scene *from, uint32_t node)
{
    for (uint32_t i = 0; i < from->skin_count; i++) {
        nook_skin *skin = &to->skins[to->skin_count];
        *skin = from->skins[i];
        skin->first_joint += to->joint_count;
        skin->name = nook_scene_copy_string(from->skins[i].name);
        if (!skin->name)
            return NOOK_E_MEMORY;
        to->skin_count++;
    }
    append(to->joints, to->joint_count, from->joints, from->joint_count, sizeof *to->joints);
    for (uint32_t i = 0; i < from->joint_count; i++)
        to->joints[to->joint_count + i].node += node;
    return NOOK_OK;
}

static void append_deformables(nook_scene *to, const nook_scene *from, uint32_t first_skin, uint32_t node,
                               uint32_t mesh, uint32_t vertex)
{
    for (uint32_t i = 0; i < from->deformable_count; i++) {
        nook_deformable *d = &to->deformables[to->deformable_count + i];
        *d = from->deformables[i];
        d->mesh += mesh;
        d->node += node;
        d->skin += d->skin == NOOK_NONE ? 0 : first_skin;
        d->first_vertex += vertex;
        d->first_influence += d->first_influence == NOOK_NONE ? 0 : (uint32_t)to->influence_count;
        d->first_delta += to->morph_delta_count;
        d->first_weight += to->morph_weight_count;
        d->first_box += to->joint_box_count;
        d->first_target_box += to->target_box_count;
    }
    append(to->influences, to->influence_count, from->influences, from->influence_count, sizeof *to->influences);
    append(to->morph_deltas, to->morph_delta_count, from->morph_deltas, from->morph_delta_count,
           sizeof *to->morph_deltas);
    append(to->morph_weights, to->morph_weight_count, from->morph_weights, from->morph_weight_count,
           sizeof *to->morph_weights);
    append(to->joint_boxes, to->joint_box_count, from->joint_boxes, from->joint_box_count, sizeof *to->joint_boxes);
    append(to->target_boxes, to->target_box_count, from->target_boxes, from->target_box_count,
           sizeof *to->target_boxes);
}

static nook_result append_clips(nook_scene *to, const nook_scene *from, uint32_t node)
{
    for (uint32_t i = 0; i < from->clip_count; i++) {
        nook_clip *clip = &to->clips[to->clip_count];
        *clip = from->clips[i];
        clip->first_track += to->track_count;
        clip->name = nook_scene_copy_string(from->clips[i].name);
        if (!clip->name)
            return NOOK_E_MEMORY;
        to->clip_count++;
    }
    for (uint32_t i = 0; i < from->track_count; i++) {
        nook_track *track = &to->tracks[to->track_count + i];
        *track = from->tracks[i];
        track->node += node;
        track->first_time += to->track_value_count;
        track->first_value += to->track_value_count;
    }
    append(to->track_values, to->track_value_count, from->track_values, from->track_value_count,
           sizeof *to->track_values);
    return NOOK_OK;
}

nook_result nook_scene_append_motion(nook_scene *to, const nook_scene *from, uint32_t node, uint32_t mesh,
                                     uint32_t vertex)
{
    uint32_t first_skin = to->skin_count;
    append_rest(to, from, node);
    nook_result result = append_skins(to, from, node);
    if (result == NOOK_OK)
        result = append_clips(to, from, node);
    if (result != NOOK_OK)
        return result;
    append_deformables(to, from, first_skin, node, mesh, vertex);
    to->joint_count += from->joint_count;
    to->deformable_count += from->deformable_count;
    to->influence_count += from->influence_count;
    to->morph_delta_count += from->morph_delta_count;
    to->morph_weight_count += from->morph_weight_count;
    to->joint_box_count += from->joint_box_count;
    to->target_box_count += from->target_box_count;
    to->track_count += from->track_count;
    to->track_value_count += from->track_value_count;
    return NOOK_OK;
}
