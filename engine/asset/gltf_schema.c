#include "engine/asset/gltf_schema_internal.h"
#include <limits.h>
#include <stddef.h>

/* Sizes are bounded by 4 GiB, the largest file that is read; sums of three of them cannot wrap in 64 bits. */
#define SIZE_LIMIT UINT32_MAX
/* tinygltf keeps the counts and offsets of sparse accessors in int. */
#define INT_LIMIT INT_MAX

/* clang-format off */
#define MEMBER(n, k, needed, array, table, least, most) \
    { (n), NOOK_GLTF_##k, (needed), (array), (table), (least), (most) }
#define INTEGER(n, least, most)        MEMBER(n, INTEGER, false, NULL, NULL, least, most)
#define NEEDED_INTEGER(n, least, most) MEMBER(n, INTEGER, true, NULL, NULL, least, most)
#define REFERENCE(n, array)            MEMBER(n, REFERENCE, false, array, NULL, 0, 0)
#define NEEDED_REFERENCE(n, array)     MEMBER(n, REFERENCE, true, array, NULL, 0, 0)
#define REFERENCES(n, array)           MEMBER(n, REFERENCES, false, array, NULL, 0, 0)
#define NEEDED_REFERENCES(n, array)    MEMBER(n, REFERENCES, true, array, NULL, 0, 0)
#define NUMBER(n)                      MEMBER(n, NUMBER, false, NULL, NULL, 0, 0)
#define NUMBERS(n, count)              MEMBER(n, NUMBERS, false, NULL, NULL, count, 0)
#define BOOLEAN(n)                     MEMBER(n, BOOLEAN, false, NULL, NULL, 0, 0)
#define STRING(n)                      MEMBER(n, STRING, false, NULL, NULL, 0, 0)
#define NEEDED_STRING(n)               MEMBER(n, STRING, true, NULL, NULL, 0, 0)
#define STRINGS(n)                     MEMBER(n, STRINGS, false, NULL, NULL, 0, 0)
#define OBJECT(n, table)               MEMBER(n, OBJECT, false, NULL, table, 0, 0)
#define NEEDED_OBJECT(n, table)        MEMBER(n, OBJECT, true, NULL, table, 0, 0)
#define LIST(n, table)                 MEMBER(n, LIST, false, NULL, table, 0, 0)
#define NEEDED_LIST(n, table)          MEMBER(n, LIST, true, NULL, table, 0, 0)
#define END                            MEMBER(NULL, INTEGER, false, NULL, NULL, 0, 0)
/* clang-format on */

typedef const nook_gltf_member table[];

static table asset = {
    NEEDED_STRING("version"),
    STRING("minVersion"),
    END,
};

static table buffer = { NEEDED_INTEGER("byteLength", 1, SIZE_LIMIT), STRING("uri"), STRING("name"), END };

static table view = {
    NEEDED_REFERENCE("buffer", "buffers"),
    INTEGER("byteOffset", 0, SIZE_LIMIT),
    NEEDED_INTEGER("byteLength", 1, SIZE_LIMIT),
    INTEGER("byteStride", 4, 252),
    END,
};

static table sparse_indices = {
    NEEDED_REFERENCE("bufferView", "bufferViews"),
    INTEGER("byteOffset", 0, INT_LIMIT),
    NEEDED_INTEGER("componentType", 5121, 5125),
    END,
};
static table sparse_values = {
    NEEDED_REFERENCE("bufferView", "bufferViews"),
    INTEGER("byteOffset", 0, INT_LIMIT),
    END,
};
static table sparse = {
    NEEDED_INTEGER("count", 1, INT_LIMIT),
    NEEDED_OBJECT("indices", sparse_indices),
    NEEDED_OBJECT("values", sparse_values),
    END,
};
static table accessor = {
    REFERENCE("bufferView", "bufferViews"),
    INTEGER("byteOffset", 0, SIZE_LIMIT),
    NEEDED_INTEGER("componentType", 5120, 5126),
    BOOLEAN("normalized"),
    NEEDED_INTEGER("count", 1, SIZE_LIMIT),
    NEEDED_STRING("type"),
    NUMBERS("min", 0),
    NUMBERS("max", 0),
    OBJECT("sparse", sparse),
    STRING("name"),
    END,
};

static table primitive = {
    MEMBER("attributes", REFERENCE_MAP, true, "accessors", NULL, 0, 0),
    REFERENCE("indices", "accessors"),
    REFERENCE("material", "materials"),
    INTEGER("mode", 0, 6),
    MEMBER("targets", MAP_LIST, false, "accessors", NULL, 0, 0),
    END,
};
static table mesh = {
    NEEDED_LIST("primitives", primitive),
    NUMBERS("weights", 0),
    STRING("name"),
    END,
};

static table node_light = { NEEDED_REFERENCE("light", "lights"), END };
static table node_extensions = { OBJECT("KHR_lights_punctual", node_light), END };
static table node = {
    REFERENCE("camera", "cameras"),
    REFERENCES("children", "nodes"),
    REFERENCE("skin", "skins"),
    REFERENCE("mesh", "meshes"),
    NUMBERS("matrix", 16),
    NUMBERS("rotation", 4),
    NUMBERS("scale", 3),
    NUMBERS("translation", 3),
    NUMBERS("weights", 0),
    STRING("name"),
    OBJECT("extensions", node_extensions),
    END,
};
static table scene = { REFERENCES("nodes", "nodes"), STRING("name"), END };

static table texture_transform = {
    NUMBERS("offset", 2), NUMBER("rotation"), NUMBERS("scale", 2), INTEGER("texCoord", 0, INT_LIMIT), END,
};
static table slot_extensions = { OBJECT("KHR_texture_transform", texture_transform), END };
static table slot = {
    NEEDED_REFERENCE("index", "textures"),
    INTEGER("texCoord", 0, INT_LIMIT),
    NUMBER("scale"),
    NUMBER("strength"),
    OBJECT("extensions", slot_extensions),
    END,
};
static table metallic_roughness = {
    NUMBERS("baseColorFactor", 4), OBJECT("baseColorTexture", slot),         NUMBER("metallicFactor"),
    NUMBER("roughnessFactor"),     OBJECT("metallicRoughnessTexture", slot), END,
};
static table emissive_strength = { NUMBER("emissiveStrength"), END };
static table no_members = { END };
static table material_extensions = {
    OBJECT("KHR_materials_emissive_strength", emissive_strength),
    OBJECT("KHR_materials_unlit", no_members),
    END,
};
static table material = {
    OBJECT("pbrMetallicRoughness", metallic_roughness),
    OBJECT("normalTexture", slot),
    OBJECT("occlusionTexture", slot),
    OBJECT("emissiveTexture", slot),
    NUMBERS("emissiveFactor", 3),
    STRING("alphaMode"),
    NUMBER("alphaCutoff"),
    BOOLEAN("doubleSided"),
    OBJECT("extensions", material_extensions),
    STRING("name"),
    END,
};
static table texture = { REFERENCE("sampler", "samplers"), REFERENCE("source", "images"), END };
static table image = { STRING("uri"), STRING("mimeType"), REFERENCE("bufferView", "bufferViews"), STRING("name"), END };
static table sampler = {
    INTEGER("magFilter", 0, INT_LIMIT),
    INTEGER("minFilter", 0, INT_LIMIT),
    INTEGER("wrapS", 0, INT_LIMIT),
    INTEGER("wrapT", 0, INT_LIMIT),
    END,
};

static table perspective = { NUMBER("aspectRatio"), NUMBER("yfov"), NUMBER("zfar"), NUMBER("znear"), END };
static table orthographic = { NUMBER("xmag"), NUMBER("ymag"), NUMBER("zfar"), NUMBER("znear"), END };
static table camera = {
    NEEDED_STRING("type"),
    OBJECT("perspective", perspective),
    OBJECT("orthographic", orthographic),
    STRING("name"),
    END,
};

static table spot = { NUMBER("innerConeAngle"), NUMBER("outerConeAngle"), END };
static table light = {
    NEEDED_STRING("type"),
    NUMBERS("color", 3),
    NUMBER("intensity"),
    NUMBER("range"),
    OBJECT("spot", spot),
    STRING("name"),
    END,
};
static table lights_punctual = { LIST("lights", light), END };
static table extensions = { OBJECT("KHR_lights_punctual", lights_punctual), END };

static table skin = {
    REFERENCE("inverseBindMatrices", "accessors"),
    REFERENCE("skeleton", "nodes"),
    NEEDED_REFERENCES("joints", "nodes"),
    STRING("name"),
    END,
};
static table channel_target = { REFERENCE("node", "nodes"), NEEDED_STRING("path"), END };
static table channel = { NEEDED_INTEGER("sampler", 0, INT_LIMIT), NEEDED_OBJECT("target", channel_target), END };
static table animation_sampler = {
    NEEDED_REFERENCE("input", "accessors"),
    STRING("interpolation"),
    NEEDED_REFERENCE("output", "accessors"),
    END,
};
static table animation = { NEEDED_LIST("channels", channel), NEEDED_LIST("samplers", animation_sampler), STRING("name"),
                           END };

const nook_gltf_member nook_gltf_schema[] = {
    NEEDED_OBJECT("asset", asset),
    STRINGS("extensionsUsed"),
    STRINGS("extensionsRequired"),
    OBJECT("extensions", extensions),
    LIST("accessors", accessor),
    LIST("animations", animation),
    LIST("buffers", buffer),
    LIST("bufferViews", view),
    LIST("cameras", camera),
    LIST("images", image),
    LIST("materials", material),
    LIST("meshes", mesh),
    LIST("nodes", node),
    LIST("samplers", sampler),
    REFERENCE("scene", "scenes"),
    LIST("scenes", scene),
    LIST("skins", skin),
    LIST("textures", texture),
    END,
};
