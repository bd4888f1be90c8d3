#include "engine/asset/gltf_shim.h"
#include <tiny_gltf.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace
{

/** Owns what the plain arrays point into. */
struct holder {
    nook_gltf_model plain{};
    tinygltf::Model source;
    std::vector<nook_gltf_view> views;
    std::vector<nook_gltf_accessor> accessors;
    std::vector<nook_gltf_primitive> primitives;
    std::vector<nook_gltf_mesh> meshes;
    std::vector<nook_gltf_material> materials;
    std::vector<nook_gltf_node> nodes;
    std::vector<nook_gltf_scene> scenes;
    std::vector<nook_gltf_camera> cameras;
    std::vector<nook_gltf_light> lights;
    std::vector<uint32_t> texture_images;
    std::vector<uint32_t> children;
    std::vector<nook_gltf_target> targets;
    std::vector<nook_gltf_skin> skins;
    std::vector<nook_gltf_animation> animations;
    std::vector<nook_gltf_channel> channels;
    std::vector<nook_gltf_sampler> samplers;
};

uint32_t reference(int index)
{
    return index < 0 ? NOOK_GLTF_NONE : static_cast<uint32_t>(index);
}

void copy_numbers(const std::vector<double> &from, double *to, size_t count)
{
    if (from.size() >= count)
        std::copy_n(from.begin(), count, to);
}

/** Number `key` of an extension object, or `fallback`. */
double number_of(const tinygltf::Value &object, const char *key, double fallback)
{
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsNumber())
        return fallback;
    return object.Get(key).GetNumberAsDouble();
}

/* 1 true, 0 false, -1 when it is not there or no truth value. */
int flag_of(const tinygltf::Value &object, const char *key)
{
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsBool())
        return -1;
    return object.Get(key).Get<bool>();
}

const tinygltf::Value *extension_of(const tinygltf::ExtensionMap &extensions, const char *name)
{
    auto found = extensions.find(name);
    return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

uint32_t attribute_of(const std::map<std::string, int> &attributes, const char *name)
{
    auto found = attributes.find(name);
    return found == attributes.end() ? NOOK_GLTF_NONE : reference(found->second);
}

nook_gltf_accessor plain_accessor(const tinygltf::Accessor &from)
{
    nook_gltf_accessor to{};
    to.view = reference(from.bufferView);
    to.offset = from.byteOffset;
    to.count = static_cast<uint32_t>(from.count);
    to.component_type = from.componentType;
    to.normalized = from.normalized;
    bool known = from.type == TINYGLTF_TYPE_SCALAR || from.type == TINYGLTF_TYPE_MAT4 ||
                 (from.type >= TINYGLTF_TYPE_VEC2 && from.type <= TINYGLTF_TYPE_VEC4);
    to.components =
        known ? static_cast<uint32_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(from.type))) : 0;
    to.has_bounds = to.components && to.components <= 4 && from.minValues.size() == to.components &&
                    from.maxValues.size() == to.components;
    if (to.has_bounds) {
        copy_numbers(from.minValues, to.min, to.components);
        copy_numbers(from.maxValues, to.max, to.components);
    }
    if (!from.sparse.isSparse)
        return to;
    to.sparse_count = static_cast<uint32_t>(from.sparse.count);
    to.sparse_index_view = reference(from.sparse.indices.bufferView);
    to.sparse_index_offset = static_cast<uint64_t>(from.sparse.indices.byteOffset);
    to.sparse_index_type = from.sparse.indices.componentType;
    to.sparse_value_view = reference(from.sparse.values.bufferView);
    to.sparse_value_offset = static_cast<uint64_t>(from.sparse.values.byteOffset);
    return to;
}

