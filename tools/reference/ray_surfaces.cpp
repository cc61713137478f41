// What is where a ray met the scene: corners, materials, shading normals.
#include <algorithm>
#include <array>
#include <glm/gtc/packing.hpp>

#include "common/brdf.h"
#include "common/tangent_frame.h"
#include "common/tonemap.h"
#include "tools/reference/ray_scene.h"

namespace ag::reference {

// A place of a texture, and the sides of a parallelogram about it; none: a point.
struct UvArea {
    glm::vec2 at{0}, right{0}, down{0};
};

namespace {

// Linear values of the 256 sRGB codes.
const std::array<float, 256>& linearOfCode() {
    static const auto table = [] {
        std::array<float, 256> values{};
        for (size_t i = 0; i < values.size(); ++i)
            values[i] = io::linearFromSrgb1(float(i) / 255.0f);
        return values;
    }();
    return table;
}

// Bilinear, repeating, of one layer's finest level.
glm::vec4 sampleLayer(const std::vector<uint8_t>& texels, uint32_t size, glm::vec2 uv, bool srgb) {
    const glm::vec2 at = (uv - glm::floor(uv)) * float(size) - 0.5f;
    const glm::vec2 low = glm::floor(at), f = at - low;
    const auto texel = [&](int dx, int dy) {
        const uint32_t x = uint32_t(int(low.x) + dx + int(size)) % size,
                       y = uint32_t(int(low.y) + dy + int(size)) % size;
        const uint8_t* t = &texels[(size_t(y) * size + x) * 4];
        if (!srgb) return glm::vec4(t[0], t[1], t[2], t[3]) / 255.0f;
        const auto& linear = linearOfCode();
        return glm::vec4(linear[t[0]], linear[t[1]], linear[t[2]], float(t[3]) / 255.0f);
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

constexpr float kMostSteps = 32;  // along a side of a footprint

// The mean over the area, by lookups a texel apart or as close as kMostSteps allows.
glm::vec4 sampleTexture(const GeometryArrays& g, const Material& m, int32_t layer, const UvArea& uv,
                        bool srgb) {
    if (layer < 0) return glm::vec4(1);
    const TextureLayers& layers = g.textures[size_t(m.textureClass)];
    const std::vector<uint8_t>& texels = (srgb ? layers.srgb : layers.linear)[size_t(layer)];
    const uint32_t size = textureClassSize(m.textureClass);
    const glm::vec2 at = m.uvTransform * glm::vec3(uv.at, 1), right = m.uvTransform * glm::vec3(uv.right, 0),
                    down = m.uvTransform * glm::vec3(uv.down, 0);
    const glm::vec2 texelsAlong = glm::vec2(glm::length(right), glm::length(down)) * float(size);
    const glm::vec2 steps = glm::clamp(glm::ceil(texelsAlong), 1.0f, kMostSteps);
    glm::vec4 sum(0);
    for (float y = 0.5f; y < steps.y; ++y)
        for (float x = 0.5f; x < steps.x; ++x)
            sum += sampleLayer(texels, size, at + right * (x / steps.x - 0.5f) + down * (y / steps.y - 0.5f),
                               srgb);
    return sum / (steps.x * steps.y);
}

}  // namespace

UvArea RayScene::uvOver(const Part& part, const Surface& s, const Footprint& over) const {
    UvArea area{.at = uvAt(part, s.triangle, s.u, s.v)};
    if (over.right == glm::vec3(0) && over.down == glm::vec3(0)) return area;
    const auto c = cornersOf(part, s.triangle);
    const glm::vec3 e1 = c[1] - c[0], e2 = c[2] - c[0];
    const float d11 = glm::dot(e1, e1), d12 = glm::dot(e1, e2), d22 = glm::dot(e2, e2);
    const float determinant = d11 * d22 - d12 * d12;
    if (!(determinant > 1e-12f * d11 * d22)) return area;
    const glm::vec2 uv0 = uvAt(part, s.triangle, 0, 0), uv1 = uvAt(part, s.triangle, 1, 0) - uv0,
                    uv2 = uvAt(part, s.triangle, 0, 1) - uv0;
    const auto along = [&](glm::vec3 d) {
        const float a = glm::dot(d, e1), b = glm::dot(d, e2);
        return (uv1 * (a * d22 - b * d12) + uv2 * (b * d11 - a * d12)) / determinant;
    };
    area.right = along(over.right), area.down = along(over.down);
    return area;
}

glm::vec2 RayScene::uvAt(const Part& part, uint32_t triangle, float u, float v) const {
    const GeometryArrays& g = *scene_.geometry;
    const uint32_t* i = &g.indices[part.primitive->firstIndex + 3 * triangle];
    const VertexAttributes* a = part.vertices.attributes;
    return a[i[0]].uv * (1 - u - v) + a[i[1]].uv * u + a[i[2]].uv * v;
}

glm::vec3 RayScene::colorAt(const Part& part, uint32_t triangle, float u, float v) const {
    const uint32_t* i = &scene_.geometry->indices[part.primitive->firstIndex + 3 * triangle];
    const auto color = [&](uint32_t corner) {
        return glm::vec3(glm::unpackUnorm3x10_1x2(part.vertices.attributes[i[corner]].color));
    };
    return color(0) * (1 - u - v) + color(1) * u + color(2) * v;
}

const Material& RayScene::materialOf(uint32_t part) const {
    return scene_.geometry->materials[parts_[part]->primitive->material];
}

std::array<glm::vec3, 3> RayScene::cornersOf(const Part& part, uint32_t triangle) const {
    const uint32_t* i = &scene_.geometry->indices[part.primitive->firstIndex + 3 * triangle];
    std::array<glm::vec3, 3> corners;
    for (size_t c = 0; c < 3; ++c)
        corners[c] = part.instance->worldFromLocal * glm::vec4(part.vertices.positions[i[c]], 1);
    return corners;
}

glm::vec3 RayScene::frontNormal(uint32_t part, uint32_t triangle) const {
    if (parts_[part]->doubleSided) return glm::vec3(0);
    const auto c = cornersOf(*parts_[part], triangle);
    const glm::vec3 n = glm::cross(c[1] - c[0], c[2] - c[0]) * (parts_[part]->mirrored ? -1.0f : 1.0f);
    const float length = glm::length(n);
    return length > 0 ? n / length : glm::vec3(0);
}

float RayScene::triangleArea(uint32_t part, uint32_t triangle) const {
    const auto c = cornersOf(*parts_[part], triangle);
    return 0.5f * glm::length(glm::cross(c[1] - c[0], c[2] - c[0]));
}

glm::vec3 RayScene::emissionAt(uint32_t part, uint32_t triangle, float u, float v) const {
    const Material& m = materialOf(part);
    if (m.textureClass == TextureClass::kNone || m.emissiveLayer < 0) return m.emissive;
    const UvArea uv{.at = uvAt(*parts_[part], triangle, u, v)};
    return m.emissive * glm::vec3(sampleTexture(*scene_.geometry, m, m.emissiveLayer, uv, true));
}

Surface RayScene::placeOn(uint32_t part, uint32_t triangle, float u, float v, glm::vec3 from) const {
    const auto c = cornersOf(*parts_[part], triangle);
    Surface s;
    const glm::vec3 position = c[0] * (1 - u - v) + c[1] * u + c[2] * v;
    const float distance = glm::distance(position, from);
    const glm::vec3 normal = glm::cross(c[1] - c[0], c[2] - c[0]);
    takeHit(from, (position - from) / std::max(distance, 1e-20f), distance, normal, part, s);
    s.triangle = triangle, s.u = u, s.v = v;
    return s;
}

float RayScene::alphaAt(const Part& part, uint32_t triangle, float u, float v) const {
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const UvArea uv{.at = uvAt(part, triangle, u, v)};
    return m.baseColor.w * sampleTexture(g, m, m.baseColorLayer, uv, true).w;
}

bool RayScene::masked(const Part& part, uint32_t triangle, float u, float v) const {
    return alphaAt(part, triangle, u, v) < scene_.geometry->materials[part.primitive->material].alphaCutoff;
}

void RayScene::resolve(Surface& s, const Footprint& over) const {
    if (s.resolved) return;
    s.resolved = true;
    const Part& part = *parts_[s.part];
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const UvArea uv = m.textureClass == TextureClass::kNone ? UvArea{} : uvOver(part, s, over);
    s.normal = shadingNormal(part, s, uv);
    if (s.hidden) {
        s.albedo = s.baseColor = s.emissive = glm::vec3(0);
        s.metallic = s.specular = 0;
        return;
    }
    s.baseColor = glm::vec3(m.baseColor);
    s.metallic = m.metallic;
    s.roughness = m.roughness;
    s.specular = m.specular;
    s.emissive = m.emissive;
    if (m.textureClass != TextureClass::kNone) {
        s.baseColor *= glm::vec3(sampleTexture(g, m, m.baseColorLayer, uv, true));
        const glm::vec4 mr = sampleTexture(g, m, m.metallicRoughnessLayer, uv, false);
        s.metallic *= mr.z;
        s.roughness *= mr.y;
        s.emissive *= glm::vec3(sampleTexture(g, m, m.emissiveLayer, uv, true));
    }
    if (m.vertexColors) s.baseColor *= colorAt(part, s.triangle, s.u, s.v);
    s.albedo = io::diffuseAlbedo(s.baseColor, s.metallic);
}

Veil RayScene::veilOf(Surface& s, glm::vec3 direction, bool glossy) const {
    resolve(s);
    const Part& part = *parts_[s.part];
    const Material& m = materialOf(s.part);
    const float alpha = m.coversWholly ? 1.0f : alphaAt(part, s.triangle, s.u, s.v);
    Veil veil{.coverage = std::clamp(alpha, 0.0f, 1.0f)};
    const glm::vec3 reflected = glossy
                                    ? io::fresnelSchlick(io::specularF0(s.baseColor, s.metallic, s.specular),
                                                         glm::vec3(io::specularF90(s.metallic, s.specular)),
                                                         std::abs(glm::dot(direction, s.geometricNormal)))
                                    : glm::vec3(0);
    veil.transmitted = io::sheetTransmits(s.baseColor, s.metallic, veil.coverage, m.transmission, reflected);
    // Right for metals and for what is none.
    s.baseColor *= 1 - m.transmission * (1 - s.metallic);
    s.albedo = io::diffuseAlbedo(s.baseColor, s.metallic);
    return veil;
}

// The interpolated normal on the ray's side, bent by the normal map as the G-buffer does it.
glm::vec3 RayScene::shadingNormal(const Part& part, const Surface& s, const UvArea& uv) const {
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const uint32_t* i = &g.indices[part.primitive->firstIndex + 3 * s.triangle];
    const VertexAttributes* a = part.vertices.attributes;
    const float u = s.u, v = s.v, w = 1 - u - v;
    glm::vec3 n =
        glm::normalize(part.normalFromLocal * (a[i[0]].normal * w + a[i[1]].normal * u + a[i[2]].normal * v));
    const float side = glm::dot(n, s.geometricNormal) < 0 ? -1.0f : 1.0f;
    if (m.normalLayer < 0) return side * n;

    const glm::vec4 tangent = a[i[0]].tangent * w + a[i[1]].tangent * u + a[i[2]].tangent * v;
    const glm::vec3 along = part.worldFromLocal * glm::vec3(tangent);
    const auto uvStep = [&](size_t corner) {
        return m.uvTransform * glm::vec3(a[i[corner]].uv - a[i[0]].uv, 0);
    };
    const auto c = cornersOf(part, s.triangle);
    const io::TangentFrame frame =
        glm::dot(along, along) > 1e-12f
            ? io::frameOfTangent(n, glm::vec4(along, part.mirrored ? -tangent.w : tangent.w))
            : io::frameOfSteps(n, c[1] - c[0], c[2] - c[0], uvStep(1), uvStep(2));
    glm::vec3 mapped = glm::vec3(sampleTexture(g, m, m.normalLayer, uv, false)) * 2.0f - 1.0f;
    mapped.x *= m.normalScale;
    mapped.y *= m.normalScale;
    const glm::vec3 bent = io::fromFrame(frame, mapped);
    return side * (glm::dot(bent, bent) > 1e-12f ? glm::normalize(bent) : n);
}

}  // namespace ag::reference
