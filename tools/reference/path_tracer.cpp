#include "tools/reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "common/sampling.h"
#include "tools/reference/path_lanes.h"

namespace ag::reference {
namespace {

// Rows of the lattice in parallel: row(number of the row, y).
template <class F>
void forEachRow(glm::uvec2 size, const Lattice& lattice, JobRunner& runner, F&& row) {
    const uint32_t rows = (size.y - lattice.offset.y + lattice.step - 1) / lattice.step;
    runner.parallelFor(rows, 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t r = begin; r < end; ++r)
            row(r, lattice.offset.y + r * lattice.step);
    });
}

// Through a place of the picture, in pixels from its top left.
glm::vec3 cameraDirection(const RenderCamera& camera, glm::uvec2 size, glm::vec2 place) {
    const glm::vec2 ndc = place / glm::vec2(size) * 2.0f - 1.0f;
    const glm::vec4 h = camera.worldFromClip * glm::vec4(ndc, 0.5f, 1);
    return glm::normalize(glm::vec3(h) / h.w - camera.position);
}

// Where a ray of the picture begins: at the near plane, before which nothing is drawn.
glm::vec3 nearPoint(const RenderCamera& camera, glm::vec3 direction) {
    return camera.position + direction * (camera.near / glm::dot(direction, camera.forward));
}

// Of the pixel whose centre's ray met the surface (ray differentials; Igehy 1999).
Footprint footprintOf(const RenderCamera& camera, glm::uvec2 size, glm::vec2 center, const Surface& s) {
    const glm::vec3 direction = cameraDirection(camera, size, center);
    const float slant = glm::dot(direction, s.geometricNormal);
    const auto toward = [&](glm::vec2 neighbour) {
        const glm::vec3 turned = cameraDirection(camera, size, center + neighbour) - direction;
        return s.distance * (turned - direction * (glm::dot(turned, s.geometricNormal) / slant));
    };
    return slant == 0 ? Footprint{} : Footprint{toward({1, 0}), toward({0, 1})};
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
            s.distance = glm::distance(scene.scene().camera.position, s.position);
            seen |= 1u << i;
        });
    }
    return seen;
}

// Point number `index` of an additive recurrence in the plane (the generalised golden ratio), shifted: evenly
// spread however many are taken.
glm::vec2 evenPoint(uint32_t index, glm::uvec2 shift) {
    const glm::uvec2 fixed = index * glm::uvec2(0xc13fa9a9u, 0x91e10da5u) + shift;
    return glm::vec2(fixed >> 8u) / 16777216.0f;
}

