// Any intermediate as an image: raw floats for files (`--layer`), colours for the eye (`--view`, keys 1-9).
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "gi/gi.h"

namespace ag::gi {

enum class Layer : uint32_t {
    kFinal,       // tonemapped
    kRadiance,    // W/(m² sr)
    kDirect,      // irradiance straight from lights, W/m²
    kIndirect,    // irradiance of all bounces, W/m²
    kBounce1,     // irradiance of the first bounce, W/m²
    kBounce2,     // of all after the first (of the second alone with later_bounces.feedback=off), W/m²
    kIrradiance,  // direct and indirect, W/m²
    kAlbedo,
    kNormal,
    kDepth,  // m along the camera's axis
    kRsm,    // radiosity over the light maps, W/m²
    kImportance,
    kClusters,      // Voronoi colours over the scene
    kVals,          // area lights drawn as polygons over the scene
    kLampClusters,  // lamps and what they light in the colours of shared shadow maps
    kIsm,           // imperfect shadow maps side by side, m
    kCount
};

std::string_view layerName(Layer layer);
std::optional<Layer> layerFromName(std::string_view name);

// Whether gloss is in it; the others are the same without, and cheaper.
bool showsGloss(Layer layer);

// The layer as floats; an invalid handle where the frame has none (no light, say: the layer is black).
ImageHandle addLayer(FrameGraph& graph, const SceneView& scene, const GiFrame& frame, Layer layer);
// The layer as display values of `size` pixels.
ImageHandle addLayerView(FrameGraph& graph, const SceneView& scene, const GiFrame& frame, Layer layer,
                         glm::uvec2 size, const CompositeSettings& settings);

}  // namespace ag::gi
