#include "tools/reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <numbers>

#include "common/brdf.h"
#include "common/lights.h"
#include "common/sampling.h"

namespace ag::reference {
namespace {

constexpr float kPi = std::numbers::pi_v<float>, kInvPi = std::numbers::inv_pi_v<float>;

// Rows of the lattice in parallel: row(number of the row, y).
template <class F>
void forEachRow(glm::uvec2 size, const Lattice& lattice, JobRunner& runner, F&& row) {
    const uint32_t rows = (size.y - lattice.offset.y + lattice.step - 1) / lattice.step;
    runner.parallelFor(rows, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t r = begin; r < end; ++r)
            row(r, lattice.offset.y + r * lattice.step);
    });
}

// Calls body(lane) for each bit.
template <class F>
void forEachLane(uint32_t lanes, F&& body) {
    for (; lanes; lanes &= lanes - 1)
        body(uint32_t(std::countr_zero(lanes)));
}

// Through a place of the picture, in pixels from its top left.
glm::vec3 cameraDirection(const RenderCamera& camera, glm::uvec2 size, glm::vec2 place) {
    const glm::vec2 ndc = place / glm::vec2(size) * 2.0f - 1.0f;
    const glm::vec4 h = camera.worldFromClip * glm::vec4(ndc, 0.5f, 1);
    return glm::normalize(glm::vec3(h) / h.w - camera.position);
}

// The first surfaces along rays from a camera, passing single-sided ones from behind; bits of the lanes that
// see one.
uint32_t seeSurfaces(const RayScene& scene, const RayLanes& rays, Surface* surfaces, uint64_t& rayCount) {
    uint32_t seen = 0;
    RayLanes onward = rays;
    while (onward.active) {
        rayCount += uint64_t(std::popcount(onward.active));
        const uint32_t met = scene.intersect(onward, surfaces);
        onward.active = 0;
        forEachLane(met, [&](uint32_t i) {
            Surface& s = surfaces[i];
            if (s.hidden)
                return onward.set(i, s.position + rays.direction[i] * scene.offset(), rays.direction[i],
                                  INFINITY);
            s.distance = glm::distance(rays.origin[i], s.position);
            scene.resolve(s);
            seen |= 1u << i;
        });
    }
    return seen;
}

// 1/sr, towards the viewer.
glm::vec3 brdf(const Surface& s, glm::vec3 toViewer, glm::vec3 toLight, bool glossy) {
    if (!glossy) return s.albedo * kInvPi;
    return io::metallicRoughnessBrdf(s.normal, toViewer, toLight, s.baseColor, s.metallic, s.roughness,
                                     s.specular);
}

struct Lit {
    glm::vec3 irradiance{0}, radiance{0};
};

// Irradiance on a plane that faces the light, and the way to it.
struct Arriving {
    glm::vec3 irradiance{0}, toLight{0};
    float reach = 0;  // m, of a shadow ray
};

Arriving arrivingFrom(const PreparedLight& prepared, const Surface& at, float offset) {
    const RenderLight& light = prepared.light;
    if (light.kind == LightKind::kDirectional) return {light.intensity, -light.direction, 1e30f};
    const glm::vec3 d = light.position - at.position;
    const float distance = glm::length(d);
    Arriving a{light.intensity, d / std::max(distance, 1e-6f), distance - 2 * offset};
    a.irradiance *= io::rangeWindow(distance, light.range) / (distance * distance);
    if (light.kind == LightKind::kSpot)
        a.irradiance *=
            io::spotFalloff(-glm::dot(a.toLight, light.direction), prepared.cosInner, prepared.cosOuter);
    return a;
}

