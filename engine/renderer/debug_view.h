// Any intermediate as an image: raw floats for files (`--layer`), colours for the eye (`--view`, keys 1-9).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/renderer/render_frame.h"

namespace ag::render {

enum class Layer : uint32_t {
    kFinal,
    kRadiance,
    kDirect,
    kEmissive,
    kSky,
    kIndirect,
    kBounce1,
    kBounce2,
    kIrradiance,
    kAlbedo,
    kNormal,
    kDepth,
    kRsm,
    kImportance,
    kClusters,
    kVals,
    kLightClusters,
    kIsm,
    kCount
};

struct LayerInfo {
    std::string_view name, unit, meaning;
    bool isIrradiance = false;  // of the camera's pixels
};

const LayerInfo& layerInfo(Layer layer);
std::optional<Layer> layerFromName(std::string_view name);
// That of a number key, 1 to 9; nothing: the picture itself.
std::optional<Layer> layerOfKey(int digit);

// The picture or its radiance, with gloss and anti-aliased; others are of the pixels' centres.
bool isPicture(Layer layer);
// For a layer alone: without what it does not show.
RenderSettings settingsOf(Layer layer, RenderSettings settings);

// Whether the frame has it; without light there are few.
bool hasLayer(const RenderFrame& frame, Layer layer);

// The layer as floats; an invalid handle where the frame has none.
ImageHandle addLayer(GraphScope scope, const SceneView& scene, const RenderFrame& frame, Layer layer);
// The layer as display values of `size` pixels; black where the frame has none.
ImageHandle addLayerView(GraphScope scope, const SceneView& scene, const RenderFrame& frame, Layer layer,
                         glm::uvec2 size, const CompositeSettings& settings);

}  // namespace ag::render
