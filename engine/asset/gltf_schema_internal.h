/** gltf_schema_internal.h - inside engine/asset only: what glTF 2.0 says each JSON member must be, as tables. */
#pragma once
#include <stdbool.h>
#include <stdint.h>

typedef enum nook_gltf_kind {
    NOOK_GLTF_INTEGER,    /**< In [low, high]. */
    NOOK_GLTF_REFERENCE,  /**< Integer, smaller than the length of the array `of`. */
    NOOK_GLTF_REFERENCES, /**< Array of those. */
    NOOK_GLTF_REFERENCE_MAP /**< Object of those, any names. */,
    NOOK_GLTF_MAP_LIST, /**< Array of REFERENCE_MAP. */
    NOOK_GLTF_NUMBER,   /**< Finite. */
    NOOK_GLTF_NUMBERS,  /**< Array of `low` finite numbers; of any length when low is 0. */
    NOOK_GLTF_BOOLEAN,
    NOOK_GLTF_STRING,
    NOOK_GLTF_STRINGS, /**< Array. */
    NOOK_GLTF_OBJECT,  /**< With `members`. */
    NOOK_GLTF_LIST,    /**< Array of objects with `members`. */
} nook_gltf_kind;

typedef struct nook_gltf_member {
    const char *name; /**< NULL ends a table. */
    nook_gltf_kind kind;
    bool required;
    const char *of; /**< A top-level array, or "lights" for those of KHR_lights_punctual. */
    const struct nook_gltf_member *members;
    uint64_t low, high;
} nook_gltf_member;

/** The members of the top-level object. Members that stand in no table are not looked at. */
extern const nook_gltf_member nook_gltf_schema[];
