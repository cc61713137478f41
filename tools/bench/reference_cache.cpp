#include "tools/bench/reference_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "engine/core/driver_cache.h"
#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/core/number.h"

namespace ag::bench {
namespace {

namespace fs = std::filesystem;

// Raised when the tracer's results change.
constexpr uint64_t kTracerVersion = 6;
constexpr int32_t kNormalMapsVersion = 2;  // of scenes with normal maps alone

template <class T>
uint64_t hashArray(const std::vector<T>& items, uint64_t seed) {
    return hashBytes(std::as_bytes(std::span(items)), seed);
}

uint64_t hashMaterial(const Material& m, uint64_t h) {
    for (const float v :
         {m.baseColor.x, m.baseColor.y, m.baseColor.z, m.baseColor.w, m.emissive.x, m.emissive.y,
          m.emissive.z, m.metallic, m.roughness, m.specular, m.normalScale, m.alphaCutoff})
        h = hashValue(v, h);
    for (const int32_t v : {int32_t(m.alphaMode), int32_t(m.doubleSided), int32_t(m.textureClass),
                            m.baseColorLayer, m.emissiveLayer, m.normalLayer, m.metallicRoughnessLayer})
        h = hashValue(v, h);
    if (m.normalLayer >= 0) h = hashValue(kNormalMapsVersion, h);
    h = hashValue(m.uvTransform, h);
    return m.alphaMode == AlphaMode::kBlend ? hashValue(m.transmission + float(m.coversWholly), h) : h;
}

uint64_t hashLight(const RenderLight& l, uint64_t h) {
    h = hashValue(uint32_t(l.kind), h);
    h = hashValue(uint32_t(l.castsShadow), h);
    for (const glm::vec3 v : {l.position, l.direction, l.intensity})
        h = hashValue(v, h);
    for (const float v : {l.range, l.innerConeAngle, l.outerConeAngle})
        h = hashValue(v, h);
    return h;
}

}  // namespace

uint64_t hashSettings(const reference::ReferenceSettings& s, uint64_t h) {
    h = hashText(s.layer, h);
    for (const uint64_t v : {uint64_t(s.paths.bounces), uint64_t(s.paths.glossy), uint64_t(s.paths.emission),
                             uint64_t(s.paths.unshadowed), uint64_t(s.paths.filter),
                             uint64_t(s.paths.litPoints), uint64_t(s.method), uint64_t(s.samplesPerPixel),
                             uint64_t(s.seed), uint64_t(s.emitterMap), kTracerVersion})
        h = combineHash(h, v);
    return hashValue(s.maxError, h);
}

uint64_t sceneHash(const RenderScene& scene) {
    const GeometryArrays& g = *scene.geometry;
    uint64_t h = hashArray(g.positions, 0);
    h = hashArray(g.attributes, h);
    h = hashArray(g.indices, h);
    for (const Primitive& p : g.primitives)
        for (const uint32_t v : {p.firstIndex, p.indexCount, uint32_t(p.vertexOffset), p.material})
            h = combineHash(h, v);
    for (const Material& m : g.materials)
        h = hashMaterial(m, h);
    for (const TextureLayers& layers : g.textures)
        for (const auto* list : {&layers.srgb, &layers.linear})
            for (const std::vector<uint8_t>& texels : *list)
                h = hashArray(texels, h);
    for (const RenderInstance& i : scene.instances)
        h = hashValue(i.worldFromLocal, combineHash(h, i.primitive));
    for (const RenderSkinnedMesh& f : scene.skinnedMeshes)
        h = combineHash(combineHash(h, f.firstVertex), f.poseVersion);
    for (const RenderLight& l : scene.lights)
        h = hashLight(l, h);
    if (scene.sky)
        h = hashArray(scene.sky->radiance.pixels, combineHash(h, uint32_t(scene.sky->radiance.width)));
    return hashValue(scene.camera.clipFromWorld, h);
}

Result<Image> ReferenceCache::get(const RenderScene& scene, glm::uvec2 size,
                                  const reference::ReferenceSettings& settings, JobRunner& runner,
                                  FunctionRef<void(double)> progress) {
    const uint64_t key = hashValue(size, hashSettings(settings, sceneHash(scene)));
    const std::string path = (fs::path(folder_) / fmt::format("{:016x}.exr", key)).string();
    if (fs::exists(path)) return loadImage(path);
    std::error_code error;
    fs::create_directories(folder_, error);
    const reference::RayScene rays(scene);
    const auto made = reference::makeReference(rays, size, settings, runner, progress);
    Image image = *reference::layerOf(made, settings.layer);
    image.attributes = {{"layer", settings.layer},
                        {"samples", std::to_string(made.samples)},
                        {"noise", fmt::format("{:.6g}", made.noise)}};
    if (const Status saved = saveImage(image, path); !saved)
        spdlog::warn("the reference is not kept: {}", saved.error().message);
    return image;
}

Result<TwoReferences> ReferenceCache::getTwo(const RenderScene& scene, glm::uvec2 size,
                                             reference::ReferenceSettings settings, JobRunner& runner,
                                             FunctionRef<void(double)> progress) {
    settings.samplesPerPixel = std::max(settings.samplesPerPixel / 2, 2u);
    settings.maxError *= std::numbers::sqrt2;
    auto a = get(scene, size, settings, runner, [&](double share) { progress(share / 2); });
    if (!a) return a.error();
    ++settings.seed;
    auto b = get(scene, size, settings, runner, [&](double share) { progress((1 + share) / 2); });
    if (!b) return b.error();
    const double noise = reference::noiseOf(*a, *b);
    return TwoReferences{std::move(*a), std::move(*b), noise};
}

std::string defaultCacheFolder() {
    const fs::path own = cacheFolder();
    return ((own.empty() ? fs::temp_directory_path() / "afterglow" : own) / "references").string();
}

}  // namespace ag::bench