nook_gltf_primitive plain_primitive(holder &h, const tinygltf::Primitive &from)
{
    nook_gltf_primitive to{};
    to.position = attribute_of(from.attributes, "POSITION");
    to.normal = attribute_of(from.attributes, "NORMAL");
    to.tangent = attribute_of(from.attributes, "TANGENT");
    to.colour = attribute_of(from.attributes, "COLOR_0");
    to.joints = attribute_of(from.attributes, "JOINTS_0");
    to.weights = attribute_of(from.attributes, "WEIGHTS_0");
    to.more_joints = attribute_of(from.attributes, "JOINTS_1");
    to.texcoord[0] = attribute_of(from.attributes, "TEXCOORD_0");
    to.texcoord[1] = attribute_of(from.attributes, "TEXCOORD_1");
    to.indices = reference(from.indices);
    to.material = reference(from.material);
    to.mode = from.mode < 0 ? 4u : static_cast<uint32_t>(from.mode);
    to.first_target = static_cast<uint32_t>(h.targets.size());
    to.target_count = static_cast<uint32_t>(from.targets.size());
    for (const auto &target : from.targets)
        h.targets.push_back({ attribute_of(target, "POSITION"), attribute_of(target, "NORMAL") });
    return to;
}

template <class Info> nook_gltf_slot plain_slot(const Info &from)
{
    nook_gltf_slot to{};
    to.texture = reference(from.index);
    to.texcoord = reference(from.texCoord);
    to.scale[0] = to.scale[1] = 1.0;
    const tinygltf::Value *transform = extension_of(from.extensions, "KHR_texture_transform");
    if (!transform)
        return to;
    for (int i = 0; i < 2; i++) {
        if (transform->Has("offset") && transform->Get("offset").ArrayLen() == 2)
            to.offset[i] = transform->Get("offset").Get(i).GetNumberAsDouble();
        if (transform->Has("scale") && transform->Get("scale").ArrayLen() == 2)
            to.scale[i] = transform->Get("scale").Get(i).GetNumberAsDouble();
    }
    to.rotation = number_of(*transform, "rotation", 0.0);
    to.texcoord = static_cast<uint32_t>(number_of(*transform, "texCoord", to.texcoord));
    return to;
}

nook_gltf_material plain_material(const tinygltf::Material &from)
{
    nook_gltf_material to{};
    const tinygltf::PbrMetallicRoughness &pbr = from.pbrMetallicRoughness;
    to.name = from.name.c_str();
    std::fill_n(to.base_colour, 4, 1.0);
    copy_numbers(pbr.baseColorFactor, to.base_colour, 4);
    copy_numbers(from.emissiveFactor, to.emissive, 3);
    to.emissive_strength = 1.0;
    if (const tinygltf::Value *emissive = extension_of(from.extensions, "KHR_materials_emissive_strength"))
        to.emissive_strength = number_of(*emissive, "emissiveStrength", 1.0);
    to.metallic = pbr.metallicFactor;
    to.roughness = pbr.roughnessFactor;
    to.normal_scale = from.normalTexture.scale;
    to.occlusion_strength = from.occlusionTexture.strength;
    to.alpha_cutoff = from.alphaCutoff;
    to.alpha_mode = from.alphaMode.c_str();
    to.double_sided = from.doubleSided;
    to.unlit = from.extensions.count("KHR_materials_unlit") != 0;
    to.base_colour_slot = plain_slot(pbr.baseColorTexture);
    to.metallic_roughness_slot = plain_slot(pbr.metallicRoughnessTexture);
    to.normal_slot = plain_slot(from.normalTexture);
    to.occlusion_slot = plain_slot(from.occlusionTexture);
    to.emissive_slot = plain_slot(from.emissiveTexture);
    return to;
}

void append_children(holder &h, const std::vector<int> &nodes, uint32_t &first, uint32_t &count)
{
    first = static_cast<uint32_t>(h.children.size());
    count = static_cast<uint32_t>(nodes.size());
    for (int node : nodes)
        h.children.push_back(reference(node));
}

