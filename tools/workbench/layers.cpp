#include "tools/workbench/layers.h"

#include <fmt/format.h>

#include <numbers>

namespace ag::workbench {

LayerName splitLayerName(const std::string& text) {
    const size_t colon = text.find(':');
    if (colon == std::string::npos) return {text};
    const bool radiance = text.substr(colon + 1) == "radiance";
    return {text.substr(0, colon), radiance, radiance};
}

std::vector<std::string_view> layerNames() {
    std::vector<std::string_view> names;
    for (uint32_t i = 0; i < uint32_t(gi::Layer::kCount); ++i)
        names.push_back(gi::layerInfo(gi::Layer(i)).name);
    return names;
}

std::string layerTable() {
    std::string out = "Layers:\n";
    for (uint32_t i = 0; i < uint32_t(gi::Layer::kCount); ++i) {
        const gi::LayerInfo& info = gi::layerInfo(gi::Layer(i));
        out += fmt::format("  {:<14} {:<23} {}\n", info.name, info.unit, info.meaning);
    }
    return out +
           "  NAME:radiance  W/(m² sr)               an irradiance times albedo / pi: what Lambert surfaces "
           "send on";
}

std::map<std::string, std::string> layerAttributes(const gi::LayerInfo& info, bool asRadiance) {
    if (!asRadiance)
        return {{"layer", std::string(info.name)},
                {"unit", std::string(info.unit)},
                {"meaning", std::string(info.meaning)}};
    return {{"layer", std::string(info.name) + ":radiance"},
            {"unit", "W/(m² sr)"},
            {"meaning", std::string(info.meaning) + ", times albedo / pi"}};
}

void toRadiance(Image& irradiance, const Image& albedo) {
    for (size_t i = 0; i < irradiance.pixels.size(); ++i)
        irradiance.pixels[i] *= albedo.pixels[i] * std::numbers::inv_pi_v<float>;
}

}  // namespace ag::workbench
