// Edits of a scene's things and materials as the session's JSON has them.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/scene/asset_edits.h"

namespace ag::workbench {

// "moves" and "materials", where there are any.
void writeEdits(const AssetEdits& edits, nlohmann::json& session);
// Throws where a value is of another type or no number of a node or material.
AssetEdits readEdits(const nlohmann::json& session);
// Fails where a node is moved or a material changed twice.
Status checkEdits(const AssetEdits& edits);

}  // namespace ag::workbench
