#include "tools/bench/area_light_set.h"

#include <algorithm>
#include <numeric>

#include "engine/gpu/transfer.h"

namespace ag::bench {
namespace {

constexpr uint32_t kFrames = 64;  // for clusters to settle

template <class T>
std::vector<T> readBuffer(render::Renderer& renderer, BufferHandle handle) {
    const gpu::Buffer& source = renderer.graph().physical(handle);
    std::vector<T> items(source.sizeBytes() / sizeof(T));
    gpu::downloadBuffer(renderer.device(), source,
                        std::as_writable_bytes(std::span(items)).first(items.size() * sizeof(T)));
    return items;
}

struct Rendered {
    render::RenderFrame frame;
    ImageHandle shown{};
};

Rendered renderSettled(render::Renderer& renderer, const RenderScene& scene, glm::uvec2 size,
                       const render::RenderSettings& whole) {
    Rendered last;
    const render::RenderSettings settings = render::settingsOf(render::Layer::kBounce1, whole);
    const uint32_t rays = render::castsTexelRays(settings) ? gi::framesToRest(settings.bounce) : 0;
    for (uint32_t i = 0; i < kFrames + rays; ++i)
        renderer.render(
            scene, size, settings, {},
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                last.frame = frame;
                last.shown = render::addLayer(scope, view, frame, render::Layer::kBounce1);
                if (last.shown) scope.output(last.shown);
                const gi::BounceLight& b = frame.bounce;
                for (const BufferHandle buffer : {b.vals.vals, b.vals.shapes, b.rsm.texels, b.isms.planes,
                                                  b.clusters.candidates, b.clusters.slotOfTexel})
                    if (buffer) scope.output(buffer);
            });
    renderer.waitIdle();
    return last;
}

void toMetresAndWatts(const render::RenderUnits& units, AreaLightSet& set) {
    const float length = units.length, area = length * length, flux = units.light * area;
    for (AreaLightRead& l : set.lights) {
        l.val.position *= length, l.val.thickness *= length, l.val.before *= length;
        l.val.area *= area, l.val.flux *= flux;
        l.shape.halfU *= length, l.shape.halfV *= length;
        l.shape.inverseRectangle /= area, l.shape.inversePolygon /= area;
        for (glm::vec2& corner : l.shape.corners)
            corner *= length;
        l.shape.gradient *= glm::vec4(1 / length, 1 / length, 1, area);
    }
    for (io::RsmTexel& t : set.texels)
        t.position *= length, t.area *= area, t.weight *= flux, t.flux *= flux;
    for (glm::vec4& plane : set.planes)
        plane *= glm::vec4(glm::vec3(1 / length), length);
}

// Texels by their lights: a count, then places.
void takeTexels(std::span<const io::RsmTexel> texels, std::span<const uint32_t> slots,
                std::span<const uint32_t> candidates, AreaLightSet& set) {
    const auto lightOf = [&](size_t i) {
        const size_t tile = i / (io::kRsmTileSize * io::kRsmTileSize);
        return candidates[tile * io::kMaxCandidates + slots[i]];
    };
    const auto isLit = [&](size_t i) { return texels[i].weight > 0 && slots[i] != io::kNoCluster; };
    for (size_t i = 0; i < texels.size(); ++i)
        if (isLit(i)) ++set.lights[lightOf(i)].texelCount;
    std::vector<uint32_t> next;
    uint32_t first = 0;
    for (AreaLightRead& l : set.lights) {
        next.push_back(l.firstTexel = first);
        first += l.texelCount;
    }
    set.texels.resize(first);
    for (size_t i = 0; i < texels.size(); ++i)
        if (isLit(i)) set.texels[next[lightOf(i)]++] = texels[i];
}

void addSums(AreaLightSet& set) {
    for (AreaLightRead& l : set.lights) {
        float sum = 0;
        for (const io::RsmTexel& t : set.texelsOf(l))
            set.weightUpTo.push_back(sum += t.weight);
        for (const glm::vec2& corner : l.shape.corners)
            l.reach = std::max(l.reach, glm::length(corner));
    }
}

}  // namespace

Result<AreaLightSet> readAreaLights(render::Renderer& renderer, const RenderScene& scene, glm::uvec2 size,
                                    const render::RenderSettings& settings) {
    renderer.load(*scene.geometry);
    const Rendered last = renderSettled(renderer, scene, size, settings);
    const gi::BounceLight& b = last.frame.bounce;
    if (!last.shown || b.rsm.empty() || !b.clusters.clusters)
        return Error{"no area lights are made: the scene has no light that bounces, or settings no clusters"};
    if (!b.isms.planes || b.isms.mapping != gi::IsmMapping::kOctahedral)
        return Error{"the lights see through no octahedral maps of planes"};
    AreaLightSet set{.mapSize = b.isms.tileSize, .picture = render::readImage(renderer, last.shown)};
    const auto vals = readBuffer<io::Val>(renderer, b.vals.vals);
    const auto shapes = readBuffer<io::ValShapeVectors>(renderer, b.vals.shapes);
    for (size_t i = 0; i < b.clusters.count; ++i)
        set.lights.push_back({.val = vals[i], .shape = shapes[i]});
    set.planes = readBuffer<glm::vec4>(renderer, b.isms.planes);
    takeTexels(readBuffer<io::RsmTexel>(renderer, b.rsm.texels),
               readBuffer<uint32_t>(renderer, b.clusters.slotOfTexel),
               readBuffer<uint32_t>(renderer, b.clusters.candidates), set);
    toMetresAndWatts(renderer.units(), set);
    addSums(set);
    return set;
}

}  // namespace ag::bench
