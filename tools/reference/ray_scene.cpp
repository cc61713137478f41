#include "tools/reference/ray_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "engine/core/program.h"
#include "tools/reference/light_sources.h"

namespace ag::reference {
namespace {

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
        if (instance.isPresent() && !isBlended(instance)) addPart(rtc_, instance);
    opaqueParts_ = uint32_t(parts_.size());
    for (const RenderInstance& instance : scene.instances)
        if (instance.isPresent() && isBlended(instance)) addPart(blended_, instance);
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
