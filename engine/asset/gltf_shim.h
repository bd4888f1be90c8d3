/**
 * gltf_shim.h - tinygltf behind a C header: glTF JSON becomes plain arrays. Nothing is checked and no file is opened here.
 *
 * tinygltf accepts almost any number anywhere, so the text must have passed nook_gltf_check_document first: afterwards
 * every index below is valid or NOOK_GLTF_NONE. Strings live as long as the model.
 */
#pragma once
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define NOOK_GLTF_NOEXCEPT noexcept
extern "C" {
#else
#define NOOK_GLTF_NOEXCEPT
#endif

#define NOOK_GLTF_NONE UINT32_MAX /**< The optional reference is absent. */

typedef struct nook_gltf_view {
    uint32_t buffer;
    uint64_t offset, length; /**< Bytes. */
    uint32_t stride;         /**< Bytes from element to element; 0 = packed. */
} nook_gltf_view;

typedef struct nook_gltf_accessor {
    uint32_t view; /**< NOOK_GLTF_NONE: all zeros, before the sparse part. */
    uint64_t offset;
    uint32_t count;      /**< Elements. */
    int component_type;  /**< GL's enumeration: 5120 byte .. 5126 float. */
    uint32_t components; /**< 1..4 for SCALAR..VEC4, 16 for MAT4; 0 for smaller matrices. */
    bool normalized;
    bool has_bounds; /**< min and max hold `components` numbers, at most 4. */
    double min[4], max[4];
    uint32_t sparse_count; /**< 0: not sparse. */
    uint32_t sparse_index_view, sparse_value_view;
    uint64_t sparse_index_offset, sparse_value_offset;
    int sparse_index_type;
} nook_gltf_accessor;

/** Accessors of the attributes that Nook reads. */
typedef struct nook_gltf_primitive {
    uint32_t position, normal, tangent, colour, joints, weights;
    uint32_t more_joints; /**< JOINTS_1: a vertex with more than four. */
    uint32_t texcoord[2];
    uint32_t indices, material;
    uint32_t mode;                       /**< 0 points .. 4 triangles, 5 strip, 6 fan. */
    uint32_t first_target, target_count; /**< Into model->targets. */
} nook_gltf_primitive;

/** Accessors of a morph target. */
typedef struct nook_gltf_target {
    uint32_t position, normal;
} nook_gltf_target;

typedef struct nook_gltf_mesh {
    const char *name;
    uint32_t first_primitive, primitive_count;
    const double *weights; /**< Of morph targets. */
    uint32_t weight_count;
} nook_gltf_mesh;

/** A texture as a material uses it, KHR_texture_transform included. */
typedef struct nook_gltf_slot {
    uint32_t texture;
    uint32_t texcoord;
    double offset[2], scale[2], rotation; /**< 0 0, 1 1, 0 when there is no transform. */
} nook_gltf_slot;

typedef struct nook_gltf_material {
    const char *name;
    double base_colour[4], emissive[3], emissive_strength;
    double metallic, roughness, normal_scale, occlusion_strength, alpha_cutoff;
    const char *alpha_mode;
    bool double_sided, unlit;
    nook_gltf_slot base_colour_slot, metallic_roughness_slot, normal_slot, occlusion_slot, emissive_slot;
} nook_gltf_material;

typedef struct nook_gltf_node {
    const char *name;
    uint32_t mesh, skin, camera, light;
    uint32_t first_child, child_count; /**< Into model->children. */
    bool has_matrix;
    double matrix[16], translation[3], rotation[4], scale[3];
    int body;              /**< extras.nook_body: 1 true, 0 false, -1 not given. */
    double mass;           /**< extras.nook_mass; 0 not given. */
    bool hung;             /**< extras.nook_hung. */
    const double *weights; /**< Of morph targets, before the mesh's. */
    uint32_t weight_count;
} nook_gltf_node;

typedef struct nook_gltf_skin {
    const char *name;
    uint32_t inverse_bind;             /**< Accessor. */
    uint32_t first_joint, joint_count; /**< Into model->children. */
} nook_gltf_skin;

typedef struct nook_gltf_sampler {
    uint32_t input, output; /**< Accessors. */
    const char *interpolation;
} nook_gltf_sampler;

typedef struct nook_gltf_channel {
    uint32_t sampler; /**< Of its animation; not checked. */
    uint32_t node;
    const char *path;
} nook_gltf_channel;

typedef struct nook_gltf_animation {
    const char *name;
    uint32_t first_channel, channel_count, first_sampler, sampler_count;
} nook_gltf_animation;

typedef struct nook_gltf_camera {
    const char *name;
    bool perspective;
    double fov_y_radians, z_near;
} nook_gltf_camera;

typedef struct nook_gltf_light {
    const char *type; /**< "directional", "point", "spot" or something unknown. */
    double colour[3], intensity, range, inner_cone, outer_cone;
} nook_gltf_light;

typedef struct nook_gltf_scene {
    uint32_t first_root, root_count; /**< Into model->children. */
} nook_gltf_scene;

typedef struct nook_gltf_model {
    nook_gltf_view *views;
    nook_gltf_accessor *accessors;
    nook_gltf_primitive *primitives;
    nook_gltf_mesh *meshes;
    nook_gltf_material *materials;
    nook_gltf_node *nodes;
    nook_gltf_scene *scenes;
    nook_gltf_camera *cameras;
    nook_gltf_light *lights;
    uint32_t *texture_images; /**< Per texture, its image or NOOK_GLTF_NONE. */
    uint32_t *children;       /**< Node indices; nodes, scenes and skins point into it. */
    nook_gltf_target *targets;
    nook_gltf_skin *skins;
    nook_gltf_animation *animations;
    nook_gltf_channel *channels;
    nook_gltf_sampler *samplers;
    uint32_t view_count, accessor_count, primitive_count, mesh_count, material_count, node_count, scene_count,
        camera_count, light_count, texture_count, skin_count, animation_count, target_count, channel_count,
        sampler_count;
    uint32_t default_scene; /**< NOOK_GLTF_NONE when the file names none. */
} nook_gltf_model;

/**
 * Parses glTF JSON. Buffers and images are the caller's business: the text must not contain them (tinygltf would open
 * files by itself, in the working directory too).
 * @param message  receives one line on failure
 * @return NULL on failure; else release with nook_gltf_model_free
 */
nook_gltf_model *nook_gltf_model_parse(const char *text, size_t size, char *message,
                                       size_t message_capacity) NOOK_GLTF_NOEXCEPT;
void nook_gltf_model_free(nook_gltf_model *model) NOOK_GLTF_NOEXCEPT; /**< NULL is allowed. */

#ifdef __cplusplus
}
#endif
