#include "tools/bench/ladder.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "common/sampling.h"
#include "tools/bench/area_light_terms.h"
#include "tools/bench/texel_rays.h"

namespace ag::bench {
namespace {

constexpr uint32_t kDraws = 4;      // of a far light's texels
constexpr uint32_t kTileSide = 32;  // pixels; the renderer's are 16 of every second pixel, or 32 of all

using StageSums = std::array<std::array<glm::vec3, 2>, kStages>;

Bounds boundsOfTile(const reference::FirstHits& hits, glm::uvec2 corner) {
    Bounds box;
    const glm::uvec2 end = glm::min(corner + kTileSide, hits.size);
    for (uint32_t y = corner.y; y < end.y; ++y)
        for (uint32_t x = corner.x; x < end.x; ++x)
            if (const reference::Surface& s = hits.surfaces[size_t(y) * hits.size.x + x]; s.distance > 0)
                box.min = glm::min(box.min, s.position), box.max = glm::max(box.max, s.position);
    return box;
}

float distanceTo(const Bounds& box, glm::vec3 place) {
    return glm::length(glm::max(glm::max(box.min - place, place - box.max), glm::vec3(0)));
}

struct NearCount {
    uint64_t texels = 0, rays = 0;
    NearCount& operator+=(NearCount more) {
        texels += more.texels, rays += more.rays;
        return *this;
    }
};

struct PixelOfLadder {
    size_t index;
    Receiver at;
};

// One clustering's lights, met by every pixel.
class LadderPass {
  public:
    LadderPass(const reference::RayScene& scene, const reference::FirstHits& hits, const AreaLightSet& set,
               const gi::BounceLightSettings& settings)
        : scene_(scene), hits_(hits), set_(set), settings_(settings) {}

    void tile(glm::uvec2 corner, LadderImages& out) {
        const Bounds box = boundsOfTile(hits_, corner);
        if (box.empty()) return;
        std::vector<bool> nearTile;
        for (const AreaLightRead& l : set_.lights)
            nearTile.push_back(distanceTo(box, l.val.position) <
                               settings_.valShading.nearReach * glm::length(l.shape.halfU));
        const glm::uvec2 end = glm::min(corner + kTileSide, hits_.size);
        for (uint32_t y = corner.y; y < end.y; ++y)
            for (uint32_t x = corner.x; x < end.x; ++x)
                pixel(size_t(y) * hits_.size.x + x, nearTile, out);
    }
    NearCount near() const { return near_; }

  private:
    void pixel(size_t index, const std::vector<bool>& nearTile, LadderImages& out) {
        const reference::Surface& at = hits_.surfaces[index];
        if (at.distance <= 0) return;
        StageSums sums{};
        TexelRays rays(scene_, set_, at);
        const PixelOfLadder pixel{index, receiverAt(at, hits_.directions[index])};
        for (size_t l = 0; l < set_.lights.size(); ++l)
            if (set_.lights[l].texelCount > 0) light(pixel, l, nearTile[l], rays, sums);
        for (size_t stage = 1; stage < kStages; ++stage)
            for (size_t draw = 0; draw < 2; ++draw)
                out.images[stage][draw].pixels[index] = sums[stage][draw];
    }

    Receiver receiverAt(const reference::Surface& at, glm::vec3 direction) const {
        const RenderCamera& camera = scene_.scene().camera;
        const float depth = at.distance * glm::dot(direction, camera.forward),
                    pixel = 2 * std::tan(camera.verticalFov / 2) / float(hits_.size.y);
        return {at.position, at.normal, depth * pixel * float(settings_.spacing)};
    }

