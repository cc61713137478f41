#include "tools/reference/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/gtc/packing.hpp>

#include "common/brdf.h"
#include "common/tonemap.h"
#include "engine/core/program.h"
#include "tools/reference/light_sources.h"

namespace ag::reference {
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

glm::vec4 sampleTexture(const GeometryArrays& g, const Material& m, int32_t layer, glm::vec2 uv, bool srgb) {
    if (layer < 0) return glm::vec4(1);
    const TextureLayers& layers = g.textures[size_t(m.textureClass)];
    const glm::vec2 at = m.uvTransform * glm::vec3(uv, 1);
    return sampleLayer((srgb ? layers.srgb : layers.linear)[size_t(layer)], textureClassSize(m.textureClass),
                       at, srgb);
}

void onEmbreeError(void*, RTCError, const char* what) {
    endProgram(fmt::format("Embree failed: {}", what));
}

}  // namespace

RayScene::RayScene(const RenderScene& scene) : scene_(scene), deformed_(deformSkinnedMeshes(scene)) {
    device_ = rtcNewDevice(nullptr);
    if (!device_) endProgram("Embree cannot begin: out of memory");
    rtcSetDeviceErrorFunction(device_, onEmbreeError, nullptr);
    const auto makeScene = [&] {
        RTCScene scene3d = rtcNewScene(device_);
        rtcSetSceneFlags(scene3d, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(scene3d, RTC_BUILD_QUALITY_HIGH);
        return scene3d;
    };
    rtc_ = makeScene();
    blended_ = makeScene();
    const GeometryArrays& g = *scene.geometry;
    const auto isBlended = [&](const RenderInstance& instance) {
        return g.materials[g.primitives[instance.primitive].material].alphaMode == AlphaMode::kBlend;
    };
    for (const RenderInstance& instance : scene.instances)
        if (!isBlended(instance)) addPart(rtc_, instance);
    opaqueParts_ = uint32_t(parts_.size());
    for (const RenderInstance& instance : scene.instances)
        if (isBlended(instance)) addPart(blended_, instance);
    rtcCommitScene(blended_);
    rtcCommitScene(rtc_);
    for (const RenderLight& light : scene.lights)
        lights_.push_back({light, std::cos(light.innerConeAngle), std::cos(light.outerConeAngle)});
    const glm::vec3 far = glm::max(glm::abs(scene.bounds.min), glm::abs(scene.bounds.max));
    offset_ = std::max(2e-5f * glm::length(scene.bounds.max - scene.bounds.min), 4e-7f * glm::length(far));
    sources_ = std::make_unique<LightSources>(*this);
}

void RayScene::addPart(RTCScene rtc, const RenderInstance& instance) {
    const GeometryArrays& g = *scene_.geometry;
    const Primitive& p = g.primitives[instance.primitive];
    const Material& material = g.materials[p.material];
    uint32_t vertices = 0;
    for (uint32_t i = 0; i < p.indexCount; ++i)
        vertices = std::max(vertices, g.indices[p.firstIndex + i] + 1);
    const VertexPointers local = verticesOf(scene_, deformed_, instance);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertices));
    for (uint32_t v = 0; v < vertices; ++v)
        positions[v] = instance.worldFromLocal * glm::vec4(local.positions[v], 1);
    auto* indices = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, p.indexCount / 3));
    std::copy_n(g.indices.begin() + p.firstIndex, p.indexCount, indices);
    const glm::mat3 linear(instance.worldFromLocal[0], instance.worldFromLocal[1],
                           instance.worldFromLocal[2]);
    parts_.push_back(
        std::make_unique<Part>(Part{&instance, &p, local, linear, glm::transpose(glm::inverse(linear)),
                                    glm::determinant(linear) < 0, material.doubleSided}));
    if (material.alphaMode == AlphaMode::kMask) {
        rtcSetGeometryUserData(geometry, this);
        rtcSetGeometryIntersectFilterFunction(geometry, filterMasked);
        rtcSetGeometryOccludedFilterFunction(geometry, filterMasked);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(rtc, geometry, uint32_t(parts_.size() - 1));
    rtcReleaseGeometry(geometry);
}

