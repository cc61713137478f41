#include "gi/bounce_points.h"

#include <algorithm>
#include <bit>
#include <numbers>

namespace ag::gi {
namespace {

uint32_t sharpBitsOf(const io::SurfaceSample& s) {
    return std::bit_cast<uint32_t>(s.curvatureLocal);  // in its place: see SkinnedSample
}

bool isThere(const io::SurfaceSample& s) {
    return s.instance != io::kNoInstance;
}

// Of [begin, end) the one nearest to the middle that is there; the middle if none is.
size_t nearestThere(std::span<const io::SurfaceSample> samples, size_t middle, size_t begin, size_t end) {
    for (size_t off = 0; off < end - begin; ++off) {
        if (middle + off < end && isThere(samples[middle + off])) return middle + off;
        if (middle >= begin + off && isThere(samples[middle - off])) return middle - off;
    }
    return middle;
}

}  // namespace

void faceSide(io::BouncePoint& point, bool back) {
    point.area *= 2;
    if (back) point.normalLocal = -point.normalLocal;
}

std::vector<io::BouncePoint> chooseBouncePoints(std::span<const SampledInstance> instances,
                                                const SurfaceSamples& samples, AlbedoAt albedoAt,
                                                FunctionRef<bool(uint32_t instance)> doubleSided,
                                                uint32_t count) {
    std::vector<io::BouncePoint> points;
    const double share = double(samples.samples.size()) / count;
    for (uint32_t i = 0; i < count; ++i) {
        const size_t begin = size_t(i * share), end = size_t((i + 1) * share);
        double area = 0;
        for (size_t k = begin; k < end; ++k)
            if (isThere(samples.samples[k])) area += double(samples.pointAreas[samples.samples[k].instance]);
        const size_t at = nearestThere(samples.samples, size_t((i + 0.5) * share), begin, end);
        if (!isThere(samples.samples[at])) {
            points.push_back({.area = 0});
            continue;
        }
        const io::SurfaceSample& s = samples.samples[at];
        const bool deformed = bool(instances[s.instance].deformed);
        const bool cutOut =
            deformed ? (sharpBitsOf(s) & io::kSharpCutOut) != 0 : s.edgesLocal[0].distance < 0;
        points.push_back({.positionLocal = s.positionLocal,
                          .instance = s.instance,
                          .normalLocal = s.normalLocal,
                          .area = cutOut ? 0 : float(area),
                          .albedo = albedoAt(s.instance, samples.uvs[at]) * samples.tints[at],
                          .edgesLocal = {s.edgesLocal[0], s.edgesLocal[1]}});
        if (deformed) points.back().edgesLocal[0].inward.x = s.curvatureLocal;
        if (!deformed && doubleSided(s.instance)) faceSide(points.back(), i % 2 == 1);
    }
    return points;
}

float meanArea(std::span<const io::BouncePoint> points) {
    double sum = 0;
    for (const io::BouncePoint& p : points)
        sum += double(p.area);
    return float(sum / double(std::max<size_t>(points.size(), 1)));
}

float emittedFlux(std::span<const io::BouncePoint> shining) {
    double sum = 0;
    for (const io::BouncePoint& p : shining)
        sum += double(p.albedo.x + p.albedo.y + p.albedo.z) / 3 * double(p.area);
    return float(sum * std::numbers::pi);
}

}  // namespace ag::gi
