// The viewer's edits in a glTF file: the source as it is, with the lights and the camera in place of its own,
// and what was moved or looks otherwise changed where it stands.
#pragma once

#include <span>
#include <string>

#include "engine/core/result.h"
#include "engine/scene/asset_edits.h"
#include "engine/scene/static_scene.h"

namespace ag::viewer {

struct SceneEdits {
    std::span<const RenderLight> lights;
    glm::dvec3 origin{0};  // m, of their positions, in the world
    CameraPose pose;
    std::vector<NodeMove> moves;      // nodes of the file, as their parents see it
    std::vector<MaterialLook> looks;  // of the file's materials, or of the one for primitives without
};
// Of an asset that was imported, or that exportGlb would write.
std::vector<NodeMove> movesInFile(const SceneAsset& asset, const AssetEdits& edits);

// Bytes of a .gltf or .glb with these lights (KHR_lights_punctual, new nodes of the scene shown) and this
// camera as the first; all else stays byte for byte what it was, apart from the JSON's spacing. Lights that
// do not bounce or cast no shadow say so in their nodes' extras, as exportGlb writes them. Fails where the
// bytes are no glTF.
Result<std::string> withEdits(std::string_view bytes, const SceneEdits& edits);

// Where the edited scene goes: beside its source, whose buffers and images it names, else into this folder.
std::string editedPath(const std::string& scene);

// `scene`: a file, or a built-in name with its number.
Status saveEdited(const std::string& scene, uint32_t param, const SceneEdits& edits, const std::string& path);

}  // namespace ag::viewer
