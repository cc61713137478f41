// A renderer on a scene for the tests of this folder.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "engine/gpu/transfer.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tests/support/device_environment.h"

namespace ag::gi {
using namespace render;

constexpr double kPi = std::numbers::pi;

// Of rays to texels, so that still frames soon rest. So few change nothing yet.
constexpr uint32_t kRayFrames = 2;

// For tests that do not depend on the size of the maps or on how long clusters take to settle: half of the
// time.
inline void useSmallMaps(RenderSettings& s) {
    s.bounce.rsm.resolution = 128;
    s.bounce.valClustering.settleFrames = 8;
    s.bounce.ismAtlas.tileSize = 16;
}

// A scene, its renderer and the last frame's handles. Timing is off, so that only derived barriers order the
// passes and synchronization validation proves them.
struct Bench {
    explicit Bench(SceneAsset built, glm::uvec2 pixels = {160, 96}, gpu::Device& device = test::device())
        : asset(std::move(built)), scene(staticScene(asset)), size(pixels), renderer(device) {
        setCamera(scene, cameraOf(asset, 0), size);
        renderer.load(asset.geometry);
        options.timing = TimingMode::kOff;
        useSmallMaps(settings);
        settings.bounce.texelRays.settleFrames = kRayFrames;
    }
    void frame() {
        renderer.render(
            scene, size, settings, options,
            [&](GraphScope scope, const SceneView&, const RenderFrame& declared) {
                last = declared;
                scope.output(declared.outputs.display);
                scope.output(declared.outputs.radiance);
                const BounceLight& light = declared.bounce;
                for (BufferHandle b :
                     {light.rsm.texels, light.clusters.clusters, light.clusters.seeds,
                      light.clusters.candidates, light.clusters.candidateCounts, light.clusters.slotOfTexel})
                    if (b) scope.output(b);
                if (light.bounce1.image) scope.output(light.bounce1.image);
                if (output) output(scope, declared);
            });
    }
    // Frames after which nothing runs any more: in the first ones nothing was asked for yet, and trees of
    // what moves are not placed.
    int restFrames() const { return int(framesToRest(settings.bounce)) + 4; }
    template <class T>
    std::vector<T> read(BufferHandle buffer) {
        const gpu::Buffer& source = renderer.graph().physical(buffer);
        std::vector<T> items(source.sizeBytes() / sizeof(T));
        renderer.waitIdle();
        gpu::downloadBuffer(renderer.device(), source, std::as_writable_bytes(std::span(items)));
        return items;
    }
    PassOutcome outcome(std::string_view pass) {
        const auto report = renderer.graph().report();
        const auto found = std::ranges::find(report, pass, &PassReport::name);
        return found == report.end() ? PassOutcome::kDropped : found->outcome;
    }
    int passesRun() {
        int count = 0;
        for (const PassReport& pass : renderer.graph().report())
            count += pass.outcome == PassOutcome::kRan;
        return count;
    }

    SceneAsset asset;
    RenderScene scene;
    glm::uvec2 size;
    RenderSettings settings;
    FrameGraphOptions options;
    Renderer renderer;
    RenderFrame last;
    std::function<void(GraphScope, const RenderFrame&)> output;  // what a test reads besides
};

// Gives a material a texture: `texelOf` by column and row, of 256 x 256; `uvOf` by position.
template <class Texel, class Uv>
void addTexture(SceneAsset& asset, uint32_t material, Texel&& texelOf, Uv&& uvOf) {
    constexpr uint32_t kSide = 256;
    Material& m = asset.geometry.materials[material];
    auto& layers = asset.geometry.textures[size_t(TextureClass::k256)].srgb;
    m.textureClass = TextureClass::k256;
    m.baseColorLayer = int32_t(layers.size());
    std::vector<uint8_t>& texels = layers.emplace_back();
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x) {
            const glm::u8vec4 texel = texelOf(x, y);
            texels.insert(texels.end(), {texel.x, texel.y, texel.z, texel.w});
        }
    for (size_t i = 0; i < asset.geometry.positions.size(); ++i)
        asset.geometry.attributes[i].uv = uvOf(asset.geometry.positions[i]);
}
// White, and cut out where `covers` is false.
template <class Covers, class Uv>
void cutOut(SceneAsset& asset, uint32_t material, Covers&& covers, Uv&& uvOf) {
    asset.geometry.materials[material].alphaMode = AlphaMode::kMask;
    const auto texelOf = [&](uint32_t x, uint32_t y) {
        return glm::u8vec4(255, 255, 255, covers(x, y) ? 255 : 0);
    };
    addTexture(asset, material, texelOf, uvOf);
}

inline double meanOf(const Image& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels)
        sum += double(p.x + p.y + p.z) / 3;
    return sum / double(image.pixels.size());
}

inline float luminanceOf(glm::vec3 c) {
    return glm::dot(c, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

// Of the pixels, how many differ by more than that.
inline double shareOff(const Image& image, const Image& truth, double most) {
    size_t off = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i)
        off += double(std::abs(luminanceOf(image.pixels[i] - truth.pixels[i]))) > most;
    return double(off) / double(truth.pixels.size());
}

// Light gathered at every spacing-th pixel is what all pixels would have, but in creases.
inline void expectAlike(const Image& image, const Image& truth, uint32_t spacing) {
    const double mean = meanOf(truth), share = shareOff(image, truth, 0.05 * mean);
    std::printf("every %u. pixel: %.2f %% of the pixels are off by 5 %% of the mean, mean ratio %.4f\n",
                spacing, 100 * share, meanOf(image) / mean);
    EXPECT_LT(share, spacing == 2 ? 0.02 : 0.04);
    EXPECT_NEAR(meanOf(image) / mean, 1, 0.002);
}

// A still scene's picture after `frames` frames: nothing runs any more, and no bit differs from that without
// skipping.
inline void expectRestAndNoBitSkipped(const SceneAsset& asset, glm::uvec2 size,
                                      const RenderSettings& settings, int frames) {
    std::array<Image, 2> images;
    for (const bool skip : {true, false}) {
        Bench b(asset, size);
        b.settings = settings;
        useSmallMaps(b.settings);
        b.settings.bounce.texelRays.settleFrames = kRayFrames;
        b.options.skip = skip;
        for (int i = 0; i < frames; ++i)
            b.frame();
        images[skip] = readImage(b.renderer, b.last.outputs.radiance);
        if (skip) {
            EXPECT_EQ(b.passesRun(), 0);
        }
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

}  // namespace ag::gi
