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
    for (uint32_t i = 0; i < uint32_t(render::Layer::kCount); ++i)
        names.push_back(render::layerInfo(render::Layer(i)).name);
    return names;
}

namespace {

std::string tableLine(const render::LayerInfo& info) {
    return fmt::format("  {:<14} {:<23} {}\n", info.name, info.unit, info.meaning);
}

constexpr const char* kProducts =
    "  NAME:radiance  W/(m² sr)               an irradiance times albedo / pi: what Lambert surfaces send on";

}  // namespace

std::string layerTable() {
    std::string out = "Layers:\n";
    for (uint32_t i = 0; i < uint32_t(render::Layer::kCount); ++i)
        out += tableLine(render::layerInfo(render::Layer(i)));
    return out + kProducts;
}

render::LayerInfo referenceLayerInfo(std::string_view name) {
    if (name.starts_with("bounce") && name != "bounces")
        return {name, "W/m²", "irradiance of exactly that many bounces, before albedo", true};
    const auto layer = render::layerFromName(name);
    return layer ? render::layerInfo(*layer) : render::LayerInfo{name, "", ""};
}

std::string referenceLayerTable() {
    std::string out = "Layers:\n";
    for (const std::string_view name :
         {"radiance", "direct", "emissive", "sky", "indirect", "irradiance", "albedo", "normal", "depth"})
        out += tableLine(referenceLayerInfo(name));
    render::LayerInfo bounces = referenceLayerInfo("bounce1");
    bounces.name = "bounce1 to 8";
    return out + tableLine(bounces) + kProducts;
}

std::map<std::string, std::string> layerAttributes(const render::LayerInfo& info, bool asRadiance) {
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