nook_gltf_node plain_node(holder &h, const tinygltf::Node &from)
{
    nook_gltf_node to{};
    to.name = from.name.c_str();
    to.mesh = reference(from.mesh);
    to.skin = reference(from.skin);
    to.camera = reference(from.camera);
    to.light = NOOK_GLTF_NONE;
    if (const tinygltf::Value *light = extension_of(from.extensions, "KHR_lights_punctual"))
        to.light = reference(static_cast<int>(number_of(*light, "light", -1)));
    append_children(h, from.children, to.first_child, to.child_count);
    to.has_matrix = from.matrix.size() == 16;
    copy_numbers(from.matrix, to.matrix, 16);
    copy_numbers(from.translation, to.translation, 3);
    to.rotation[3] = 1.0;
    copy_numbers(from.rotation, to.rotation, 4);
    std::fill_n(to.scale, 3, 1.0);
    copy_numbers(from.scale, to.scale, 3);
    to.body = flag_of(from.extras, "nook_body");
    to.hung = flag_of(from.extras, "nook_hung") == 1;
    to.weights = from.weights.data();
    to.weight_count = static_cast<uint32_t>(from.weights.size());
    to.mass = number_of(from.extras, "nook_mass", 0.0);
    return to;
}

nook_gltf_light plain_light(const tinygltf::Light &from)
{
    nook_gltf_light to{};
    to.type = from.type.c_str();
    std::fill_n(to.colour, 3, 1.0);
    copy_numbers(from.color, to.colour, 3);
    to.intensity = from.intensity;
    to.range = from.range;
    to.inner_cone = from.spot.innerConeAngle;
    to.outer_cone = from.spot.outerConeAngle;
    return to;
}

void convert_geometry(holder &h)
{
    for (const tinygltf::BufferView &from : h.source.bufferViews)
        h.views.push_back(
            { reference(from.buffer), from.byteOffset, from.byteLength, static_cast<uint32_t>(from.byteStride) });
    for (const tinygltf::Accessor &from : h.source.accessors)
        h.accessors.push_back(plain_accessor(from));
    for (const tinygltf::Mesh &from : h.source.meshes) {
        h.meshes.push_back({ from.name.c_str(), static_cast<uint32_t>(h.primitives.size()),
                             static_cast<uint32_t>(from.primitives.size()), from.weights.data(),
                             static_cast<uint32_t>(from.weights.size()) });
        for (const tinygltf::Primitive &primitive : from.primitives)
            h.primitives.push_back(plain_primitive(h, primitive));
    }
}

void convert_scene(holder &h)
{
    for (const tinygltf::Material &from : h.source.materials)
        h.materials.push_back(plain_material(from));
    for (const tinygltf::Texture &from : h.source.textures)
        h.texture_images.push_back(reference(from.source));
    for (const tinygltf::Node &from : h.source.nodes)
        h.nodes.push_back(plain_node(h, from));
    for (const tinygltf::Scene &from : h.source.scenes) {
        nook_gltf_scene to{};
        append_children(h, from.nodes, to.first_root, to.root_count);
        h.scenes.push_back(to);
    }
    for (const tinygltf::Camera &from : h.source.cameras)
        h.cameras.push_back({ from.name.c_str(), from.type == "perspective", from.perspective.yfov,
                              from.type == "perspective" ? from.perspective.znear : from.orthographic.znear });
    for (const tinygltf::Light &from : h.source.lights)
        h.lights.push_back(plain_light(from));
}

nook_gltf_animation plain_animation(holder &h, const tinygltf::Animation &from)
{
    nook_gltf_animation to{};
    to.name = from.name.c_str();
    to.first_channel = static_cast<uint32_t>(h.channels.size());
    to.channel_count = static_cast<uint32_t>(from.channels.size());
    to.first_sampler = static_cast<uint32_t>(h.samplers.size());
    to.sampler_count = static_cast<uint32_t>(from.samplers.size());
    for (const tinygltf::AnimationChannel &channel : from.channels)
        h.channels.push_back(
            { reference(channel.sampler), reference(channel.target_node), channel.target_path.c_str() });
    for (const tinygltf::AnimationSampler &sampler : from.samplers)
        h.samplers.push_back({ reference(sampler.input), reference(sampler.output), sampler.interpolation.c_str() });
    return to;
}