// From every punctual light, with shadow rays, for the lanes' surfaces. Looks materials up only where light
// arrives. `weight(lane, light, irradiance)`: how much of it counts.
template <class F>
void directLight(const RayScene& scene, bool glossy, uint32_t lanes, Surface* surfaces,
                 const glm::vec3* toViewer, Lit* lit, uint64_t& rayCount, F&& weight) {
    for (uint32_t l = 0; l < scene.lights().size(); ++l) {
        const PreparedLight& light = scene.lights()[l];
        RayLanes shadows;
        glm::vec3 irradiance[RayLanes::kCount];
        forEachLane(lanes, [&](uint32_t i) {
            const Arriving a = arrivingFrom(light, surfaces[i], scene.offset());
            if (a.irradiance == glm::vec3(0) || glm::dot(surfaces[i].geometricNormal, a.toLight) <= 0) return;
            irradiance[i] = a.irradiance;
            shadows.set(i, leaveSurface(scene, surfaces[i]), a.toLight, a.reach);
        });
        uint32_t reached = shadows.active;
        if (light.light.castsShadow) {
            rayCount += uint64_t(std::popcount(reached));
            reached = scene.visible(shadows);
        }
        forEachLane(reached, [&](uint32_t i) {
            Surface& s = surfaces[i];
            scene.resolve(s);
            const glm::vec3 toLight = shadows.direction[i];
            const glm::vec3 all = irradiance[i] * std::max(glm::dot(s.normal, toLight), 0.0f),
                            e = all * weight(i, l, all);
            lit[i].irradiance += e;
            lit[i].radiance += e * brdf(s, toViewer[i], toLight, glossy);
        });
    }
}

constexpr auto kAllCounts = [](uint32_t, uint32_t, glm::vec3) { return 1.0f; };

struct Sample {
    glm::vec3 direction{0};
    float density = 0;       // 1/sr
    float incident = 0;      // cosine / density
    glm::vec3 reflected{0};  // brdf x cosine / density
};

glm::vec3 inFrame(glm::vec3 normal, float sine, float cosine, float phi) {
    glm::vec3 t, b;
    io::orthonormalBasis(normal, t, b);
    return t * (sine * std::cos(phi)) + b * (sine * std::sin(phi)) + normal * cosine;
}

bool hasCoat(const Surface& s, bool glossy) {
    return glossy && (s.specular > 0 || s.metallic > 0);
}

// Of the lobes that sampleDirection draws from, per sr.
float densityOf(const Surface& s, glm::vec3 toViewer, glm::vec3 direction, bool glossy) {
    const float nl = glm::dot(s.normal, direction);
    if (nl <= 0) return 0;
    if (!hasCoat(s, glossy)) return nl * kInvPi;
    const float alpha = std::max(s.roughness * s.roughness, io::kLeastAlpha);
    const glm::vec3 h = glm::normalize(toViewer + direction);
    const float nh = glm::dot(s.normal, h), vh = std::max(glm::dot(toViewer, h), 1e-6f);
    return 0.5f * nl * kInvPi + 0.5f * io::ggxDistribution(nh, alpha) * nh / (4 * vh);
}

// A cosine lobe; for glossy surfaces half the time the GGX distribution of half vectors instead, weighted by
// the density of both together.
Sample sampleDirection(const Surface& s, glm::vec3 toViewer, bool glossy, float u, float v, float choice) {
    Sample out;
    const float phi = 2 * kPi * v;
    const bool coat = hasCoat(s, glossy);
    if (!coat || choice < 0.5f) {
        out.direction = inFrame(s.normal, std::sqrt(u), std::sqrt(std::max(1 - u, 0.0f)), phi);
        if (!coat) {
            out.density = std::sqrt(std::max(1 - u, 0.0f)) * kInvPi;
            out.incident = kPi;
            out.reflected = s.albedo;
            return out;
        }
    }
    if (choice >= 0.5f) {
        const float alpha = std::max(s.roughness * s.roughness, io::kLeastAlpha), a2 = alpha * alpha;
        const float cosine = std::sqrt((1 - u) / (1 + (a2 - 1) * u));
        const glm::vec3 h = inFrame(s.normal, std::sqrt(std::max(1 - cosine * cosine, 0.0f)), cosine, phi);
        out.direction = glm::reflect(-toViewer, h);
    }
    const float nl = glm::dot(s.normal, out.direction);
    if (nl <= 0) return {};
    out.density = densityOf(s, toViewer, out.direction, glossy);
    out.incident = nl / out.density;
    out.reflected = brdf(s, toViewer, out.direction, glossy) * out.incident;
    return out;
}

