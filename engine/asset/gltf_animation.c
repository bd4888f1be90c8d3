/* Animations: channels and their samplers become tracks. What their keys say is checked here, once. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { UINT = 5125, FLOAT = 5126 };

/* A channel that is being read. */
typedef struct channel_place {
    uint32_t animation, channel;
    const nook_gltf_sampler *sampler;
} channel_place;

static const char *const path_names[] = { [NOOK_TRACK_TRANSLATION] = "translation",
                                          [NOOK_TRACK_ROTATION] = "rotation",
                                          [NOOK_TRACK_SCALE] = "scale",
                                          [NOOK_TRACK_WEIGHTS] = "weights" };
static const char *const interpolation_names[] = {
    [NOOK_STEP] = "STEP", [NOOK_LINEAR] = "LINEAR", [NOOK_CUBIC_SPLINE] = "CUBICSPLINE"
};

static size_t find_name(const char *const *names, size_t count, const char *name)
{
    size_t i = 0;
    while (i < count && strcmp(names[i], name) != 0)
        i++;
    return i;
}

static uint32_t targets_of_node(const nook_scene *scene, uint32_t node)
{
    uint32_t deformable = nook_scene_deformable_of_node(scene, node);
    return deformable == NOOK_NONE ? 0 : scene->deformables[deformable].target_count;
}

/* ---- Keys -------------------------------------------------------------------------------------------------------- */

static nook_result fail(const nook_gltf *gltf, const channel_place *place, const char *what)
{
    return nook_fail(NOOK_E_FORMAT, "%s: animations[%u].channels[%u]: %s", gltf->path, place->animation, place->channel,
                     what);
}

static nook_result check_accessors(const nook_gltf *gltf, const channel_place *place, const nook_track *track)
{
    const nook_gltf_accessor *input = &gltf->model->accessors[place->sampler->input];
    const nook_gltf_accessor *output = &gltf->model->accessors[place->sampler->output];
    bool scalars = track->path == NOOK_TRACK_WEIGHTS;
    bool fractions = track->path == NOOK_TRACK_WEIGHTS || track->path == NOOK_TRACK_ROTATION;
    bool typed = output->component_type == FLOAT || (fractions && output->normalized && output->component_type < UINT);
    uint64_t values = (uint64_t)input->count * (track->interpolation == NOOK_CUBIC_SPLINE ? 3 : 1);
    if (input->components != 1 || input->component_type != FLOAT)
        return fail(gltf, place, "its times are not single floats");
    if (output->components != (scalars ? 1 : track->width) || !typed)
        return fail(gltf, place, "its values are not of the type that its path asks for");
    if (output->count != values * (scalars ? track->width : 1))
        return nook_fail(NOOK_E_FORMAT, "%s: animations[%u].channels[%u]: %u values for %u times; expected %llu",
                         gltf->path, place->animation, place->channel, output->count, input->count,
                         (unsigned long long)(values * (scalars ? track->width : 1)));
    return NOOK_OK;
}

static nook_result check_times(const nook_gltf *gltf, const channel_place *place, const float *times, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) {
        if (!isfinite(times[i]) || times[i] < 0.0f)
            return fail(gltf, place, "a time is negative or not finite");
        if (i > 0 && times[i] < times[i - 1])
            return fail(gltf, place, "its times fall");
    }
    return NOOK_OK;
}

/* Rotations become unit; those of splines stay as they are, because their tangents are measured on them. */
static nook_result check_values(const nook_gltf *gltf, const channel_place *place, const nook_track *track,
                                float *values, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return fail(gltf, place, "a value is not finite");
    if (track->path != NOOK_TRACK_ROTATION)
        return NOOK_OK;
    bool spline = track->interpolation == NOOK_CUBIC_SPLINE;
    for (size_t i = spline ? 4 : 0; i < count; i += spline ? 12 : 4) {
        double length = 0.0;
        for (size_t k = 0; k < 4; k++)
            length += (double)values[i + k] * (double)values[i + k];
        length = sqrt(length);
        if (!(length > 0.0))
            return fail(gltf, place, "a rotation has no length");
        for (size_t k = 0; k < 4 && !spline; k++)
            values[i + k] = (float)((double)values[i + k] / length);
    }
    return NOOK_OK;
}

static nook_result read_keys(nook_gltf *gltf, const channel_place *place, nook_track *track)
{
    nook_scene *scene = gltf->scene;
    nook_result result = check_accessors(gltf, place, track);
    if (result != NOOK_OK)
        return result;
    track->key_count = gltf->model->accessors[place->sampler->input].count;
    const nook_gltf_accessor *output = &gltf->model->accessors[place->sampler->output];
    size_t values = (size_t)output->count * output->components, total = scene->track_value_count;
    total += values + track->key_count;
    if (total > NOOK_GLTF_TRACK_VALUES_MAX)
        return nook_fail(NOOK_E_MEMORY, "%s: its animations have more than %d numbers; split it", gltf->path,
                         NOOK_GLTF_TRACK_VALUES_MAX);
    float *grown = realloc(scene->track_values, total * sizeof *grown);
    if (!grown)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for the keys of its animations", gltf->path);
    scene->track_values = grown;
    track->first_time = scene->track_value_count;
    track->first_value = track->first_time + track->key_count;
    nook_gltf_read_floats(gltf, place->sampler->input, grown + track->first_time);
    nook_gltf_read_floats(gltf, place->sampler->output, grown + track->first_value);
    scene->track_value_count = (uint32_t)total;
    result = check_times(gltf, place, grown + track->first_time, track->key_count);
    return result == NOOK_OK ? check_values(gltf, place, track, grown + track->first_value, values) : result;
}

