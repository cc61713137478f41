#include "tools/viewer/edited_gltf.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "engine/core/safe_file.h"
#include "engine/scene/gltf_export.h"
#include "engine/scene/gltf_import.h"
#include "tools/scenegen/scenes.h"

namespace ag::viewer {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr char kPunctual[] = "KHR_lights_punctual", kUnlit[] = "KHR_materials_unlit",
               kStrength[] = "KHR_materials_emissive_strength";
constexpr size_t kGlbHeader = 12, kChunkHeader = 8;

template <class V>
json listOf(const V& v) {
    return {v.x, v.y, v.z};
}

json lightOf(const RenderLight& l) {
    static constexpr const char* kTypes[] = {"directional", "point", "spot"};
    const float most = std::max({l.intensity.x, l.intensity.y, l.intensity.z, 1e-20f});
    json out = {
        {"type", kTypes[size_t(l.kind)]}, {"intensity", double(most)}, {"color", listOf(l.intensity / most)}};
    if (l.range > 0) out["range"] = l.range;
    if (l.kind == LightKind::kSpot)
        out["spot"] = {{"innerConeAngle", l.innerConeAngle}, {"outerConeAngle", l.outerConeAngle}};
    return out;
}

// A frame whose -Z is `forward` and whose top leans towards `up`.
json rotationOf(glm::vec3 forward, glm::vec3 up) {
    const glm::vec3 right = rightOf(forward, up);
    const glm::quat q = glm::quat_cast(glm::mat3(right, glm::cross(right, forward), -forward));
    return {q.x, q.y, q.z, q.w};
}

json nodeOf(const RenderLight& l, glm::dvec3 origin, size_t index) {
    json node = {{"name", "light " + std::to_string(index)},
                 {"translation", listOf(origin + glm::dvec3(l.position))},
                 {"rotation", rotationOf(l.direction, {0, 1, 0})},
                 {"extensions", {{kPunctual, {{"light", index}}}}}};
    if (!l.bounces) node["extras"]["bounces"] = false;
    if (!l.castsShadow) node["extras"]["castsShadow"] = false;
    return node;
}

void removeExtension(json& object, const char* extension) {
    if (!object.contains("extensions")) return;
    object["extensions"].erase(extension);
    if (object["extensions"].empty()) object.erase("extensions");
}

void removeLights(json& document) {
    for (json& node : document["nodes"])
        removeExtension(node, kPunctual);
}

void addCamera(json& document, const CameraPose& pose) {
    for (json& node : document["nodes"])
        if (node.contains("camera")) node["camera"] = node["camera"].get<size_t>() + 1;
    json& cameras = document["cameras"];
    if (cameras.is_null()) cameras = json::array();
    const json camera = {{"type", "perspective"},
                         {"perspective", {{"yfov", pose.verticalFov}, {"znear", pose.near}}}};
    cameras.insert(cameras.begin(), camera);
    document["nodes"].push_back({{"name", "view"},
                                 {"camera", 0},
                                 {"translation", listOf(pose.position)},
                                 {"rotation", rotationOf(pose.forward, pose.up)}});
}

void noteUsed(json& document, const char* extension) {
    json& used = document["extensionsUsed"];
    if (used.is_null()) used = json::array();
    if (std::ranges::find(used, json(extension)) == used.end()) used.push_back(extension);
}

bool hasExtension(const json& object, const char* extension) {
    return object.contains("extensions") && object["extensions"].contains(extension);
}

void removeName(json& document, const char* list, const char* name) {
    if (!document.contains(list)) return;
    json& names = document[list];
    const auto found = std::ranges::find(names, json(name));
    if (found != names.end()) names.erase(found);
    if (names.empty()) document.erase(list);
}

// Where no material has it any more.
void noteUnlitUnused(json& document) {
    for (const json& material : document["materials"])
        if (hasExtension(material, kUnlit)) return;
    removeName(document, "extensionsUsed", kUnlit);
    removeName(document, "extensionsRequired", kUnlit);
}

void addLights(json& document, const SceneEdits& edits) {
    json& list = document["extensions"][kPunctual]["lights"] = json::array();
    for (size_t i = 0; i < edits.lights.size(); ++i) {
        list.push_back(lightOf(edits.lights[i]));
        document["nodes"].push_back(nodeOf(edits.lights[i], edits.origin, i));
    }
    noteUsed(document, kPunctual);
}

// In its own place, or its matrix.
void moveNode(json& node, glm::dvec3 offset) {
    const bool matrix = node.contains("matrix");
    json& place = node[matrix ? "matrix" : "translation"];
    if (place.is_null()) place = {0.0, 0.0, 0.0};
    for (size_t c = 0; c < 3; ++c) {
        json& number = place.at(matrix ? 12 + c : c);
        number = number.get<double>() + offset[int(c)];
    }
}

void moveNodes(json& document, const SceneEdits& edits) {
    for (const NodeMove& move : edits.moves)
        moveNode(document["nodes"].at(move.node), move.offset);
}

// What shone as it is whatever the light now shines by its emission.
void makeLit(json& material) {
    if (!hasExtension(material, kUnlit)) return;
    removeExtension(material, kUnlit);
    json& pbr = material["pbrMetallicRoughness"];
    if (pbr.contains("baseColorTexture")) material["emissiveTexture"] = pbr["baseColorTexture"];
}

void setLook(json& material, const MaterialLook& look) {
    makeLit(material);
    json& pbr = material["pbrMetallicRoughness"];
    pbr["baseColorFactor"] = {look.baseColor.x, look.baseColor.y, look.baseColor.z, look.baseColor.w};
    pbr["metallicFactor"] = look.metallic;
    pbr["roughnessFactor"] = look.roughness;
    const float strength = std::max({look.emissive.x, look.emissive.y, look.emissive.z, 1.0f});
    material["emissiveFactor"] = listOf(look.emissive / strength);
    removeExtension(material, kStrength);
    if (strength > 1) material["extensions"][kStrength] = {{"emissiveStrength", strength}};
}

// A material after the file's own is what primitives without one are drawn with.
void addDefaultMaterial(json& document) {
    json& materials = document["materials"];
    for (json& mesh : document["meshes"])
        for (json& primitive : mesh["primitives"])
            if (!primitive.contains("material")) primitive["material"] = materials.size();
    materials.push_back({{"name", "default"}});
}

void setLooks(json& document, const SceneEdits& edits) {
    if (edits.looks.empty()) return;
    json& materials = document["materials"];
    if (materials.is_null()) materials = json::array();
    const size_t own = materials.size();
    for (const MaterialLook& look : edits.looks) {
        if (look.material == own && materials.size() == own) addDefaultMaterial(document);
        setLook(materials.at(look.material), look);
        if (look.emissive.x > 1 || look.emissive.y > 1 || look.emissive.z > 1) noteUsed(document, kStrength);
    }
    noteUnlitUnused(document);
}

// New nodes are roots of the scene that is shown.
void edit(json& document, const SceneEdits& edits) {
    json& nodes = document["nodes"];
    if (nodes.is_null()) nodes = json::array();
    const size_t first = nodes.size();
    moveNodes(document, edits);
    setLooks(document, edits);
    removeLights(document);
    addCamera(document, edits.pose);
    addLights(document, edits);
    if (!document.contains("scenes")) return;  // every node without a parent is shown
    json& shown = document["scenes"].at(document.value("scene", size_t(0)));
    for (size_t i = first; i < document["nodes"].size(); ++i)
        shown["nodes"].push_back(i);
}

uint32_t wordAt(std::string_view bytes, size_t at) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

std::string wordOf(size_t value) {
    const auto word = uint32_t(value);
    return {reinterpret_cast<const char*>(&word), sizeof word};
}

Result<std::string> editedJson(std::string_view text, const SceneEdits& edits) {
    json document = json::parse(text, nullptr, false);
    if (!document.is_object()) return Error{"it is no glTF"};
    try {
        edit(document, edits);
        return document.dump(-1, ' ', false, json::error_handler_t::replace);
    } catch (const json::exception&) {
        return Error{"its JSON is not that of a glTF"};
    }
}

}  // namespace

