// The node tree in parents-first order, with lights and cameras.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/scene/gltf_internal.h"
#include "engine/scene/static_scene.h"

namespace ag::gltf {
namespace {

NodeTransform decompose(const std::vector<double>& m) {
    glm::dmat3 linear;
    for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r)
            linear[c][r] = m[size_t(c * 4 + r)];
    NodeTransform out;
    out.translation = {m[12], m[13], m[14]};
    for (int c = 0; c < 3; ++c) {
        const double length = glm::length(linear[c]);
        out.scale[c] = float(length);
        if (length > 0) linear[c] /= length;
    }
    if (glm::determinant(linear) < 0) {  // mirrored: keep it in the scale
        linear[0] = -linear[0];
        out.scale.x = -out.scale.x;
    }
    out.rotation = glm::normalize(glm::quat(glm::quat_cast(linear)));
    return out;
}

NodeTransform transformOf(const tinygltf::Node& n) {
    if (n.matrix.size() == 16) return decompose(n.matrix);
    NodeTransform out;
    if (n.translation.size() == 3) out.translation = {n.translation[0], n.translation[1], n.translation[2]};
    if (n.rotation.size() == 4) {
        const glm::quat q(float(n.rotation[3]), float(n.rotation[0]), float(n.rotation[1]),
                          float(n.rotation[2]));
        out.rotation = glm::length(q) > 1e-6f ? glm::normalize(q) : glm::quat(1, 0, 0, 0);
    }
    if (n.scale.size() == 3) out.scale = {float(n.scale[0]), float(n.scale[1]), float(n.scale[2])};
    return out;
}

bool flagOf(const tinygltf::Value& object, const char* key, bool otherwise) {
    return object.Has(key) && object.Get(key).IsBool() ? object.Get(key).Get<bool>() : otherwise;
}

std::string textOf(const tinygltf::Value& object, const char* key) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : "";
}

glm::vec3 vectorOf(const tinygltf::Value& object, const char* key) {
    glm::vec3 out(0);
    if (object.Has(key) && object.Get(key).IsArray() && object.Get(key).ArrayLen() == 3)
        for (int i = 0; i < 3; ++i)
            out[i] = floatOf(object.Get(key).Get(i).GetNumberAsDouble());
    return out;
}

NodeExtras extrasOf(const tinygltf::Value& extras) {
    NodeExtras out;
    if (!extras.IsObject()) return out;
    out.collider = flagOf(extras, "collider", false);
    out.moveExtent = vectorOf(extras, "moveExtent");
    out.bounces = flagOf(extras, "bounces", true);
    out.castsShadow = flagOf(extras, "castsShadow", true);
    out.tag = textOf(extras, "tag");
    out.text = textOf(extras, "text");
    out.room = int32_t(std::clamp(numberOf(extras, "room", -1), -1.0, 1000.0));
    out.wants = vectorOf(extras, "wants");
    out.pivot = vectorOf(extras, "pivot");
    out.axis = vectorOf(extras, "axis");
    for (const auto& [name, value] : {std::pair("amount", &out.amount),
                                      {"mass", &out.mass},
                                      {"least", &out.least},
                                      {"most", &out.most},
                                      {"swing", &out.swing}})
        *value = floatOf(extras, name, 0);
    out.openToSky = flagOf(extras, "openToSky", false);
    out.shy = flagOf(extras, "shy", false);
    out.movePeriod = floatOf(extras, "movePeriod", 0);
    out.spinSpeed = floatOf(extras, "spinSpeed", 0);
    out.flickerDepth = std::clamp(floatOf(extras, "flickerDepth", 0), 0.0f, 1.0f);
    out.flickerPeriod = std::max(floatOf(extras, "flickerPeriod", 0), 0.0f);
    out.flickerOff = std::clamp(floatOf(extras, "flickerOff", 0), 0.0f, 1.0f);
    out.clip = int32_t(std::clamp(numberOf(extras, "clip", 0), -1.0, 1e6));
    out.clipStart = std::max(floatOf(extras, "clipStart", 0), 0.0f);
    out.clipSpeed = floatOf(extras, "clipSpeed", 1);
    out.clipLoops = flagOf(extras, "clipLoops", true);
    return out;
}

int lightOf(const tinygltf::Node& n) {
    const auto found = n.extensions.find("KHR_lights_punctual");
    return found == n.extensions.end() ? -1 : int(numberOf(found->second, "light", -1));
}

