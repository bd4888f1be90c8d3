/**
 * scene.h - a glTF 2.0 file as plain data: everything checked, triangulated and finite, before anyone else sees it.
 *
 * Space     metres, right-handed, Y up (glTF's own). Matrices column-major, column vectors.
 * Memory    one owner: nook_scene_destroy frees all of it. Everything is constant after loading.
 */
#pragma once
#include "engine/asset/scene_motion.h"
#include "engine/core/matrix.h"
#include "engine/core/medium.h"
#include "engine/core/result.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NOOK_NONE UINT32_MAX /**< No such image, material, mesh, ... */

typedef struct nook_vertex {
    float position[3]; /**< Metres, mesh space. Finite. */
    float normal[3];   /**< Unit, mesh space; made from the triangles where the file has none or a broken one. */
    float tangent[4];  /**< xyz unit, w = +-1 (bitangent sign); all 0 without a normal map. */
    float uv[2];       /**< First texture coordinates; 0 when absent. KHR_texture_transform is applied. */
    float colour[4];   /**< Linear vertex colour; 1 when absent. */
} nook_vertex;

/** Triangles with one material: a glTF primitive; strips and fans are expanded. */
typedef struct nook_primitive {
    uint32_t first_vertex, vertex_count; /**< Into scene->vertices. */
    uint32_t first_index,
        index_count;   /**< Into scene->indices; a multiple of 3; values are relative to first_vertex. */
    uint32_t material; /**< Into scene->materials; always valid (a default one stands at the end). */
    bool flat; /**< The file has no normals: each triangle has its own three vertices, in order, and one normal. */
} nook_primitive;

typedef struct nook_mesh {
    char *name; /**< UTF-8, never NULL. */
    uint32_t first_primitive, primitive_count;
    float bounds_min[3], bounds_max[3]; /**< Mesh space, metres; min > max when the mesh draws nothing. */
} nook_mesh;

typedef enum nook_alpha_mode { NOOK_ALPHA_OPAQUE, NOOK_ALPHA_MASK, NOOK_ALPHA_BLEND } nook_alpha_mode;

typedef struct nook_material {
    char *name;
    float base_colour[4]; /**< Linear, multiplies the image. */
    float metallic, roughness;
    float emissive[3]; /**< Linear, KHR_materials_emissive_strength included. */
    float normal_scale, occlusion_strength;
    float alpha_cutoff; /**< NOOK_ALPHA_MASK. */
    nook_alpha_mode alpha_mode;
    bool double_sided, unlit;
    uint32_t base_colour_image, metallic_roughness_image, normal_image, emissive_image,
        occlusion_image; /**< Or NOOK_NONE. */
} nook_material;

/** 8-bit RGBA, top row first. Colour images are sRGB encoded, data images linear; the material slot tells which. */
typedef struct nook_image {
    char *name;
    uint8_t *pixels; /**< width * height * 4 bytes; NULL when it could not be read (a warning was logged). */
    uint32_t width, height;
} nook_image;

typedef struct nook_node {
    char *name;
    uint32_t parent; /**< NOOK_NONE for a root. Parents stand before their children. */
    uint32_t mesh;   /**< NOOK_NONE for none. */
    uint32_t camera, light;
    uint32_t skin; /**< NOOK_NONE. */
    /**
     * Composed in double. As loaded a skinned mesh's node has the identity, and its vertices are not posed: glTF places such a
     * mesh by its joints alone. engine/animation poses it.
     */
    nook_matrix world_from_local;
    /**
     * A rigid body: the nearest extras {"nook_body": true or false}, on it or above it, decides; without one, whether
     * its mesh is drawn by several nodes.
     */
    bool moving;
    double mass;   /**< Kilograms, extras {"nook_mass": number}; 0 when it is not given. */
    bool hung;     /**< extras {"nook_hung": true}: the body hangs on another and does not fall. */
    bool animated; /**< A clip moves it or a node above it, or its mesh is a deformable: nothing else may move it. */
} nook_node;

typedef struct nook_scene_camera {
    char *name;
    double fov_y_radians, z_near;
    bool perspective; /**< false: orthographic, not used by the renderer. */
    nook_matrix world_from_view;
} nook_scene_camera;

typedef enum nook_light_kind { NOOK_LIGHT_DIRECTIONAL, NOOK_LIGHT_POINT, NOOK_LIGHT_SPOT } nook_light_kind;

typedef struct nook_light {
    nook_light_kind kind;
    float colour[3];              /**< Linear. */
    float intensity;              /**< Lux (directional) or candela. */
    float range;                  /**< Metres; 0 = unbounded. */
    float inner_cone, outer_cone; /**< Radians; spot only. */
    nook_matrix world_from_light; /**< Shines along -Z. */
} nook_light;

