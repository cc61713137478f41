#include "tools/reference/reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/sampling.h"
#include "tools/reference/light_sources.h"
#include "tools/reference/vpl_tracer.h"

namespace ag::reference {
namespace {

using Clock = std::chrono::steady_clock;

// Means over the pixels' paths, or over their places.
Image meansOf(const Image& sums, const std::vector<PixelCount>& counts, SampleCount PixelCount::*kind) {
    Image out = sums;
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] /= float(std::max((counts[i].*kind).samples, 1u));
    return out;
}

Image plus(Image a, const Image& b) {
    for (size_t i = 0; i < a.pixels.size(); ++i)
        a.pixels[i] += b.pixels[i];
    return a;
}

Image halfway(const Image& a, const Image& b) {
    Image out = a;
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = (a.pixels[i] + b.pixels[i]) * 0.5f;
    return out;
}

Reference assemble(const RayScene& scene, const FirstHits& hits, const LightSums& sums,
                   const PathSettings& settings) {
    Reference r;
    const glm::vec3 forward = scene.scene().camera.forward;
    const bool centers = !settings.drawsPlaces();
    const auto ofPaths = [&](const Image& image) { return meansOf(image, sums.counts, &PixelCount::paths); };
    const auto ofPlaces = [&](const Image& image) {
        return meansOf(image, sums.counts, &PixelCount::places);
    };
    for (const Image& bounce : sums.bounces)
        r.bounces.push_back(ofPaths(bounce));
    r.bounces[0] = centers ? hits.irradiance : ofPlaces(sums.directIrradiance);
    r.emissive = ofPaths(sums.emissive);
    r.sky = ofPaths(sums.sky);
    r.indirect = ofPaths(sums.indirect);
    r.irradiance = plus(plus(r.bounces[0], r.indirect), plus(r.emissive, r.sky));
    r.radiance = plus(ofPaths(sums.radiance), centers ? hits.radiance : ofPlaces(sums.directRadiance));
    for (Image* image : {&r.albedo, &r.normal, &r.depth})
        *image = Image(int(hits.size.x), int(hits.size.y));
    for (size_t i = 0; i < hits.surfaces.size(); ++i) {
        const Surface& s = hits.surfaces[i];
        if (s.distance <= 0) {
            if (centers) r.radiance.pixels[i] += scene.skyAlong(hits.directions[i]);
            continue;
        }
        if (centers) r.radiance.pixels[i] += s.emissive;
        r.albedo.pixels[i] = s.albedo;
        r.normal.pixels[i] = s.normal;
        r.depth.pixels[i] = glm::vec3(s.distance * glm::dot(hits.directions[i], forward));
    }
    return r;
}

Reference meanOf(const Reference& a, const Reference& b, std::string_view layer) {
    Reference out = a;
    for (size_t i = 0; i < a.bounces.size(); ++i)
        out.bounces[i] = halfway(a.bounces[i], b.bounces[i]);
    out.emissive = halfway(a.emissive, b.emissive);
    out.sky = halfway(a.sky, b.sky);
    out.indirect = halfway(a.indirect, b.indirect);
    out.irradiance = halfway(a.irradiance, b.irradiance);
    out.radiance = halfway(a.radiance, b.radiance);
    const Image* first = layerOf(a, layer);
    out.noise = first ? noiseOf(*first, *layerOf(b, layer)) : 0;
    return out;
}

// A pixel of an 8x8 block in an order that spreads: bits of the index go to alternating halves.
glm::uvec2 spreadOffset(uint32_t index) {
    glm::uvec2 at(0);
    for (uint32_t bit = 0; bit < 3; ++bit) {
        const uint32_t two = index >> (2 * bit) & 3;
        at.x = at.x * 2 + ((two ^ (two >> 1)) & 1);
        at.y = at.y * 2 + (two >> 1 & 1);
    }
    return at;
}

}  // namespace