void convert_motion(holder &h)
{
    for (const tinygltf::Skin &from : h.source.skins) {
        nook_gltf_skin to{};
        to.name = from.name.c_str();
        to.inverse_bind = reference(from.inverseBindMatrices);
        append_children(h, from.joints, to.first_joint, to.joint_count);
        h.skins.push_back(to);
    }
    for (const tinygltf::Animation &from : h.source.animations)
        h.animations.push_back(plain_animation(h, from));
}

template <class T> void publish(std::vector<T> &from, T *&to, uint32_t &count)
{
    to = from.data();
    count = static_cast<uint32_t>(from.size());
}

void publish_all(holder &h)
{
    nook_gltf_model &m = h.plain;
    publish(h.views, m.views, m.view_count);
    publish(h.accessors, m.accessors, m.accessor_count);
    publish(h.primitives, m.primitives, m.primitive_count);
    publish(h.meshes, m.meshes, m.mesh_count);
    publish(h.materials, m.materials, m.material_count);
    publish(h.nodes, m.nodes, m.node_count);
    publish(h.scenes, m.scenes, m.scene_count);
    publish(h.cameras, m.cameras, m.camera_count);
    publish(h.lights, m.lights, m.light_count);
    publish(h.texture_images, m.texture_images, m.texture_count);
    publish(h.targets, m.targets, m.target_count);
    publish(h.skins, m.skins, m.skin_count);
    publish(h.animations, m.animations, m.animation_count);
    publish(h.channels, m.channels, m.channel_count);
    publish(h.samplers, m.samplers, m.sampler_count);
    m.children = h.children.data();
    m.default_scene = reference(h.source.defaultScene);
}

bool refuse_file(const std::string &, void *)
{
    return false;
}

bool refuse_read(std::vector<unsigned char> *, std::string *, const std::string &, void *)
{
    return false;
}

bool refuse_write(std::string *, const std::string &, const std::vector<unsigned char> &, void *)
{
    return false;
}

std::string same_path(const std::string &path, void *)
{
    return path;
}

bool parse(holder &h, const char *text, size_t size, std::string &error)
{
    tinygltf::TinyGLTF loader;
    std::string warning;
    loader.SetFsCallbacks({ refuse_file, same_path, refuse_read, refuse_write, nullptr });
    return loader.LoadASCIIFromString(&h.source, &error, &warning, text, static_cast<unsigned>(size), "");
}

nook_gltf_model *fail(char *message, size_t capacity, const char *text)
{
    std::snprintf(message, capacity, "%s", text);
    for (char *c = message; *c; c++)
        if (*c == '\n')
            *c = c[1] ? ' ' : '\0';
    return nullptr;
}

} // namespace

extern "C" nook_gltf_model *nook_gltf_model_parse(const char *text, size_t size, char *message,
                                                  size_t capacity) noexcept
{
    try {
        std::unique_ptr<holder> h(new holder);
        std::string error;
        if (!parse(*h, text, size, error))
            return fail(message, capacity, error.empty() ? "tinygltf refused it" : error.c_str());
        convert_geometry(*h);
        convert_scene(*h);
        convert_motion(*h);
        publish_all(*h);
        return &h.release()->plain;
    } catch (const std::exception &e) {
        return fail(message, capacity, e.what());
    } catch (...) {
        return fail(message, capacity, "unknown exception in tinygltf");
    }
}

extern "C" void nook_gltf_model_free(nook_gltf_model *model) noexcept
{
    /* `plain` is the first member, and holder has no virtual functions. */
    delete reinterpret_cast<holder *>(model);
}
