#include "engine/renderer/scene_surfaces.h"

#include <glm/gtc/color_space.hpp>

#include "common/brdf.h"
#include "engine/scene/deform.h"

namespace ag::render {
namespace {

// Whether an alpha-masked surface is cut out at a place of its texture.
bool isCutOut(const GeometryArrays& g, const Material& m, glm::vec2 vertexUv) {
    if (m.alphaMode != AlphaMode::kMask) return false;
    float alpha = m.baseColor.w;
    if (m.baseColorLayer >= 0) {
        const glm::vec2 uv = m.uvTransform * glm::vec3(vertexUv, 1);
        const uint32_t side = textureClassSize(m.textureClass);
        const glm::uvec2 texel(glm::fract(uv) * (float(side) - 0.5f));
        const auto& layer = g.textures[size_t(m.textureClass)].srgb[size_t(m.baseColorLayer)];
        alpha *= float(layer[(size_t(texel.y) * side + texel.x) * 4 + 3]) / 255;
    }
    return alpha < m.alphaCutoff;
}

glm::vec3 linearOf(const uint8_t* texel) {
    return glm::convertSRGBToLinear(glm::vec3(texel[0], texel[1], texel[2]) / 255.0f);
}

float metallicAt(const GeometryArrays& g, const Material& m, size_t texel) {
    if (m.metallicRoughnessLayer < 0) return m.metallic;
    return m.metallic *
           float(g.textures[size_t(m.textureClass)].linear[size_t(m.metallicRoughnessLayer)][texel * 4 + 2]) /
           255;
}

// Mean of the diffuse albedo over a window of the texture, an eighth of its width: a point stands for more
// than a texel.
glm::vec3 albedoAbout(const GeometryArrays& g, const Material& m, glm::vec2 vertexUv) {
    if (m.baseColorLayer < 0 && m.metallicRoughnessLayer < 0)
        return io::diffuseAlbedo(glm::vec3(m.baseColor), m.metallic);
    const int side = int(textureClassSize(m.textureClass)), step = side / 64;
    const glm::ivec2 middle(glm::fract(m.uvTransform * glm::vec3(vertexUv, 1)) * float(side));
    glm::vec3 sum(0);
    for (int y = -4; y < 4; ++y)
        for (int x = -4; x < 4; ++x) {
            const glm::ivec2 at = (middle + glm::ivec2(x, y) * step + side) % side;
            const size_t texel = size_t(at.y) * size_t(side) + size_t(at.x);
            glm::vec3 base(m.baseColor);
            if (m.baseColorLayer >= 0)
                base *=
                    linearOf(&g.textures[size_t(m.textureClass)].srgb[size_t(m.baseColorLayer)][texel * 4]);
            sum += io::diffuseAlbedo(base, metallicAt(g, m, texel)) / 64.0f;
        }
    return sum;
}

std::vector<gi::SampledMesh> meshesOf(const GeometryArrays& g) {
    std::vector<gi::SampledMesh> meshes;
    for (const Primitive& p : g.primitives) {
        const VertexAttributes* const attributes = g.attributes.data() + p.vertexOffset;
        meshes.push_back(
            {.positions = gi::Strided<glm::vec3>::of(g.positions.data() + p.vertexOffset),
             .normals = {reinterpret_cast<const std::byte*>(&attributes->normal), sizeof *attributes},
             .uvs = {reinterpret_cast<const std::byte*>(&attributes->uv), sizeof *attributes},
             .indices = std::span(g.indices).subspan(p.firstIndex, p.indexCount),
             .blocksLight = g.materials[p.material].alphaMode != AlphaMode::kBlend});
    }
    return meshes;
}

std::vector<gi::SampledInstance> instancesOf(const RenderScene& scene, const DeformedVertices& deformed) {
    std::vector<gi::SampledInstance> instances;
    for (const RenderInstance& instance : scene.instances) {
        instances.push_back({.worldFromLocal = instance.worldFromLocal,
                             .mesh = instance.primitive,
                             .movable = instance.movable || instance.skinnedMesh != kNoSkinnedMesh});
        if (instance.skinnedMesh == kNoSkinnedMesh || deformed.positions.empty()) continue;
        instances.back().deformed =
            gi::Strided<glm::vec3>::of(verticesOf(scene, deformed, instance).positions);
        instances.back().firstDeformed = uint32_t(firstVertexOf(scene, instance));
    }
    return instances;
}

auto withSampledScene(const RenderScene& scene, auto&& use) {
    const GeometryArrays& g = *scene.geometry;
    const DeformedVertices deformed = deformSkinnedMeshes(scene);
    const std::vector<gi::SampledMesh> meshes = meshesOf(g);
    const std::vector<gi::SampledInstance> instances = instancesOf(scene, deformed);
    const auto cutOut = [&](uint32_t mesh, glm::vec2 uv) {
        return isCutOut(g, g.materials[g.primitives[mesh].material], uv);
    };
    return use(gi::SampledScene{meshes, instances, scene.bounds, cutOut});
}

}  // namespace

gi::SurfaceSamples sampleSurfaces(const RenderScene& scene, uint32_t count) {
    return withSampledScene(scene, [&](const gi::SampledScene& s) { return gi::sampleSurfaces(s, count); });
}

gi::OccluderTrees buildTrees(const RenderScene& scene, gi::TreesOf of) {
    return withSampledScene(scene, [of](const gi::SampledScene& s) { return gi::buildOccluderTrees(s, of); });
}

gi::MoverTree placeTrees(const RenderScene& scene, const gi::OccluderTrees& trees, bool movers) {
    return gi::placeTrees(trees, movers ? instancesOf(scene, {}) : std::vector<gi::SampledInstance>{});
}

std::vector<io::BouncePoint> chooseBouncePoints(const RenderScene& scene, const gi::SurfaceSamples& samples,
                                                uint32_t count) {
    const GeometryArrays& g = *scene.geometry;
    const DeformedVertices deformed = deformSkinnedMeshes(scene);
    const auto albedo = [&](uint32_t instance, glm::vec2 uv) {
        return albedoAbout(g, g.materials[g.primitives[scene.instances[instance].primitive].material], uv);
    };
    return chooseBouncePoints(instancesOf(scene, deformed), samples, albedo, count);
}

}  // namespace ag::render
