#include "tools/reference/ray_scene.h"

#include <algorithm>
#include <cmath>

#include "common/brdf.h"
#include "common/tonemap.h"
#include "engine/core/check.h"

namespace ag::reference {
namespace {

// Bilinear, repeating, of one layer's finest level.
glm::vec4 sampleLayer(const std::vector<uint8_t>& texels, uint32_t size, glm::vec2 uv, bool srgb) {
    const glm::vec2 at = (uv - glm::floor(uv)) * float(size) - 0.5f;
    const glm::vec2 low = glm::floor(at), f = at - low;
    const auto texel = [&](int dx, int dy) {
        const uint32_t x = uint32_t(int(low.x) + dx + int(size)) % size,
                       y = uint32_t(int(low.y) + dy + int(size)) % size;
        const uint8_t* t = &texels[(size_t(y) * size + x) * 4];
        const glm::vec4 value = glm::vec4(t[0], t[1], t[2], t[3]) / 255.0f;
        return srgb ? glm::vec4(io::linearFromSrgb(glm::vec3(value)), value.w) : value;
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

}  // namespace

RayScene::RayScene(const RenderScene& scene) : scene_(scene) {
    device_ = rtcNewDevice(nullptr);
    AG_CHECK(device_ != nullptr);
    rtc_ = rtcNewScene(device_);
    rtcSetSceneFlags(rtc_, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(rtc_, RTC_BUILD_QUALITY_HIGH);
    const GeometryArrays& g = *scene.geometry;
    for (const RenderInstance& instance : scene.instances) {
        const Primitive& p = g.primitives[instance.primitive];
        const Material& material = g.materials[p.material];
        if (material.alphaMode == AlphaMode::kBlend) continue;
        uint32_t vertices = 0;
        for (uint32_t i = 0; i < p.indexCount; ++i)
            vertices = std::max(vertices, g.indices[p.firstIndex + i] + 1);
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* positions = static_cast<glm::vec3*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(glm::vec3), vertices));
        for (uint32_t v = 0; v < vertices; ++v)
            positions[v] = instance.worldFromLocal * glm::vec4(g.positions[size_t(p.vertexOffset) + v], 1);
        auto* indices = static_cast<uint32_t*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, p.indexCount / 3));
        std::copy_n(g.indices.begin() + p.firstIndex, p.indexCount, indices);
        const glm::mat3 linear(instance.worldFromLocal[0], instance.worldFromLocal[1],
                               instance.worldFromLocal[2]);
        parts_.push_back(std::make_unique<Part>(Part{&instance, &p, glm::transpose(glm::inverse(linear))}));
        if (material.alphaMode == AlphaMode::kMask) {
            rtcSetGeometryUserData(geometry, this);
            rtcSetGeometryIntersectFilterFunction(geometry, filterMasked);
            rtcSetGeometryOccludedFilterFunction(geometry, filterMasked);
        }
        rtcCommitGeometry(geometry);
        rtcAttachGeometryByID(rtc_, geometry, uint32_t(parts_.size() - 1));
        rtcReleaseGeometry(geometry);
    }
    rtcCommitScene(rtc_);
    const glm::vec3 far = glm::max(glm::abs(scene.bounds.min), glm::abs(scene.bounds.max));
    offset_ = std::max(2e-5f * glm::length(scene.bounds.max - scene.bounds.min), 4e-7f * glm::length(far));
}

RayScene::~RayScene() {
    rtcReleaseScene(rtc_);
    rtcReleaseDevice(device_);
}

glm::vec2 RayScene::uvAt(const Part& part, uint32_t triangle, float u, float v) const {
    const GeometryArrays& g = *scene_.geometry;
    const uint32_t* i = &g.indices[part.primitive->firstIndex + 3 * triangle];
    const VertexAttributes* a = &g.attributes[size_t(part.primitive->vertexOffset)];
    return a[i[0]].uv * (1 - u - v) + a[i[1]].uv * u + a[i[2]].uv * v;
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
    RTCRayHit ray{};
    ray.ray = {origin.x,    origin.y, origin.z, 0,   direction.x, direction.y,
               direction.z, 0,        INFINITY, ~0u, 0,           0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(rtc_, &context, &ray);
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return false;

    const Part& part = *parts_[ray.hit.geomID];
    const GeometryArrays& g = *scene_.geometry;
    const Material& m = g.materials[part.primitive->material];
    const float u = ray.hit.u, v = ray.hit.v;
    const uint32_t* i = &g.indices[part.primitive->firstIndex + 3 * ray.hit.primID];
    const VertexAttributes* a = &g.attributes[size_t(part.primitive->vertexOffset)];
    const glm::vec3 local = a[i[0]].normal * (1 - u - v) + a[i[1]].normal * u + a[i[2]].normal * v;
    surface.distance = ray.ray.tfar;
    surface.position = origin + direction * ray.ray.tfar;
    surface.geometricNormal = glm::normalize(glm::vec3(ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z));
    surface.normal = glm::normalize(part.normalFromLocal * local);
    if (glm::dot(surface.geometricNormal, direction) > 0) surface.geometricNormal = -surface.geometricNormal;
    if (glm::dot(surface.normal, surface.geometricNormal) < 0) surface.normal = -surface.normal;

    const glm::vec2 uv = uvAt(part, ray.hit.primID, u, v);
    const glm::vec3 base =
        glm::vec3(m.baseColor) * glm::vec3(sampleTexture(g, m, m.baseColorLayer, uv, true));
    const float metallic =
        m.metallic *
        (m.metallicRoughnessLayer < 0 ? 1.0f : sampleTexture(g, m, m.metallicRoughnessLayer, uv, false).z);
    surface.albedo = io::diffuseAlbedo(base, metallic);
    surface.emissive = m.emissive * glm::vec3(sampleTexture(g, m, m.emissiveLayer, uv, true));
    return true;
}

bool RayScene::visible(glm::vec3 origin, glm::vec3 direction, float distance) const {
    RTCRay ray{origin.x,    origin.y, origin.z, 0,   direction.x, direction.y,
               direction.z, 0,        distance, ~0u, 0,           0};
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(rtc_, &context, &ray);
    return ray.tfar > 0;
}

}  // namespace ag::reference
