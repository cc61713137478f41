#include "gi/library/arguments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "gi/library/border.h"
#include "gi/probes.h"

namespace ag::guest {
namespace {

constexpr float kMostSkyRadiance = 1e6f;  // W/(m² sr)

// Hosts built against an earlier version hand over its padding, too.
constexpr size_t kMaterialOf11 = 64, kFrameOf11 = offsetof(AgiFrame, drawRsmVersion) + sizeof(uint64_t);
static_assert(offsetof(AgiMaterial, emissive) >= kMaterialOf11 && kFrameOf11 % alignof(AgiFrame) == 0);

glm::vec3 vec3Of(const float* v) {
    return {v[0], v[1], v[2]};
}
glm::dvec3 dvec3Of(const double* v) {
    return {v[0], v[1], v[2]};
}
bool isDirection(const float* v) {
    const float length = glm::length(vec3Of(v));
    return isFinite(v, 3) && length > 0.99f && length < 1.01f;
}
bool isLight(const float* v, size_t count) {
    return isFinite(v, count) && std::all_of(v, v + count, [](float x) { return x >= 0; });
}

GuestMaterial materialOf(const AgiMaterial& m) {
    refuseUnless(isLight(m.albedo, 3), "a material's albedo is not finite or is negative");
    refuseUnless(!m.albedoMap || isLight(m.albedoMapMean, 3),
                 "a material's albedoMapMean is not finite or is negative");
    refuseUnless(m.alphaCutoff >= 0 && m.alphaCutoff <= 1, "a material's alphaCutoff is not between 0 and 1");
    refuseUnless(m.coverage >= 0 && m.coverage <= 1, "a material's coverage is not between 0 and 1");
    refuseUnless(isLight(m.emissive, 3), "a material's emissive is not finite or is negative");
    return {.albedo = vec3Of(m.albedo),
            .mean = vec3Of(m.albedoMapMean),
            .map = m.albedoMap,
            .alphaCutoff = m.albedoMap ? m.alphaCutoff : 0,
            .coverage = m.coverage,
            .doubleSided = m.doubleSided != 0,
            .emissive = vec3Of(m.emissive)};
}

template <class T>
std::vector<T> copyOf(const void* from, uint32_t stride, uint32_t count) {
    const gi::Strided<T> items{static_cast<const std::byte*>(from), stride};
    std::vector<T> out(count);
    for (uint32_t i = 0; i < count; ++i)
        out[i] = items[i];
    return out;
}

GuestMesh meshOf(const AgiMesh& m, size_t materials) {
    refuseUnless(bool(m.vertexBuffer) == bool(m.indexBuffer),
                 "a mesh has a vertex or an index buffer, not both");
    refuseUnless(m.positions && m.normals && m.indices, "a mesh's host memory is null");
    refuseUnless(m.vertexCount > 0 && m.indexCount > 0 && m.indexCount % 3 == 0,
                 "a mesh has no vertices, or not three indices a triangle");
    refuseUnless(m.positionStride >= 12 && m.normalStride >= 12 && (m.uvStride == 0 || m.uvStride >= 8),
                 "a mesh's stride is shorter than what it strides over");
    refuseUnless(m.indexType == VK_INDEX_TYPE_UINT16 || m.indexType == VK_INDEX_TYPE_UINT32,
                 "a mesh's indices are neither UINT16 nor UINT32");
    refuseUnless(m.material < materials, "a mesh's material is none of the scene's");
    GuestMesh mesh{.given = m};
    mesh.positions = copyOf<glm::vec3>(m.positions, m.positionStride, m.vertexCount);
    mesh.normals = copyOf<glm::vec3>(m.normals, m.normalStride, m.vertexCount);
    if (m.uvs && m.uvStride > 0) mesh.uvs = copyOf<glm::vec2>(m.uvs, m.uvStride, m.vertexCount);
    if (m.indexType == VK_INDEX_TYPE_UINT32) {
        mesh.indices = copyOf<uint32_t>(m.indices, 4, m.indexCount);
    } else {
        const std::vector<uint16_t> narrow = copyOf<uint16_t>(m.indices, 2, m.indexCount);
        mesh.indices.assign(narrow.begin(), narrow.end());
    }
    for (const uint32_t index : mesh.indices)
        refuseUnless(index < m.vertexCount, "a mesh's index is past its vertices");
    for (size_t i = 0; m.clockwise && i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i], mesh.indices[i + 1]);
    for (const glm::vec3& p : mesh.positions) {
        refuseUnless(isFinite(&p.x, 3), "a mesh's position is not finite");
        mesh.bounds.add(p);
    }
    for (glm::vec3& n : mesh.normals)
        if (!isFinite(&n.x, 3)) n = glm::vec3(0);
    mesh.given.positions = mesh.given.normals = mesh.given.uvs = mesh.given.indices = nullptr;
    return mesh;
}

GuestInstance instanceOf(const AgiInstance& i, const GuestScene& scene) {
    refuseUnless(i.mesh < scene.meshes().size() && scene.meshes()[i.mesh].there,
                 "an instance's mesh is none of the scene's");
    refuseUnless(isFinite(i.position, 3) && isFinite(i.linear, 9), "an instance's transform is not finite");
    GuestInstance out{.id = i.id, .mesh = i.mesh, .movable = i.movable != 0, .position = dvec3Of(i.position)};
    for (int column = 0; column < 3; ++column)
        out.linear[column] = vec3Of(i.linear + 3 * column);
    return out;
}

GuestLight lightOf(const AgiLight& l) {
    refuseUnless(l.kind >= AGI_LIGHT_DIRECTIONAL && l.kind <= AGI_LIGHT_SPOT, "a light's kind is none");
    refuseUnless(isFinite(l.position, 3), "a light's position is not finite");
    refuseUnless(isLight(l.intensity, 3) && isLight(&l.range, 1) && isLight(&l.budgetShare, 1),
                 "a light's intensity, range or budgetShare is not finite or is negative");
    refuseUnless(l.kind == AGI_LIGHT_POINT || isDirection(l.direction),
                 "a light's direction is not a unit vector");
    refuseUnless(l.kind != AGI_LIGHT_SPOT || (l.innerAngle >= 0 && l.innerAngle <= l.outerAngle &&
                                              l.outerAngle < std::numbers::pi_v<float> / 2),
                 "a spot's angles are not 0 <= innerAngle <= outerAngle < pi/2");
    refuseUnless(l.mapSize == 0 || (l.mapSize >= 32 && l.mapSize <= 1024),
                 "a light's mapSize is not 32 to 1024");
    return {.light = {.kind = LightKind(l.kind),
                      .direction = l.kind == AGI_LIGHT_POINT ? glm::vec3(0, -1, 0) : vec3Of(l.direction),
                      .intensity = vec3Of(l.intensity),
                      .range = l.range,
                      .innerConeAngle = l.innerAngle,
                      .outerConeAngle = l.outerAngle,
                      .resolution = l.mapSize ? l.mapSize : 512,
                      .budgetShare = l.budgetShare,
                      .id = l.id},
            .position = dvec3Of(l.position)};
}

bool isRotation(const float* m) {
    const glm::vec3 x = vec3Of(m), y = vec3Of(m + 3), z = vec3Of(m + 6);
    const glm::vec3 lengths(glm::length(x), glm::length(y), glm::length(z));
    const glm::vec3 skew(glm::dot(x, y), glm::dot(y, z), glm::dot(z, x));
    return isFinite(m, 9) && glm::all(glm::lessThan(glm::abs(lengths - 1.0f), glm::vec3(1e-3f))) &&
           glm::all(glm::lessThan(glm::abs(skew), glm::vec3(1e-3f)));
}

// The picture of a sky, and where it points.
GuestSky skyOf(const AgiSky& s) {
    const bool single = s.width == 1 && s.height == 1;
    refuseUnless(single || (s.width == 2 * s.height && s.height > 0 && s.height <= 8192),
                 "a sky is neither a single texel nor twice as wide as high, at most 16384 texels");
    refuseUnless(s.radiance != nullptr, "a sky's radiance is null");
    const float* const turn = s.worldFromPicture;
    const bool turned = std::any_of(turn, turn + 9, [](float x) { return x != 0; });
    refuseUnless(!turned || isRotation(turn), "a sky's worldFromPicture is neither zero nor a rotation");
    std::vector<glm::vec3> radiance(size_t(s.width) * s.height);
    GuestSky sky;
    for (size_t i = 0; i < radiance.size(); ++i) {
        radiance[i] = vec3Of(s.radiance + 3 * i);
        for (int c = 0; c < 3; ++c)
            refuseUnless(radiance[i][c] >= 0 && radiance[i][c] <= kMostSkyRadiance,
                         "a sky's radiance is not 0 to 1e6");
        sky.mean += std::max({radiance[i].x, radiance[i].y, radiance[i].z}) / float(radiance.size());
    }
    gi::SkyPicture picture{.size = {int(s.width), int(s.height)}, .radiance = radiance};
    if (turned) picture.worldFromPicture = glm::mat3(vec3Of(turn), vec3Of(turn + 3), vec3Of(turn + 6));
    sky.table = gi::makeSkyTable(picture, 1);
    sky.version = hashBytes(std::as_bytes(std::span(sky.table.texels))) | 1;
    return sky;
}

bool isPerspective(const float* m) {
    return isFinite(m, 16) && m[3] == 0 && m[7] == 0 && std::abs(m[11]) == 1 && m[15] == 0 && m[0] != 0 &&
           m[5] != 0 && m[14] != 0;
}

void refuseBadImages(const AgiFrame& f) {
    refuseUnless(f.depth.view && f.normal.view && f.irradiance.view && f.irradiance.image,
                 "a frame lacks its depth, normal or irradiance image");
    refuseUnless(f.irradiance.format == VK_FORMAT_R16G16B16A16_SFLOAT &&
                     (!f.gloss.view || f.gloss.format == VK_FORMAT_R16G16B16A16_SFLOAT),
                 "results are R16G16B16A16_SFLOAT");
    refuseUnless(!f.gloss.view || (f.baseColor.view && f.roughnessMetallic.view),
                 "gloss needs baseColor and roughnessMetallic");
    refuseUnless(f.normalEncoding >= 0 && f.normalEncoding <= AGI_NORMAL_OCTAHEDRAL_UNSIGNED,
                 "a frame's normalEncoding is none");
    refuseUnless(f.roughnessChannel < 4 && f.metallicChannel < 4, "a channel is 0 to 3");
}

// Of each item, as large as the host knows it.
template <class To, class From, class Convert>
std::vector<To> allOf(uint32_t count, const From* items, const char* areNull, Convert&& convert) {
    std::vector<To> out;
    out.reserve(count);
    for (uint32_t i = 0; i < count; ++i)
        out.push_back(convert(wholeOf(items, i, areNull)));
    return out;
}

}  // namespace

