#include "tools/bench/texel_rays.h"

#include <algorithm>
#include <bit>

#include "common/form_factors.h"
#include "common/sampling.h"
#include "tools/reference/direct_light.h"

namespace ag::bench {
namespace {

float meanOf(glm::vec3 v) {
    return (v.x + v.y + v.z) / 3;
}

}  // namespace

TexelRays::TexelRays(const reference::RayScene& scene, const AreaLightSet& set, const reference::Surface& at)
    : scene_(scene), set_(set), at_(at), from_(reference::leaveSurface(scene, at)) {}

// Those whose ray would start into the surface do not arrive.
void TexelRays::add(const io::RsmTexel& texel, glm::vec3 flux, TexelSum& sum) {
    const float factor =
        io::diskVectorFactor(at_.position, at_.normal, texel.position, texel.normal, texel.area * io::kInvPi);
    if (!(factor > 0)) return;
    const glm::vec3 irradiance = flux / texel.area * factor, d = texel.position - from_;
    const float distance = glm::length(d);
    whole_ += meanOf(irradiance);
    if (!(distance > 0) || glm::dot(d, at_.geometricNormal) <= 0) return;
    waiting_[count_] = {irradiance, meanOf(irradiance)};
    lanes_.set(count_++, from_, d / distance, std::max(distance - 2 * scene_.offset(), 0.0f));
    if (count_ == reference::RayLanes::kCount) trace(sum);
}

void TexelRays::trace(TexelSum& sum) {
    const uint32_t seen = count_ > 0 ? scene_.visible(lanes_) : 0;
    rays_ += count_;
    for (uint32_t lane = 0; lane < count_; ++lane)
        if (seen >> lane & 1) sum.irradiance += waiting_[lane].irradiance, sum.seen += waiting_[lane].weight;
    count_ = lanes_.active = 0;
}

TexelSum TexelRays::finish(TexelSum sum) {
    trace(sum);
    sum.seen = whole_ > 0 ? sum.seen / whole_ : 0;
    whole_ = 0;
    return sum;
}

TexelSum TexelRays::all(const AreaLightRead& light) {
    TexelSum sum;
    for (const io::RsmTexel& texel : set_.texelsOf(light))
        add(texel, texel.flux, sum);
    return finish(sum);
}

TexelSum TexelRays::some(const AreaLightRead& light, uint32_t count, uint32_t seed) {
    TexelSum sum;
    if (light.texelCount == 0) return sum;
    const auto upTo = std::span(set_.weightUpTo).subspan(light.firstTexel, light.texelCount);
    for (uint32_t i = 0; i < count; ++i) {
        const float u = (float(i) + io::hashToUnit(seed * count + i)) / float(count) * upTo.back();
        const size_t chosen =
            std::min(size_t(std::ranges::lower_bound(upTo, u) - upTo.begin()), upTo.size() - 1);
        const io::RsmTexel& texel = set_.texelsOf(light)[chosen];
        add(texel, texel.flux * (upTo.back() / (float(count) * texel.weight)), sum);
    }
    return finish(sum);
}

bool TexelRays::sees(glm::vec3 place) {
    const glm::vec3 d = place - from_;
    const float distance = glm::length(d);
    if (!(distance > 0) || glm::dot(d, at_.geometricNormal) <= 0) return false;
    ++rays_;
    return scene_.visible(from_, d / distance, std::max(distance - 2 * scene_.offset(), 0.0f));
}

}  // namespace ag::bench
