#include "tools/workbench/session_edits.h"

#include <algorithm>
#include <nlohmann/json.hpp>

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

NodeMove moveIn(const json& file) {
    NodeMove move{.node = file.at("node").get<uint32_t>()};
    for (int c = 0; c < 3; ++c)
        move.offset[c] = numberIn(file.at("offset").at(size_t(c)), -kMostNumber, kMostNumber);
    return move;
}

MaterialLook lookIn(const json& file) {
    MaterialLook look{.material = file.at("material").get<uint32_t>(),
                      .metallic = shareIn(file.at("metallic")),
                      .roughness = shareIn(file.at("roughness"))};
    for (int c = 0; c < 4; ++c)
        look.baseColor[c] = shareIn(file.at("base_color").at(size_t(c)));
    for (int c = 0; c < 3; ++c)
        look.emissive[c] = float(numberIn(file.at("emissive").at(size_t(c)), 0, kMostNumber));
    return look;
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

}  // namespace ag::workbench
