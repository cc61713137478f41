#include "engine/scene/gltf_export.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <span>
#include <sstream>

#include "engine/core/safe_file.h"

namespace ag {
namespace {

tinygltf::Value number(double v) {
    return tinygltf::Value(v);
}

template <class V>
std::vector<double> doubles(const V& v) {
    std::vector<double> out;
    for (int i = 0; i < V::length(); ++i)
        out.push_back(double(v[i]));
    return out;
}

// Appends bytes as a buffer view of their own.
int addView(tinygltf::Model& model, const void* bytes, size_t size, int target) {
    auto& data = model.buffers[0].data;
    data.resize((data.size() + 3) / 4 * 4);
    tinygltf::BufferView view;
    view.buffer = 0;
    view.byteOffset = data.size();
    view.byteLength = size;
    view.target = target;
    data.resize(data.size() + size);
    std::memcpy(data.data() + view.byteOffset, bytes, size);
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size() - 1);
}

template <class T>
int addAccessor(tinygltf::Model& model, const std::vector<T>& items, int component, int type, int target,
                const Bounds* bounds = nullptr) {
    tinygltf::Accessor a;
    a.bufferView = addView(model, items.data(), items.size() * sizeof(T), target);
    a.componentType = component;
    a.count = items.size();
    a.type = type;
    if (bounds) {
        a.minValues = doubles(bounds->min);
        a.maxValues = doubles(bounds->max);
    }
    model.accessors.push_back(a);
    return int(model.accessors.size() - 1);
}

void addSkin(tinygltf::Model& model, std::span<const SkinVertex> skin, tinygltf::Primitive& out) {
    std::vector<glm::u16vec4> joints;
    std::vector<glm::vec4> weights;
    bool bent = false;
    for (const SkinVertex& v : skin) {
        const bool moved = v.weights != glm::vec4(0);  // others are in no triangle, or nothing bends the mesh
        bent = bent || moved;
        joints.push_back(v.joints);
        weights.push_back(moved ? v.weights : glm::vec4(1, 0, 0, 0));
    }
    if (!bent) return;
    const int buffer = TINYGLTF_TARGET_ARRAY_BUFFER;
    out.attributes["JOINTS_0"] =
        addAccessor(model, joints, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, buffer);
    out.attributes["WEIGHTS_0"] =
        addAccessor(model, weights, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, buffer);
}

tinygltf::Skin skinOf(tinygltf::Model& model, const SceneSkin& s) {
    tinygltf::Skin out;
    out.name = s.name;
    out.joints.assign(s.joints.begin(), s.joints.end());
    out.inverseBindMatrices =
        addAccessor(model, s.inverseBind, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_MAT4, 0);
    return out;
}

int addValues(tinygltf::Model& model, const SceneChannel& c) {
    if (c.path == ChannelPath::kRotation)
        return addAccessor(model, c.values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC4, 0);
    const std::vector<glm::vec3> values(c.values.begin(), c.values.end());
    return addAccessor(model, values, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_VEC3, 0);
}

tinygltf::Animation animationOf(tinygltf::Model& model, const SceneAnimation& a) {
    static constexpr const char* kPaths[] = {"translation", "rotation", "scale"};
    static constexpr const char* kInterpolations[] = {"STEP", "LINEAR", "CUBICSPLINE"};
    tinygltf::Animation out;
    out.name = a.name;
    for (const SceneChannel& c : a.channels) {
        tinygltf::AnimationSampler sampler;
        sampler.interpolation = kInterpolations[size_t(c.interpolation)];
        sampler.input = addAccessor(model, c.times, TINYGLTF_COMPONENT_TYPE_FLOAT, TINYGLTF_TYPE_SCALAR, 0);
        model.accessors.back().minValues = {double(c.times.front())};
        model.accessors.back().maxValues = {double(c.times.back())};
        sampler.output = addValues(model, c);
        tinygltf::AnimationChannel channel;
        channel.sampler = int(out.samplers.size());
        channel.target_node = int(c.node);
        channel.target_path = kPaths[size_t(c.path)];
        out.samplers.push_back(sampler);
        out.channels.push_back(channel);
    }
    return out;
}

tinygltf::Primitive primitiveOf(tinygltf::Model& model, const GeometryArrays& g, const Primitive& p) {
    uint32_t vertices = 0;
    std::vector<uint32_t> indices(g.indices.begin() + p.firstIndex,
                                  g.indices.begin() + p.firstIndex + p.indexCount);
    for (uint32_t i : indices)
        vertices = std::max(vertices, i + 1);
    std::vector<glm::vec3> positions, normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uvs;
    std::vector<glm::u16vec4> colors;
    for (uint32_t v = 0; v < vertices; ++v) {
        const size_t at = size_t(p.vertexOffset) + v;
        positions.push_back(g.positions[at]);
        normals.push_back(g.attributes[at].normal);
        tangents.push_back(g.attributes[at].tangent);
        uvs.push_back(g.attributes[at].uv);
        colors.push_back(glm::u16vec4(glm::unpackUnorm3x10_1x2(g.attributes[at].color) * 65535.0f + 0.5f));
    }
    tinygltf::Primitive out;
    const int buffer = TINYGLTF_TARGET_ARRAY_BUFFER, f = TINYGLTF_COMPONENT_TYPE_FLOAT;
    out.attributes["POSITION"] = addAccessor(model, positions, f, TINYGLTF_TYPE_VEC3, buffer, &p.boundsLocal);
    out.attributes["NORMAL"] = addAccessor(model, normals, f, TINYGLTF_TYPE_VEC3, buffer);
    if (!tangents.empty() && tangents[0] != glm::vec4(0))
        out.attributes["TANGENT"] = addAccessor(model, tangents, f, TINYGLTF_TYPE_VEC4, buffer);
    out.attributes["TEXCOORD_0"] = addAccessor(model, uvs, f, TINYGLTF_TYPE_VEC2, buffer);
    if (g.materials[p.material].vertexColors) {
        out.attributes["COLOR_0"] =
            addAccessor(model, colors, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, TINYGLTF_TYPE_VEC4, buffer);
        model.accessors.back().normalized = true;
    }
    if (!g.skin.empty()) addSkin(model, {g.skin.data() + p.vertexOffset, vertices}, out);
    out.indices = addAccessor(model, indices, TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                              TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER);
    out.material = int(p.material);
    out.mode = TINYGLTF_MODE_TRIANGLES;
    return out;
}

tinygltf::Material materialOf(const Material& m) {
    tinygltf::Material out;
    out.name = m.name;
    out.pbrMetallicRoughness.baseColorFactor = doubles(m.baseColor);
    out.pbrMetallicRoughness.metallicFactor = double(m.metallic);
    out.pbrMetallicRoughness.roughnessFactor = double(m.roughness);
    const float strength = std::max({m.emissive.x, m.emissive.y, m.emissive.z, 1.0f});
    out.emissiveFactor = doubles(m.emissive / strength);
    if (strength > 1)
        out.extensions["KHR_materials_emissive_strength"] =
            tinygltf::Value(tinygltf::Value::Object{{"emissiveStrength", number(double(strength))}});
    if (m.specular != 1)
        out.extensions["KHR_materials_specular"] =
            tinygltf::Value(tinygltf::Value::Object{{"specularFactor", number(double(m.specular))}});
    if (m.alphaMode == AlphaMode::kBlend && m.baseColor.w < 1) out.alphaMode = "BLEND";
    if (m.transmission > 0)
        out.extensions["KHR_materials_transmission"] =
            tinygltf::Value(tinygltf::Value::Object{{"transmissionFactor", number(double(m.transmission))}});
    out.doubleSided = m.doubleSided;
    return out;
}

void addVector(tinygltf::Value::Object& extras, const char* name, glm::vec3 v) {
    if (v == glm::vec3(0)) return;
    extras[name] = tinygltf::Value(
        tinygltf::Value::Array{number(double(v.x)), number(double(v.y)), number(double(v.z))});
}

void addGameExtras(const NodeExtras& e, tinygltf::Value::Object& extras) {
    if (!e.bounces) extras["bounces"] = tinygltf::Value(false);
    if (!e.castsShadow) extras["castsShadow"] = tinygltf::Value(false);
    if (e.openToSky) extras["openToSky"] = tinygltf::Value(true);
    if (e.shy) extras["shy"] = tinygltf::Value(true);
    if (!e.tag.empty()) extras["tag"] = tinygltf::Value(e.tag);
    if (!e.text.empty()) extras["text"] = tinygltf::Value(e.text);
    if (e.room >= 0) extras["room"] = tinygltf::Value(e.room);
    addVector(extras, "moveExtent", e.moveExtent);
    addVector(extras, "wants", e.wants);
    addVector(extras, "pivot", e.pivot);
    addVector(extras, "axis", e.axis);
    for (const auto& [name, value] : {std::pair("amount", e.amount),
                                      {"mass", e.mass},
                                      {"least", e.least},
                                      {"most", e.most},
                                      {"swing", e.swing}})
        if (value != 0) extras[name] = number(double(value));
}

tinygltf::Node nodeOf(const SceneNode& n) {
    tinygltf::Node out;
    out.name = n.name;
    out.mesh = n.mesh;
    out.camera = n.camera;
    out.skin = n.skin;
    out.translation = doubles(n.local.translation);
    out.rotation = {double(n.local.rotation.x), double(n.local.rotation.y), double(n.local.rotation.z),
                    double(n.local.rotation.w)};
    out.scale = doubles(n.local.scale);
    if (n.light >= 0)
        out.extensions["KHR_lights_punctual"] =
            tinygltf::Value(tinygltf::Value::Object{{"light", tinygltf::Value(n.light)}});
    const NodeExtras& e = n.extras;
    tinygltf::Value::Object extras;
    if (e.collider) extras["collider"] = tinygltf::Value(true);
    if (e.movePeriod > 0) extras["movePeriod"] = number(double(e.movePeriod));
    if (e.spinSpeed != 0) extras["spinSpeed"] = number(double(e.spinSpeed));
    if (e.flickerDepth > 0) extras["flickerDepth"] = number(double(e.flickerDepth));
    if (e.flickerPeriod > 0) extras["flickerPeriod"] = number(double(e.flickerPeriod));
    if (e.flickerOff > 0) extras["flickerOff"] = number(double(e.flickerOff));
    if (e.clip != 0) extras["clip"] = tinygltf::Value(e.clip);
    if (e.clipStart > 0) extras["clipStart"] = number(double(e.clipStart));
    if (e.clipSpeed != 1) extras["clipSpeed"] = number(double(e.clipSpeed));
    if (!e.clipLoops) extras["clipLoops"] = tinygltf::Value(false);
    addGameExtras(e, extras);
    if (!extras.empty()) out.extras = tinygltf::Value(extras);
    return out;
}

tinygltf::Light lightOf(const SceneLight& l) {
    static constexpr const char* kTypes[] = {"directional", "point", "spot"};
    tinygltf::Light out;
    out.name = l.name;
    out.type = kTypes[size_t(l.kind)];
    const float most = std::max({l.intensity.x, l.intensity.y, l.intensity.z, 1e-20f});
    out.intensity = double(most);
    out.color = doubles(l.intensity / most);
    out.range = double(l.range);
    if (l.kind == LightKind::kSpot) {
        out.spot.innerConeAngle = double(l.innerConeAngle);
        out.spot.outerConeAngle = double(l.outerConeAngle);
    }
    return out;
}

tinygltf::Camera cameraOf(const SceneCamera& c) {
    tinygltf::Camera out;
    out.name = c.name;
    out.type = "perspective";
    out.perspective.yfov = double(c.verticalFov);
    out.perspective.znear = double(c.near);
    return out;
}

}  // namespace