ReferenceSettings withBlended(const RayScene& scene, ReferenceSettings settings) {
    settings.paths.blended = scene.hasBlended() && settings.layer == "radiance" &&
                             settings.method == Method::kPaths && !settings.paths.unshadowed;
    return settings;
}

const Image* layerOf(const Reference& r, std::string_view name) {
    if (name == "radiance") return &r.radiance;
    if (name == "irradiance") return &r.irradiance;
    if (name == "emissive") return &r.emissive;
    if (name == "sky") return &r.sky;
    if (name == "indirect" || name == "bounces") return &r.indirect;
    if (name == "albedo") return &r.albedo;
    if (name == "normal") return &r.normal;
    if (name == "depth") return &r.depth;
    if (name == "direct") return &r.bounces[0];
    if (!name.starts_with("bounce") || name.size() != 7) return nullptr;
    const size_t bounce = size_t(name[6] - '0');
    return bounce >= 1 && bounce < r.bounces.size() ? &r.bounces[bounce] : nullptr;
}

Status checkLayer(std::string_view name, uint32_t bounces) {
    Reference shape;
    shape.bounces.resize(kBouncesApart + 1);
    if (!layerOf(shape, name)) return Error{fmt::format("the reference has no layer '{}'", name)};
    if (name.starts_with("bounce") && name != "bounces" && uint32_t(name[6] - '0') > bounces)
        return Error{fmt::format("layer {} needs --bounces {} or more", name, name[6])};
    return Ok{};
}

double noiseOf(const Image& a, const Image& b) {
    double squares = 0, mean = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double d = double(a.pixels[i][c]) - double(b.pixels[i][c]);
            squares += d * d / 4;
            mean += double(a.pixels[i][c] + b.pixels[i][c]) / 2;
        }
    const double count = double(a.pixels.size()) * 3;
    return mean > 0 ? std::sqrt(squares / count) / (mean / count) : 0;
}

namespace {

constexpr uint32_t kLeastPoints = 2048, kMostPoints = 8192;  // drawn for each round of samples
constexpr double kSamplesToLearnFrom = 64;                   // a pixel of each half
constexpr double kSamplesToPlanBy = 32;                      // then whenever there are four times as many

// One of two independent estimates of the picture.
class Half {
  public:
    Half(const RayScene& scene, const FirstHits& hits, const ReferenceSettings& settings, uint32_t half)
        : scene_(scene),
          hits_(hits),
          settings_(settings),
          seed_(settings.seed * 2 + half),
          plan_(hits, settings.paths),
          sums_(hits.size, settings.paths.bounces, MeasuredLayer(settings.layer)) {}

    // Adds `count` samples to the pixels that are due, or more if the method takes more.
    void add(uint32_t count, LitPoints* lit, JobRunner& runner) {
        const uint32_t seed = io::hashUint(seed_) + round_ * RayLanes::kCount;
        if (settings_.method == Method::kPaths) {
            const auto pixels = uint32_t(hits_.surfaces.size());
            if (lit) lit->draw(std::clamp(pixels, kLeastPoints, kMostPoints), seed, runner, sums_.rays);
            addPaths(scene_, hits_, settings_.paths,
                     {.seed = seed_, .number = round_, .count = count, .plan = &plan_, .lit = lit}, runner,
                     sums_);
        } else {
            const auto emitters = traceEmitters(scene_, settings_.emitterMap, seed, sums_.rays);
            count = std::min(count, std::max(uint32_t(emitters.size()), 1u));
            addEmitters(scene_, hits_, emitters, {.seed = seed, .count = count}, runner, sums_);
        }
        round_ += 1;
    }
    void planBy(const Half& other) { plan_.adapt(other.sums_); }
    const LightSums& sums() const { return sums_; }

