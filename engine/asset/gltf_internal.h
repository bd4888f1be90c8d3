/**
 * gltf_internal.h - inside engine/asset only: the state of one load, and its stages in their order.
 *
 *   source (bytes) -> document (JSON checked) -> buffers, images -> model (tinygltf) -> materials, meshes, nodes
 *   -> skins, deformables, animations (gltf_motion_internal.h)
 *
 * Every stage logs its one error line itself and leaves what it made so far to nook_gltf_close and nook_scene_destroy.
 */
#pragma once
#include "engine/asset/gltf_shim.h"
#include "engine/asset/json_tree.h"
#include "engine/asset/scene.h"
#include "engine/core/file.h"
#include "engine/core/log.h"

/** Largest scene that is taken: 2^26 vertices are 4 GiB, 2^28 indices 1 GiB. A small file can ask for more. */
enum { NOOK_GLTF_VERTICES_MAX = 1 << 26, NOOK_GLTF_INDICES_MAX = 1 << 28 };

/** A buffer, or an image still encoded. */
typedef struct nook_gltf_bytes {
    const uint8_t *bytes;
    size_t size;
    uint8_t *owned; /**< What to free; NULL when the bytes lie in the GLB file. */
} nook_gltf_bytes;

/** The bytes of the file and where its parts are. */
typedef struct nook_gltf_source {
    nook_file file;
    const char *json;
    size_t json_size;
    const uint8_t *bin; /**< NULL without a BIN chunk. */
    size_t bin_size;
} nook_gltf_source;

typedef struct nook_gltf {
    const char *path;
    nook_scene *scene; /**< Being filled. */
    nook_gltf_source source;
    nook_json_tree json;
    nook_gltf_bytes *buffers;
    uint32_t buffer_count;
    nook_gltf_model *model;
    uint32_t vertex_capacity, index_capacity; /**< Room in scene->vertices and scene->indices. */
    bool uv_sets_differ_said;                 /**< The warning was given once; it would come for every material. */
    struct nook_gltf_origin *origins; /**< Per primitive of the scene, where it comes from (gltf_motion_internal.h). */
    uint32_t *scene_nodes;            /**< Per node of the file, that of the scene or NOOK_NONE. */
    uint32_t *file_nodes;             /**< Per node of the scene, that of the file. */
} nook_gltf;

/** Reads the file and finds JSON and BIN in it. @return NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_FORMAT, NOOK_E_VERSION */
nook_result nook_gltf_open_source(nook_gltf *gltf);
void nook_gltf_close(nook_gltf *gltf); /**< Frees everything but the scene. */

/** Parses the JSON and checks every known member: type, range, references, versions, extensions. */
nook_result nook_gltf_check_document(nook_gltf *gltf);
/** The JSON with its top-level "buffers" and "images" hidden, through tinygltf. */
nook_result nook_gltf_parse_model(nook_gltf *gltf);
/** Element `index` of a top-level array. @return NOOK_JSON_NONE when there is no such array or element */
uint32_t nook_gltf_document_element(const nook_gltf *gltf, const char *array, uint32_t index);
uint32_t nook_gltf_document_count(const nook_gltf *gltf, const char *array);

/** Why a uri was refused: one phrase that follows its name. */
typedef struct nook_gltf_reason {
    char text[400];
} nook_gltf_reason;

/**
 * The bytes a "uri" stands for: a data: URI, or a regular file in the scene's folder or below it.
 * @return NOOK_E_FORMAT not allowed or broken; NOOK_E_NOT_FOUND, NOOK_E_IO, NOOK_E_MEMORY; not logged, *out_reason says it
 */
nook_result nook_gltf_read_uri(const nook_gltf *gltf, uint32_t uri, nook_gltf_bytes *out_bytes,
                               nook_gltf_reason *out_reason);
/**
 * The path of the file a "uri" stands for: a regular file as above; data: URIs are refused. The scene remembers it.
 * @return as nook_gltf_read_uri
 */
nook_result nook_gltf_uri_path(const nook_gltf *gltf, uint32_t uri, char *out_path, size_t capacity,
                               nook_gltf_reason *out_reason);
/** Whether a "uri" may be opened at all. @param what  "buffers[2]", for the message. @return NOOK_E_FORMAT, logged */
nook_result nook_gltf_check_uri(const nook_gltf *gltf, const char *what, uint32_t uri);
/** Reads all buffers. @return as nook_gltf_read_uri, logged */
nook_result nook_gltf_read_buffers(nook_gltf *gltf);
void nook_gltf_bytes_free(nook_gltf_bytes *bytes);

/** Decodes all images; one that is broken becomes a warning. @param decode  false: names only */
nook_result nook_gltf_read_images(nook_gltf *gltf, bool decode);

/** Checks views and accessors against the buffers, so that reading them needs no further checks. */
nook_result nook_gltf_check_accessors(nook_gltf *gltf);
/** Reads as float, integers normalised when the accessor says so. out: count * components. @param components  as stored */
void nook_gltf_read_floats(const nook_gltf *gltf, uint32_t accessor, float *out);
/** Reads unsigned integers. out: count. The accessor has one unsigned component. */
void nook_gltf_read_indices(const nook_gltf *gltf, uint32_t accessor, uint32_t *out);

nook_result nook_gltf_convert_materials(nook_gltf *gltf);
/** The slot whose texture coordinates a material's vertices carry. @return NULL when the material has no texture */
const nook_gltf_slot *nook_gltf_material_uv_slot(const nook_gltf *gltf, uint32_t material);

nook_result nook_gltf_convert_meshes(nook_gltf *gltf);
nook_result nook_gltf_convert_nodes(nook_gltf *gltf);
/** Reads the scalar fields that nodes of the scene name. @return NOOK_E_FORMAT, and what nook_scalar_volume_load returns, logged */
nook_result nook_gltf_convert_densities(nook_gltf *gltf);
/** Makes the camera and the light of a node; there is room for them. @return NOOK_E_MEMORY */
nook_result nook_gltf_attach(nook_gltf *gltf, const nook_gltf_node *from, const nook_matrix *world_from_local,
                             nook_node *to);

/** Makes room behind the scene's vertices or indices. @return NULL, logged, when there is none */
nook_vertex *nook_gltf_add_vertices(nook_gltf *gltf, size_t count);
uint32_t *nook_gltf_add_indices(nook_gltf *gltf, size_t count);
