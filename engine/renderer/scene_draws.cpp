#include "engine/renderer/scene_draws.h"

#include <algorithm>

namespace ag::render {
namespace {

BucketRange rangeOf(const BucketRange& all, DrawLayer layer) {
    if (layer == DrawLayer::kAll) return all;
    if (layer == DrawLayer::kStatic) return {all.firstCommand, all.staticCount, all.staticCount};
    return {all.firstCommand + all.staticCount, all.commandCount - all.staticCount, 0};
}

bool admits(DrawFilter filter, const DrawBucket& bucket) {
    return filter == DrawFilter::kAll || filter == DrawFilter::kShapes ||
           bucket.alphaMask == (filter == DrawFilter::kMaskedOnly);
}

// With the bucket's state and variant, without its commands.
RasterDraw drawOf(const DrawBucket& bucket, const DrawOptions& options) {
    const bool camera = options.viewer == Viewer::kCamera;
    const bool shapes = options.filter == DrawFilter::kShapes || options.filter == DrawFilter::kOpaqueOnly;
    RasterDraw draw;
    if (!shapes) {
        draw.spec[draw.specCount++] = gpu::specConstant("kTextureClass", uint32_t(bucket.textureClass));
        draw.spec[draw.specCount++] = gpu::specConstant("kAlphaMask", bool(bucket.alphaMask));
        if (options.filter == DrawFilter::kAll)
            draw.spec[draw.specCount++] = gpu::specConstant("kVertexColors", bool(bucket.vertexColors));
        if (camera) draw.spec[draw.specCount++] = gpu::specConstant("kNormalMaps", bool(bucket.normalMap));
    }
    draw.cull = bucket.doubleSided || !camera ? gpu::CullMode::kNone : gpu::CullMode::kBack;
    draw.mirrored = bucket.mirrored;
    draw.deformed = bucket.deformed;
    draw.viewport = options.viewport;
    return draw;
}

}  // namespace

void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              const glm::mat4& clipFromWorld, const DrawOptions& options) {
    drawView(pass, scene, view, std::as_bytes(std::span(&clipFromWorld, 1)), options);
}

void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              std::span<const std::byte> push, const DrawOptions& options) {
    const std::span<const DrawBucket> buckets = scene.draws->buckets();
    for (size_t b = 0; b < buckets.size(); ++b) {
        const BucketRange range = rangeOf(view.buckets[b], options.layer);
        if (!admits(options.filter, buckets[b]) || range.commandCount == 0) continue;
        RasterDraw draw = drawOf(buckets[b], options);
        std::ranges::copy(push, draw.push.begin());
        draw.pushSizeBytes = uint32_t(push.size());
        draw.commands = scene.commands;
        draw.commandsOffsetBytes =
            (view.commandRange.first + range.firstCommand) * sizeof(VkDrawIndexedIndirectCommand);
        draw.commandCount = range.commandCount;
        draw.commandsVersion = view.versionOf(options.layer);
        pass.draw(draw);
    }
}

bool hasMasked(const SceneView& scene) {
    return std::ranges::any_of(scene.draws->buckets(), [](const DrawBucket& b) { return b.alphaMask; });
}

void bindBaseColors(PassBuilder& pass, const SceneView& scene, Sampler sampler) {
    static constexpr std::array kSrgb = {"srgb256", "srgb512", "srgb1024", "srgb2048"};
    for (size_t c = 0; c < kSrgb.size(); ++c)
        pass.sample(kSrgb[c], scene.srgbTextures[c], sampler);
}

void bindMaterials(PassBuilder& pass, const SceneView& scene, Sampler sampler) {
    static constexpr std::array kLinear = {"linear256", "linear512", "linear1024", "linear2048"};
    pass.read("materials", scene.materials);
    bindBaseColors(pass, scene, sampler);
    for (size_t c = 0; c < kLinear.size(); ++c)
        pass.sample(kLinear[c], scene.linearTextures[c], sampler);
}

}  // namespace ag::render