SceneLight lightFrom(const tinygltf::Light& l) {
    SceneLight out{.name = l.name, .intensity = glm::vec3(floatOf(l.intensity)), .range = floatOf(l.range)};
    out.kind = l.type == "directional" ? LightKind::kDirectional
               : l.type == "spot"      ? LightKind::kSpot
                                       : LightKind::kPoint;
    for (int c = 0; c < 3 && l.color.size() == 3; ++c)
        out.intensity[c] *= floatOf(l.color[size_t(c)]);
    if (out.kind == LightKind::kSpot) {
        out.innerConeAngle = float(l.spot.innerConeAngle);
        out.outerConeAngle = float(l.spot.outerConeAngle);
    }
    return out;
}

SceneCamera cameraFrom(const tinygltf::Camera& c) {
    SceneCamera out{.name = c.name};
    if (c.type == "orthographic") {
        const auto& o = c.orthographic;
        constexpr float kLeastHeight = 1e-6f;  // m
        out.orthographicHeight = std::isfinite(o.ymag) && o.ymag != 0
                                     ? std::max(2 * std::abs(floatOf(o.ymag)), kLeastHeight)
                                     : 2.0f;
        out.near = std::isfinite(o.znear) && o.znear > 0 ? floatOf(o.znear) : 0.0f;
    }
    if (c.type != "perspective") return out;
    if (c.perspective.yfov > 0.01 && c.perspective.yfov < 3.1) out.verticalFov = float(c.perspective.yfov);
    if (std::isfinite(c.perspective.znear) && c.perspective.znear > 0)
        out.near = std::max(floatOf(c.perspective.znear), 1e-9f);
    return out;
}

// KHR_node_visibility: of the node and all below it.
bool isHidden(const tinygltf::Node& n) {
    const auto found = n.extensions.find("KHR_node_visibility");
    return found != n.extensions.end() && !flagOf(found->second, "visible", true);
}

// EXT_mesh_gpu_instancing: the accessor of an attribute, -1: none.
int instanceAccessor(const tinygltf::Node& n, const char* name) {
    const auto found = n.extensions.find("EXT_mesh_gpu_instancing");
    if (found == n.extensions.end() || !found->second.Has("attributes")) return -1;
    const double index = numberOf(found->second.Get("attributes"), name, -1);
    return int(std::clamp(index, -1.0, 2e9));
}

bool isInstanced(const tinygltf::Node& n) {
    return n.extensions.contains("EXT_mesh_gpu_instancing");
}

// How many copies; 0: the attributes do not fit together.
uint64_t instanceCount(const tinygltf::Model& model, const tinygltf::Node& n) {
    std::optional<uint64_t> count;
    for (const auto& [name, type] :
         {std::pair("TRANSLATION", TINYGLTF_TYPE_VEC3), std::pair("ROTATION", TINYGLTF_TYPE_VEC4),
          std::pair("SCALE", TINYGLTF_TYPE_VEC3)}) {
        const int index = instanceAccessor(n, name);
        if (index < 0) continue;
        if (size_t(index) >= model.accessors.size()) return 0;
        const tinygltf::Accessor& a = model.accessors[size_t(index)];
        if (a.type != type || (count && *count != a.count)) return 0;
        count = a.count;
    }
    return count.value_or(0);
}

// The copies become nodes of their own below the node.
Fault addInstances(const tinygltf::Model& model, const tinygltf::Node& n, int32_t parent, int32_t mesh,
                   const ImportLimits& limits, SceneAsset& asset) {
    const uint64_t count = instanceCount(model, n);
    if (count == 0)
        return fmt::format("node '{}' has instances whose attributes do not fit together", n.name);
    if (count > limits.nodes - std::min<uint64_t>(limits.nodes, asset.nodes.size()))
        return "its instances are more nodes than the limit";
    const auto values = [&](const char* name, int components) {
        const int index = instanceAccessor(n, name);
        return index < 0 ? std::vector<float>() : readFloats(model, index, components);
    };
    const std::vector<float> moves = values("TRANSLATION", 3), turns = values("ROTATION", 4),
                             scales = values("SCALE", 3);
    for (const auto* list : {&moves, &turns, &scales})
        if (!std::ranges::all_of(*list, [](float v) { return std::abs(v) < 1e12f; }))
            return fmt::format("node '{}' has an instance that is not finite", n.name);
    for (size_t i = 0; i < count; ++i) {
        NodeTransform t;
        if (!moves.empty()) t.translation = {moves[3 * i], moves[3 * i + 1], moves[3 * i + 2]};
        if (!scales.empty()) t.scale = {scales[3 * i], scales[3 * i + 1], scales[3 * i + 2]};
        if (!turns.empty()) {
            const glm::quat q(turns[4 * i + 3], turns[4 * i], turns[4 * i + 1], turns[4 * i + 2]);
            if (glm::length(q) > 1e-6f) t.rotation = glm::normalize(q);
        }
        asset.nodes.push_back({.name = fmt::format("{} {}", n.name, i),
                               .parent = parent,
                               .depth = asset.nodes[size_t(parent)].depth + 1,
                               .local = t,
                               .mesh = mesh});
    }
    return std::nullopt;
}

