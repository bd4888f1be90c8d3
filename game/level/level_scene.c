#include "game/level/level_scene.h"
#include "engine/animation/scene_stand.h"
#include "engine/asset/scene_join.h"
#include "engine/core/file.h"
#include "engine/core/log.h"
#include "engine/core/rotation.h"
#include "engine/core/suggestion.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The files of a level, loaded, in its order; behind them a ground where it has one. */
typedef struct loading {
    const nook_level *level;
    nook_scene_part parts[NOOK_LEVEL_FILES_MAX + 1];
    uint32_t part_count;
    nook_scene_instance *instances;
    uint32_t instance_count;
} loading;

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static nook_result load_files(loading *l, const nook_scene_options *options)
{
    for (uint32_t i = 0; i < l->level->file_count; i++) {
        const nook_level_file *file = &l->level->files[i];
        nook_scene *scene;
        if (file->line > 0 && !nook_file_exists(file->path))
            return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: there is no file %s; paths are relative to the level's own",
                             l->level->path, file->line, file->path);
        nook_result result = nook_scene_load(file->path, options, &scene);
        if (result != NOOK_OK)
            return result;
        l->parts[l->part_count++] = (nook_scene_part){ scene, !*file->name };
        if (*file->name && scene->density_count)
            nook_log_warning("%s: the scalar field of %s is left out: libraries give what nodes draw; put it into the "
                             "scene of the level",
                             file->path, scene->densities[0].name);
    }
    return NOOK_OK;
}

static nook_result make_ground(loading *l)
{
    const nook_level *level = l->level;
    if (!(level->ground_half > 0.0))
        return NOOK_OK;
    float positions[4][3];
    static const uint32_t indices[] = { 0, 1, 2, 2, 1, 3 };
    for (int i = 0; i < 4; i++) {
        positions[i][0] = (float)(level->ground[0] + (i / 2 ? 1.0 : -1.0) * level->ground_half);
        positions[i][1] = (float)level->ground[1];
        positions[i][2] = (float)(level->ground[2] + (i % 2 ? 1.0 : -1.0) * level->ground_half);
    }
    nook_scene *scene;
    nook_result result = nook_scene_from_triangles("ground", positions[0], 4, indices, 6, &scene);
    if (result != NOOK_OK)
        return result;
    scene->materials[0].metallic = 0.0f;
    l->parts[l->part_count++] = (nook_scene_part){ scene, true };
    return NOOK_OK;
}

/* ---- Nodes ------------------------------------------------------------------------------------------------------- */

static bool moves(const nook_level_entity *entity)
{
    return entity->kind == NOOK_LEVEL_BODY || entity->kind == NOOK_LEVEL_MOVER || entity->kind == NOOK_LEVEL_SPINNER;
}

/* Splits "library:node"; for a plain node the library is "". @return the node */
static const char *split_node(const char *node, char out_library[NOOK_LEVEL_NAME_SIZE])
{
    const char *colon = strchr(node, ':');
    snprintf(out_library, NOOK_LEVEL_NAME_SIZE, "%.*s", colon ? (int)(colon - node) : 0, node);
    return colon ? colon + 1 : node;
}

/* Where an entity puts its node; the node keeps its scale. */
static nook_matrix place(const nook_level_entity *entity, const nook_node *node)
{
    double rotation[4], scale[3] = { 1, 1, 1 };
    if (!entity->placed)
        return node->world_from_local;
    nook_rotation_from_matrix(&node->world_from_local, rotation, scale);
    nook_rotation_from_degrees(entity->turn, rotation);
    return nook_matrix_compose(entity->at, rotation, scale);
}

static nook_result check_node(const loading *l, const nook_level_entity *entity, const nook_scene *scene,
                              uint32_t index)
{
    if (scene->nodes[index].mesh == NOOK_NONE)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: the node %s of %s draws nothing", l->level->path, entity->line,
                         entity->name, scene->nodes[index].name, scene->path);
    if (scene->nodes[index].animated)
        return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: the node %s of %s is moved by an animation; leave it to that",
                         l->level->path, entity->line, entity->name, scene->nodes[index].name, scene->path);
    for (uint32_t i = index + 1; i < scene->node_count; i++) {
        if (scene->nodes[i].parent == index && scene->nodes[i].mesh != NOOK_NONE)
            return nook_fail(NOOK_E_FORMAT,
                             "%s:%u: %s: the node %s of %s has %s below it, which would stay behind; join their meshes",
                             l->level->path, entity->line, entity->name, scene->nodes[index].name, scene->path,
                             scene->nodes[i].name);
    }
    return NOOK_OK;
}

static nook_result refuse_node(const loading *l, const nook_level_entity *entity, const char *library, const char *node)
{
    bool known = false;
    nook_suggestion near = nook_suggestion_for(node);
    for (uint32_t p = 0; p < l->level->file_count; p++) {
        if (strcmp(l->level->files[p].name, library) != 0)
            continue;
        known = true;
        for (uint32_t i = 0; i < l->parts[p].scene->node_count; i++)
            nook_suggestion_offer(&near, l->parts[p].scene->nodes[i].name);
    }
    const char *hint = near.nearest ? near.nearest : "";
    if (!known)
        return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: %s: there is no library %s; the top of the file names them",
                         l->level->path, entity->line, entity->name, library);
    return nook_fail(NOOK_E_NOT_FOUND, "%s:%u: %s: there is no node %s in %s%s%s%s", l->level->path, entity->line,
                     entity->name, node, *library ? library : "the scene", *hint ? "; did you mean " : "", hint,
                     *hint ? "?" : "");
}

