/**
 * level.h - a level as its text file says it: glTF files, and entities with components. docs/playing.md has the format.
 *
 * Everything here is plain data that was checked when it was read; nothing refers to GL, physics or the ECS.
 */
#pragma once
#include "engine/core/result.h"
#include <stdbool.h>
#include <stdint.h>

enum {
    NOOK_LEVEL_NAME_SIZE = 64,
    NOOK_LEVEL_TEXT_SIZE = 256,
    NOOK_LEVEL_NEEDS_MAX = 8,
    NOOK_LEVEL_FILES_MAX = 16,
    NOOK_LEVEL_ENTITIES_MAX = 4096 /**< They are looked up by name, one after the other. */
};

/** A glTF file of the level. */
typedef struct nook_level_file {
    char path[1024]; /**< As it can be opened from the working directory. */
    char name
        [NOOK_LEVEL_NAME_SIZE]; /**< "": all of its nodes stand in the level. Else a library: they come by "name:node". */
    unsigned line;              /**< Where in the level's file it is named, for messages; 0: it is the level itself. */
} nook_level_file;

typedef enum nook_level_kind {
    NOOK_LEVEL_BODY,    /**< A rigid body. */
    NOOK_LEVEL_FIXED,   /**< Stands still. */
    NOOK_LEVEL_MOVER,   /**< Goes from where it stands to another place when what it needs is so, and back when not. */
    NOOK_LEVEL_SPINNER, /**< Turns when what it needs is so. */
    NOOK_LEVEL_PLATE,   /**< Is down while enough weight lies on it. */
    NOOK_LEVEL_SHADE,   /**< Is open while little of the sky is seen from its top. */
    NOOK_LEVEL_GOAL     /**< A box that the player must come to. No node. */
} nook_level_kind;

typedef enum nook_level_shape {
    NOOK_LEVEL_SHAPE_AUTO, /**< The simplest that fits: game/level/shape_fit.h. */
    NOOK_LEVEL_SHAPE_BOX,
    NOOK_LEVEL_SHAPE_CYLINDER,
    NOOK_LEVEL_SHAPE_SPHERE,
    NOOK_LEVEL_SHAPE_MESH, /**< Its triangles; not of bodies. */
    NOOK_LEVEL_SHAPE_NONE
} nook_level_shape;

/** An entity: a header line "[kind name]" and what stands below it. Members that its kind does not have are zero. */
typedef struct nook_level_entity {
    nook_level_kind kind;
    /** Unique; also that of the scene's node, unless `node` says another. Bodies and fixed ones: "crate_*" is all nodes so named. */
    char name[NOOK_LEVEL_NAME_SIZE];
    char node[NOOK_LEVEL_NAME_SIZE]; /**< "node" or "library:node"; the same as name when it is not given. */
    bool placed;    /**< at or turn was given, and what is not is 0: else it stands where its file has it. */
    double at[3];   /**< Metres. */
    double turn[3]; /**< Degrees about x, then y, then z. */
    nook_level_shape shape;
    double mass; /**< Kilograms; 0: the node's nook_mass, else by its box and the density of body.def. */
    double friction, restitution; /**< Coulomb coefficient; [0, 1]. Those of body.def when they are not given. */
    char needs[NOOK_LEVEL_NEEDS_MAX][NOOK_LEVEL_NAME_SIZE]; /**< Entities that must all be down, open or there. */
    uint32_t need_count;
    unsigned needs_line;       /**< Where they stand in the file. */
    double slide[3], swing[3]; /**< Mover: metres, and degrees, from closed to open. */
    double seconds;            /**< Mover: from closed to open. Plate, shade: how long it must hold. */
    double axis[3], rpm;       /**< Spinner: unit, own space. */
    bool latch;                /**< Plate, shade, mover, spinner: stays open for the rest of the try once it opened. */
    double weight;             /**< Plate: kilograms. */
    char accepts
        [NOOK_LEVEL_NAME_SIZE]; /**< Plate: only bodies of this name, "crate_*" for several; "" all, the player too. */
    double visibility, reach;   /**< Shade: most of the sky that may be seen, [0, 1]; metres that count. */
    double size[3];             /**< Goal: metres, `at` is its middle. */
    unsigned line;              /**< Where in the file, for messages. */
} nook_level_entity;

typedef struct nook_level {
    char path[1024];
    char title[NOOK_LEVEL_TEXT_SIZE], task[NOOK_LEVEL_TEXT_SIZE], won[NOOK_LEVEL_TEXT_SIZE], lost[NOOK_LEVEL_TEXT_SIZE];
    char settings[1024]; /**< Of the AO while it is played; "": as it comes. */
    nook_level_file files[NOOK_LEVEL_FILES_MAX];
    uint32_t file_count;
    double start[3];             /**< The player's feet. */
    double yaw, pitch;           /**< Degrees; yaw 0 looks along -Z, + to the left; pitch + up. */
    double seconds;              /**< Of play until it is lost; 0: no end. */
    nook_level_entity *entities; /**< Owned. */
    uint32_t entity_count;
    /** A still floor that no file has: half its side, 0 for none, and its middle. For models without ground below them. */
    double ground_half, ground[3];
    double
        loose_longest; /**< Nodes whose box in the world is at most this long are bodies, metres; 0: those that glTF says. */
} nook_level;

/**
 * Reads a level, or makes one of a glTF file (.gltf, .glb: all its nodes, nothing to win, the start where there is room).
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (file:line: what is wrong), NOOK_E_MEMORY; *out_level is NULL then
 */
nook_result nook_level_read(const char *path, nook_level **out_level);
void nook_level_free(nook_level *level); /**< NULL is allowed. */

/** "body", "plate", ... */
const char *nook_level_kind_name(nook_level_kind kind);
/** Whether a name is the pattern, or begins with it where the pattern ends in '*'. */
bool nook_level_name_matches(const char *pattern, const char *name);
/**
 * The entity that says what a node of the scene is: one of its very name before patterns, the first of these.
 * Entities of libraries name nodes of their own. @return NULL: none does
 */
const nook_level_entity *nook_level_find_node(const nook_level *level, const char *node);
/** @return NULL: there is none of that name */
const nook_level_entity *nook_level_find(const nook_level *level, const char *name);