struct PixelSums {
    glm::dvec3 bounces[kBouncesApart + 1] = {};
    glm::dvec3 indirect{0}, radiance{0};
    void add(uint32_t bounce, glm::vec3 irradiance, glm::vec3 reflected) {
        if (bounce <= kBouncesApart) bounces[bounce] += glm::dvec3(irradiance);
        if (bounce > 0) indirect += glm::dvec3(irradiance);
        radiance += glm::dvec3(reflected);
    }
};

// What techniques without visibility of indirect light aim at: every surface along the ray counts, as if the
// ones before it were not there.
void traceThrough(const RayScene& scene, const Surface& first, glm::vec3 toViewer, bool glossy,
                  Random& random, glm::vec2 uv, PixelSums& sums, uint64_t& rays) {
    const Sample sample = sampleDirection(first, toViewer, glossy, uv.x, uv.y, glossy ? random.next() : 0);
    if (sample.incident <= 0 || glm::dot(sample.direction, first.geometricNormal) <= 0) return;
    Surface met;
    glm::vec3 origin = leaveSurface(scene, first);
    while (++rays, scene.intersect(origin, sample.direction, met)) {
        const glm::vec3 back = -sample.direction;
        Lit lit;
        directLight(scene, glossy, 1, &met, &back, &lit, rays, kAllCounts);
        sums.add(1, lit.radiance * sample.incident, lit.radiance * sample.reflected);
        // Far enough not to meet the same plane again when it is grazed.
        const float slant = std::abs(glm::dot(sample.direction, met.geometricNormal));
        origin = met.position + sample.direction * (scene.offset() / std::max(slant, 1e-3f));
    }
}

// Up to eight paths of one pixel, a step at a time, their rays traced together. Each vertex's outgoing
// radiance counts at the start as irradiance and, through the first surface's brdf, as radiance towards the
// camera.
class PathLanes {
  public:
    PathLanes(const RayScene& scene, const PathSettings& settings, const LitPoints* lit)
        : scene_(scene),
          settings_(settings),
          lit_(lit && !lit->empty() && !lit->points().empty() ? lit : nullptr) {}

    void begin(uint32_t lane, const Surface* first, glm::vec3 toViewer, glm::vec2 uv, Random random) {
        Lane& l = lanes_[lane];
        l.at = first, l.toViewer = toViewer, l.uv = uv, l.random = random;
        l.irradianceWeight = l.radianceWeight = glm::vec3(1);
        alive_ |= 1u << lane;
    }

    // The next paths begin at surfaces like this one; null: anywhere.
    void beginTile(const Surface* surface, float spread, uint32_t tile, uint32_t seed) {
        if (!lit_) return;
        tile_.choose(*lit_, surface, spread, surface ? lit_->usualSum(tile) : 0, seed);
        all_.choose(*lit_, nullptr, 0, 0, 0);
    }
    double tileSum() const { return tile_.sum(); }

    // To their ends; what they bring is added.
    void trace(PixelSums& sums, std::vector<LitPointWorth>& worths) {
        const bool looksForSources = settings_.emission || settings_.environment != glm::vec3(0);
        const uint32_t last = settings_.bounces + (looksForSources ? 1 : 0);
        for (uint32_t bounce = 1; bounce <= last && alive_; ++bounce) {
            if (lit_ && bounce <= settings_.bounces) connect(bounce, sums, worths);
            Surface* met = met_[bounce % 2];
            step(bounce, met, sums);
            if (bounce <= settings_.bounces) receive(bounce, met, sums);
            forEachLane(bounce < last ? alive_ : 0, [&](uint32_t i) {
                scene_.resolve(met[i]);
                lanes_[i].at = &met[i];
            });
        }
        alive_ = 0;
    }
    uint64_t rays() const { return rays_; }