// Transforms that are fine one by one may leave the range of floats together.
Fault checkPlaces(const SceneAsset& asset) {
    const std::vector<WorldPlacement> places = placeNodes(asset);
    for (size_t i = 0; i < places.size(); ++i) {
        bool near = true;
        for (int c = 0; c < 3; ++c) {
            near = near && std::abs(places[i].translation[c]) < double(kFarthest);
            for (int r = 0; r < 3; ++r)
                near = near && std::abs(places[i].linear[c][r]) < kFarthest;
        }
        if (!near)
            return fmt::format("node '{}' stands farther off or is larger than {:g} m", asset.nodes[i].name,
                               kFarthest);
    }
    return std::nullopt;
}

}  // namespace

Fault importNodes(const tinygltf::Model& model, std::span<const int32_t> meshOfNode,
                  const ImportLimits& limits, SceneAsset& asset, std::vector<int32_t>& newIndex) {
    // Roots: of the default scene, else of the first, else every node without a parent.
    struct Pending {
        int node;
        int32_t parent;  // new index
        bool hidden;
    };
    std::vector<Pending> pending;
    const int scene = model.defaultScene >= 0 ? model.defaultScene : model.scenes.empty() ? -1 : 0;
    std::vector<int> roots;
    if (scene >= 0) {
        roots = model.scenes[size_t(scene)].nodes;
    } else {
        std::vector<bool> isChild(model.nodes.size(), false);
        for (const tinygltf::Node& n : model.nodes)
            for (int child : n.children)
                isChild[size_t(child)] = true;
        for (size_t i = 0; i < model.nodes.size(); ++i)
            if (!isChild[i]) roots.push_back(int(i));
    }
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        pending.push_back({*root, -1, false});

    newIndex.assign(model.nodes.size(), -1);
    while (!pending.empty()) {
        const auto [old, parent, hiddenAbove] = pending.back();
        pending.pop_back();
        if (newIndex[size_t(old)] != -1) return fmt::format("node {} is listed twice in its scene", old);
        const tinygltf::Node& n = model.nodes[size_t(old)];
        const int32_t index = int32_t(asset.nodes.size());
        const bool hidden = hiddenAbove || isHidden(n);
        newIndex[size_t(old)] = index;
        asset.nodes.push_back({.name = n.name,
                               .parent = parent,
                               .depth = parent < 0 ? 0 : asset.nodes[size_t(parent)].depth + 1,
                               .local = transformOf(n),
                               .mesh = hidden || isInstanced(n) ? -1 : meshOfNode[size_t(old)],
                               .light = hidden ? -1 : lightOf(n),
                               .camera = n.camera,
                               .skin = n.skin,
                               .source = old,
                               .extras = extrasOf(n.extras)});
        for (auto child = n.children.rbegin(); child != n.children.rend(); ++child)
            pending.push_back({*child, index, hidden});
        if (isInstanced(n) && n.mesh >= 0 && !hidden)
            if (Fault f = addInstances(model, n, index, meshOfNode[size_t(old)], limits, asset)) return f;
    }
    if (Fault f = checkPlaces(asset)) return f;
    for (const tinygltf::Light& l : model.lights)
        asset.lights.push_back(lightFrom(l));
    for (const tinygltf::Camera& c : model.cameras)
        asset.cameras.push_back(cameraFrom(c));
    return std::nullopt;
}

}  // namespace ag::gltf
