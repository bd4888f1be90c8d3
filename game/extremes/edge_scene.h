/**
 * edge_scene.h - the scene that most extreme cases look at: a floor, a wall behind it, a box and a ball on it, four bodies in sight of
 * one camera, 7.3 units from corner to corner. Made by code, at any scale.
 */
#pragma once
#include "game/extremes/edge_estimator.h"
#include "game/extremes/extremes.h"
#include "modules/ao/technique.h"
#include "modules/fixture/view.h"

/** What of it is not as usual; zero means as usual. */
typedef struct nook_edge_scene_desc {
    uint32_t width, height;             /**< Pixels; 0: 48 x 48. */
    uint32_t resolution;                /**< Voxels along a body's longest side; 0: 64. */
    double vertex_scale;                /**< The vertices are multiplied by it; 0: 1. */
    double matrix_scale;                /**< World_from_mesh is multiplied by it; 0: 1. */
    double vertex_offset[3];            /**< Vertices are that far from their mesh's origin; matrices take them back. */
    double z_near, z_far;               /**< Before scaling; 0: 0.1 and infinite. */
    bool normal_z;                      /**< Depth 0 is near; else reversed. */
    bool rows_down;                     /**< Row 0 is the top row: a flipped projection. */
    uint32_t depth_format;              /**< As in nook_fixture_view_desc. */
    uint32_t normal_format;             /**< As in nook_fixture_view_desc. */
    uint32_t frame_index;               /**< Seeds the noise. */
    const nook_ao_technique *technique; /**< Added to those of the program. NULL: none. */
    void *user;                         /**< For it: pass->progress_user. */
} nook_edge_scene_desc;

enum { NOOK_EDGE_BODIES = 4 };

typedef struct nook_edge_scene {
    nook_fixture_view *view;
    nook_fixture_mesh world;                    /**< All bodies at their places, before any nook_edge_scene_move. */
    nook_fixture_mesh bodies[NOOK_EDGE_BODIES]; /**< As they were baked; their matrices are in view->occluders. */
    size_t pixels;                              /**< Of the view. */
    double scale;                               /**< World units per unit of the usual scene. */
    double diagonal;                            /**< World units. */
    double voxel_size;                          /**< Of the coarsest volume, world units. */
} nook_edge_scene;

/**
 * Bakes the bodies, draws them, and sets r_max to 0.8 usual units and all rays to 16. Release with nook_edge_scene_free.
 * @return as nook_fixture_view_create, _add and _draw; *out_scene is zero on failure
 */
nook_result nook_edge_scene_make(const nook_extremes *extremes, const nook_edge_scene_desc *desc,
                                 nook_edge_scene *out_scene);
void nook_edge_scene_free(nook_edge_scene *scene); /**< Zeroed is allowed. */

/** Sets r_max in usual units. @return as nook_ao_set_param */
nook_result nook_edge_scene_reach(nook_edge_scene *scene, double r_max);
/** Draws again, with the camera and the projection as they are now. Before any move. */
nook_result nook_edge_scene_draw(nook_edge_scene *scene);
/** Carries bodies, camera and normals along with `move`, rigid or mirrored: the picture must stay the same. */
void nook_edge_scene_move(nook_edge_scene *scene, const nook_matrix *move);

/** Every estimator of the program, and what is outside of [0, 1] as the worst. @param what  where that is */
nook_result nook_edge_scene_record_all(nook_edge_scene *scene, nook_extreme_found *found, const char *what);

/** Records and counts what is outside [0, 1]. @param estimator  its name, or a technique's @param format  where, as in nook_extreme_check */
nook_result nook_edge_scene_record(nook_edge_scene *scene, const char *estimator, nook_extreme_found *found,
                                   const char *format, ...) NOOK_PRINTF(4, 5);