Result<std::string> withEdits(std::string_view bytes, const SceneEdits& edits) {
    if (!bytes.starts_with("glTF")) return editedJson(bytes, edits);
    constexpr size_t kText = kGlbHeader + kChunkHeader;
    if (bytes.size() < kText || wordAt(bytes, kGlbHeader) > bytes.size() - kText)
        return Error{"it is no GLB"};
    const size_t length = wordAt(bytes, kGlbHeader);
    auto text = editedJson(bytes.substr(kText, length), edits);
    if (!text) return text.error();
    text->resize((text->size() + 3) / 4 * 4, ' ');
    const std::string_view rest = bytes.substr(kText + length);
    return "glTF" + wordOf(2) + wordOf(kText + text->size() + rest.size()) + wordOf(text->size()) + "JSON" +
           *text + std::string(rest);
}

std::vector<NodeMove> movesInFile(const SceneAsset& asset, const AssetEdits& edits) {
    const bool imported = std::ranges::any_of(asset.nodes, [](const SceneNode& n) { return n.source >= 0; });
    std::vector<NodeMove> moves;
    for (const NodeMove& move : edits.moves) {
        const int32_t node = imported ? asset.nodes[move.node].source : int32_t(move.node);
        if (node >= 0) moves.push_back({uint32_t(node), offsetInParent(asset, move)});
    }
    return moves;
}

std::string editedPath(const std::string& scene) {
    const fs::path path(scene);
    if (scenegen::isBuiltIn(scene)) return scene + "_edited.glb";
    return (path.parent_path() / (path.stem().string() + "_edited" + path.extension().string())).string();
}

Status saveEdited(const std::string& scene, uint32_t param, const SceneEdits& edits,
                  const std::string& path) {
    std::string source = scene;
    if (scenegen::isBuiltIn(scene)) {
        const auto asset = scenegen::buildScene(scene, param);
        if (!asset) return asset.error();
        if (Status made = exportGlb(*asset, path); !made) return made;
        source = path;
    }
    const auto bytes = readFile(source, ImportLimits{}.fileBytes);
    if (!bytes) return bytes.error();
    const auto edited = withEdits(*bytes, edits);
    if (!edited) return Error{source + ": " + edited.error().message};
    return writeFileSafely(path, *edited);
}

}  // namespace ag::viewer
