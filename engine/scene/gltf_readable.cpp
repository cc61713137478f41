// What tinygltf refuses although files may have it.
#include <nlohmann/json.hpp>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

constexpr char kNoBytes[] = "data:application/octet-stream;base64,AA==";

void fillEmptyBuffers(nlohmann::json& json, bool binary) {
    if (!json.contains("buffers") || !json["buffers"].is_array()) return;
    for (size_t i = binary ? 1 : 0; i < json["buffers"].size(); ++i) {
        nlohmann::json& buffer = json["buffers"][i];
        if (!buffer.is_object() || buffer.contains("uri")) continue;
        buffer["byteLength"] = 1;
        buffer["uri"] = kNoBytes;
    }
}

// Null: it is no object, or has no such member.
nlohmann::json* member(nlohmann::json* value, const char* key) {
    if (!value || !value->is_object()) return nullptr;
    const auto found = value->find(key);
    return found == value->end() ? nullptr : &*found;
}

// A compressed mesh's indices have no view until they are decompressed: that of the compressed bytes stands
// in.
void viewIndices(nlohmann::json& primitive, nlohmann::json& accessors) {
    const nlohmann::json* view =
        member(member(member(&primitive, "extensions"), "KHR_draco_mesh_compression"), "bufferView");
    const nlohmann::json* indices = member(&primitive, "indices");
    if (!view || !view->is_number_unsigned() || !indices || !indices->is_number_unsigned() ||
        indices->get<size_t>() >= accessors.size())
        return;
    nlohmann::json& accessor = accessors[indices->get<size_t>()];
    if (accessor.is_object() && !accessor.contains("bufferView")) accessor["bufferView"] = *view;
}

void viewAllIndices(nlohmann::json& json) {
    if (!json.contains("accessors") || !json["accessors"].is_array() || !json.contains("meshes")) return;
    for (nlohmann::json& mesh : json["meshes"])
        if (nlohmann::json* primitives = member(&mesh, "primitives"))
            for (nlohmann::json& primitive : *primitives)
                viewIndices(primitive, json["accessors"]);
}

bool holds(std::string_view text, std::string_view word) {
    return text.find(word) != std::string_view::npos;
}

std::string replaceAll(std::string_view text, std::string_view what, std::string_view with) {
    std::string out;
    for (size_t at = text.find(what); at != std::string_view::npos; at = text.find(what)) {
        out.append(text.substr(0, at)).append(with);
        text.remove_prefix(at + what.size());
    }
    return out.append(text);
}

}  // namespace

std::string readableJson(std::string_view text, bool binary) {
    std::string out(text);
    for (const char* type : {"data:image/webp;", "data:image/ktx2;"})
        out = replaceAll(out, type, "data:application/octet-stream;");
    const bool meshopt = holds(text, "EXT_meshopt_compression"),
               draco = holds(text, "KHR_draco_mesh_compression");
    if (!meshopt && !draco) return out;
    nlohmann::json json = nlohmann::json::parse(out, nullptr, false);
    if (!json.is_object()) return out;
    if (meshopt) fillEmptyBuffers(json, binary);
    if (draco) viewAllIndices(json);
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace ag::gltf
