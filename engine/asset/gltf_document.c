/* Checks the JSON itself, because tinygltf coerces or ignores what does not fit: -1, 2^62, strings for numbers. */
#include "engine/asset/gltf_internal.h"
#include "engine/asset/gltf_schema_internal.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NESTING_MAX = 256, MEMBERS_MAX = 1024, PLACE_CAPACITY = 200, SHOWN = 40 };

static const char *const supported_extensions[] = { "KHR_mesh_quantization", "KHR_texture_transform",
                                                    "KHR_materials_unlit", "KHR_lights_punctual",
                                                    "KHR_materials_emissive_strength" };

/** Where the walk is, for messages: "accessors[2].sparse.count". */
typedef struct walk {
    const nook_gltf *gltf;
    char place[PLACE_CAPACITY];
    size_t place_length;
} walk;

static nook_result check_member(walk *w, uint32_t value, const nook_gltf_member *member);

static const nook_json_value *value_of(const walk *w, uint32_t value)
{
    return &w->gltf->json.values[value];
}

/* What stands in the file, as written: escapes keep it on one line. */
static nook_result fail_at(const walk *w, uint32_t value, const char *expected)
{
    const nook_json_value *v = value_of(w, value);
    const char *shown = w->gltf->json.text + v->start;
    uint32_t length = v->length < SHOWN ? v->length : SHOWN;
    if (v->kind == NOOK_JSON_ARRAY || v->kind == NOOK_JSON_OBJECT) {
        shown = v->kind == NOOK_JSON_ARRAY ? "an array" : "an object";
        length = (uint32_t)strlen(shown);
    }
    return nook_fail(NOOK_E_FORMAT, "%s: %s is %.*s; expected %s", w->gltf->path, w->place, (int)length, shown,
                     expected);
}

static size_t enter(walk *w, const char *separator, const char *name, uint32_t index)
{
    size_t before = w->place_length, room = sizeof w->place - before;
    int written = name ? snprintf(w->place + before, room, "%s%s", separator, name)
                       : snprintf(w->place + before, room, "[%u]", index);
    if (written > 0)
        w->place_length += (size_t)written < room ? (size_t)written : room - 1;
    return before;
}

static void leave(walk *w, size_t before)
{
    w->place_length = before;
    w->place[before] = '\0';
}

static uint32_t find_array(const nook_gltf *gltf, const char *name)
{
    uint32_t owner = 0;
    if (strcmp(name, "lights") == 0) {
        owner = nook_json_tree_find(&gltf->json, 0, "extensions");
        owner = nook_json_tree_find(&gltf->json, owner, "KHR_lights_punctual");
    }
    uint32_t array = nook_json_tree_find(&gltf->json, owner, name);
    return array != NOOK_JSON_NONE && gltf->json.values[array].kind == NOOK_JSON_ARRAY ? array : NOOK_JSON_NONE;
}

uint32_t nook_gltf_document_count(const nook_gltf *gltf, const char *array)
{
    uint32_t found = find_array(gltf, array);
    return found == NOOK_JSON_NONE ? 0 : gltf->json.values[found].count;
}

uint32_t nook_gltf_document_element(const nook_gltf *gltf, const char *array, uint32_t index)
{
    uint32_t found = find_array(gltf, array);
    if (found == NOOK_JSON_NONE || index >= gltf->json.values[found].count)
        return NOOK_JSON_NONE;
    uint32_t value = found + 1;
    for (uint32_t i = 0; i < index; i++)
        value = gltf->json.values[value].next;
    return value;
}

static nook_result check_integer(const walk *w, uint32_t value, uint64_t low, uint64_t high)
{
    uint64_t number;
    char expected[80];
    if (nook_json_tree_integer(&w->gltf->json, value, &number) && number >= low && number <= high)
        return NOOK_OK;
    snprintf(expected, sizeof expected, "an integer from %llu to %llu", (unsigned long long)low,
             (unsigned long long)high);
    return fail_at(w, value, expected);
}

static nook_result check_reference(const walk *w, uint32_t value, const char *array)
{
    uint64_t number;
    char expected[80];
    uint32_t count = nook_gltf_document_count(w->gltf, array);
    if (nook_json_tree_integer(&w->gltf->json, value, &number) && number < count)
        return NOOK_OK;
    snprintf(expected, sizeof expected, "the index of one of %u %s", count, array);
    return fail_at(w, value, expected);
}

static nook_result check_number(const walk *w, uint32_t value)
{
    if (value_of(w, value)->kind == NOOK_JSON_NUMBER && isfinite(nook_json_tree_number(&w->gltf->json, value)))
        return NOOK_OK;
    return fail_at(w, value, "a finite number");
}

static nook_result check_kind(const walk *w, uint32_t value, nook_json_kind kind, const char *expected)
{
    return value_of(w, value)->kind == kind ? NOOK_OK : fail_at(w, value, expected);
}