  private:
    const RayScene& scene_;
    const FirstHits& hits_;
    const ReferenceSettings& settings_;
    uint32_t seed_, round_ = 0;
    SamplingPlan plan_;
    LightSums sums_;
};

// Samples a pixel of each half; one is enough where there is nothing to draw.
uint32_t samplesOfHalf(const RayScene& scene, const ReferenceSettings& s) {
    const PathSettings& p = s.paths;
    const bool draws = p.bounces > 0 || !scene.sources().empty() || p.drawsPlaces();
    return draws ? std::max(s.samplesPerPixel / 2, 1u) : 0;
}

bool usesLitPoints(const ReferenceSettings& s) {
    return s.method == Method::kPaths && s.paths.litPoints && s.paths.bounces > 0 && !s.paths.unshadowed;
}

// The first chances of points know nothing of what the picture sees: some paths that count nowhere teach
// them.
void teach(const RayScene& scene, const FirstHits& hits, const ReferenceSettings& settings, JobRunner& runner,
           LitPoints& lit, uint64_t& rays) {
    constexpr uint32_t kLessons = 3, kPupils = 4096;  // pixels, about
    const auto step = uint32_t(std::sqrt(double(hits.surfaces.size()) / kPupils));
    LightSums ignored(hits.size, settings.paths.bounces);
    for (uint32_t lesson = 0; lesson < kLessons; ++lesson) {
        const uint32_t seed = io::hashUint(settings.seed ^ io::hashUint(lesson + 1));
        lit.draw(kMostPoints, seed, runner, rays);
        addPaths(
            scene, hits, settings.paths,
            {.seed = seed, .count = RayLanes::kCount, .lattice = {std::max(step, 1u), {0, 0}}, .lit = &lit},
            runner, ignored);
        lit.learn();
    }
    rays += ignored.rays;
}

}  // namespace

struct Refinement::Impl {
    const RayScene& scene;
    const ReferenceSettings settings;
    JobRunner& runner;
    FirstHits hits;
    uint64_t rays = 0;  // before the halves'
    std::optional<LitPoints> points;
    std::optional<Half> halves[2];
    double nextLesson = RayLanes::kCount, nextPlan = kSamplesToPlanBy;

    double done() const { return halves[0]->sums().meanPaths(); }
    void learn() {
        if (!points || done() < nextLesson) return;
        points->learn();
        nextLesson = 2 * done();
        if (done() >= kSamplesToLearnFrom) points->stopLearning();
    }
    // Each half by what the other found, so that they stay independent.
    void plan() {
        if (settings.method != Method::kPaths || done() < nextPlan) return;
        halves[0]->planBy(*halves[1]);
        halves[1]->planBy(*halves[0]);
        nextPlan = 4 * done();
    }
};

Refinement::Refinement(const RayScene& scene, glm::uvec2 size, const ReferenceSettings& settings,
                       JobRunner& runner)
    : impl_(new Impl{scene, withBlended(scene, settings), runner, FirstHits(size)}) {
    Impl& r = *impl_;
    traceFirstHits(scene, r.settings.paths, {}, runner, r.hits, r.rays);
    if (usesLitPoints(r.settings)) r.points.emplace(scene);
    if (r.points) teach(scene, r.hits, r.settings, runner, *r.points, r.rays);
    for (uint32_t i = 0; i < 2; ++i)
        r.halves[i].emplace(scene, r.hits, r.settings, i);
}

Refinement::~Refinement() = default;

bool Refinement::add(uint32_t count) {
    Impl& r = *impl_;
    const double before = r.done();
    for (auto& half : r.halves)
        half->add(std::min(count, RayLanes::kCount), r.points ? &*r.points : nullptr, r.runner);
    if (r.done() == before) return false;
    r.learn();
    r.plan();
    return true;
}

double Refinement::samplesOfHalf() const {
    return impl_->done();
}

Reference Refinement::half(uint32_t index) const {
    return assemble(impl_->scene, impl_->hits, impl_->halves[index]->sums(), impl_->settings.paths);
}

Reference Refinement::mean() const {
    Reference out = meanOf(half(0), half(1), impl_->settings.layer);
    const LightSums &a = impl_->halves[0]->sums(), &b = impl_->halves[1]->sums();
    out.samples = uint32_t(std::lround(a.meanPaths() + b.meanPaths()));
    out.rays = impl_->rays + a.rays + b.rays;
    return out;
}

