#include "engine/renderer/scene_surfaces.h"

#include <algorithm>
#include <glm/gtc/color_space.hpp>

#include "common/brdf.h"
#include "engine/renderer/mesh_points.h"
#include "engine/scene/deform.h"
#include "engine/scene/static_scene.h"

namespace ag::render {
namespace {

// In [0, 1)², whatever a file says.
glm::vec2 textureUv(const Material& m, glm::vec2 vertexUv) {
    const glm::vec2 uv = glm::fract(m.uvTransform * glm::vec3(vertexUv, 1));
    return uv.x >= 0 && uv.x < 1 && uv.y >= 0 && uv.y < 1 ? uv : glm::vec2(0);
}

// Whether an alpha-masked surface is cut out at a place of its texture.
bool isCutOut(const GeometryArrays& g, const Material& m, glm::vec2 vertexUv) {
    if (m.alphaMode != AlphaMode::kMask) return false;
    float alpha = m.baseColor.w;
    if (m.baseColorLayer >= 0) {
        const uint32_t side = textureClassSize(m.textureClass);
        const glm::uvec2 texel(textureUv(m, vertexUv) * (float(side) - 0.5f));
        const auto& layer = g.textures[size_t(m.textureClass)].srgb[size_t(m.baseColorLayer)];
        alpha *= float(layer[(size_t(texel.y) * side + texel.x) * 4 + 3]) / 255;
    }
    return alpha < m.alphaCutoff;
}

io::BvhMask maskAt(const Material& m, const std::array<glm::vec2, 3>& vertexUvs) {
    if (m.alphaMode != AlphaMode::kMask || m.baseColorLayer < 0) return {};
    const auto uv = [&](size_t corner) { return m.uvTransform * glm::vec3(vertexUvs[corner], 1); };
    return {.uv0 = uv(0),
            .uv1 = uv(1),
            .uv2 = uv(2),
            .imageCode = io::packMask(uint32_t(m.textureClass), uint32_t(m.baseColorLayer)),
            .leastAlpha = m.alphaCutoff / std::max(m.baseColor.w, 1e-6f)};
}

glm::vec3 linearOf(const uint8_t* texel) {
    return glm::convertSRGBToLinear(glm::vec3(texel[0], texel[1], texel[2]) / 255.0f);
}

// Factors of the material's.
glm::vec2 roughnessAndMetallicAt(const GeometryArrays& g, const Material& m, size_t texel) {
    if (m.metallicRoughnessLayer < 0) return glm::vec2(1);
    const uint8_t* const at =
        &g.textures[size_t(m.textureClass)].linear[size_t(m.metallicRoughnessLayer)][texel * 4];
    return glm::vec2(at[1], at[2]) / 255.0f;
}

// The mean over a window of the material's textures of what `at` has in a texel: a point stands for more than
// one. `uv` in [0, 1)²; `windows`: such windows along a texture's side.
template <class F>
glm::vec3 meanAbout(const Material& m, glm::vec2 uv, int windows, F&& at) {
    const int side = int(textureClassSize(m.textureClass)), step = std::max(side / (8 * windows), 1);
    const glm::ivec2 middle(uv * float(side));
    glm::vec3 sum(0);
    for (int y = -4; y < 4; ++y)
        for (int x = -4; x < 4; ++x) {
            const glm::ivec2 texel = (middle + glm::ivec2(x, y) * step + side) % side;
            sum += at(size_t(texel.y) * size_t(side) + size_t(texel.x)) / 64.0f;
        }
    return sum;
}

glm::vec3 colorOf(const GeometryArrays& g, const Material& m, int32_t layer, size_t texel) {
    return layer < 0 ? glm::vec3(1)
                     : linearOf(&g.textures[size_t(m.textureClass)].srgb[size_t(layer)][texel * 4]);
}

float bumpShareAt(const GeometryArrays& g, const Material& m, size_t texel) {
    if (m.normalLayer < 0) return 1;
    const uint8_t* const at = &g.textures[size_t(m.textureClass)].linear[size_t(m.normalLayer)][texel * 4];
    return io::bumpShareOfHemisphere(glm::vec3(at[0], at[1], at[2]) / 127.5f - 1.0f, m.normalScale);
}

constexpr int kAlbedoWindows = 8;

// What bounces of the light that a smooth surface would receive.
glm::vec3 albedoAbout(const GeometryArrays& g, const Material& m, glm::vec2 uv, bool whole) {
    const auto reflects = [&](glm::vec3 base, glm::vec2 roughnessAndMetallic) {
        const float rough = m.roughness * roughnessAndMetallic.x,
                    metallic = m.metallic * roughnessAndMetallic.y;
        return whole ? io::wholeReflectance(base, metallic, rough, m.specular)
                     : io::diffuseAlbedo(base, metallic);
    };
    const glm::vec3 base(m.baseColor);
    if (m.baseColorLayer < 0 && m.metallicRoughnessLayer < 0 && m.normalLayer < 0)
        return reflects(base, glm::vec2(1));
    return meanAbout(m, uv, kAlbedoWindows, [&](size_t texel) {
        return bumpShareAt(g, m, texel) *
               reflects(base * colorOf(g, m, m.baseColorLayer, texel), roughnessAndMetallicAt(g, m, texel));
    });
}

// The same, worked out once for each window: triangles are many.
class AlbedoWindows {
  public:
    AlbedoWindows(const GeometryArrays& g, bool whole) : g_(g) {
        for (const Material& m : g.materials)
            for (int i = 0; i < kAlbedoWindows * kAlbedoWindows; ++i) {
                const glm::vec2 window(i % kAlbedoWindows, i / kAlbedoWindows);
                windows_.push_back(albedoAbout(g, m, (window + 0.5f) / float(kAlbedoWindows), whole));
            }
    }
    glm::vec3 operator()(uint32_t primitive, glm::vec2 vertexUv) const {
        const uint32_t material = g_.primitives[primitive].material;
        const glm::uvec2 window(textureUv(g_.materials[material], vertexUv) * float(kAlbedoWindows));
        return windows_[(material * kAlbedoWindows + window.y) * kAlbedoWindows + window.x];
    }