/* ---- Tracks ------------------------------------------------------------------------------------------------------ */

/* @return false: nothing in the scene is moved by it */
static bool find_target(nook_gltf *gltf, const channel_place *place, const nook_gltf_channel *from, nook_track *out)
{
    nook_scene *scene = gltf->scene;
    size_t path = find_name(path_names, NOOK_COUNT(path_names), from->path);
    if (path == NOOK_COUNT(path_names)) {
        nook_scene_warn(scene, "%s: animations[%u].channels[%u] moves '%.20s', which is not known; left out",
                        gltf->path, place->animation, place->channel, from->path);
        return false;
    }
    if (from->node == NOOK_GLTF_NONE || gltf->scene_nodes[from->node] == NOOK_NONE)
        return false;
    out->node = gltf->scene_nodes[from->node];
    out->path = (nook_track_path)path;
    out->width = path == NOOK_TRACK_WEIGHTS ? targets_of_node(scene, out->node) : path == NOOK_TRACK_ROTATION ? 4 : 3;
    if (out->width == 0 || (path != NOOK_TRACK_WEIGHTS && scene->rest[out->node].is_matrix)) {
        nook_scene_warn(scene, "%s: animations[%u].channels[%u] moves %s of nodes[%u], which has %s; left out",
                        gltf->path, place->animation, place->channel, from->path, from->node,
                        out->width == 0 ? "no morph targets" : "a matrix");
        return false;
    }
    return true;
}

static nook_result read_track(nook_gltf *gltf, channel_place *place, nook_clip *clip)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_animation *animation = &gltf->model->animations[place->animation];
    const nook_gltf_channel *from = &gltf->model->channels[animation->first_channel + place->channel];
    nook_track track = { .node = NOOK_NONE };
    if (from->sampler >= animation->sampler_count)
        return nook_fail(NOOK_E_FORMAT, "%s: animations[%u].channels[%u].sampler is %u; there are %u", gltf->path,
                         place->animation, place->channel, from->sampler, animation->sampler_count);
    place->sampler = &gltf->model->samplers[animation->first_sampler + from->sampler];
    size_t interpolation =
        find_name(interpolation_names, NOOK_COUNT(interpolation_names), place->sampler->interpolation);
    if (interpolation == NOOK_COUNT(interpolation_names))
        return nook_fail(NOOK_E_FORMAT,
                         "%s: animations[%u].samplers[%u].interpolation is '%.20s'; expected LINEAR, "
                         "STEP or CUBICSPLINE",
                         gltf->path, place->animation, from->sampler, place->sampler->interpolation);
    track.interpolation = (nook_interpolation)interpolation;
    if (!find_target(gltf, place, from, &track))
        return NOOK_OK;
    nook_result result = read_keys(gltf, place, &track);
    if (result != NOOK_OK)
        return result;
    clip->duration = fmax(clip->duration, (double)scene->track_values[track.first_time + track.key_count - 1]);
    scene->nodes[track.node].animated = true;
    scene->tracks[scene->track_count++] = track;
    clip->track_count++;
    return NOOK_OK;
}

static nook_result read_clip(nook_gltf *gltf, uint32_t index)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_animation *animation = &gltf->model->animations[index];
    nook_clip *clip = &scene->clips[index];
    *clip = (nook_clip){ .name = nook_scene_copy_string(animation->name), .first_track = scene->track_count };
    if (!clip->name)
        return NOOK_E_MEMORY;
    scene->clip_count++;
    for (uint32_t c = 0; c < animation->channel_count; c++) {
        channel_place place = { .animation = index, .channel = c };
        nook_result result = read_track(gltf, &place, clip);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result nook_gltf_convert_animations(nook_gltf *gltf)
{
    nook_scene *scene = gltf->scene;
    const nook_gltf_model *model = gltf->model;
    scene->clips = nook_scene_allocate(gltf->path, model->animation_count, sizeof *scene->clips);
    scene->tracks = nook_scene_allocate(gltf->path, model->channel_count, sizeof *scene->tracks);
    if (!scene->clips || !scene->tracks)
        return NOOK_E_MEMORY;
    for (uint32_t i = 0; i < model->animation_count; i++) {
        nook_result result = read_clip(gltf, i);
        if (result != NOOK_OK)
            return result;
    }
    for (uint32_t n = 0; n < scene->node_count; n++) { /* parents stand before their children */
        uint32_t parent = scene->nodes[n].parent;
        scene->nodes[n].animated |= parent != NOOK_NONE && scene->nodes[parent].animated;
    }
    return NOOK_OK;
}