Reference makeReference(const RayScene& scene, glm::uvec2 size, const ReferenceSettings& settings,
                        JobRunner& runner, FunctionRef<void(double)> progress) {
    Refinement picture(scene, size, settings, runner);
    const double target = samplesOfHalf(scene, withBlended(scene, settings));
    double done = 0, nextCheck = 8;
    while (done < target &&
           picture.add(uint32_t(std::min(std::ceil(target - done), double(RayLanes::kCount))))) {
        done = picture.samplesOfHalf();
        progress(std::min(done / target, 1.0));
        if (settings.maxError <= 0 || done < nextCheck) continue;
        if (picture.mean().noise < settings.maxError) break;
        nextCheck = done + std::max(done / 8, 1.0);
    }
    return picture.mean();
}

namespace {

constexpr uint32_t kStep = 8, kCells = kStep * kStep;  // pixels a side of a block, and of all

// Each pixel takes the sums of the nearest cell of its block that was reached.
void fillFromReached(glm::uvec2 size, uint32_t cells, LightSums& sums) {
    const LightSums reached = sums;
    const auto nearest = [&](glm::uvec2 pixel) {
        const glm::uvec2 block = pixel / kStep * kStep;
        glm::uvec2 best = block;
        uint32_t bestDistance = ~0u;
        for (uint32_t cell = 0; cell < cells; ++cell) {
            const glm::uvec2 at = block + spreadOffset(cell);
            const glm::ivec2 d = glm::ivec2(at) - glm::ivec2(pixel);
            const auto distance = uint32_t(d.x * d.x + d.y * d.y);
            if (at.x < size.x && at.y < size.y && distance < bestDistance) bestDistance = distance, best = at;
        }
        return size_t(best.y) * size.x + best.x;
    };
    for (uint32_t y = 0; y < size.y; ++y)
        for (uint32_t x = 0; x < size.x; ++x) {
            const size_t to = size_t(y) * size.x + x, from = nearest({x, y});
            for (size_t b = 0; b < sums.bounces.size(); ++b)
                sums.bounces[b].pixels[to] = reached.bounces[b].pixels[from];
            sums.emissive.pixels[to] = reached.emissive.pixels[from];
            sums.sky.pixels[to] = reached.sky.pixels[from];
            sums.indirect.pixels[to] = reached.indirect.pixels[from];
            sums.radiance.pixels[to] = reached.radiance.pixels[from];
            sums.counts[to] = reached.counts[from];
        }
}

}  // namespace

void traceOverTime(const RayScene& scene, glm::uvec2 size, const PathSettings& settings,
                   std::span<const double> seconds, JobRunner& runner,
                   FunctionRef<void(double, const Reference&)> seen) {
    uint64_t rays = 0;
    FirstHits hits(size);
    LightSums sums(size, settings.bounces);
    double spent = 0;
    uint32_t passes = 0;
    const auto tracePass = [&] {
        const auto start = Clock::now();
        const Lattice lattice{kStep, spreadOffset(passes % kCells)};
        if (lattice.offset.x < size.x && lattice.offset.y < size.y) {
            if (passes < kCells) traceFirstHits(scene, settings, lattice, runner, hits, rays);
            addPaths(scene, hits, settings, {.number = passes / kCells, .lattice = lattice}, runner, sums);
        }
        ++passes;
        spent += std::chrono::duration<double>(Clock::now() - start).count();
    };
    for (const double time : seconds) {
        while (passes == 0 || spent < time)
            tracePass();
        LightSums filled = sums;
        fillFromReached(size, std::min(passes, kCells), filled);
        Reference picture = assemble(scene, hits, filled, settings);
        picture.samples = (passes + kCells - 1) / kCells;
        picture.rays = rays + sums.rays;
        seen(spent, picture);
    }
}

}  // namespace ag::reference