  private:
    static constexpr uint32_t kCandidates = 4;  // of lit points for each connection

    struct Lane {
        const Surface* at = nullptr;
        glm::vec3 toViewer{0}, direction{0};
        glm::vec3 irradianceWeight{1}, radianceWeight{1};
        glm::vec2 uv{0};
        float density = 0;  // of the direction, 1/sr
        Random random{0};
    };

    // What a lit point sends to a surface if nothing stands between.
    struct Bridge {
        uint32_t point = 0;
        glm::vec3 direction{0};
        float distance = 0;
        float geometry = 0;  // cosines / distance², of what this way of finding the light counts
    };

    // Of candidates on the lit surface, 1/m². The picture's surfaces have their tile's choice of points.
    float densityOfConnections(uint32_t bounce, const LitPoint& p) const {
        return kCandidates * p.density * (bounce == 1 ? tile_.usuallyOftener(p) : 1);
    }

    // 0 where one of both looks away.
    Bridge bridgeTo(uint32_t bounce, const Lane& l, glm::vec3 from, uint32_t point) const {
        const LitPoint& p = lit_->points()[point];
        Bridge b{.point = point};
        const glm::vec3 d = p.position - from;
        b.distance = glm::length(d);
        b.direction = d / std::max(b.distance, 1e-20f);
        const float nl = glm::dot(l.at->normal, b.direction), ny = -glm::dot(p.normal, b.direction);
        if (!(nl > 0) || !(ny > 0) || glm::dot(l.at->geometricNormal, b.direction) <= 0) return b;
        // Balance heuristic: both densities on the lit surface, 1/m².
        const float perArea = ny / (b.distance * b.distance), own = densityOfConnections(bounce, p);
        const float other = densityOf(*l.at, l.toViewer, b.direction, settings_.glossy);  // 1/sr
        b.geometry = nl * own / (own / perArea + other);
        return b;
    }

    // A lit point each, where it sees the path's last surface: of some candidates one, by what they would
    // send (resampled importance sampling; Talbot, Cline and Egbert 2005).
    void connect(uint32_t bounce, PixelSums& sums, std::vector<LitPointWorth>& worths) {
        RayLanes rays;
        Bridge chosen[RayLanes::kCount];
        float weight[RayLanes::kCount];
        const auto points = lit_->points();
        forEachLane(alive_, [&](uint32_t i) {
            Lane& l = lanes_[i];
            const glm::vec3 from = leaveSurface(scene_, *l.at);
            float total = 0, target = 0;
            for (uint32_t c = 0; c < kCandidates; ++c) {
                const float which = l.random.next(), place = l.random.next(), turn = l.random.next();
                const uint32_t point = (bounce == 1 ? tile_ : all_).candidate(which, place);
                if (points[point].brightness <= 0) continue;
                const Bridge b = bridgeTo(bounce, l, from, point);
                const float sends = b.geometry * points[point].brightness;
                const float worth = sends / (bounce == 1 ? tile_.oftener(point) : 1);
                total += worth;
                if (turn * total < worth) chosen[i] = b, target = sends;
            }
            if (!(target > 0)) return;
            weight[i] = total / (target * kCandidates);
            rays.set(i, from, chosen[i].direction, chosen[i].distance - 2 * scene_.offset());
        });
        rays_ += uint64_t(std::popcount(rays.active));
        forEachLane(scene_.visible(rays), [&](uint32_t i) {
            const Lane& l = lanes_[i];
            const Bridge& b = chosen[i];
            const LitPoint& p = points[b.point];
            const glm::vec3 sent = lit_->arriving(b.point) *
                                   brdf(lit_->surface(b.point), -b.direction, p.toLight, settings_.glossy);
            const glm::vec3 arrives = sent * (b.geometry * weight[i]);
            const glm::vec3 reflected = arrives * brdf(*l.at, l.toViewer, b.direction, settings_.glossy);
            const glm::vec3 irradiance = l.irradianceWeight * (bounce == 1 ? arrives : reflected);
            sums.add(bounce, irradiance, l.radianceWeight * reflected);
            if (lit_->learns()) worths.push_back({p.texel, irradiance.x + irradiance.y + irradiance.z});
        });
    }

