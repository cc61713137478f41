// Large primitives in pieces that lie together, so that views draw only what is near their frustum.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag {

constexpr uint32_t kMostTrianglesInPiece = 512;

// Halves primitives at the median triangle along their longest side until none has more triangles than that.
// Only the order of indices changes; meshes keep their triangles.
void splitLargePrimitives(SceneAsset& asset, uint32_t mostTriangles = kMostTrianglesInPiece);

}  // namespace ag
