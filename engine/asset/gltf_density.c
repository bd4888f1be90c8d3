/* Scalar fields that nodes name: extras {"nook_density": {"file": "a.nrrd", "window": [low, high], "length": metres}}. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/nrrd_internal.h"
#include "engine/asset/scalar_medium.h"
#include "engine/asset/scene_internal.h"
#include "engine/core/suggestion.h"
#include <stdio.h>
#include <stdlib.h>

enum { PATH_CAPACITY = 4096, WHAT_CAPACITY = 64 };

static bool is_kind(const nook_gltf *gltf, uint32_t value, nook_json_kind kind)
{
    return value != NOOK_JSON_NONE && gltf->json.values[value].kind == kind;
}

/* What is misspelt does nothing; what is left out because of it is refused elsewhere, and does not say why. */
static void warn_of_unknown_keys(const nook_gltf *gltf, const char *what, uint32_t object)
{
    static const char *const known[] = { "file", "window", "length" };
    const nook_json_tree *json = &gltf->json;
    uint32_t key = object + 1;
    for (uint32_t i = 0; i < json->values[object].count; i++, key = json->values[key + 1].next) {
        char *given = nook_json_tree_copy_string(json, key, NULL);
        nook_suggestion suggestion = nook_suggestion_for(given ? given : "");
        for (size_t name = 0; name < sizeof known / sizeof *known; name++)
            nook_suggestion_offer(&suggestion, known[name]);
        if (given && suggestion.distance > 0)
            nook_scene_warn(gltf->scene, "%s: %s.%.60s is not known and does nothing; %s%s%s", gltf->path, what, given,
                            suggestion.nearest ? "did you mean '" : "file, window and length are",
                            suggestion.nearest ? suggestion.nearest : "", suggestion.nearest ? "'?" : "");
        free(given);
    }
}

static nook_result read_transfer(const nook_gltf *gltf, const char *what, uint32_t object, nook_scalar_transfer *out)
{
    const nook_json_tree *json = &gltf->json;
    uint32_t window = nook_json_tree_find(json, object, "window"), length = nook_json_tree_find(json, object, "length");
    bool pair = is_kind(gltf, window, NOOK_JSON_ARRAY) && json->values[window].count == 2 &&
                is_kind(gltf, window + 1, NOOK_JSON_NUMBER) && is_kind(gltf, window + 2, NOOK_JSON_NUMBER);
    if (!pair)
        return nook_fail(NOOK_E_FORMAT, "%s: %s.window: give two numbers, [low, high]", gltf->path, what);
    if (!is_kind(gltf, length, NOOK_JSON_NUMBER))
        return nook_fail(NOOK_E_FORMAT, "%s: %s.length: give a number, the metres along which high is opaque",
                         gltf->path, what);
    *out = (nook_scalar_transfer){ nook_json_tree_number(json, window + 1), nook_json_tree_number(json, window + 2),
                                   nook_json_tree_number(json, length) };
    return NOOK_OK;
}

/* A detached header's samples are the scene's, too. @return false: no memory */
static bool list_files(nook_scene *scene, const nook_nrrd_files *files)
{
    bool listed = true;
    for (size_t i = 0; i < files->count && listed; i++)
        listed = nook_scene_add_file(scene, files->paths[i]);
    return listed;
}

static nook_result load_medium(nook_gltf *gltf, const char *what, const char *path,
                               const nook_scalar_transfer *transfer, nook_medium *out)
{
    char name[PATH_CAPACITY + WHAT_CAPACITY];
    const nook_nrrd_owner owner = { name, gltf->scene };
    nook_scalar_volume volume;
    nook_nrrd_files files;
    snprintf(name, sizeof name, "%s: %s", gltf->path, what);
    nook_result result = nook_scalar_volume_load_files(path, &owner, &volume, &files);
    bool listed = result != NOOK_OK || list_files(gltf->scene, &files);
    nook_nrrd_files_free(&files);
    if (!listed) {
        nook_scalar_volume_free(&volume);
        return NOOK_E_MEMORY;
    }
    if (result != NOOK_OK)
        return result;
    result = nook_scalar_medium(name, &volume, transfer, gltf->scene, out);
    nook_scalar_volume_free(&volume);
    return result;
}

static nook_result add_density(nook_gltf *gltf, const char *what, uint32_t object, const nook_node *node)
{
    char path[PATH_CAPACITY];
    nook_scalar_transfer transfer;
    nook_gltf_reason reason;
    nook_medium medium;
    nook_matrix unused;
    uint32_t file = nook_json_tree_find(&gltf->json, object, "file");
    warn_of_unknown_keys(gltf, what, object);
    if (!is_kind(gltf, file, NOOK_JSON_STRING))
        return nook_fail(NOOK_E_FORMAT, "%s: %s.file: give the name of a .nrrd or .nhdr file", gltf->path, what);
    nook_result result = read_transfer(gltf, what, object, &transfer);
    if (result != NOOK_OK)
        return result;
    result = nook_gltf_uri_path(gltf, file, path, sizeof path, &reason);
    if (result != NOOK_OK)
        return nook_fail(result, "%s: %s.file: %s", gltf->path, what, reason.text);
    result = load_medium(gltf, what, path, &transfer, &medium);
    if (result != NOOK_OK)
        return result;
    if (!nook_matrix_inverse_affine(&node->world_from_local, &unused)) {
        nook_scene_warn(gltf->scene, "%s: %s is flattened to nothing by its scale; it darkens nothing", gltf->path,
                        what);
        free((void *)(uintptr_t)medium.extinction);
        return NOOK_OK;
    }
    result = nook_scene_add_density(gltf->scene, node->name, &medium, &node->world_from_local);
    if (result != NOOK_OK)
        free((void *)(uintptr_t)medium.extinction);
    return result;
}

nook_result nook_gltf_convert_densities(nook_gltf *gltf)
{
    uint32_t count = nook_gltf_document_count(gltf, "nodes"), node = nook_gltf_document_element(gltf, "nodes", 0);
    nook_result result = NOOK_OK;
    for (uint32_t i = 0; i < count && result == NOOK_OK; i++, node = gltf->json.values[node].next) {
        char what[WHAT_CAPACITY];
        uint32_t extras = nook_json_tree_find(&gltf->json, node, "extras");
        uint32_t object = extras == NOOK_JSON_NONE ? extras : nook_json_tree_find(&gltf->json, extras, "nook_density");
        if (object == NOOK_JSON_NONE || gltf->scene_nodes[i] == NOOK_NONE)
            continue;
        snprintf(what, sizeof what, "nodes[%u].extras.nook_density", i);
        result =
            is_kind(gltf, object, NOOK_JSON_OBJECT)
                ? add_density(gltf, what, object, &gltf->scene->nodes[gltf->scene_nodes[i]])
                : nook_fail(NOOK_E_FORMAT, "%s: %s: give an object with file, window and length", gltf->path, what);
    }
    return result;
}