    // On to the next surfaces, with what emission and environment bring on the way.
    void step(uint32_t bounce, Surface* met, PixelSums& sums) {
        RayLanes rays;
        forEachLane(alive_, [&](uint32_t i) {
            Lane& l = lanes_[i];
            if (bounce > 1) l.uv = {l.random.next(), l.random.next()};
            const float choice = settings_.glossy ? l.random.next() : 0;
            const Sample sample =
                sampleDirection(*l.at, l.toViewer, settings_.glossy, l.uv.x, l.uv.y, choice);
            if (sample.incident <= 0 || glm::dot(sample.direction, l.at->geometricNormal) <= 0) return;
            l.irradianceWeight *= bounce == 1 ? glm::vec3(sample.incident) : sample.reflected;
            l.radianceWeight *= sample.reflected;
            l.direction = sample.direction;
            l.density = sample.density;
            rays.set(i, leaveSurface(scene_, *l.at), sample.direction, INFINITY);
        });
        rays_ += uint64_t(std::popcount(rays.active));
        alive_ = scene_.intersect(rays, met);
        forEachLane(rays.active & ~alive_, [&](uint32_t i) {
            const Lane& l = lanes_[i];
            sums.add(bounce - 1, l.irradianceWeight * settings_.environment,
                     l.radianceWeight * settings_.environment);
        });
        forEachLane(alive_, [&](uint32_t i) {
            Lane& l = lanes_[i];
            l.toViewer = -l.direction;
            if (!settings_.emission) return;
            scene_.resolve(met[i]);
            sums.add(bounce - 1, l.irradianceWeight * met[i].emissive, l.radianceWeight * met[i].emissive);
        });
    }

    // Direct light of the surfaces just met.
    void receive(uint32_t bounce, Surface* met, PixelSums& sums) {
        glm::vec3 toViewer[RayLanes::kCount];
        Lit lit[RayLanes::kCount];
        forEachLane(alive_, [&](uint32_t i) { toViewer[i] = lanes_[i].toViewer; });
        const auto weight = [&](uint32_t i, uint32_t light, glm::vec3 irradiance) {
            if (!lit_) return 1.0f;
            const Surface& s = met[i];
            const float perSteradian = s.distance * s.distance / glm::dot(s.geometricNormal, toViewer[i]);
            const float other =
                densityOfConnections(bounce, lit_->pointOn(light, s, irradiance)) * perSteradian;
            return lanes_[i].density / (lanes_[i].density + other);
        };
        directLight(scene_, settings_.glossy, alive_, met, toViewer, lit, rays_, weight);
        forEachLane(alive_, [&](uint32_t i) {
            const Lane& l = lanes_[i];
            if (lit[i].radiance != glm::vec3(0))
                sums.add(bounce, l.irradianceWeight * lit[i].radiance, l.radianceWeight * lit[i].radiance);
        });
    }

    const RayScene& scene_;
    const PathSettings& settings_;
    const LitPoints* lit_;
    TilePoints tile_, all_;
    Lane lanes_[RayLanes::kCount];
    Surface met_[2][RayLanes::kCount];  // by odd and even bounces
    uint32_t alive_ = 0;
    uint64_t rays_ = 0;
};

// Point number `index` of an additive recurrence in the plane (the generalised golden ratio), shifted: evenly
// spread however many are taken.
glm::vec2 evenPoint(uint32_t index, glm::uvec2 shift) {
    const glm::uvec2 fixed = index * glm::uvec2(0xc13fa9a9u, 0x91e10da5u) + shift;
    return glm::vec2(fixed >> 8u) / 16777216.0f;
}

