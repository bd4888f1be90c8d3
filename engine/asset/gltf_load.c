/* nook_scene_load: the order of the stages. */
#include "engine/asset/gltf_motion_internal.h"
#include "engine/asset/scene_internal.h"
#include <stdlib.h>

/* Gives back the room that growing left over: half of it in the worst case. */
static void trim(nook_scene *scene)
{
    void *vertices = realloc(scene->vertices, (scene->vertex_count ? scene->vertex_count : 1) * sizeof(nook_vertex));
    void *indices = realloc(scene->indices, (scene->index_count ? scene->index_count : 1) * sizeof(uint32_t));
    scene->vertices = vertices ? vertices : scene->vertices;
    scene->indices = indices ? indices : scene->indices;
}

static nook_result load(nook_gltf *gltf, const nook_scene_options *options)
{
    nook_result result;
    if ((result = nook_gltf_open_source(gltf)) || (result = nook_gltf_check_document(gltf)) ||
        (result = nook_gltf_read_buffers(gltf)) || (result = nook_gltf_parse_model(gltf)) ||
        (result = nook_gltf_check_accessors(gltf)) ||
        (result = nook_gltf_read_images(gltf, !(options && options->skip_images))) ||
        (result = nook_gltf_convert_materials(gltf)) || (result = nook_gltf_convert_meshes(gltf)) ||
        (result = nook_gltf_convert_nodes(gltf)) || (result = nook_gltf_convert_densities(gltf)) ||
        (result = nook_gltf_convert_skins(gltf)) || (result = nook_gltf_convert_deformables(gltf)) ||
        (result = nook_gltf_convert_animations(gltf)))
        return result;
    trim(gltf->scene);
    return nook_scene_finish(gltf->scene);
}

nook_result nook_scene_load(const char *path, const nook_scene_options *options, nook_scene **out_scene)
{
    *out_scene = NULL;
    nook_scene *scene = nook_scene_allocate(path, 1, sizeof *scene);
    if (!scene)
        return NOOK_E_MEMORY;
    nook_gltf gltf = { .path = path, .scene = scene };
    scene->path = nook_scene_copy_string(path);
    scene->silent = options && options->silent;
    nook_result result = scene->path && nook_scene_add_file(scene, path) ? load(&gltf, options) : NOOK_E_MEMORY;
    nook_gltf_close(&gltf);
    if (result != NOOK_OK) {
        nook_scene_destroy(scene);
        return result;
    }
    *out_scene = scene;
    return NOOK_OK;
}
