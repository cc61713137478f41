// glTF 2.0 files (.gltf, .glb) to a SceneAsset. tinygltf parses; everything it lets pass is checked here, so
// that a hostile file gives a sentence and nothing else. URIs never leave the file's own folder.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/scene/scene_asset.h"

namespace ag {

// What a file may hold at most.
struct ImportLimits {
    uint64_t fileBytes = uint64_t(1) << 30;  // of the file and all buffers beside it together
    uint32_t jsonDepth = 128;                // brackets in brackets
    uint64_t vertices = 50'000'000;          // of all meshes together, as they are drawn
    uint64_t indices = 150'000'000;
    uint64_t zeroElements = 1 << 20;  // of an accessor that no data stand behind
    uint32_t nodes = 1'000'000;
    uint32_t nodeDepth = 1024;
    uint64_t joints = 1'000'000;      // of all skins together
    uint64_t keyValues = 20'000'000;  // of all animations' channels together
    uint32_t imageSide = 16384;
    uint64_t imageTexels = uint64_t(1) << 28;  // of all images together
    uint64_t layerTexels = uint64_t(1) << 29;  // of all textures, resampled to the sizes of their classes
};

// The error names the file and the fault in one sentence.
Result<SceneAsset> importGltf(const std::string& path, const ImportLimits& limits = {});

}  // namespace ag