// The same in four dimensions: the place in the pixel and the first direction must be independent.
struct EvenPair {
    glm::vec2 place, direction;
};
EvenPair evenPair(uint32_t index, glm::uvec2 shift) {
    // Powers of the inverse root of x^5 = x + 1, times 2^32 (Roberts 2018).
    const glm::uvec4 fixed = index * glm::uvec4(0xdb4f0b91u, 0xbbe05633u, 0xa0f2ec75u, 0x89e18285u) +
                             glm::uvec4(shift, io::hashUint(shift.y), io::hashUint(shift.x + 1));
    const glm::vec4 unit = glm::vec4(fixed >> 8u) / 16777216.0f;
    return {{unit.x, unit.y}, {unit.z, unit.w}};
}

constexpr uint32_t kTileSide = 16;  // pixels

// Those of the lattice in the tile.
template <class F>
void forEachPixelOfTile(glm::uvec2 tile, glm::uvec2 size, const Lattice& lattice, F&& pixel) {
    const glm::uvec2 begin = tile * kTileSide, end = glm::min(begin + kTileSide, size);
    const auto firstFrom = [&](uint32_t from, uint32_t offset) {
        return from + (offset + lattice.step - from % lattice.step) % lattice.step;
    };
    for (uint32_t y = firstFrom(begin.y, lattice.offset.y); y < end.y; y += lattice.step)
        for (uint32_t x = firstFrom(begin.x, lattice.offset.x); x < end.x; x += lattice.step)
            pixel(x, y);
}

// What one thread needs to add paths to pixels.
class PixelTracer {
  public:
    PixelTracer(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
                const PathRange& range, const LitPoints* lit)
        : scene_(scene), hits_(hits), settings_(settings), range_(range), paths_(scene, settings, lit) {}

    void add(uint32_t x, uint32_t y, LightSums& sums) {
        const size_t i = size_t(y) * hits_.size.x + x;
        const bool centers = settings_.filter == PixelFilter::kCenter;
        if (centers && hits_.surfaces[i].distance <= 0) return;
        key_ = io::hashUint(uint32_t(i) ^ io::hashUint(range_.seed));
        PixelSums pixel;
        for (uint32_t s = range_.first; s < range_.first + range_.count; s += RayLanes::kCount) {
            const uint32_t count = std::min(RayLanes::kCount, range_.first + range_.count - s);
            if (settings_.unshadowed)
                throughSurfaces(i, s, count, pixel);
            else if (centers)
                fromCenter(i, s, count, pixel);
            else
                fromFilter({x, y}, s, count, pixel);
        }
        for (size_t b = 0; b < sums.bounces.size(); ++b)
            sums.bounces[b].pixels[i] += glm::vec3(pixel.bounces[b]);
        sums.indirect.pixels[i] += glm::vec3(pixel.indirect);
        sums.radiance.pixels[i] += glm::vec3(pixel.radiance);
    }
    // Before the pixels of a tile, from (x, y) on.
    void beginTile(glm::uvec2 corner, uint32_t tile) {
        const glm::uvec2 middle = glm::min(corner + kTileSide / 2, hits_.size - 1u);
        const Surface& s = hits_.surfaces[size_t(middle.y) * hits_.size.x + middle.x];
        const float angle = 2 * std::tan(scene_.scene().camera.verticalFov / 2) / float(hits_.size.y);
        const uint32_t seed = io::hashUint(tile ^ io::hashUint(range_.seed + range_.first));
        paths_.beginTile(s.distance > 0 ? &s : nullptr, s.distance * angle * kTileSide / 2, tile, seed);
    }
    double tileSum() const { return paths_.tileSum(); }
    uint64_t rays() const { return rays_ + paths_.rays(); }
    std::vector<LitPointWorth>& worths() { return worths_; }

  private:
    glm::uvec2 shift() const { return {key_, io::hashUint(key_)}; }
    Random randomOf(uint32_t sample) const {
        return {uint64_t(key_) << 32 | io::hashUint(sample * 2 + 1 + io::hashUint(range_.seed))};
    }

