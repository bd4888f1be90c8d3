/**
 * renderer.h - the deferred frame: a scene, draws, a camera and lights in; G-buffer textures and a picture out.
 *
 *   create -> upload a scene -> every frame: begin -> (ambient occlusion by the caller) -> finish -> image
 *
 * Space   metres, right-handed, Y up; angles in radians. Colours are linear unless said otherwise.
 * Data    everything a frame needs is in nook_frame; the renderer keeps nothing of it once finish has returned.
 * See     docs/rendering.md for passes, formats and bindings.
 */
#pragma once
#include "engine/animation/scene_pose.h"
#include "engine/asset/scene.h"
#include "engine/core/matrix.h"
#include "engine/core/rectangle.h"
#include "engine/core/result.h"
#include "engine/gpu/gpu.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_MAX_POINT_LIGHTS 64u

typedef struct nook_renderer nook_renderer;         /**< The targets of one size and the passes' state. */
typedef struct nook_render_scene nook_render_scene; /**< A scene on the GPU. */

/** One instance of a mesh in this frame. */
typedef struct nook_draw {
    uint32_t mesh; /**< Into scene->meshes. */
    bool moves;    /**< It may stand elsewhere in the next frame: tells what is worth keeping of a shadow map. */
    nook_matrix world_from_local; /**< Any affine matrix; a singular one is not drawn. */
    uint32_t pose_version; /**< Of a deformable: the frame's. 0: the mesh is as the scene has it, and so is its box. */
    nook_box box;          /**< Of the posed mesh, mesh space; with a pose_version. */
} nook_draw;

typedef struct nook_camera {
    nook_matrix view_from_world; /**< Rigid: rotation and translation only. */
    double fov_y_radians;        /**< Vertical, (0, pi). */
    double z_near;               /**< Metres, > 0. There is no far plane. */
} nook_camera;

/** Parallel light with a shadow map. Black: no sun, no shadow pass. */
typedef struct nook_sun {
    double direction[3]; /**< Where it shines to, world; need not be unit. */
    float colour[3];     /**< Irradiance of a surface that faces it, lux. */
} nook_sun;

typedef struct nook_point_light {
    double position[3];         /**< World, metres. */
    float colour[3];            /**< Radiant intensity, candela. */
    float range;                /**< Metres, where it has faded to 0; 0 = unbounded. */
    double direction[3];        /**< Spot: where it shines to, unit. All 0: a point light, shines everywhere. */
    float cos_inner, cos_outer; /**< Spot: full inside the first angle's cosine, 0 outside the second's. */
} nook_point_light;

typedef struct nook_lights {
    nook_sun sun;
    nook_point_light points[NOOK_MAX_POINT_LIGHTS];
    uint32_t point_count;    /**< At most NOOK_MAX_POINT_LIGHTS. */
    float ambient_top[3];    /**< Radiance of the sky straight up, before exposure. */
    float ambient_bottom[3]; /**< Radiance from straight down. */
    float exposure;          /**< Multiplies all light; > 0. */
} nook_lights;

/** What a frame is made from. Borrowed until nook_frame_finish returns. */
typedef struct nook_frame {
    nook_render_scene *scene;
    const nook_draw *draws; /**< In any order; draws of one mesh become one instanced call. */
    size_t draw_count;
    const nook_mesh_pose *poses; /**< Per deformable of the scene; NULL: vertices are as the scene has them. */
    uint32_t pose_version;       /**< Another one, not 0, whenever the poses differ from those of the frame before. */
    nook_camera camera;
    const nook_lights *lights;
    bool
        quick; /**< For play, not for measuring: material images in the sharper of two mip levels, not anisotropic, filtered and
                     multiplied as sRGB stores colours, and the triangles' normals from the positions of neighbouring pixels, right to about 1e-4;
                     so too the tangents of normal images, which leaves out those of the vertices. */
    bool
        cull_back_faces; /**< true: single-sided materials are not seen from behind, as glTF has it. false: every surface
                               is seen from both sides, as rays, volumes and shadows see it. */
} nook_frame;

/** What nook_frame_finish writes into the image. */
typedef enum nook_view {
    NOOK_VIEW_LIT, /**< The picture. */
    NOOK_VIEW_BASE_COLOUR,
    NOOK_VIEW_NORMAL,           /**< World, * 0.5 + 0.5. */
    NOOK_VIEW_GEOMETRIC_NORMAL, /**< World, * 0.5 + 0.5. */
    NOOK_VIEW_DEPTH,            /**< White near, black far. */
    NOOK_VIEW_METALLIC,
    NOOK_VIEW_ROUGHNESS,
    NOOK_VIEW_EMISSIVE,
    NOOK_VIEW_VISIBILITY,    /**< What ambient light is multiplied by; white where nothing is drawn. */
    NOOK_VIEW_SHADOW,        /**< Fraction of the sun that arrives. */
    NOOK_VIEW_OCCLUSION_MAP, /**< Of the material: what its own texture leaves of ambient light. */
    NOOK_VIEW_LIGHT, /**< The picture before tone mapping, logarithmic: 0 is 1/1024, each doubling adds 16 of 255. */
    NOOK_VIEW_SHADOW_MAP, /**< The sun's whole map, square in the middle: white near the sun, black nothing. */
    NOOK_VIEW_COUNT
} nook_view;

const char *nook_view_name(nook_view view); /**< "lit", "base_colour", ... */
/** @return false for an unknown name; *out_view is untouched */
bool nook_view_parse(const char *name, nook_view *out_view);

