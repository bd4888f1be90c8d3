/**
 * edge_render.h - the usual scene drawn by the engine's own renderer, as a game draws it: nodes in double, vertices in float.
 */
#pragma once
#include "engine/render/renderer.h"
#include "game/extremes/edge_scene.h"

/** Release with nook_edge_render_free. */
typedef struct nook_edge_render {
    nook_gpu *gpu;
    nook_scene *all;  /**< Owns the vertices. */
    nook_scene scene; /**< The same with a mesh for each body. */
    nook_primitive primitives[NOOK_EDGE_BODIES];
    nook_mesh meshes[NOOK_EDGE_BODIES];
    nook_render_scene *uploaded;
    nook_renderer *renderer;
} nook_edge_render;

/** Uploads the bodies of `scene`. It must stay where it was made. @return as nook_renderer_create; zero on failure */
nook_result nook_edge_render_make(const nook_extremes *extremes, const nook_edge_scene *scene,
                                  nook_edge_render *out_render);
void nook_edge_render_free(nook_edge_render *render); /**< Zeroed is allowed. */

/**
 * Draws the bodies where their occluders are, and puts the renderer's depths and geometric normals, every bit of them, in the place
 * of the view's. @param scene  the one it was made from, moved or not
 */
nook_result nook_edge_render_draw(nook_edge_render *render, nook_edge_scene *scene);