    void throughSurfaces(size_t i, uint32_t first, uint32_t count, PixelSums& pixel) {
        for (uint32_t s = first; s < first + count; ++s) {
            Random random = randomOf(s);
            traceThrough(scene_, hits_.surfaces[i], -hits_.directions[i], settings_.glossy, random,
                         evenPoint(s, shift()), pixel, rays_);
        }
    }

    void fromCenter(size_t i, uint32_t first, uint32_t count, PixelSums& pixel) {
        for (uint32_t s = 0; s < count; ++s)
            paths_.begin(s, &hits_.surfaces[i], -hits_.directions[i], evenPoint(first + s, shift()),
                         randomOf(first + s));
        paths_.trace(pixel, worths_);
    }

    // Rays through every `stride`-th place of the pixel; bits of those that see a surface.
    uint32_t lookThrough(glm::uvec2 at, uint32_t first, uint32_t stride, uint32_t count, glm::vec3* toViewer,
                         Lit* lit) {
        const RenderCamera& camera = scene_.scene().camera;
        RayLanes rays;
        for (uint32_t s = 0; s < count; ++s) {
            const glm::vec2 offset =
                filterOffset(settings_.filter, evenPair(first + s * stride, shift()).place);
            const glm::vec3 direction = cameraDirection(camera, hits_.size, glm::vec2(at) + 0.5f + offset);
            rays.set(s, camera.position, direction, INFINITY);
            toViewer[s] = -direction;
        }
        const uint32_t seen = seeSurfaces(scene_, rays, seen_, rays_);
        directLight(scene_, settings_.glossy, seen, seen_, toViewer, lit, rays_, kAllCounts);
        return seen;
    }

    // Direct light at `count` places, each counted `share` times.
    uint32_t addDirect(glm::uvec2 at, uint32_t first, uint32_t stride, uint32_t count, float share,
                       glm::vec3* toViewer, PixelSums& pixel) {
        Lit lit[RayLanes::kCount];
        const uint32_t seen = lookThrough(at, first, stride, count, toViewer, lit);
        for (uint32_t s = 0; s < count; ++s) {
            const bool there = seen >> s & 1;
            pixel.add(0, lit[s].irradiance * share,
                      (there ? lit[s].radiance + seen_[s].emissive : settings_.environment) * share);
        }
        return seen;
    }

    // Where direct light changes within a pixel, a shadow's edge or a sunlit thing's, more places are looked
    // at than paths begin: such light can be hundreds of times what bounces.
    void fromFilter(glm::uvec2 at, uint32_t first, uint32_t count, PixelSums& pixel) {
        const uint32_t places = isEdge(at) ? kPlacesAtEdges : 1;
        glm::vec3 toViewer[RayLanes::kCount];
        uint32_t seen = 0;
        for (uint32_t p = places; p-- > 0;)  // the paths' own places last
            seen = addDirect(at, first * places + p, places, count, 1 / float(places), toViewer, pixel);
        forEachLane(seen, [&](uint32_t s) {
            paths_.begin(s, &seen_[s], toViewer[s], evenPair(first + s, shift()).direction,
                         randomOf(first + s));
        });
        paths_.trace(pixel, worths_);
    }

    // By what the centres of the pixel and its neighbours have: the same for every sample.
    bool isEdge(glm::uvec2 at) const {
        float least = INFINITY, most = 0;
        for (uint32_t y = at.y - (at.y > 0); y <= std::min(at.y + 1, hits_.size.y - 1); ++y)
            for (uint32_t x = at.x - (at.x > 0); x <= std::min(at.x + 1, hits_.size.x - 1); ++x) {
                const glm::vec3 r = hits_.radiance.at(int(x), int(y));
                least = std::min(least, r.x + r.y + r.z), most = std::max(most, r.x + r.y + r.z);
            }
        return most - least > kLeastEdge * most;
    }

    static constexpr uint32_t kPlacesAtEdges = 8;
    static constexpr float kLeastEdge = 0.2f;

