#include "tools/stress/stage.h"
#include "engine/gpu/transfer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace ag::stress {
namespace {

bool finite(glm::vec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool finite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](glm::vec3 p) { return finite(p); });
}

template <class T>
bool finiteFloats(const std::vector<T>& rows, size_t floats) {
    for (const T& row : rows) {
        const auto* numbers = reinterpret_cast<const float*>(&row);
        for (size_t i = 0; i < floats; ++i)
            if (!std::isfinite(numbers[i])) return false;
    }
    return true;
}

}  // namespace

Stage::Stage(gpu::Device& device, SceneAsset built, glm::uvec2 pixels, uint32_t mapResolution)
    : asset(std::move(built)), scene(staticScene(asset, likelyView(asset))), size(pixels), renderer(device) {
    setCamera(scene, cameraOf(asset, 0), size);
    renderer.load(asset.geometry);
    settings.bounce.rsm.resolution = mapResolution;
}

void Stage::frame() {
    renderer.render(
        scene, size, settings, options,
        [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& declared) {
            last_ = declared;
            radiance_ = render::addLayer(scope, view, declared, render::Layer::kRadiance);
            scope.output(radiance_);
            scope.output(declared.outputs.display);
            if (declared.bounce.rsm.empty() || settings.technique == render::Technique::kNone) return;
            scope.output(declared.bounce.rsm.texels);
            if (!declared.bounce.clusters.clusters) return;
            for (const BufferHandle b :
                 {declared.bounce.clusters.clusters, declared.bounce.clusters.candidates,
                  declared.bounce.clusters.candidateCounts, declared.bounce.clusters.slotOfTexel})
                scope.output(b);
            scope.output(declared.bounce.vals.vals);
        });
}

void Stage::frames(uint32_t count) {
    for (uint32_t i = 0; i < count; ++i)
        frame();
}

Image Stage::radiance() {
    return render::readImage(renderer, radiance_);
}

template <class T>
std::vector<T> Stage::read(BufferHandle buffer) {
    const gpu::Buffer& source = renderer.graph().physical(buffer);
    std::vector<T> items(source.sizeBytes() / sizeof(T));
    renderer.waitIdle();
    gpu::downloadBuffer(renderer.device(), source, std::as_writable_bytes(std::span(items)));
    return items;
}

std::optional<std::string> Stage::clusterFault() {
    const auto texels = read<io::RsmTexel>(last_.bounce.rsm.texels);
    if (!finiteFloats(texels, sizeof(io::RsmTexel) / 4)) return "a texel of an RSM is no number";
    if (!last_.bounce.clusters.clusters) return std::nullopt;
    const auto clusters = read<io::Cluster>(last_.bounce.clusters.clusters);
    const auto slots = read<uint32_t>(last_.bounce.clusters.slotOfTexel);
    const auto candidates = read<uint32_t>(last_.bounce.clusters.candidates);
    const auto counts = read<uint32_t>(last_.bounce.clusters.candidateCounts);
    glm::dvec3 ofTexels(0), ofClusters(0);
    std::vector<uint32_t> members(clusters.size(), 0);
    for (size_t i = 0; i < texels.size(); ++i) {
        const bool lit = texels[i].weight > 0;
        if (lit != (slots[i] != io::kNoCluster)) return fmt::format("texel {} and its cluster disagree", i);
        if (!lit) continue;
        const size_t tile = i / (io::kRsmTileSize * io::kRsmTileSize);
        if (slots[i] >= counts[tile]) return fmt::format("texel {} is in no candidate of its tile", i);
        const uint32_t cluster = candidates[tile * io::kMaxCandidates + slots[i]];
        if (cluster >= clusters.size()) return fmt::format("texel {} is in no cluster", i);
        ++members[cluster];
        ofTexels += glm::dvec3(texels[i].flux);
    }
    for (size_t c = 0; c < clusters.size(); ++c) {
        const io::Cluster& k = clusters[c];
        const bool good = finite(k.position) && finite(k.normal) && finite(k.flux) && finite(k.chroma) &&
                          finite(k.covarianceDiagonal) && finite(k.covarianceMixed) && std::isfinite(k.area);
        if (!good) return fmt::format("cluster {} holds what is no number", c);
        if (float(members[c]) != k.texelCount) return fmt::format("cluster {} miscounts its texels", c);
        ofClusters += glm::dvec3(k.flux);
    }
    for (int channel = 0; channel < 3; ++channel)
        if (std::abs(ofClusters[channel] - ofTexels[channel]) > 1e-4 * ofTexels[channel])
            return fmt::format("clusters hold {:.6g} of {:.6g} W", ofClusters[channel], ofTexels[channel]);
    if (!finiteFloats(read<io::Val>(last_.bounce.vals.vals), sizeof(io::Val) / 4))
        return "an area light holds what is no number";
    return std::nullopt;
}

std::optional<std::string> Stage::fault() {
    if (!finite(radiance())) return "a pixel is no number";
    if (last_.bounce.rsm.empty() || settings.technique == render::Technique::kNone) return std::nullopt;
    return clusterFault();
}

uint32_t Stage::litTexels() {
    uint32_t lit = 0;
    for (const io::RsmTexel& texel : read<io::RsmTexel>(last_.bounce.rsm.texels))
        lit += texel.weight > 0;
    return lit;
}

}  // namespace ag::stress
