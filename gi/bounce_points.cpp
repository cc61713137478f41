#include "gi/bounce_points.h"

#include <bit>
#include <glm/gtc/color_space.hpp>

#include "common/brdf.h"

namespace ag::gi {
namespace {

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

uint32_t sharpBitsOf(const io::SurfaceSample& s) {
    return std::bit_cast<uint32_t>(s.bendLocal);  // in its place: see FigureSample
}

}  // namespace

std::vector<io::BouncePoint> chooseBouncePoints(const RenderScene& scene, const SurfaceSamples& samples,
                                                uint32_t count) {
    std::vector<io::BouncePoint> points;
    const double share = double(samples.samples.size()) / count;
    for (uint32_t i = 0; i < count; ++i) {
        const size_t at = size_t((i + 0.5) * share);
        double area = 0;
        for (size_t k = size_t(i * share), end = size_t((i + 1) * share); k < end; ++k)
            area += double(samples.pointAreas[samples.samples[k].instance]);
        const io::SurfaceSample& s = samples.samples[at];
        const Primitive& p = scene.geometry->primitives[scene.instances[s.instance].primitive];
        const bool figure = scene.instances[s.instance].figure != kNoFigure;
        const bool cutOut = figure ? (sharpBitsOf(s) & io::kSharpCutOut) != 0 : s.edgesLocal[0].distance < 0;
        points.push_back(
            {.positionLocal = s.positionLocal,
             .instance = s.instance,
             .normalLocal = s.normalLocal,
             .area = cutOut ? 0 : float(area),
             .albedo = albedoAbout(*scene.geometry, scene.geometry->materials[p.material], samples.uvs[at]),
             .edgesLocal = {s.edgesLocal[0], s.edgesLocal[1]}});
        if (figure) points.back().edgesLocal[0].inward.x = s.bendLocal;
    }
    return points;
}

}  // namespace ag::gi
