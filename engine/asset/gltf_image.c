/* The images of a glTF file. None of them is needed to draw the geometry, so everything wrong here is a warning. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/image.h"
#include "engine/asset/scene_internal.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Decoded images of one scene together; the rest is left out. */
#define SCENE_BYTES_MAX ((size_t)2 << 30)

static nook_gltf_bytes view_bytes(const nook_gltf *gltf, uint32_t view_value)
{
    uint64_t index = 0;
    nook_json_tree_integer(&gltf->json, view_value, &index);
    const nook_gltf_view *view = &gltf->model->views[index];
    return (nook_gltf_bytes){ gltf->buffers[view->buffer].bytes + view->offset, (size_t)view->length, NULL };
}

/* The check of the mimeType that the file gives against what the bytes are. */
static void check_type(nook_gltf *gltf, const char *what, uint32_t object, const nook_gltf_bytes *bytes)
{
    uint32_t mime = nook_json_tree_find(&gltf->json, object, "mimeType");
    nook_image_type type = nook_image_detect(bytes->bytes, bytes->size);
    if (mime == NOOK_JSON_NONE || type == NOOK_IMAGE_UNKNOWN)
        return;
    const char *is = type == NOOK_IMAGE_PNG ? "image/png" : "image/jpeg";
    if (!nook_json_tree_string_is(&gltf->json, mime, is))
        nook_scene_warn(gltf->scene, "%s: %s is %s, whatever its mimeType says", gltf->path, what, is);
}

static void decode(nook_gltf *gltf, const char *what, const nook_gltf_bytes *bytes, nook_image *image, size_t *total)
{
    const char *reason = nook_image_decode(bytes->bytes, bytes->size, &image->pixels, &image->width, &image->height);
    size_t size = (size_t)image->width * image->height * 4;
    if (!reason && *total + size > SCENE_BYTES_MAX) {
        reason = "does not fit into the 2 GiB for all images of a scene";
        nook_image_free(image->pixels);
        image->pixels = NULL;
        image->width = image->height = 0;
    }
    if (reason)
        nook_scene_warn(gltf->scene, "%s: %s %s; drawn without it", gltf->path, what, reason);
    else
        *total += size;
}

static void read_image(nook_gltf *gltf, uint32_t index, uint32_t object, size_t *total)
{
    char what[32];
    nook_gltf_bytes bytes = { 0 };
    nook_gltf_reason reason = { "it has neither uri nor bufferView" };
    nook_result result = NOOK_E_FORMAT;
    uint32_t uri = nook_json_tree_find(&gltf->json, object, "uri");
    uint32_t view = nook_json_tree_find(&gltf->json, object, "bufferView");
    snprintf(what, sizeof what, "images[%u]", index);
    if (view != NOOK_JSON_NONE) {
        bytes = view_bytes(gltf, view);
        result = NOOK_OK;
    } else if (uri != NOOK_JSON_NONE) {
        result = nook_gltf_read_uri(gltf, uri, &bytes, &reason);
    }
    if (result != NOOK_OK) {
        nook_scene_warn(gltf->scene, "%s: %s: %s; drawn without it", gltf->path, what, reason.text);
        return;
    }
    check_type(gltf, what, object, &bytes);
    decode(gltf, what, &bytes, &gltf->scene->images[index], total);
    nook_gltf_bytes_free(&bytes);
}

static char *image_name(const nook_gltf *gltf, uint32_t object)
{
    uint32_t name = nook_json_tree_find(&gltf->json, object, "name");
    return name == NOOK_JSON_NONE ? nook_scene_copy_string("") : nook_json_tree_copy_string(&gltf->json, name, NULL);
}

nook_result nook_gltf_read_images(nook_gltf *gltf, bool decode_pixels)
{
    nook_scene *scene = gltf->scene;
    size_t total = 0;
    uint32_t count = nook_gltf_document_count(gltf, "images");
    uint32_t object = nook_gltf_document_element(gltf, "images", 0);
    scene->images = nook_scene_allocate(gltf->path, count, sizeof *scene->images);
    if (!scene->images)
        return NOOK_E_MEMORY;
    scene->image_count = count;
    for (uint32_t i = 0; i < count; i++, object = gltf->json.values[object].next) {
        scene->images[i].name = image_name(gltf, object);
        if (!scene->images[i].name)
            return NOOK_E_MEMORY;
        if (decode_pixels)
            read_image(gltf, i, object, &total);
    }
    return NOOK_OK;
}
