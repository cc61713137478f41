#include "tools/reference/light_sums.h"

#include <algorithm>

namespace ag::reference {

MeasuredLayer::MeasuredLayer(std::string_view name) {
    if (name == "irradiance" || name == "direct") kind_ = Kind::kIrradiance;
    if (name == "emissive") kind_ = Kind::kEmissive;
    if (name == "sky") kind_ = Kind::kSky;
    if (name.starts_with("bounce")) kind_ = Kind::kBounce, bounce_ = uint32_t(name.back() - '0');
    if (name == "indirect" || name == "bounces") kind_ = Kind::kIndirect;
}

glm::vec3 MeasuredLayer::ofPaths(const PixelSums& sums) const {
    switch (kind_) {
        case Kind::kRadiance:
            return sums.radiance;
        case Kind::kIrradiance:
            return sums.emissive + sums.sky + sums.indirect;
        case Kind::kEmissive:
            return sums.emissive;
        case Kind::kSky:
            return sums.sky;
        case Kind::kIndirect:
            return sums.indirect;
        case Kind::kBounce:
            return sums.bounces[std::min(bounce_, kBouncesApart)];
    }
    return glm::vec3(0);
}

glm::vec3 MeasuredLayer::ofDirect(const Lit& lit) const {
    if (kind_ == Kind::kRadiance) return lit.radiance;
    return kind_ == Kind::kIrradiance ? lit.irradiance : glm::vec3(0);
}

LightSums::LightSums(glm::uvec2 size, uint32_t bounceCount, MeasuredLayer layer)
    : bounces(std::min(bounceCount, kBouncesApart) + 1, Image(int(size.x), int(size.y))),
      emissive(int(size.x), int(size.y)),
      sky(emissive),
      indirect(emissive),
      radiance(indirect),
      directIrradiance(indirect),
      directRadiance(indirect),
      counts(indirect.pixels.size()),
      measured(layer) {}

double LightSums::meanPaths() const {
    uint64_t paths = 0, pixels = 0;
    for (const PixelCount& c : counts)
        paths += c.paths.samples, pixels += c.paths.samples > 0;
    return pixels ? double(paths) / double(pixels) : 0;
}

}  // namespace ag::reference
