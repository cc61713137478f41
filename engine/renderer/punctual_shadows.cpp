#include "engine/renderer/punctual_shadows.h"

#include <algorithm>

#include "engine/core/check.h"
#include "engine/renderer/scene_draws.h"
#include "gi/light_views.h"

namespace ag::render {
namespace {

constexpr uint32_t kFaces = 6;

// Three by two faces a place; all fit as soon as the faces are small enough.
struct Places {
    uint32_t face = 0;  // texels along a side
    uint32_t columns = 1, count = 0;
    glm::uvec2 origin(uint32_t place) const {
        return glm::uvec2(place % columns * 3, place / columns * 2) * face;
    }
    glm::uvec2 size() const { return glm::uvec2(columns * 3, (count + columns - 1) / columns * 2) * face; }
};

Places placesFor(uint32_t count, const PunctualShadowSettings& s) {
    for (uint32_t face = s.faceResolution; face > 16; face /= 2) {
        const uint32_t columns = s.atlasSize / (3 * face), rows = s.atlasSize / (2 * face);
        if (columns * rows >= count) return {face, std::min(columns, count), count};
    }
    return {16, s.atlasSize / 48, count};
}

uint64_t ownerOf(const RenderScene& scene, const LightCluster& cluster) {
    return scene.lights[cluster.center].id + 1;  // 0 is nobody
}

// Centres of before keep their places, the others take free ones. There are as many places as clusters may
// be.
void assignPlaces(const RenderScene& scene, const LightClusters& clusters, uint32_t count,
                  PunctualShadowHistory& h) {
    h.owners.resize(count, 0);
    for (uint64_t& owner : h.owners)
        if (std::ranges::none_of(clusters.clusters,
                                 [&](const LightCluster& c) { return ownerOf(scene, c) == owner; }))
            owner = 0;
    h.places.resize(clusters.clusters.size());
    for (size_t i = 0; i < clusters.clusters.size(); ++i) {
        const uint64_t id = ownerOf(scene, clusters.clusters[i]);
        auto place = std::ranges::find(h.owners, id);
        if (place == h.owners.end()) place = std::ranges::find(h.owners, uint64_t(0));
        AG_CHECK_MSG(place != h.owners.end(), "more clusters than places");
        *place = id;
        h.places[i] = uint32_t(place - h.owners.begin());
    }
}

// What shading knows of a cluster's map.
io::LightClusterRow rowOf(const RenderScene& scene, const LightCluster& cluster, const Places& places,
                          uint32_t place) {
    const RenderLight& light = scene.lights[cluster.center];
    const bool spot = isSpotCluster(scene, cluster);
    // All of the cluster's punctual lights see by this map.
    const float far = gi::farDistanceOf(light.position, cluster.reach, scene.bounds);
    return {
        .center = light.position,
        .radius = cluster.radius,
        .direction = spot ? light.direction : glm::vec3(0),
        .tanHalf = spot ? gi::spotView(light.position, light.direction, light.outerConeAngle, 1).tanHalf : 1,
        .origin = places.origin(place),
        .size = spot ? 2 * places.face : places.face,
        .nearDistance = gi::kNearOfFar * far,
        .farDistance = far};
}

// What the camera sees of the scene; its frustum has no end.
gi::Frustum seenPart(const RenderScene& scene) {
    const glm::vec3 far = glm::max(glm::abs(scene.bounds.min - scene.camera.position),
                                   glm::abs(scene.bounds.max - scene.camera.position));
    return gi::frustumOf(scene.camera.clipFromWorld, scene.camera.near / std::max(glm::length(far), 1.0f));
}

PassBuilder beginFaces(GraphScope scope, const SceneView& scene, ImageHandle atlas) {
    // Masked surfaces need their textures, and then all are drawn with them.
    const bool masked = hasMasked(scene);
    PassBuilder pass = masked ? scope.raster("punctual_shadows.faces", "shadow_maps/masked.vert",
                                             "shadow_maps/masked.frag", gpu::VertexLayout::kPositionsAndUvs)
                              : scope.raster("punctual_shadows.faces", "shadow_maps/depth.vert", "",
                                             gpu::VertexLayout::kPositions);
    pass.depthPatches(atlas)
        .geometry(scene.geometry)
        .read("instances", scene.instances)
        .read("drawnRows", scene.drawnRows);
    if (masked) bindMaterials(pass, scene);
    return pass;
}

}  // namespace

bool isSpotCluster(const RenderScene& scene, const LightCluster& cluster) {
    return cluster.lightCount == 1 && scene.lights[cluster.center].kind == LightKind::kSpot;
}

PunctualShadows addPunctualShadows(GraphScope scope, const SceneView& scene, const LightClusters& clusters,
                                   uint32_t mostClusters, const PunctualShadowSettings& settings,
                                   PunctualShadowHistory& history) {
    const RenderScene& s = *scene.scene;
    const Places places = placesFor(mostClustersNeeded(s, mostClusters), settings);
    if (clusters.clusters.empty() || s.instances.empty()) return {};
    assignPlaces(s, clusters, places.count, history);
    PunctualShadows shadows{.atlas = scope.image("punctual_shadows.atlas",
                                                 {.format = VK_FORMAT_D32_SFLOAT, .size = places.size()}),
                            .softTaps = settings.softTaps,
                            .places = places.count};
    history.rows.clear();
    history.views.clear();
    history.rects.clear();
    PassBuilder pass = beginFaces(scope, scene, shadows.atlas);
    // A point's shadow at what the camera sees is in faces whose view meets the camera's; a disk's taps may
    // leave them.
    const bool onlySeen = settings.softTaps == 0;
    const gi::Frustum seen = seenPart(s);
    const auto lightOf = [&](size_t i) -> const RenderLight& {
        return s.lights[clusters.clusters[i].center];
    };
    const DrawFilter filter = hasMasked(scene) ? DrawFilter::kAll : DrawFilter::kOpaqueOnly;
    for (size_t i = 0; i < clusters.clusters.size(); ++i) {
        const uint32_t place = history.places[i];
        const io::LightClusterRow& row =
            history.rows.emplace_back(rowOf(s, clusters.clusters[i], places, place));
        const bool spot = isSpotCluster(s, clusters.clusters[i]);
        for (uint32_t face = 0; face < (spot ? 1 : kFaces); ++face) {
            const gi::LightView view =
                spot ? gi::spotView(row.center, row.direction, lightOf(i).outerConeAngle, row.farDistance)
                     : gi::cubeFaceView(row.center, face, row.farDistance);
            const glm::mat4& clipFromWorld = view.clipFromWorld;
            if (onlySeen && !gi::mayMeet(seen, gi::frustumOf(clipFromWorld))) continue;
            history.views.push_back({scene.slots.firstLight + place * kFaces + face, clipFromWorld});
            history.rects.emplace_back(row.origin + glm::uvec2(face % 3, face / 3) * row.size, row.size,
                                       row.size);
        }
    }
    scene.draws->cullAll(s, history.views);
    for (size_t i = 0; i < history.views.size(); ++i) {
        const ViewRequest& view = history.views[i];
        pass.patch(history.rects[i]);
        drawView(pass, scene, scene.draws->cull(s, view.slot, view.clipFromWorld), view.clipFromWorld,
                 {.viewport = history.rects[i], .filter = filter});
    }
    const std::span<const std::byte> bytes = std::as_bytes(std::span(history.rows));
    shadows.clusters =
        scope.buffer("punctual_shadows.clusters", {.sizeBytes = places.count * sizeof(io::LightClusterRow),
                                                   .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.upload("punctual_shadows.clusters", shadows.clusters, bytes);
    return shadows;
}

}  // namespace ag::render