  private:
    const GeometryArrays& g_;
    std::vector<glm::vec3> windows_;
};

// Signs have finer texture than what reflects.
glm::vec3 emissionAbout(const GeometryArrays& g, const Material& m, glm::vec2 vertexUv) {
    if (m.emissiveLayer < 0) return m.emissive;
    return m.emissive * meanAbout(m, textureUv(m, vertexUv), 32,
                                  [&](size_t texel) { return colorOf(g, m, m.emissiveLayer, texel); });
}

const Material& materialOf(const RenderScene& scene, uint32_t instance) {
    const GeometryArrays& g = *scene.geometry;
    return g.materials[g.primitives[scene.instances[instance].primitive].material];
}

std::vector<gi::SampledMesh> meshesOf(const GeometryArrays& g) {
    std::vector<gi::SampledMesh> meshes;
    for (const Primitive& p : g.primitives) {
        const VertexAttributes* const attributes = g.attributes.data() + p.vertexOffset;
        meshes.push_back(
            {.positions = gi::Strided<glm::vec3>::of(g.positions.data() + p.vertexOffset),
             .normals = {reinterpret_cast<const std::byte*>(&attributes->normal), sizeof *attributes},
             .uvs = {reinterpret_cast<const std::byte*>(&attributes->uv), sizeof *attributes},
             .colors = g.materials[p.material].vertexColors
                           ? gi::Strided<uint32_t>{reinterpret_cast<const std::byte*>(&attributes->color),
                                                   sizeof *attributes}
                           : gi::Strided<uint32_t>{},
             .indices = std::span(g.indices).subspan(p.firstIndex, p.indexCount),
             .blocksLight = g.materials[p.material].alphaMode != AlphaMode::kBlend,
             .doubleSided = g.materials[p.material].doubleSided});
    }
    return meshes;
}

std::vector<gi::SampledInstance> instancesOf(const RenderScene& scene, const DeformedVertices& deformed) {
    std::vector<gi::SampledInstance> instances;
    for (const RenderInstance& instance : scene.instances) {
        instances.push_back({.worldFromLocal = instance.worldFromLocal,
                             .mesh = instance.primitive,
                             .movable = instance.movable || instance.skinnedMesh != kNoSkinnedMesh,
                             .isPresent = instance.isPresent()});
        if (instance.skinnedMesh == kNoSkinnedMesh || deformed.positions.empty()) continue;
        instances.back().deformed =
            gi::Strided<glm::vec3>::of(verticesOf(scene, deformed, instance).positions);
        instances.back().firstDeformed =
            uint32_t(firstVertexOf(scene, instance.primitive, instance.skinnedMesh));
    }
    return instances;
}

auto withSampledScene(const RenderScene& scene, std::span<const gi::SampledMesh> meshes, auto&& use) {
    const GeometryArrays& g = *scene.geometry;
    const DeformedVertices deformed = deformSkinnedMeshes(scene);
    const std::vector<gi::SampledInstance> instances = instancesOf(scene, deformed);
    const auto cutOut = [&](uint32_t mesh, glm::vec2 uv) {
        return isCutOut(g, g.materials[g.primitives[mesh].material], uv);
    };
    return use(gi::SampledScene{meshes, instances, scene.bounds, cutOut});
}

auto withSampledScene(const RenderScene& scene, auto&& use) {
    return withSampledScene(scene, meshesOf(*scene.geometry), use);
}

// Those that shine, as if nothing else were there. Colours of vertices tint what is reflected alone.
std::vector<gi::SampledMesh> emissiveMeshesOf(const GeometryArrays& g) {
    std::vector<gi::SampledMesh> meshes = meshesOf(g);
    for (size_t i = 0; i < meshes.size(); ++i) {
        meshes[i].colors = {};
        meshes[i].blocksLight &= g.materials[g.primitives[i].material].emissive != glm::vec3(0);
    }
    return meshes;
}

}  // namespace

gi::SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count) {
    return withSampledScene(scene, [&](const gi::SampledScene& s) { return gi::sampleSurfaces(s, count); });
}

