#include "tools/workbench/session_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>

#include "tools/workbench/scene_options.h"

namespace ag::workbench {
namespace {

using nlohmann::json;

json moveOf(const NodeMove& m) {
    return {{"node", m.node}, {"offset", {m.offset.x, m.offset.y, m.offset.z}}};
}

json materialOf(const MaterialLook& l) {
    return {{"material", l.material},
            {"base_color", {l.baseColor.x, l.baseColor.y, l.baseColor.z, l.baseColor.w}},
            {"metallic", l.metallic},
            {"roughness", l.roughness},
            {"emissive", {l.emissive.x, l.emissive.y, l.emissive.z}}};
}

double numberIn(const json& value, double least, double most) {
    return std::clamp(value.get<double>(), least, most);
}

float shareIn(const json& value) {
    return float(numberIn(value, 0, 1));
}

// Of a node or a material. Whether the scene has it is seen when the edits are applied.
uint32_t indexIn(const json& value) {
    if (!value.is_number_integer()) throw json::other_error::create(501, "no whole number", &value);
    const int64_t index = value.get<int64_t>();
    const bool inRange = index >= 0 && index <= std::numeric_limits<uint32_t>::max();
    if (!inRange) throw json::other_error::create(501, "out of range", &value);
    return uint32_t(index);
}

NodeMove moveIn(const json& file) {
    NodeMove move{.node = indexIn(file.at("node"))};
    for (int c = 0; c < 3; ++c)
        move.offset[c] = numberIn(file.at("offset").at(size_t(c)), -kMostNumber, kMostNumber);
    return move;
}

MaterialLook lookIn(const json& file) {
    MaterialLook look{.material = indexIn(file.at("material")),
                      .metallic = shareIn(file.at("metallic")),
                      .roughness = shareIn(file.at("roughness"))};
    for (int c = 0; c < 4; ++c)
        look.baseColor[c] = shareIn(file.at("base_color").at(size_t(c)));
    for (int c = 0; c < 3; ++c)
        look.emissive[c] = float(numberIn(file.at("emissive").at(size_t(c)), 0, kMostNumber));
    return look;
}

// The index that two of them have, if any do.
template <class Edit>
std::optional<uint32_t> repeated(const std::vector<Edit>& edits, uint32_t Edit::*index) {
    std::vector<uint32_t> all;
    for (const Edit& edit : edits)
        all.push_back(edit.*index);
    std::ranges::sort(all);
    const auto twice = std::ranges::adjacent_find(all);
    return twice == all.end() ? std::nullopt : std::optional(*twice);
}

}  // namespace

void writeEdits(const AssetEdits& edits, json& session) {
    for (const NodeMove& move : edits.moves)
        session["moves"].push_back(moveOf(move));
    for (const MaterialLook& look : edits.looks)
        session["materials"].push_back(materialOf(look));
}

AssetEdits readEdits(const json& session) {
    AssetEdits edits;
    for (const json& move : session.value("moves", json::array()))
        edits.moves.push_back(moveIn(move));
    for (const json& look : session.value("materials", json::array()))
        edits.looks.push_back(lookIn(look));
    return edits;
}

Status checkEdits(const AssetEdits& edits) {
    if (const auto node = repeated(edits.moves, &NodeMove::node))
        return Error{fmt::format("it moves node {} twice", *node)};
    if (const auto material = repeated(edits.looks, &MaterialLook::material))
        return Error{fmt::format("it changes material {} twice", *material)};
    return Ok{};
}

}  // namespace ag::workbench