// The same in space.
glm::vec3 evenPlace(uint32_t index, glm::uvec2 shift) {
    const glm::uvec3 fixed =
        index * glm::uvec3(0xd1b54a33u, 0xabc98389u, 0x8cb92ba7u) +
        glm::uvec3(io::hashUint(shift.x + 2), io::hashUint(shift.y + 2), shift.x ^ shift.y);
    return glm::vec3(fixed >> 8u) / 16777216.0f;
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
                const PathRound& round)
        : scene_(scene),
          hits_(hits),
          settings_(settings),
          round_(round),
          paths_(scene, settings, round.lit) {}

    // Before the pixels of a tile, from `corner` on. The middles of its quarters stand for it.
    void beginTile(glm::uvec2 corner, uint32_t tile) {
        if (!round_.lit) return;
        TileSurfaces surfaces;
        float distances = 0;
        for (const glm::uvec2 quarter :
             {glm::uvec2(1, 1), glm::uvec2(3, 1), glm::uvec2(1, 3), glm::uvec2(3, 3)}) {
            const glm::uvec2 at = corner + quarter * kTileSide / 4u;
            if (at.x >= hits_.size.x || at.y >= hits_.size.y) continue;
            const Surface& s = hits_.surfaces[size_t(at.y) * hits_.size.x + at.x];
            if (s.distance > 0) surfaces.at[surfaces.count++] = &s, distances += s.distance;
        }
        if (surfaces.count > 0) {
            const float angle = 2 * std::tan(scene_.scene().camera.verticalFov / 2) / float(hits_.size.y);
            surfaces.spread = distances / float(surfaces.count) * angle * kTileSide / 4;
        }
        const uint32_t seed = io::hashUint(tile ^ io::hashUint(round_.seed + round_.number));
        paths_.beginTile(surfaces, round_.lit->usualSum(tile), round_.lit->sights(tile), seed);
    }
    double tileSum() const { return paths_.tileSum(); }

    void add(uint32_t x, uint32_t y, LightSums& sums) {
        const size_t i = size_t(y) * hits_.size.x + x;
        const bool centers = !settings_.drawsPlaces();
        if (centers && hits_.surfaces[i].distance <= 0) return;
        key_ = io::hashUint(uint32_t(i) ^ io::hashUint(round_.seed));
        for (uint32_t left = round_.count; left > 0;) {
            const uint32_t count = std::min(RayLanes::kCount, left);
            PixelSums packet;
            if (settings_.unshadowed)
                throughSurfaces(i, sums.counts[i].paths.samples, count, packet);
            else if (centers)
                fromCenter(i, sums.counts[i].paths.samples, count, packet);
            else
                fromFilter({x, y}, count, sums, packet);
            addPacket(packet, i, count, sums);
            left -= count;
        }
    }
    uint64_t rays() const { return rays_ + paths_.rays(); }
    std::vector<LitPointWorth>& worths() { return worths_; }

  private:
    glm::uvec2 shift() const { return {key_, io::hashUint(key_)}; }
    Random randomOf(uint32_t path) const {
        return {uint64_t(key_) << 32 | io::hashUint(path * 2 + 1 + io::hashUint(round_.seed))};
    }

    // Of path number `path` at the pixel's centre.
    PathStart startAt(size_t i, uint32_t path) const {
        return {.surface = &hits_.surfaces[i],
                .toViewer = -hits_.directions[i],
                .uv = evenPoint(path, shift()),
                .source = evenPlace(path, shift()),
                .random = randomOf(path)};
    }

    static void addPacket(const PixelSums& packet, size_t i, uint32_t paths, LightSums& sums) {
        for (size_t b = 0; b < sums.bounces.size(); ++b)
            sums.bounces[b].pixels[i] += glm::vec3(packet.bounces[b]);
        sums.emissive.pixels[i] += glm::vec3(packet.emissive);
        sums.sky.pixels[i] += glm::vec3(packet.sky);
        sums.indirect.pixels[i] += glm::vec3(packet.indirect);
        sums.radiance.pixels[i] += glm::vec3(packet.radiance);
        sums.counts[i].paths.add(paths, sums.measured.ofPaths(packet) / float(paths));
    }

    // The camera's ray goes on through surfaces that blend with what is behind them, or ends at one, by
    // chance. What it sees then, and by how much that counts. False: the sky, or nothing.
    bool passBlended(const RayLanes& rays, uint32_t lane, bool opaque, Random random, glm::vec3& counts) {
        glm::vec3 from = rays.origin[lane];
        const glm::vec3 along = rays.direction[lane];
        const float end = opaque ? glm::distance(from, seen_[lane].position) : INFINITY;
        for (Surface s; ++rays_, scene_.intersectBlended(from, along, s);) {
            from = s.position + along * scene_.offset();
            if (glm::distance(rays.origin[lane], s.position) >= end) break;
            if (s.hidden) continue;
            const Veil veil = scene_.veilOf(s, along, settings_.glossy);
            const float passing = mean(veil.transmitted), passes = passing / (passing + veil.coverage);
            if (random.next() < passes) {
                counts *= veil.transmitted / passes;
                continue;
            }
            counts *= veil.coverage / (1 - passes);
            seen_[lane] = s;
            seen_[lane].distance = glm::distance(scene_.scene().camera.position, s.position);
            return true;
        }
        return opaque;
    }

    void throughSurfaces(size_t i, uint32_t first, uint32_t count, PixelSums& packet) {
        for (uint32_t s = first; s < first + count; ++s)
            traceThrough(scene_, startAt(i, s), settings_.glossy, packet, rays_);
    }

    void fromCenter(size_t i, uint32_t first, uint32_t count, PixelSums& packet) {
        for (uint32_t s = 0; s < count; ++s)
            paths_.begin(s, startAt(i, first + s));
        paths_.trace(packet, worths_);
    }

    // Direct light at `count` places of a pixel, numbers `first` on of a sequence; bits of those that see a
    // surface. `seenAs`: by how much what is seen counts.
    uint32_t addDirect(glm::uvec2 at, uint32_t first, uint32_t count, glm::uvec2 shift, glm::vec3* toViewer,
                       glm::vec3* seenAs, LightSums& sums) {
        const RenderCamera& camera = scene_.scene().camera;
        RayLanes rays;
        for (uint32_t s = 0; s < count; ++s) {
            const glm::vec2 offset = filterOffset(settings_.filter, evenPair(first + s, shift).place);
            const glm::vec3 direction = cameraDirection(camera, hits_.size, glm::vec2(at) + 0.5f + offset);
            rays.set(s, nearPoint(camera, direction), direction, INFINITY);
            toViewer[s] = -direction;
        }
        uint32_t seen = seeSurfaces(scene_, rays, seen_, rays_);
        forEachLane(seen, [&](uint32_t s) { scene_.resolve(seen_[s]); });
        std::fill_n(seenAs, count, glm::vec3(1));
        for (uint32_t s = 0; s < count && settings_.blended; ++s) {
            const Random random{uint64_t(shift.x) << 32 | io::hashUint(shift.y ^ io::hashUint(first + s))};
            const bool opaque = seen >> s & 1;
            seen |= uint32_t(passBlended(rays, s, opaque, random, seenAs[s])) << s;
        }
        Lit lit[RayLanes::kCount];
        directLight(scene_, {.active = seen, .surfaces = seen_, .toViewer = toViewer, .lit = lit},
                    settings_.glossy, rays_, kAllCounts);
        const size_t i = size_t(at.y) * hits_.size.x + at.x;
        glm::vec3 measured(0);
        for (uint32_t s = 0; s < count; ++s) {
            lit[s].radiance += seen >> s & 1 ? seen_[s].emissive : scene_.skyAlong(-toViewer[s]);
            lit[s].radiance *= seenAs[s];
            sums.directIrradiance.pixels[i] += lit[s].irradiance;
            sums.directRadiance.pixels[i] += lit[s].radiance;
            measured += sums.measured.ofDirect(lit[s]);
        }
        sums.counts[i].places.add(count, measured / float(count));
        return seen;
    }

    // Where direct light changes within a pixel, a shadow's edge or a sunlit thing's, more places are looked
    // at than paths begin: such light can be hundreds of times what bounces.
    void fromFilter(glm::uvec2 at, uint32_t count, LightSums& sums, PixelSums& packet) {
        const size_t i = size_t(at.y) * hits_.size.x + at.x;
        const uint32_t first = sums.counts[i].paths.samples, further = sums.counts[i].places.samples - first;
        const uint32_t places = round_.plan ? round_.plan->of(i).places : 1;
        const glm::uvec2 otherShift = shift() * 5u + 1u;
        glm::vec3 toViewer[RayLanes::kCount], seenAs[RayLanes::kCount];
        for (uint32_t p = 0; p + 1 < places; ++p)
            addDirect(at, further + p * count, count, otherShift, toViewer, seenAs, sums);
        const uint32_t seen = addDirect(at, first, count, shift(), toViewer, seenAs, sums);
        forEachLane(seen, [&](uint32_t s) {
            paths_.begin(s, {.surface = &seen_[s],
                             .toViewer = toViewer[s],
                             .seenAs = seenAs[s],
                             .uv = evenPair(first + s, shift()).direction,
                             .source = evenPlace(first + s, shift()),
                             .random = randomOf(first + s)});
        });
        paths_.trace(packet, worths_);
    }

    const RayScene& scene_;
    const FirstHits& hits_;
    const PathSettings& settings_;
    const PathRound& round_;
    PathLanes paths_;
    Surface seen_[RayLanes::kCount];
    std::vector<LitPointWorth> worths_;
    uint64_t rays_ = 0;
    uint32_t key_ = 0;
};

}  // namespace

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
            ray.set(0, nearPoint(camera, hits.directions[i]), hits.directions[i], INFINITY);
            Surface& surface = hits.surfaces[i];
            if (!seeSurfaces(scene, ray, &surface, count)) {
                surface.distance = 0;
                continue;
            }
            scene.resolve(surface, footprintOf(camera, size, glm::vec2(x, y) + 0.5f, surface));
            const glm::vec3 toViewer = -hits.directions[i];
            Lit lit;
            directLight(scene, {.active = 1, .surfaces = &surface, .toViewer = &toViewer, .lit = &lit},
                        settings.glossy, count, kAllCounts);
            hits.irradiance.pixels[i] = lit.irradiance;
            hits.radiance.pixels[i] = lit.radiance;
        }
        total += count;
    });
    rays += total;
}