    void light(const PixelOfLadder& pixel, size_t l, bool nearTile, TexelRays& rays, StageSums& sums) {
        const AreaLightRead& light = set_.lights[l];
        const Receiver& at = pixel.at;
        const glm::vec3 whole = nearTile ? polygonIrradiance(light, at) : diskIrradiance(light, at);
        const bool arrives = whole != glm::vec3(0);
        const uint32_t taps = settings_.valShading.taps;
        const float byMap = !arrives   ? 0
                            : nearTile ? softMapVisibility(set_, l, at.position, taps)
                                       : hardMapVisibility(set_, l, at.position);
        const float byRay = arrives && rays.sees(eyeOf(light)) ? 1.0f : 0.0f;
        const bool near = glm::length(at.position - light.val.position) < kNearReaches * light.reach;
        TexelSum texels[2];
        if (near) {
            const uint64_t before = rays.rays();
            texels[0] = texels[1] = rays.all(light);
            near_ += {light.texelCount, rays.rays() - before};
        } else {
            for (uint32_t draw = 0; draw < 2; ++draw)
                texels[draw] =
                    rays.some(light, kDraws, io::hashUint(uint32_t(pixel.index) * 1024 + l) + draw);
        }
        for (size_t draw = 0; draw < 2; ++draw) {
            const auto add = [&](Stage stage, glm::vec3 irradiance) {
                sums[size_t(stage)][draw] += irradiance;
            };
            add(Stage::kEveryPixel, whole * byMap);
            add(Stage::kCentreRay, whole * byRay);
            add(Stage::kTexelRays, whole * texels[draw].seen);
            add(Stage::kTexels, texels[draw].irradiance);
            add(Stage::kNearTexels, near ? texels[draw].irradiance : whole * byMap);
            add(Stage::kNearTexelsCentreRay, near ? texels[draw].irradiance : whole * byRay);
        }
    }

    const reference::RayScene& scene_;
    const reference::FirstHits& hits_;
    const AreaLightSet& set_;
    const gi::BounceLightSettings& settings_;
    NearCount near_;
};

}  // namespace

LadderImages climbLadder(const reference::RayScene& scene, const reference::FirstHits& hits,
                         const AreaLightSet& set, const gi::BounceLightSettings& settings,
                         JobRunner& runner) {
    LadderImages out;
    for (std::vector<Image>& both : out.images)
        both.assign(2, Image(int(hits.size.x), int(hits.size.y)));
    out.images[size_t(Stage::kRendered)].assign(2, set.picture);
    const glm::uvec2 tiles = (hits.size + kTileSide - 1u) / kTileSide;
    std::atomic<uint64_t> texels{0}, traced{0};
    runner.parallelFor(tiles.x * tiles.y, 1, [&](uint32_t begin, uint32_t end) {
        LadderPass pass(scene, hits, set, settings);
        for (uint32_t t = begin; t < end; ++t)
            pass.tile(glm::uvec2(t % tiles.x, t / tiles.x) * kTileSide, out);
        texels += pass.near().texels;
        traced += pass.near().rays;
    });
    out.nearTexels = double(texels) / double(hits.surfaces.size());
    out.nearRays = double(traced) / double(hits.surfaces.size());
    return out;
}

Result<Ladder> measureLadder(gpu::Device& device, const RenderScene& scene, const LadderOptions& options,
                             ReferenceCache& cache, JobRunner& runner, FunctionRef<void(double)> progress) {
    const auto truth = cache.getTwo(scene, options.size, options.reference, runner, progress);
    if (!truth) return truth.error();
    const reference::RayScene rays(scene);
    reference::FirstHits hits(options.size);
    uint64_t rayCount = 0;
    reference::traceFirstHits(rays, options.reference.paths, {}, runner, hits, rayCount);
    render::Renderer renderer(device);
    render::RenderSettings settings;
    Ladder ladder{.size = options.size, .noise = truth->noise};
    std::array<std::vector<ImageDifference>, kStages> errors;
    for (uint32_t seed = 0; seed < options.clusterings; ++seed) {
        settings.bounce.valClustering.seed = seed;
        const auto set = readAreaLights(renderer, scene, options.size, settings);
        if (!set) return set.error();
        const LadderImages stages = climbLadder(rays, hits, *set, settings.bounce, runner);
        ladder.nearTexels += stages.nearTexels / options.clusterings;
        ladder.nearRays += stages.nearRays / options.clusterings;
        for (size_t s = 0; s < kStages; ++s) {
            const auto error = compareImages(truth->both(), stages.of(Stage(s)));
            if (!error) return error.error();
            errors[s].push_back(*error);
        }
    }
    for (size_t s = 0; s < kStages; ++s)
        ladder.errors[s] = meanOf(errors[s]);
    return ladder;
}

}  // namespace ag::bench