/** G-buffer textures of the last begin, for ambient occlusion. Valid until set_size or destroy. */
typedef struct nook_gbuffer {
    nook_texture base_colour;      /**< SRGB8_ALPHA8. */
    nook_texture normal;           /**< RG16, shading, world, octahedral. */
    nook_texture geometric_normal; /**< RG16, of the triangle, faces the viewer: give this one to ambient occlusion. */
    nook_texture material;         /**< RGBA8: metallic, roughness, occlusion map, flags. */
    nook_texture emissive;         /**< R11F_G11F_B10F. */
    nook_texture depth;            /**< DEPTH_COMPONENT32F, reversed-Z, 0 where nothing is drawn. */
} nook_gbuffer;

/**
 * Uploads a scene; images with NULL pixels count as absent.
 * @param scene  borrowed: must outlive the result
 * @return NOOK_E_MEMORY or NOOK_E_RANGE (an image larger than the device takes); *out_scene is NULL then
 */
nook_result nook_render_scene_create(nook_gpu *gpu, const nook_scene *scene, nook_render_scene **out_scene);
void nook_render_scene_destroy(nook_render_scene *scene);         /**< NULL is allowed. */
uint64_t nook_render_scene_bytes(const nook_render_scene *scene); /**< On the GPU, mip chains included. */

/**
 * Puts the vertices of deformables into a pose, unless they are in it; frames with these poses do the same. Before
 * nook_render_scene_vertices are used otherwise.
 * @param poses, version  as in nook_frame
 */
void nook_render_scene_pose(nook_render_scene *scene, const nook_mesh_pose *poses, uint32_t version);
/** nook_vertex of the whole scene, those of deformables in their last pose; and its indices, as scene->primitives have them. */
nook_buffer nook_render_scene_vertices(const nook_render_scene *scene);
nook_buffer nook_render_scene_indices(const nook_render_scene *scene);
/** The image of a material's base colour. @return id 0: it has none */
nook_texture nook_render_scene_base_colour(const nook_render_scene *scene, uint32_t material);

/** The draws of a scene as it stands in its file: one for each node that has a mesh. @param out NULL only counts */
size_t nook_scene_draws(const nook_scene *scene, nook_draw *out);

/** @return NOOK_E_RANGE a size of 0 or above the device's limit, NOOK_E_MEMORY, NOOK_E_DEVICE, NOOK_E_NOT_FOUND (a shader) */
nook_result nook_renderer_create(nook_gpu *gpu, uint32_t width, uint32_t height, nook_renderer **out_renderer);
void nook_renderer_destroy(nook_renderer *renderer); /**< NULL is allowed. */
/** Makes the targets anew; the same size does nothing. On failure the old ones stay. @return as create */
nook_result nook_renderer_set_size(nook_renderer *renderer, uint32_t width, uint32_t height);

/** Draws the sun's shadow map and the G-buffer. @return NOOK_E_ARG a mesh index or a number out of range, NOOK_E_MEMORY */
nook_result nook_frame_begin(nook_renderer *renderer, const nook_frame *frame);
/**
 * Lights the G-buffer of the begin before it and writes the image.
 * @param frame       the one given to nook_frame_begin, unchanged
 * @param visibility  any 2D texture of the frame's size, red = fraction of the sky seen; id 0: everything is open
 */
void nook_frame_finish(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, nook_view view);

/** The two halves of nook_frame_begin, for those who time them: checks, culls and draws the sun's shadow map. @return as begin */
nook_result nook_frame_shadow(nook_renderer *renderer, const nook_frame *frame);
/** Draws the G-buffer of the frame that nook_frame_shadow was given. */
void nook_frame_gbuffer(nook_renderer *renderer, const nook_frame *frame);
/**
 * As nook_frame_finish for a part of the picture; the rest of the image stays: views side by side on one G-buffer.
 * @param part  inside the picture; all zero: all of it
 */
void nook_frame_finish_part(nook_renderer *renderer, const nook_frame *frame, nook_texture visibility, nook_view view,
                            nook_rectangle part);

nook_gbuffer nook_renderer_gbuffer(const nook_renderer *renderer);
/** Clip from view of a camera at the renderer's size: what ambient occlusion needs beside the depth. */
nook_matrix nook_renderer_clip_from_view(const nook_renderer *renderer, const nook_camera *camera);
/** The result: RGBA8, sRGB encoded, row 0 at the bottom. */
nook_texture nook_renderer_image(const nook_renderer *renderer);
/** Reads the result, top row first, RGB. @param out width * height * 3 bytes */
void nook_renderer_read(nook_renderer *renderer, uint8_t *out);
/** Copies the result to the default framebuffer of a window, stretched to width x height pixels. */
void nook_renderer_present(nook_renderer *renderer, uint32_t width, uint32_t height);

/** A sun from the upper left front and a sky; no points. */
nook_lights nook_lights_default(void);
/**
 * The lights of a scene, exposed so that the brightest of them lights a white surface to about white at a distance of a
 * quarter of the scene's size, over a dim sky. The default ones when the scene has none.
 */
nook_lights nook_lights_from_scene(const nook_scene *scene);
/**
 * A three-quarter view from outside that holds the whole box. For interiors the caller chooses.
 * @param bounds_min, bounds_max  world, metres; an empty box (min > max) is taken as a unit cube at the origin
 * @param aspect  width / height
 */
nook_camera nook_camera_frame(const double bounds_min[3], const double bounds_max[3], double aspect);
/** A scene's camera; it must be a perspective one. */
nook_camera nook_camera_from_scene(const nook_scene_camera *camera);

#ifdef __cplusplus
}
#endif
