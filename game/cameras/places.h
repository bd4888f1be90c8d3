/**
 * places.h - where views are taken from: around a scene's own cameras, inside a room, or around an object. The k-th trial of a place
 * is a point of a low-discrepancy sequence; whether it is a view worth having is game/cameras/glance.h's.
 */
#pragma once
#include "engine/asset/scene.h"
#include "engine/render/renderer.h"
#include "game/cameras/rays.h"

typedef enum nook_place_kind { NOOK_PLACE_CAMERA, NOOK_PLACE_ROOM, NOOK_PLACE_AROUND } nook_place_kind;

/** A place with its own sequence of views. */
typedef struct nook_place {
    const nook_scene *scene; /**< Borrowed. */
    const nook_rays *rays;   /**< Borrowed. */
    nook_place_kind kind;
    nook_camera camera; /**< The scene's own; else of a room the one inside, of an object the one that holds all. */
    double diagonal;    /**< Of the scene, metres. */
    uint32_t shift;     /**< Where in the sequence it begins: no two places move alike. */
    double (*open)[3];  /**< Of a room: points that one can walk to from the camera. Owned. */
    uint32_t open_count;
} nook_place;

/** @return 1 for scenes without cameras, else one for each that the renderer can use */
uint32_t nook_places_count(const nook_scene *scene);

/**
 * @param index   below the count
 * @param aspect  width / height of the pictures
 * @return NOOK_E_MEMORY; *out_place is zero then
 */
nook_result nook_place_find(const nook_scene *scene, const nook_rays *rays, uint32_t index, double aspect,
                            nook_place *out_place);
void nook_place_free(nook_place *place); /**< Zeroed ones are allowed. */

/** @return false: that trial stands in a wall, or has one between itself and its place */
bool nook_place_try(const nook_place *place, uint32_t trial, nook_camera *out_camera);