/* Nodes are known by their names: that of an entity from a library must not be another's. */
static nook_result check_name(const loading *l, const nook_level_entity *entity)
{
    for (uint32_t p = 0; p < l->part_count; p++) {
        const nook_scene *scene = l->parts[p].scene;
        for (uint32_t i = 0; i < scene->node_count && l->parts[p].nodes; i++) {
            if (strcmp(scene->nodes[i].name, entity->name) == 0)
                return nook_fail(NOOK_E_FORMAT, "%s:%u: %s: %s has a node of that name; give the entity another",
                                 l->level->path, entity->line, entity->name, scene->path);
        }
    }
    return NOOK_OK;
}

static nook_result take_from_library(loading *l, const nook_level_entity *entity, const char *library,
                                     const char *node_name)
{
    for (uint32_t p = 0; p < l->level->file_count; p++) {
        const nook_scene *scene = l->parts[p].scene;
        if (strcmp(l->level->files[p].name, library) != 0)
            continue;
        for (uint32_t i = 0; i < scene->node_count; i++) {
            if (strcmp(scene->nodes[i].name, node_name) != 0)
                continue;
            l->instances[l->instance_count++] =
                (nook_scene_instance){ entity->name, p, i, place(entity, &scene->nodes[i]), moves(entity) };
            nook_result result = check_name(l, entity);
            return result == NOOK_OK ? check_node(l, entity, scene, i) : result;
        }
    }
    return refuse_node(l, entity, library, node_name);
}

/* What an entity says of nodes that stand in the level's scenes. */
static nook_result change_nodes(loading *l, const nook_level_entity *entity)
{
    bool found = false, pattern = strchr(entity->node, '*') != NULL;
    for (uint32_t p = 0; p < l->part_count; p++) {
        nook_scene *scene = l->parts[p].scene;
        for (uint32_t i = 0; i < scene->node_count && l->parts[p].nodes; i++) {
            nook_node *node = &scene->nodes[i];
            if (!nook_level_name_matches(entity->node, node->name))
                continue;
            if (pattern && node->mesh == NOOK_NONE)
                continue; /* a light, a camera, a group: nobody has named it */
            found = true;
            if (nook_level_find_node(l->level, node->name) != entity)
                continue; /* another names it more closely */
            nook_result result = check_node(l, entity, scene, i);
            if (result != NOOK_OK)
                return result;
            node->world_from_local = place(entity, node);
            node->moving = moves(entity);
        }
    }
    return found ? NOOK_OK : refuse_node(l, entity, "", entity->node);
}

static nook_result apply_entities(loading *l)
{
    const nook_level *level = l->level;
    l->instances = calloc(level->entity_count + 1, sizeof *l->instances);
    if (!l->instances)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its entities", level->path);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < level->entity_count && result == NOOK_OK; i++) {
        const nook_level_entity *entity = &level->entities[i];
        char library[NOOK_LEVEL_NAME_SIZE];
        if (entity->kind == NOOK_LEVEL_GOAL)
            continue;
        const char *node = split_node(entity->node, library);
        result = *library ? take_from_library(l, entity, library, node) : change_nodes(l, entity);
    }
    return result;
}

/* The longest side of what a node draws, along its own axes, in the world. */
static double longest_side(const nook_scene *scene, const nook_node *node)
{
    const nook_mesh *mesh = &scene->meshes[node->mesh];
    double rotation[4], scale[3] = { 1, 1, 1 }, longest = 0.0;
    nook_rotation_from_matrix(&node->world_from_local, rotation, scale);
    for (int k = 0; k < 3; k++)
        longest = fmax(longest, fabs(scale[k]) * ((double)mesh->bounds_max[k] - (double)mesh->bounds_min[k]));
    return longest;
}

/* Models whose file says nothing of bodies: what is small enough is one. */
static void loosen(loading *l)
{
    for (uint32_t p = 0; p < l->level->file_count && l->level->loose_longest > 0.0; p++) {
        nook_scene *scene = l->parts[p].scene;
        for (uint32_t i = 0; i < scene->node_count; i++) {
            nook_node *node = &scene->nodes[i];
            if (node->mesh != NOOK_NONE && !node->animated && longest_side(scene, node) <= l->level->loose_longest)
                node->moving = true;
        }
    }
}

nook_result nook_level_scene_load(const nook_level *level, const nook_scene_options *options, nook_scene **out_scene)
{
    loading l = { .level = level };
    *out_scene = NULL;
    nook_result result = load_files(&l, options);
    if (result == NOOK_OK)
        result = make_ground(&l);
    if (result == NOOK_OK)
        result = apply_entities(&l);
    if (result == NOOK_OK) {
        loosen(&l);
        result = nook_scene_join(level->path, l.parts, l.part_count, l.instances, l.instance_count, out_scene);
    }
    if (result == NOOK_OK && (result = nook_scene_stand(*out_scene, NOOK_NONE, 0.0)) != NOOK_OK) {
        nook_scene_destroy(*out_scene);
        *out_scene = NULL;
    }
    for (uint32_t i = 0; i < l.part_count; i++)
        nook_scene_destroy(l.parts[i].scene);
    free(l.instances);
    return result;
}