/* A name that stands twice would let a checked value hide an unchecked one: parsers differ in which of them they take. */
static nook_result check_names(const walk *w, uint32_t object)
{
    const nook_json_tree *json = &w->gltf->json;
    uint32_t count = value_of(w, object)->count, member = object + 1;
    if (count > MEMBERS_MAX)
        return nook_fail(NOOK_E_FORMAT, "%s: %s has %u members; at most %d are read", w->gltf->path, w->place, count,
                         MEMBERS_MAX);
    for (uint32_t i = 0; i < count; i++) {
        char *name = nook_json_tree_copy_string(json, member, NULL);
        if (!name)
            return nook_fail(NOOK_E_MEMORY, "%s: no memory", w->gltf->path);
        bool twice = nook_json_tree_find(json, object, name) != json->values[member].next;
        free(name);
        if (twice)
            return fail_at(w, member, "every member name once");
        member = json->values[json->values[member].next].next;
    }
    return NOOK_OK;
}

static nook_result check_object(walk *w, uint32_t object, const nook_gltf_member *members)
{
    nook_result result = check_kind(w, object, NOOK_JSON_OBJECT, "an object");
    if (result == NOOK_OK)
        result = check_names(w, object);
    for (const nook_gltf_member *member = members; result == NOOK_OK && member->name; member++) {
        uint32_t value = nook_json_tree_find(&w->gltf->json, object, member->name);
        size_t before = enter(w, w->place_length ? "." : "", member->name, 0);
        if (value != NOOK_JSON_NONE)
            result = check_member(w, value, member);
        else if (member->required)
            result = nook_fail(NOOK_E_FORMAT, "%s: %s is missing", w->gltf->path, w->place);
        leave(w, before);
    }
    return result;
}

/* An object whose members are all references, whatever their names: attributes and morph targets. */
static nook_result check_map(walk *w, uint32_t object, const char *array)
{
    nook_result result = check_kind(w, object, NOOK_JSON_OBJECT, "an object");
    if (result == NOOK_OK)
        result = check_names(w, object);
    uint32_t key = object + 1;
    for (uint32_t i = 0; result == NOOK_OK && i < value_of(w, object)->count; i++) {
        uint32_t value = value_of(w, key)->next;
        result = check_reference(w, value, array);
        key = value_of(w, value)->next;
    }
    return result;
}

static nook_result check_element(walk *w, uint32_t value, const nook_gltf_member *member)
{
    switch (member->kind) {
    case NOOK_GLTF_REFERENCES:
        return check_reference(w, value, member->of);
    case NOOK_GLTF_MAP_LIST:
        return check_map(w, value, member->of);
    case NOOK_GLTF_NUMBERS:
        return check_number(w, value);
    case NOOK_GLTF_STRINGS:
        return check_kind(w, value, NOOK_JSON_STRING, "a string");
    default:
        return check_object(w, value, member->members);
    }
}

static nook_result check_array(walk *w, uint32_t array, const nook_gltf_member *member)
{
    nook_result result = check_kind(w, array, NOOK_JSON_ARRAY, "an array");
    if (result != NOOK_OK)
        return result;
    uint32_t count = value_of(w, array)->count, value = array + 1;
    if (member->kind == NOOK_GLTF_NUMBERS && member->low && count != member->low)
        return nook_fail(NOOK_E_FORMAT, "%s: %s has %u numbers; expected %llu", w->gltf->path, w->place, count,
                         (unsigned long long)member->low);
    for (uint32_t i = 0; result == NOOK_OK && i < count; i++) {
        size_t before = enter(w, "", NULL, i);
        result = check_element(w, value, member);
        leave(w, before);
        value = value_of(w, value)->next;
    }
    return result;
}

static nook_result check_member(walk *w, uint32_t value, const nook_gltf_member *member)
{
    switch (member->kind) {
    case NOOK_GLTF_INTEGER:
        return check_integer(w, value, member->low, member->high);
    case NOOK_GLTF_REFERENCE:
        return check_reference(w, value, member->of);
    case NOOK_GLTF_REFERENCE_MAP:
        return check_map(w, value, member->of);
    case NOOK_GLTF_NUMBER:
        return check_number(w, value);
    case NOOK_GLTF_BOOLEAN:
        return check_kind(w, value, NOOK_JSON_BOOL, "true or false");
    case NOOK_GLTF_STRING:
        return check_kind(w, value, NOOK_JSON_STRING, "a string");
    case NOOK_GLTF_OBJECT:
        return check_object(w, value, member->members);
    default:
        return check_array(w, value, member);
    }
}

/* "2.0" to 2 and 0. */
static bool parse_version(const char *text, unsigned *major, unsigned *minor)
{
    char rest;
    return strlen(text) < 8 && sscanf(text, "%u.%u%c", major, minor, &rest) == 2;
}

