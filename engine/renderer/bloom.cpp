#include "engine/renderer/bloom.h"

#include <array>

namespace ag::render {
namespace {

constexpr uint32_t kLevels = 5;
constexpr float kCoarserShare = 0.6f;  // of a level: what is wider

// Names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, kLevels> kHalves = {"bloom.half0", "bloom.half1", "bloom.half2",
                                                           "bloom.half3", "bloom.half4"};
constexpr std::array<std::string_view, kLevels> kSpreads = {"bloom.picture", "bloom.spread0", "bloom.spread1",
                                                            "bloom.spread2", "bloom.spread3"};

}  // namespace

ImageHandle addBloom(GraphScope scope, ImageHandle radiance, const BloomSettings& s) {
    if (s.share <= 0) return radiance;
    std::array<ImageHandle, kLevels + 1> levels{radiance};
    for (uint32_t i = 0; i < kLevels; ++i) {
        ImageInfo info = scope.info(levels[i]);
        info.size = glm::max(info.size / 2u, 1u);
        levels[i + 1] = scope.image(kHalves[i], info);
        scope.fullscreen(kHalves[i], "bloom/halve.frag")
            .sample("light", levels[i], Sampler::kLinearClamp)
            .colorClear(levels[i + 1], glm::vec4(0));
    }
    ImageHandle coarse = levels[kLevels];
    for (uint32_t i = kLevels; i-- > 0;) {
        const ImageHandle mixed = scope.image(kSpreads[i], scope.info(levels[i]));
        scope.fullscreen(kSpreads[i], "bloom/spread.frag")
            .sample("fine", levels[i])
            .sample("coarse", coarse, Sampler::kLinearClamp)
            .push(i == 0 ? s.share : kCoarserShare)
            .colorClear(mixed, glm::vec4(0));
        coarse = mixed;
    }
    return coarse;
}

}  // namespace ag::render