enum { NOOK_SCENE_DENSITIES_MAX = 64 };

/** A scalar field that darkens what is around it: extras {"nook_density": ...} of a node (docs/volume_kinds.md). Nothing draws it. */
typedef struct nook_scene_density {
    char *name;                   /**< Of its node, never NULL. */
    nook_medium medium;           /**< Local space; its extinction is owned. */
    nook_matrix world_from_local; /**< Of its node as loaded; invertible. It stands still. */
} nook_scene_density;

typedef struct nook_scene {
    char *path;
    nook_vertex *vertices;
    size_t vertex_count;
    uint32_t *indices;
    size_t index_count;
    nook_primitive *primitives;
    uint32_t primitive_count;
    nook_mesh *meshes;
    uint32_t mesh_count;
    nook_material *materials;
    uint32_t material_count; /**< At least 1: the last is glTF's default material. */
    nook_image *images;
    uint32_t image_count;
    nook_node *nodes;
    uint32_t node_count;      /**< Those reachable from the default scene. */
    uint32_t file_node_count; /**< All in the file, those of other scenes included. */
    nook_scene_camera *cameras;
    uint32_t camera_count; /**< One per node that has a camera. */
    nook_light *lights;
    uint32_t light_count; /**< One per node that has a light. */
    nook_scene_density *densities;
    uint32_t density_count; /**< At most NOOK_SCENE_DENSITIES_MAX; NULL and 0 for most scenes. */
    uint32_t skin_count, joint_count, deformable_count, morph_weight_count, joint_box_count, target_box_count,
        clip_count, track_count, track_value_count;
    nook_node_rest *rest; /**< As nodes; NULL in scenes that no file was loaded for. */
    nook_vertex
        *rest_vertices; /**< Of deformables; NULL until vertices hold a pose (engine/animation/scene_stand.h). */
    size_t rest_vertex_count;
    nook_skin *skins; /* what can move: engine/asset/scene_motion.h */
    nook_skin_joint *joints;
    nook_deformable *deformables;
    nook_influence *influences;
    size_t influence_count;
    nook_morph_delta *morph_deltas;
    size_t morph_delta_count;
    double *morph_weights;
    nook_box *joint_boxes, *target_boxes;
    nook_clip *clips;
    nook_track *tracks;
    float *track_values;
    uint64_t triangle_count;             /**< Drawn by the default scene, instances counted, degenerate ones too. */
    double bounds_min[3], bounds_max[3]; /**< World space of all drawn vertices; min > max when nothing is drawn. */
    char **warnings;
    uint32_t warning_count;
    bool silent; /**< Warnings are kept, not logged. */
    char *
        *files; /**< What it was read from: itself, buffers and images, those of joined scenes; as they were opened. */
    uint32_t file_count;
} nook_scene;

typedef struct nook_scene_options {
    bool skip_images; /**< Leave pixels NULL: for tools that need geometry only. */
    bool silent;      /**< Keep warnings in the scene only: for a first look at a file that is loaded again. */
} nook_scene_options;

/**
 * Loads .gltf or .glb.
 * @param options  NULL for the defaults
 * @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT (one line says what is wrong), NOOK_E_VERSION, NOOK_E_MEMORY;
 *         *out_scene is NULL on failure
 */
nook_result nook_scene_load(const char *path, const nook_scene_options *options, nook_scene **out_scene);
void nook_scene_destroy(nook_scene *scene); /**< NULL is allowed. */

/** A scene made by code, for tests and fixtures: one mesh, one node, one default material. Copies its inputs. */
nook_result nook_scene_from_triangles(const char *name, const float *positions, uint32_t vertex_count,
                                      const uint32_t *indices, uint32_t index_count, nook_scene **out_scene);

/** Whether it draws triangles, and not as glass. */
bool nook_primitive_is_opaque(const nook_scene *scene, const nook_primitive *primitive);
/** The deformable of a node. @return NOOK_NONE: its mesh keeps its shape */
uint32_t nook_scene_deformable_of_node(const nook_scene *scene, uint32_t node);

/* For those who change a scene before it is used. */

/** Mesh boxes and the world box, triangle_count, and the checks of what is drawn. @return NOOK_E_FORMAT when too large */
nook_result nook_scene_finish(nook_scene *scene);
/** Replaces the normals of these triangles' vertices by those of the faces; the vertices must not be shared. */
void nook_scene_make_flat_normals(nook_vertex *vertices, uint32_t vertex_count);
/** The same place and view direction without scale, shear and mirroring: what cameras and lights take of their node. */
nook_matrix nook_scene_without_scale(const nook_matrix *world_from_local);
/** Leaves what stands: no skins, deformables and clips, and no node is animated any more. */
void nook_scene_forget_motion(nook_scene *scene);

#ifdef __cplusplus
}
#endif