    const RayScene& scene_;
    const FirstHits& hits_;
    const PathSettings& settings_;
    const PathRange& range_;
    PathLanes paths_;
    Surface seen_[RayLanes::kCount];
    std::vector<LitPointWorth> worths_;
    uint64_t rays_ = 0;
    uint32_t key_ = 0;
};

}  // namespace

float Random::next() {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    const auto word = uint32_t((state ^ (state >> 22)) >> (22 + (state >> 61)));
    return float(word >> 8) / 16777216.0f;
}

LightSums::LightSums(glm::uvec2 size, uint32_t bounceCount)
    : bounces(std::min(bounceCount, kBouncesApart) + 1, Image(int(size.x), int(size.y))),
      indirect(int(size.x), int(size.y)),
      radiance(int(size.x), int(size.y)) {}

glm::vec3 leaveSurface(const RayScene& scene, const Surface& s) {
    return s.position + s.geometricNormal * scene.offset();
}

FirstHits::FirstHits(glm::uvec2 pixels)
    : size(pixels),
      surfaces(size_t(pixels.x) * pixels.y),
      directions(surfaces.size()),
      irradiance(int(pixels.x), int(pixels.y)),
      radiance(irradiance) {}

void traceFirstHits(const RayScene& scene, const PathSettings& settings, const Lattice& lattice,
                    JobRunner& runner, FirstHits& hits, uint64_t& rays) {
    const glm::uvec2 size = hits.size;
    const RenderCamera& camera = scene.scene().camera;
    std::atomic<uint64_t> total{0};
    forEachRow(size, lattice, runner, [&](uint32_t, uint32_t y) {
        uint64_t count = 0;
        for (uint32_t x = lattice.offset.x; x < size.x; x += lattice.step) {
            const size_t i = size_t(y) * size.x + x;
            hits.directions[i] = cameraDirection(camera, size, glm::vec2(x, y) + 0.5f);
            RayLanes ray;
            ray.set(0, camera.position, hits.directions[i], INFINITY);
            Surface& surface = hits.surfaces[i];
            if (!seeSurfaces(scene, ray, &surface, count)) {
                surface.distance = 0;
                continue;
            }
            const glm::vec3 toViewer = -hits.directions[i];
            Lit lit;
            directLight(scene, settings.glossy, 1, &surface, &toViewer, &lit, count, kAllCounts);
            hits.irradiance.pixels[i] = lit.irradiance;
            hits.radiance.pixels[i] = lit.radiance;
        }
        total += count;
    });
    rays += total;
}

void addPaths(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
              const PathRange& range, JobRunner& runner, LightSums& sums, LitPoints* lit) {
    const glm::uvec2 tiles = (hits.size + kTileSide - 1u) / kTileSide;
    std::atomic<uint64_t> rays{0};
    std::vector<std::vector<LitPointWorth>> worths(tiles.y);
    std::vector<double> tileSums(size_t(tiles.x) * tiles.y, 0);
    if (lit) lit->setTileCount(uint32_t(tileSums.size()));
    runner.parallelFor(tiles.y, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t row = begin; row < end; ++row) {
            PixelTracer tracer(scene, hits, settings, range, lit);
            for (uint32_t column = 0; column < tiles.x; ++column) {
                const uint32_t tile = row * tiles.x + column;
                tracer.beginTile(glm::uvec2(column, row) * kTileSide, tile);
                forEachPixelOfTile({column, row}, hits.size, range.lattice,
                                   [&](uint32_t x, uint32_t y) { tracer.add(x, y, sums); });
                tileSums[tile] = tracer.tileSum();
            }
            worths[row] = std::move(tracer.worths());
            rays += tracer.rays();
        }
    });
    for (uint32_t tile = 0; lit && tile < tileSums.size(); ++tile)
        if (tileSums[tile] > 0) lit->addTileSum(tile, tileSums[tile]);
    if (lit && lit->learns())
        for (const auto& row : worths)
            lit->note(row);
    sums.rays += rays;
    if (range.lattice.step == 1) sums.samples += range.count;
}

}  // namespace ag::reference