RayScene::~RayScene() {
    rtcReleaseScene(blended_);
    rtcReleaseScene(rtc_);
    rtcReleaseDevice(device_);
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
    const glm::vec2 uv = uvAt(*parts_[part], triangle, u, v);
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

bool RayScene::masked(const Part& part, uint32_t triangle, float u, float v) const {
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const float alpha =
        m.baseColor.w * sampleTexture(g, m, m.baseColorLayer, uvAt(part, triangle, u, v), true).w;
    return alpha < m.alphaCutoff;
}

void RayScene::filterMasked(const RTCFilterFunctionNArguments* arguments) {
    const auto& self = *static_cast<const RayScene*>(arguments->geometryUserPtr);
    for (uint32_t i = 0; i < arguments->N; ++i) {
        if (arguments->valid[i] == 0) continue;
        const uint32_t geometry = RTCHitN_geomID(arguments->hit, arguments->N, i);
        if (self.masked(*self.parts_[geometry], RTCHitN_primID(arguments->hit, arguments->N, i),
                        RTCHitN_u(arguments->hit, arguments->N, i),
                        RTCHitN_v(arguments->hit, arguments->N, i)))
            arguments->valid[i] = 0;
    }
}

bool RayScene::intersect(glm::vec3 origin, glm::vec3 direction, Surface& surface) const {
    return intersectIn(rtc_, origin, direction, surface);
}

bool RayScene::intersectBlended(glm::vec3 origin, glm::vec3 direction, Surface& surface) const {
    return intersectIn(blended_, origin, direction, surface);
}

bool RayScene::intersectIn(RTCScene rtc, glm::vec3 origin, glm::vec3 direction, Surface& surface) const {
    RTCRayHit ray{};
    ray.ray = {origin.x,    origin.y, origin.z, 0,   direction.x, direction.y,
               direction.z, 0,        INFINITY, ~0u, 0,           0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rtc, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    takeHit(origin, direction, ray.ray.tfar, {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}, ray.hit.geomID,
            surface);
    surface.triangle = ray.hit.primID;
    surface.u = ray.hit.u;
    surface.v = ray.hit.v;
    return true;
}

void RayScene::takeHit(glm::vec3 origin, glm::vec3 direction, float distance, glm::vec3 normal, uint32_t part,
                       Surface& s) const {
    s.distance = distance;
    s.position = origin + direction * distance;
    s.geometricNormal = glm::normalize(normal);
    const bool behind = glm::dot(s.geometricNormal, direction) > 0;
    if (behind) s.geometricNormal = -s.geometricNormal;
    s.part = part;
    s.hidden = behind != parts_[part]->mirrored && !parts_[part]->doubleSided;
    s.resolved = false;
}

void RayScene::resolve(Surface& s) const {
    if (s.resolved) return;
    s.resolved = true;
    const Part& part = *parts_[s.part];
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    s.normal = shadingNormal(part, s.triangle, s.u, s.v, s.geometricNormal);
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
        const glm::vec2 uv = uvAt(part, s.triangle, s.u, s.v);
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
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const float alpha =
        m.baseColor.w * sampleTexture(g, m, m.baseColorLayer, uvAt(part, s.triangle, s.u, s.v), true).w;
    Veil veil{.coverage = m.coversWholly ? 1.0f : std::clamp(alpha, 0.0f, 1.0f)};
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
glm::vec3 RayScene::shadingNormal(const Part& part, uint32_t triangle, float u, float v,
                                  glm::vec3 geometricNormal) const {
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const uint32_t* i = &g.indices[part.primitive->firstIndex + 3 * triangle];
    const VertexAttributes* a = part.vertices.attributes;
    const float w = 1 - u - v;
    glm::vec3 n =
        glm::normalize(part.normalFromLocal * (a[i[0]].normal * w + a[i[1]].normal * u + a[i[2]].normal * v));
    if (glm::dot(n, geometricNormal) < 0) n = -n;
    if (m.normalLayer < 0) return n;

    const glm::vec4 tangent = a[i[0]].tangent * w + a[i[1]].tangent * u + a[i[2]].tangent * v;
    glm::vec3 t = part.worldFromLocal * glm::vec3(tangent), b;
    if (glm::dot(t, t) > 1e-12f) {
        t = glm::normalize(t - n * glm::dot(n, t));
        b = glm::cross(n, t) * tangent.w;
    } else {  // along the triangle's own texture coordinates
        const glm::vec3* p = part.vertices.positions;
        const glm::vec3 e1 = part.worldFromLocal * (p[i[1]] - p[i[0]]),
                        e2 = part.worldFromLocal * (p[i[2]] - p[i[0]]);
        const glm::vec2 d1 = a[i[1]].uv - a[i[0]].uv, d2 = a[i[2]].uv - a[i[0]].uv;
        const float sign = d1.x * d2.y - d1.y * d2.x < 0 ? -1.0f : 1.0f;
        t = (e1 * d2.y - e2 * d1.y) * sign;
        b = (e2 * d1.x - e1 * d2.x) * sign;
        const float scale = std::sqrt(std::max(glm::dot(t, t), glm::dot(b, b)));
        if (!(scale > 0)) return n;
        t /= scale;
        b /= scale;
    }
    glm::vec3 mapped =
        glm::vec3(sampleTexture(g, m, m.normalLayer, uvAt(part, triangle, u, v), false)) * 2.0f - 1.0f;
    mapped.x *= m.normalScale;
    mapped.y *= m.normalScale;
    const glm::vec3 bent = t * mapped.x + b * mapped.y + n * mapped.z;
    return glm::dot(bent, bent) > 1e-12f ? glm::normalize(bent) : n;
}

bool RayScene::visible(glm::vec3 origin, glm::vec3 direction, float distance) const {
    RTCRay ray{origin.x,    origin.y, origin.z, 0,   direction.x, direction.y,
               direction.z, 0,        distance, ~0u, 0,           0};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(rtc_, &context, &ray);
    return ray.tfar > 0;
}

namespace {

bool isSingle(uint32_t lanes) {
    return (lanes & (lanes - 1)) == 0;
}

void setRays(const RayLanes& from, int* valid, RTCRay8& to) {
    for (uint32_t i = 0; i < RayLanes::kCount; ++i) {
        valid[i] = from.active >> i & 1 ? -1 : 0;
        to.org_x[i] = from.origin[i].x, to.org_y[i] = from.origin[i].y, to.org_z[i] = from.origin[i].z;
        to.dir_x[i] = from.direction[i].x, to.dir_y[i] = from.direction[i].y,
        to.dir_z[i] = from.direction[i].z;
        to.tnear[i] = 0, to.tfar[i] = from.reach[i];
        to.time[i] = 0, to.mask[i] = ~0u, to.id[i] = 0, to.flags[i] = 0;
    }
}

}  // namespace

uint32_t RayScene::intersect(const RayLanes& rays, Surface* surfaces) const {
    if (rays.active == 0) return 0;
    if (isSingle(rays.active)) {
        const auto i = uint32_t(std::countr_zero(rays.active));
        return intersect(rays.origin[i], rays.direction[i], surfaces[i]) ? rays.active : 0;
    }
    RTCRayHit8 r;
    alignas(32) int valid[RayLanes::kCount];
    setRays(rays, valid, r.ray);
    for (uint32_t i = 0; i < RayLanes::kCount; ++i)
        r.hit.geomID[i] = r.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect8(valid, rtc_, &context, &r);
    uint32_t met = 0;
    for (uint32_t i = 0; i < RayLanes::kCount; ++i) {
        if (!valid[i] || r.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        met |= 1u << i;
        Surface& s = surfaces[i];
        takeHit(rays.origin[i], rays.direction[i], r.ray.tfar[i],
                {r.hit.Ng_x[i], r.hit.Ng_y[i], r.hit.Ng_z[i]}, r.hit.geomID[i], s);
        s.triangle = r.hit.primID[i];
        s.u = r.hit.u[i];
        s.v = r.hit.v[i];
    }
    return met;
}

uint32_t RayScene::visible(const RayLanes& rays) const {
    if (rays.active == 0) return 0;
    if (isSingle(rays.active)) {
        const auto i = uint32_t(std::countr_zero(rays.active));
        return visible(rays.origin[i], rays.direction[i], rays.reach[i]) ? rays.active : 0;
    }
    RTCRay8 r;
    alignas(32) int valid[RayLanes::kCount];
    setRays(rays, valid, r);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded8(valid, rtc_, &context, &r);
    uint32_t free = 0;
    for (uint32_t i = 0; i < RayLanes::kCount; ++i)
        if (valid[i] && r.tfar[i] > 0) free |= 1u << i;
    return free;
}

}  // namespace ag::reference
