/**
 * animation.h - clips that run in a world: a component that holds where one is, and the systems that pose the scene by it.
 *
 * Clips that move nodes of one hierarchy are alternatives: one entity plays one of them. Hierarchies of a scene are independent.
 */
#pragma once
#include "engine/animation/scene_pose.h"
#include "engine/ecs/world.h"

/** This entity plays a clip of the scene. */
typedef struct nook_animation {
    uint32_t clip; /**< Into scene->clips. */
    bool loop;     /**< Begins again at its end; false: stays there. */
    double time;   /**< Seconds since it began, at speed 1; any finite number. */
    double speed;  /**< 1 as the file has it, 0 stands, below 0 backwards. */
} nook_animation;

/** What clips have made of a scene. A world resource. */
typedef struct nook_animated_scene {
    nook_scene_pose *pose;
    double step;      /**< Seconds that pass with the next run of systems; they set it to 0. */
    uint32_t version; /**< Another one with each pose; never 0 once a pose was made. */
    bool changes;     /**< In this run. */
} nook_animated_scene;

/**
 * Gives a world an entity for each hierarchy of the scene that has clips, playing the first of them in a loop, and the systems.
 * Before the systems that read transforms.
 * @param pose  of the scene that the world shows; outlives the world
 * @return as nook_world_add_system
 */
nook_result nook_animations_set_up(nook_world *world, nook_scene_pose *pose);
/** The systems of this code, which was loaded anew. @return as nook_world_replace_system */
nook_result nook_animations_renew(nook_world *world);
/** NULL in a world without. */
nook_animated_scene *nook_animations_of(nook_world *world);
