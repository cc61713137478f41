#include "engine/renderer/scene_draws.h"

#include <algorithm>

namespace ag::render {
namespace {

BucketRange rangeOf(const BucketRange& all, DrawLayer layer) {
    if (layer == DrawLayer::kAll) return all;
    if (layer == DrawLayer::kStatic) return {all.firstCommand, all.staticCount, all.staticCount};
    return {all.firstCommand + all.staticCount, all.commandCount - all.staticCount, 0};
}

}  // namespace

void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              const glm::mat4& clipFromWorld, glm::uvec4 viewport, DrawFilter filter, Viewer viewer,
              DrawLayer layer) {
    drawView(pass, scene, view, std::as_bytes(std::span(&clipFromWorld, 1)), viewport, filter, viewer, layer);
}

void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              std::span<const std::byte> push, glm::uvec4 viewport, DrawFilter filter, Viewer viewer,
              DrawLayer layer) {
    const bool camera = viewer == Viewer::kCamera;
    const bool shapes = filter == DrawFilter::kShapes || filter == DrawFilter::kOpaqueOnly;
    const std::span<const DrawBucket> buckets = scene.draws->buckets();
    for (size_t b = 0; b < buckets.size(); ++b) {
        const DrawBucket& bucket = buckets[b];
        const bool wanted = filter == DrawFilter::kAll || filter == DrawFilter::kShapes ||
                            bucket.alphaMask == (filter == DrawFilter::kMaskedOnly);
        const BucketRange range = rangeOf(view.buckets[b], layer);
        if (!wanted || range.commandCount == 0) continue;
        RasterDraw draw;
        if (!shapes) {
            draw.spec[draw.specCount++] = {0, uint32_t(bucket.textureClass)};
            draw.spec[draw.specCount++] = {1, bucket.alphaMask};
            if (camera) draw.spec[draw.specCount++] = {2, bucket.normalMap};
        }
        draw.cull = bucket.doubleSided || !camera ? gpu::CullMode::kNone : gpu::CullMode::kBack;
        draw.mirrored = bucket.mirrored;
        draw.deformed = bucket.deformed;
        draw.viewport = viewport;
        std::ranges::copy(push, draw.push.begin());
        draw.pushSizeBytes = uint32_t(push.size());
        draw.commands = scene.commands;
        draw.commandsOffsetBytes = range.firstCommand * sizeof(VkDrawIndexedIndirectCommand);
        draw.commandCount = range.commandCount;
        draw.commandsVersion = view.versionOf(layer);
        pass.draw(draw);
    }
}

bool hasMasked(const SceneView& scene) {
    return std::ranges::any_of(scene.draws->buckets(), [](const DrawBucket& b) { return b.alphaMask; });
}

void bindMaterials(PassBuilder& pass, const SceneView& scene) {
    static constexpr std::array kSrgb = {"srgb256", "srgb512", "srgb1024", "srgb2048"};
    static constexpr std::array kLinear = {"linear256", "linear512", "linear1024", "linear2048"};
    pass.read("materials", scene.materials);
    for (size_t c = 0; c < 4; ++c) {
        pass.sample(kSrgb[c], scene.srgbTextures[c], Sampler::kTrilinearRepeat);
        pass.sample(kLinear[c], scene.linearTextures[c], Sampler::kTrilinearRepeat);
    }
}

}  // namespace ag::render