std::vector<GuestMaterial> materialsOf(uint32_t count, const AgiMaterial* materials) {
    return allOf<GuestMaterial>(count, materials, "materials are null", materialOf);
}

std::vector<GuestMesh> meshesOf(uint32_t count, const AgiMesh* meshes, size_t materials) {
    return allOf<GuestMesh>(count, meshes, "meshes are null",
                            [&](const AgiMesh& m) { return meshOf(m, materials); });
}

std::vector<GuestInstance> instancesOf(uint32_t count, const AgiInstance* instances,
                                       const GuestScene& scene) {
    return allOf<GuestInstance>(count, instances, "instances are null",
                                [&](const AgiInstance& i) { return instanceOf(i, scene); });
}

std::vector<GuestLight> lightsOf(uint32_t count, const AgiLight* lights) {
    return allOf<GuestLight>(count, lights, "lights are null", lightOf);
}

std::vector<GuestProbe> probesOf(uint32_t count, const AgiProbe* given) {
    refuseUnless(count <= gi::kMostProbes, "there are more than 4096 probes");
    std::vector<GuestProbe> probes;
    for (const AgiProbe& p : std::span(given, count)) {
        const bool any = vec3Of(p.normal) == glm::vec3(0);
        refuseUnless(isFinite(p.position, 3) && (any || isDirection(p.normal)),
                     "a probe's position is not finite, or its normal neither zero nor a unit vector");
        probes.push_back({p.id, dvec3Of(p.position), vec3Of(p.normal)});
    }
    return probes;
}

GuestSky skyOf(const AgiSky* given) {
    return given ? skyOf(whole(given, "sky is null")) : GuestSky{};
}

void refuseBadFrame(const AgiFrame& f, uint64_t lastFrame) {
    refuseUnless(f.frame > 0 && f.frame >= lastFrame, "frames' numbers grow from 1");
    refuseUnless(f.framesDone < f.frame, "a frame that is being recorded cannot be done");
    refuseUnless(f.width > 0 && f.height > 0 && f.width <= 16384 && f.height <= 16384,
                 "a frame's width or height is not 1 to 16384");
    refuseUnless(isFinite(f.cameraPosition, 3), "a frame's cameraPosition is not finite");
    refuseUnless(isRotation(f.viewFromWorld), "a frame's viewFromWorld is not a rotation");
    refuseUnless(isPerspective(f.clipFromView), "a frame's clipFromView is not a perspective");
    refuseUnless(isFinite(f.jitter, 2), "a frame's jitter is not finite");
    refuseBadImages(f);
}

}  // namespace ag::guest