Status exportGlb(const SceneAsset& asset, const std::string& path) {
    for (const Material& m : asset.geometry.materials)
        if (m.textureClass != TextureClass::kNone)
            return Error{path + ": scenes with textures are not written"};
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "Afterglow";
    model.buffers.emplace_back();
    for (const Material& m : asset.geometry.materials)
        model.materials.push_back(materialOf(m));
    for (const SceneMesh& mesh : asset.meshes) {
        tinygltf::Mesh out;
        out.name = mesh.name;
        for (uint32_t p = 0; p < mesh.primitiveCount; ++p)
            out.primitives.push_back(
                primitiveOf(model, asset.geometry, asset.geometry.primitives[mesh.firstPrimitive + p]));
        model.meshes.push_back(out);
    }
    tinygltf::Scene scene;
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        model.nodes.push_back(nodeOf(asset.nodes[i]));
        if (asset.nodes[i].parent >= 0)
            model.nodes[size_t(asset.nodes[i].parent)].children.push_back(int(i));
        else
            scene.nodes.push_back(int(i));
    }
    for (const SceneSkin& s : asset.skins)
        model.skins.push_back(skinOf(model, s));
    for (const SceneAnimation& a : asset.animations)
        model.animations.push_back(animationOf(model, a));
    for (const SceneLight& l : asset.lights)
        model.lights.push_back(lightOf(l));
    for (const SceneCamera& c : asset.cameras)
        model.cameras.push_back(cameraOf(c));
    for (const char* name : {"KHR_lights_punctual", "KHR_materials_specular",
                             "KHR_materials_emissive_strength", "KHR_materials_transmission"})
        model.extensionsUsed.push_back(name);
    model.scenes.push_back(scene);
    model.defaultScene = 0;
    std::ostringstream bytes;
    tinygltf::TinyGLTF writer;
    if (!writer.WriteGltfSceneToStream(&model, bytes, false, true))
        return Error{path + ": the scene cannot be encoded"};
    return writeFileSafely(path, bytes.view());
}

}  // namespace ag