static nook_result check_version(const nook_gltf *gltf, const char *member, unsigned minor_max)
{
    unsigned major = 0, minor = 0;
    uint32_t asset = nook_json_tree_find(&gltf->json, 0, "asset");
    uint32_t value = nook_json_tree_find(&gltf->json, asset, member);
    if (value == NOOK_JSON_NONE)
        return NOOK_OK;
    char *text = nook_json_tree_copy_string(&gltf->json, value, NULL);
    if (!text)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory", gltf->path);
    bool readable = parse_version(text, &major, &minor) && major == 2 && minor <= minor_max;
    free(text);
    const nook_json_value *v = &gltf->json.values[value];
    return readable ? NOOK_OK
                    : nook_fail(NOOK_E_VERSION, "%s: asset.%s is '%.*s'; glTF 2.0 is read, convert it", gltf->path,
                                member, v->length < SHOWN ? (int)v->length : SHOWN, gltf->json.text + v->start);
}

static bool is_supported(const nook_json_tree *json, uint32_t name)
{
    for (size_t i = 0; i < NOOK_COUNT(supported_extensions); i++)
        if (nook_json_tree_string_is(json, name, supported_extensions[i]))
            return true;
    return false;
}

static nook_result check_extensions(const nook_gltf *gltf)
{
    uint32_t count = nook_gltf_document_count(gltf, "extensionsRequired");
    for (uint32_t i = 0; i < count; i++) {
        uint32_t name = nook_gltf_document_element(gltf, "extensionsRequired", i);
        const nook_json_value *v = &gltf->json.values[name];
        if (!is_supported(&gltf->json, name))
            return nook_fail(NOOK_E_VERSION, "%s: requires the extension %.*s, which is not supported; export without",
                             gltf->path, v->length < SHOWN ? (int)v->length : SHOWN, gltf->json.text + v->start);
    }
    return NOOK_OK;
}

/* All of them before any is opened. Images are looked at when they are read: the scene can do without. */
static nook_result check_buffer_uris(const nook_gltf *gltf)
{
    uint32_t count = nook_gltf_document_count(gltf, "buffers");
    uint32_t object = nook_gltf_document_element(gltf, "buffers", 0);
    for (uint32_t i = 0; i < count; i++, object = gltf->json.values[object].next) {
        char what[32];
        uint32_t uri = nook_json_tree_find(&gltf->json, object, "uri");
        snprintf(what, sizeof what, "buffers[%u]", i);
        nook_result result = uri == NOOK_JSON_NONE ? NOOK_OK : nook_gltf_check_uri(gltf, what, uri);
        if (result != NOOK_OK)
            return result;
    }
    return NOOK_OK;
}

nook_result nook_gltf_check_document(nook_gltf *gltf)
{
    nook_result result =
        nook_json_tree_read(gltf->path, gltf->source.json, gltf->source.json_size, NESTING_MAX, &gltf->json);
    if (result != NOOK_OK)
        return result;
    if (gltf->json.values[0].kind != NOOK_JSON_OBJECT)
        return nook_fail(NOOK_E_FORMAT, "%s: the JSON is not an object", gltf->path);
    walk w = { .gltf = gltf };
    /* Versions and extensions first: a file for another version has other members. */
    if ((result = check_object(&w, 0, (const nook_gltf_member[]){ nook_gltf_schema[0], nook_gltf_schema[2], { 0 } })) ||
        (result = check_version(gltf, "version", UINT32_MAX)) || (result = check_version(gltf, "minVersion", 0)) ||
        (result = check_extensions(gltf)) || (result = check_object(&w, 0, nook_gltf_schema)))
        return result;
    return check_buffer_uris(gltf);
}

/* Renames a top-level array in the copy of the text, so that tinygltf does not see it. */
static void hide(const nook_gltf *gltf, char *copy, const char *name)
{
    uint32_t value = nook_json_tree_find(&gltf->json, 0, name);
    if (value == NOOK_JSON_NONE)
        return;
    for (uint32_t key = 1;; key = gltf->json.values[gltf->json.values[key].next].next) {
        if (gltf->json.values[key].next == value) {
            copy[gltf->json.values[key].start] = '_';
            return;
        }
    }
}

nook_result nook_gltf_parse_model(nook_gltf *gltf)
{
    char message[256];
    size_t size = gltf->source.json_size;
    char *copy = malloc(size);
    if (!copy)
        return nook_fail(NOOK_E_MEMORY, "%s: no memory for its JSON", gltf->path);
    memcpy(copy, gltf->source.json, size);
    hide(gltf, copy, "buffers");
    hide(gltf, copy, "images");
    gltf->model = nook_gltf_model_parse(copy, size, message, sizeof message);
    free(copy);
    return gltf->model ? NOOK_OK : nook_fail(NOOK_E_FORMAT, "%s: %s", gltf->path, message);
}