void addPaths(const RayScene& scene, const FirstHits& hits, const PathSettings& settings,
              const PathRound& round, JobRunner& runner, LightSums& sums) {
    constexpr uint32_t kTilesAtOnce = 4;
    LitPoints* const lit = round.lit;
    const glm::uvec2 tiles = (hits.size + kTileSide - 1u) / kTileSide;
    const uint32_t count = tiles.x * tiles.y;
    std::atomic<uint64_t> rays{0};
    std::vector<std::vector<LitPointWorth>> worths(count);
    std::vector<double> tileSums(count, 0);
    if (lit) lit->setTileCount(count);
    const auto traceTile = [&](uint32_t tile, PixelTracer& tracer) {
        const glm::uvec2 at(tile % tiles.x, tile / tiles.x);
        bool begun = false;
        forEachPixelOfTile(at, hits.size, round.lattice, [&](uint32_t x, uint32_t y) {
            const size_t pixel = size_t(y) * hits.size.x + x;
            if (round.plan && !round.plan->isDue(pixel, round.number, tile)) return;
            if (!begun) tracer.beginTile(at * kTileSide, tile);
            begun = true;
            tracer.add(x, y, sums);
        });
        tileSums[tile] = begun ? tracer.tileSum() : 0;
        worths[tile] = std::exchange(tracer.worths(), {});
    };
    runner.parallelFor(count, kTilesAtOnce, [&](uint32_t begin, uint32_t end) {
        PixelTracer tracer(scene, hits, settings, round);
        for (uint32_t tile = begin; tile < end; ++tile)
            traceTile(tile, tracer);
        rays += tracer.rays();
    });
    for (uint32_t tile = 0; lit && tile < count; ++tile) {
        if (tileSums[tile] > 0) lit->addTileSum(tile, tileSums[tile]);
        if (lit->learns()) lit->note(worths[tile]);
    }
    sums.rays += rays;
}

}  // namespace ag::reference
