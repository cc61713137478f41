// The layers that render and reference write: their names, units and meaning.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/image.h"
#include "engine/renderer/debug_view.h"

namespace ag::workbench {

// NAME or NAME:radiance.
struct LayerName {
    std::string layer;
    bool asRadiance = false;
    bool known = true;  // what follows the colon is
};
LayerName splitLayerName(const std::string& text);

std::vector<std::string_view> layerNames();  // of the renderer
std::string layerTable();                    // one line each: name, unit, meaning

// The reference's layers; bounceN is exactly the N-th bounce there.
render::LayerInfo referenceLayerInfo(std::string_view name);
std::string referenceLayerTable();

// For an image file: layer, unit, meaning.
std::map<std::string, std::string> layerAttributes(const render::LayerInfo& info, bool asRadiance);

// Irradiance to the radiance that a Lambert surface of this albedo sends on, W/(m² sr).
void toRadiance(Image& irradiance, const Image& albedo);

}  // namespace ag::workbench
