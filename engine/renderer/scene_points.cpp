#include "engine/renderer/scene_points.h"

#include <algorithm>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"

namespace ag::render {
namespace {

template <class T>
void stageChanged(ScenePoints::Stage stage, std::span<const T> items, ChangedElements& changed,
                  const gpu::Buffer& to) {
    for (const RenderScene::Range& range : changed.merged()) {
        const uint32_t end = std::min(range.end, uint32_t(items.size()));
        if (range.begin < end)
            stage(std::as_bytes(items.subspan(range.begin, end - range.begin)), to, range.begin * sizeof(T));
    }
    changed.clear();
}

}  // namespace

void ScenePoints::update(const RenderScene& scene, bool whole, float lightUnit) {
    if (version_ == scene.instancesVersion && whole_ == whole) return;
    const bool all = scene.allInstancesChanged || version_ + 1 != scene.instancesVersion;
    const RenderScene::Range every{0, uint32_t(scene.instances.size())};
    const bool known = version_ != 0 && whole_ == whole;
    if (!known || !pool_.follow(scene, all ? std::span(&every, 1) : std::span(scene.changedInstances)))
        pool_.start(scene, whole, lightUnit);
    version_ = scene.instancesVersion;
    whole_ = whole;
    const bool changed =
        !pool_.changedSamples.empty() || !pool_.changedAreas.empty() || !pool_.changedBounces.empty();
    if (changed && !pool_.isEmpty()) fitBuffers();
}

// Room for more, so that what comes one by one makes new buffers rarely.
void ScenePoints::fitBuffers() {
    const auto fit = [&](std::unique_ptr<gpu::Buffer>& buffer, gpu::BufferDesc desc, uint64_t spare,
                         ChangedElements& changed, size_t count) {
        if (buffer && buffer->sizeBytes() >= desc.sizeBytes) return;
        gpu::retire(device_, std::move(buffer));
        desc.sizeBytes += spare;
        buffer = std::make_unique<gpu::Buffer>(device_, desc);
        changed.add(0, uint32_t(count));
        ++buffers_;
    };
    const auto samples = pool_.samples();
    const auto areas = pool_.pointAreas();
    const auto bounces = pool_.bouncePoints();
    fit(samples_,
        {.name = "scene.surface_samples", .sizeBytes = samples.size_bytes(), .texelFormat = gpu::kVec4Texels},
        0, pool_.changedSamples, samples.size());
    fit(areas_,
        {.name = "scene.point_areas", .sizeBytes = areas.size_bytes(), .texelFormat = VK_FORMAT_R32_SFLOAT},
        areas.size_bytes() / 8 * 4, pool_.changedAreas, areas.size());
    fit(bouncePoints_, {.name = "scene.bounce_points", .sizeBytes = bounces.size_bytes()}, 0,
        pool_.changedBounces, bounces.size());
}

void ScenePoints::import(GraphScope scope, gi::Occluders& o) {
    if (pool_.isEmpty()) return;
    // What differs within them is in the versions of static points and of instances.
    const uint64_t layout = combineHash(pool_.layoutVersion(), buffers_);
    o.samples = scope.importBuffer("scene.surface_samples", *samples_, layout);
    o.pointAreas = scope.importBuffer("scene.point_areas", *areas_, layout);
    o.sampleCount = uint32_t(pool_.samples().size());
    o.staticSampleCount = pool_.staticCount();
    o.bouncePoints = scope.importBuffer("scene.bounce_points", *bouncePoints_,
                                        combineHash(pool_.bounceVersion(), buffers_));
    o.bouncePointCount = pool_.reflectingCount();
    o.emissivePointCount = pool_.emissiveCount();
    o.emissiveFlux = pool_.emissiveFlux();
    o.bouncePointArea = pool_.reflectingArea();
    o.emissivePointArea = pool_.emissiveArea();
}

void ScenePoints::upload(Stage stage) {
    if (pool_.isEmpty()) return;
    stageChanged(stage, pool_.samples(), pool_.changedSamples, *samples_);
    stageChanged(stage, pool_.pointAreas(), pool_.changedAreas, *areas_);
    stageChanged(stage, pool_.bouncePoints(), pool_.changedBounces, *bouncePoints_);
}

uint64_t ScenePoints::deviceBytes() const {
    uint64_t bytes = 0;
    for (const auto* buffer : {samples_.get(), areas_.get(), bouncePoints_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes;
}

}  // namespace ag::render
