#include "gi/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "gi/cascades.h"
#include "gi/scene_draws.h"

namespace ag::gi {
namespace {

struct Atlas {
    uint32_t tile = 0;  // texels of a view's place
    uint32_t columns = 1;
    uint32_t count = 0;
    glm::uvec2 place(uint32_t i) const { return glm::uvec2(i % columns, i / columns) * tile; }
    glm::uvec2 size() const { return glm::uvec2(columns, (count + columns - 1) / columns) * tile; }
};

Atlas atlasOf(uint32_t tile, uint32_t count) {
    uint32_t columns = 1;
    while (columns * columns < count)
        ++columns;
    return {tile, columns, count};
}

struct Views {
    std::array<io::ShadowView, io::kMaxShadowViews> items{};
    uint32_t count = 0;
};

constexpr float kLeastSplit = 1.0f / 100;  // the first cascade ends no nearer, of the way to the last

// Where the scene ends, seen from the camera.
float sceneReach(const RenderScene& scene) {
    const glm::vec3 c = scene.camera.position;
    const glm::vec3 far = glm::max(glm::abs(scene.bounds.min - c), glm::abs(scene.bounds.max - c));
    return std::max(glm::length(far), 2 * scene.camera.near);
}

void addSunViews(const SceneView& scene, const RenderLight& light, const ShadowMapSettings& settings,
                 Views& views) {
    const RenderCamera& camera = scene.scene->camera;
    const float aspect = float(scene.size.x) / float(scene.size.y);
    const uint32_t count = std::clamp(settings.cascades, 1u, io::kMaxCascades);
    const float whole = sceneReach(*scene.scene), reach = whole * settings.cascadeReach;
    float begin = camera.near;
    for (uint32_t i = 0; i < count; ++i) {
        const float split =
            cascadeEnd(i, count, std::max(camera.near, kLeastSplit * reach), reach, settings.cascadeSplit);
        const float end = i + 1 == count ? whole : split;  // beyond it nothing would cast a shadow
        const Cascade c = fitCascade(camera, aspect, light.direction, scene.scene->bounds, scene.extent,
                                     begin, end, settings.resolution);
        views.items[views.count++] = {
            .clipFromWorld = c.clipFromWorld,
            .size = settings.resolution,
            .texelSize = std::sqrt(c.size.x * c.size.y) / float(settings.resolution),
            .farDistance = c.farDistance};
        begin = end;
    }
}

ImageHandle addAtlas(FrameGraph& graph, const SceneView& scene, std::span<io::ShadowView> views,
                     uint32_t tile) {
    const Atlas atlas = atlasOf(tile, uint32_t(views.size()));
    const ImageHandle image =
        graph.image("shadow_maps.atlas", {.format = VK_FORMAT_D32_SFLOAT, .size = atlas.size()});
    PassBuilder opaque =
        graph.raster("shadow_maps.cascades", "shadow_maps/depth.vert", "", gpu::VertexLayout::kPositions);
    opaque.depthClear(image).geometry(scene.geometry).read("instances", scene.instances);
    std::array<ViewRequest, io::kMaxShadowViews> requests;
    for (uint32_t v = 0; v < views.size(); ++v)
        requests[v] = {scene.viewsClaimed + v, views[v].clipFromWorld};
    scene.draws->cullAll(*scene.scene, {requests.data(), views.size()});
    for (uint32_t v = 0; v < views.size(); ++v) {
        io::ShadowView& view = views[v];
        view.origin = atlas.place(v);
        const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.claimView(), view.clipFromWorld);
        drawView(opaque, scene, draws, view.clipFromWorld, {view.origin, view.size, view.size},
                 DrawFilter::kOpaqueOnly, Viewer::kLight);
    }
    return image;
}

// Masked surfaces need their textures: a second pass over the same atlas, only where the scene has any.
void addMasked(FrameGraph& graph, const SceneView& scene, ImageHandle image,
               std::span<const io::ShadowView> views, uint32_t firstSlot) {
    if (!hasMasked(scene)) return;
    PassBuilder masked = graph.raster("shadow_maps.cascades_masked", "shadow_maps/masked.vert",
                                      "shadow_maps/masked.frag", gpu::VertexLayout::kPositionsAndUvs);
    masked.depth(image).geometry(scene.geometry).read("instances", scene.instances);
    bindMaterials(masked, scene);
    for (uint32_t v = 0; v < views.size(); ++v)
        drawView(masked, scene, scene.draws->cull(*scene.scene, firstSlot + v, views[v].clipFromWorld),
                 views[v].clipFromWorld, {views[v].origin, views[v].size, views[v].size},
                 DrawFilter::kMaskedOnly, Viewer::kLight);
}

}  // namespace

ShadowMaps addSunShadows(FrameGraph& graph, const SceneView& scene, const ShadowMapSettings& settings) {
    ShadowMaps maps;
    Views views;
    const auto& lights = scene.scene->lights;
    for (uint32_t i = 0; i < lights.size() && maps.sunCount < kMostSuns; ++i) {
        if (lights[i].kind != LightKind::kDirectional || lights[i].intensity == glm::vec3(0)) continue;
        SunShadow& sun = maps.suns[maps.sunCount++] = {.light = i, .firstView = views.count};
        if (!lights[i].castsShadow || scene.scene->instances.empty()) continue;
        addSunViews(scene, lights[i], settings, views);
        sun.viewCount = views.count - sun.firstView;
    }
    if (views.count == 0) return maps;
    const std::span all(views.items.data(), views.count);
    const uint32_t firstSlot = scene.viewsClaimed;
    maps.atlas = addAtlas(graph, scene, all, settings.resolution);
    addMasked(graph, scene, maps.atlas, all, firstSlot);
    maps.views = graph.buffer("shadow_maps.views", {.sizeBytes = sizeof views.items});
    graph.upload("shadow_maps.views", maps.views, std::as_bytes(std::span(views.items)));
    return maps;
}

}  // namespace ag::gi
