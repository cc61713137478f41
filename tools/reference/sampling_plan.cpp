#include "tools/reference/sampling_plan.h"

#include <algorithm>
#include <cmath>

#include "common/sampling.h"
#include "tools/reference/path_tracer.h"

namespace ag::reference {
namespace {

constexpr uint32_t kPlacesAtEdges = 8, kMostPlaces = 8;
constexpr float kLeastEdge = 0.2f;
constexpr int kSmoothing = 2;  // pixels each way: few samples tell little about one
// Of the mean; what varied little so far may still hold what is rare.
constexpr float kLeastShare = 0.25f, kMostShare = 32;
constexpr float kMostRounds = 128;

float sum(glm::vec3 v) {
    return v.x + v.y + v.z;
}

// By what the centres of the pixel and its neighbours have.
bool isEdge(const Image& direct, int x, int y) {
    float least = INFINITY, most = 0;
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, direct.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, direct.width - 1); ++u) {
            const float r = sum(direct.at(u, v));
            least = std::min(least, r), most = std::max(most, r);
        }
    return most - least > kLeastEdge * most;
}

// Means over squares of 2 kSmoothing + 1 pixels a side.
std::vector<float> smoothed(const std::vector<float>& values, glm::ivec2 size) {
    std::vector<float> rows(values.size()), out(values.size());
    const auto mean = [](const std::vector<float>& from, int at, int end, auto&& index) {
        const int begin = std::max(at - kSmoothing, 0), last = std::min(at + kSmoothing, end - 1);
        float total = 0;
        for (int i = begin; i <= last; ++i)
            total += from[index(i)];
        return total / float(last - begin + 1);
    };
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            rows[size_t(y * size.x + x)] =
                mean(values, x, size.x, [&](int i) { return size_t(y * size.x + i); });
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
            out[size_t(y * size.x + x)] =
                mean(rows, y, size.y, [&](int i) { return size_t(i * size.x + x); });
    return out;
}

// Of one sample, from the packets' means: samples of a packet are spread evenly and vary less together.
float variance(glm::vec3 total, const SampleCount& c) {
    if (c.packets < 2) return 0;
    const float packets = float(c.packets), each = float(c.samples) / packets;
    const glm::vec3 mean = total / float(c.samples);
    return each * std::max(c.packetSquares / packets - glm::dot(mean, mean), 0.0f) * packets / (packets - 1);
}

PixelSums pathSumsAt(const LightSums& sums, size_t i) {
    PixelSums pixel;
    for (size_t b = 0; b < sums.bounces.size(); ++b)
        pixel.bounces[b] = sums.bounces[b].pixels[i];
    pixel.emissive = sums.emissive.pixels[i];
    pixel.sky = sums.sky.pixels[i];
    pixel.indirect = sums.indirect.pixels[i];
    pixel.radiance = sums.radiance.pixels[i];
    return pixel;
}

struct Variances {
    std::vector<float> path, place;  // of one each, by pixel
};

Variances variancesOf(const LightSums& sums, glm::ivec2 size) {
    Variances v;
    v.path.resize(sums.counts.size()), v.place.resize(sums.counts.size());
    for (size_t i = 0; i < sums.counts.size(); ++i) {
        const PixelCount& c = sums.counts[i];
        v.path[i] = variance(sums.measured.ofPaths(pathSumsAt(sums, i)), c.paths);
        const Lit direct{sums.directIrradiance.pixels[i], sums.directRadiance.pixels[i]};
        v.place[i] = variance(sums.measured.ofDirect(direct), c.places);
    }
    return {smoothed(v.path, size), smoothed(v.place, size)};
}

}  // namespace

SamplingPlan::SamplingPlan(const FirstHits& hits, const PathSettings& settings)
    : size_(hits.size),
      pathCost_(2 * float(std::min(settings.bounces, 3u)) + 0.1f),
      pixels_(hits.surfaces.size()) {
    for (uint32_t y = 0; y < size_.y; ++y)
        for (uint32_t x = 0; x < size_.x; ++x)
            if (isEdge(hits.radiance, int(x), int(y)))
                pixels_[size_t(y) * size_.x + x].places = kPlacesAtEdges;
}

void SamplingPlan::adapt(const LightSums& other) {
    const Variances variances = variancesOf(other, size_);
    std::vector<float> asked(pixels_.size());
    double total = 0;
    for (size_t i = 0; i < pixels_.size(); ++i) {
        const float path = variances.path[i], place = variances.place[i];
        const float places =
            place > 0 ? std::clamp(std::round(std::sqrt(place * pathCost_ / std::max(path, 1e-30f))), 1.0f,
                                   float(kMostPlaces))
                      : 1;
        pixels_[i].places = uint8_t(places);
        asked[i] = std::sqrt((path + place / places) / (pathCost_ + places));
        total += double(asked[i]);
    }
    if (!(total > 0)) return;
    const float mean = float(total / double(asked.size()));
    float most = 0;
    for (float& a : asked)
        a = std::clamp(a / mean, kLeastShare, kMostShare), most = std::max(most, a);
    for (size_t i = 0; i < pixels_.size(); ++i)
        pixels_[i].every = uint8_t(std::exp2(std::round(std::log2(std::min(most / asked[i], kMostRounds)))));
}

bool SamplingPlan::isDue(size_t pixel, uint32_t round, uint32_t tile) const {
    return (round + io::hashUint(tile)) % pixels_[pixel].every == 0;
}

}  // namespace ag::reference