std::vector<MeshPoints> sampleMeshes(const GeometryArrays& g) {
    std::vector<MeshPoints> result;
    const std::vector<gi::SampledMesh> meshes = meshesOf(g);
    const auto each = uint32_t(kAllMeshPoints / std::max<size_t>(meshes.size(), 1));
    const auto cutOut = [&](uint32_t mesh, glm::vec2 uv) {
        return isCutOut(g, g.materials[g.primitives[mesh].material], uv);
    };
    for (uint32_t i = 0; i < meshes.size(); ++i) {
        const gi::SampledInstance alone{.mesh = i};
        gi::SurfaceSamples chosen =
            gi::sampleSurfaces({meshes, std::span(&alone, 1), g.primitives[i].boundsLocal, cutOut},
                               std::clamp(each, kLeastMeshPoints, kMostMeshPoints));
        MeshPoints points;
        if (!chosen.samples.empty()) points.area = chosen.pointAreas[0] * float(chosen.samples.size());
        points.samples = std::move(chosen.samples);
        points.uvs = std::move(chosen.uvs);
        points.tints = std::move(chosen.tints);
        result.push_back(std::move(points));
    }
    return result;
}

glm::vec3 albedoOf(const RenderScene& scene, uint32_t instance, glm::vec2 uv, bool whole) {
    const Material& m = materialOf(scene, instance);
    return albedoAbout(*scene.geometry, m, textureUv(m, uv), whole);
}

gi::OccluderTrees buildTrees(const RenderScene& scene, gi::TreesOf of, SurfaceLight sent) {
    const GeometryArrays& g = *scene.geometry;
    const AlbedoWindows albedo(g, sent.whole);
    const auto sentAt = [&](uint32_t primitive, glm::vec2 uv) {
        const Material& m = g.materials[g.primitives[primitive].material];
        const bool shines = m.emissive != glm::vec3(0);
        return gi::SentAt{albedo(primitive, uv), shines ? emissionAbout(g, m, uv) / sent.unit : glm::vec3(0)};
    };
    const auto maskOf = [&](uint32_t primitive, const std::array<glm::vec2, 3>& uvs) {
        return maskAt(g.materials[g.primitives[primitive].material], uvs);
    };
    return withSampledScene(
        scene, [&](const gi::SampledScene& s) { return gi::buildOccluderTrees(s, of, sentAt, maskOf); });
}

void placeTrees(const RenderScene& scene, const gi::OccluderTrees& trees, bool movers,
                std::vector<gi::SampledInstance>& moving, gi::MoverTree& result) {
    moving.clear();
    for (const RenderInstance& i : scene.instances)
        if (movers && i.isPresent() && (i.movable || i.skinnedMesh != kNoSkinnedMesh))
            moving.push_back({.worldFromLocal = i.worldFromLocal, .mesh = i.primitive, .movable = true});
    gi::placeTrees(trees, moving, result);
}

std::vector<io::BouncePoint> chooseBouncePoints(const RenderScene& scene, const gi::SurfaceSamples& samples,
                                                uint32_t count, bool whole) {
    const DeformedVertices deformed = deformSkinnedMeshes(scene);
    const auto albedo = [&](uint32_t instance, glm::vec2 uv) { return albedoOf(scene, instance, uv, whole); };
    const auto doubleSided = [&](uint32_t instance) { return materialOf(scene, instance).doubleSided; };
    return chooseBouncePoints(instancesOf(scene, deformed), samples, albedo, doubleSided, count);
}

std::vector<io::BouncePoint> chooseEmissivePoints(const RenderScene& scene, uint32_t count, float lightUnit) {
    if (!hasEmissive(scene)) return {};
    const auto radiance = [&](uint32_t instance, glm::vec2 uv) {
        return emissionAbout(*scene.geometry, materialOf(scene, instance), uv) / lightUnit;
    };
    return withSampledScene(scene, emissiveMeshesOf(*scene.geometry), [&](const gi::SampledScene& s) {
        const gi::SurfaceSamples samples = gi::sampleSurfaces(s, 4 * count);
        if (samples.samples.empty()) return std::vector<io::BouncePoint>{};
        const auto doubleSided = [&](uint32_t instance) { return materialOf(scene, instance).doubleSided; };
        return chooseBouncePoints(s.instances, samples, radiance, doubleSided, count);
    });
}

}  // namespace ag::render
