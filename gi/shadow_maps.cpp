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

uint32_t viewsOf(const RenderLight& light, const ShadowMapSettings& settings) {
    if (!light.castsShadow || light.intensity == glm::vec3(0)) return 0;
    if (light.kind == LightKind::kPoint) return 6;
    return light.kind == LightKind::kSpot ? 1 : std::clamp(settings.cascades, 1u, io::kMaxCascades);
}

void addLampViews(const RenderScene& scene, const RenderLight& light, const ShadowMapSettings& settings,
                  Views& views) {
    const float far = farDistanceOf(light, scene.bounds);
    const bool point = light.kind == LightKind::kPoint;
    const uint32_t size = point ? settings.resolution / 2 : settings.resolution;
    for (uint32_t face = 0; face < (point ? 6u : 1u); ++face) {
        const LightView view = point ? cubeFaceView(light.position, face, settings.nearDistance, far)
                                     : spotView(light, settings.nearDistance, far);
        views.items[views.count++] = {
            .clipFromWorld = view.clipFromWorld, .size = size, .texelSize = 2 * view.tanHalf / float(size)};
    }
}

// The last cascade ends where the scene does.
float cascadeReach(const RenderScene& scene, const ShadowMapSettings& settings) {
    const glm::vec3 c = scene.camera.position;
    const glm::vec3 far = glm::max(glm::abs(scene.bounds.min - c), glm::abs(scene.bounds.max - c));
    return std::clamp(glm::length(far), 1.0f, settings.cascadeDistance);
}

void addSunViews(const SceneView& scene, const RenderLight& light, const ShadowMapSettings& settings,
                 Views& views) {
    const RenderCamera& camera = scene.scene->camera;
    const float aspect = float(scene.size.x) / float(scene.size.y);
    const uint32_t count = viewsOf(light, settings);
    const float reach = cascadeReach(*scene.scene, settings);
    float begin = camera.near;
    for (uint32_t i = 0; i < count; ++i) {
        const float end = cascadeEnd(i, count, std::max(camera.near, 0.5f), reach, settings.cascadeSplit);
        const Cascade c =
            fitCascade(camera, aspect, light.direction, scene.scene->bounds, begin, end, settings.resolution);
        views.items[views.count++] = {
            .clipFromWorld = c.clipFromWorld,
            .size = settings.resolution,
            .texelSize = std::sqrt(c.size.x * c.size.y) / float(settings.resolution),
            .farDistance = c.farDistance};
        begin = end;
    }
}

ImageHandle addAtlas(FrameGraph& graph, const SceneView& scene, const char* passName, const char* imageName,
                     std::span<io::ShadowView> views, uint32_t tile) {
    if (views.empty()) return {};
    const Atlas atlas = atlasOf(tile, uint32_t(views.size()));
    const ImageHandle image = graph.image(imageName, {.format = VK_FORMAT_D32_SFLOAT, .size = atlas.size()});
    PassBuilder opaque = graph.raster(passName, "shadow_maps/depth.vert", "", gpu::VertexLayout::kPositions);
    opaque.depthClear(image).geometry(scene.geometry).read("instances", scene.instances);
    for (uint32_t v = 0; v < views.size(); ++v) {
        io::ShadowView& view = views[v];
        view.origin = atlas.place(v);
        const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.claimView(), view.clipFromWorld);
        drawView(opaque, scene, draws, view.clipFromWorld, {view.origin, view.size, view.size},
                 DrawFilter::kOpaqueOnly, Viewer::kLight);
    }
    return image;
}

bool anyMasked(const SceneView& scene) {
    return std::ranges::any_of(scene.draws->buckets(), [](const DrawBucket& b) { return b.alphaMask; });
}

// Masked surfaces need their textures: a second pass over the same atlas, only where the scene has any.
void addMasked(FrameGraph& graph, const SceneView& scene, const char* passName, ImageHandle image,
               std::span<const io::ShadowView> views, uint32_t firstSlot) {
    if (views.empty() || !anyMasked(scene)) return;
    PassBuilder masked = graph.raster(passName, "shadow_maps/masked.vert", "shadow_maps/masked.frag",
                                      gpu::VertexLayout::kPositionsAndAttributes);
    masked.depth(image).geometry(scene.geometry).read("instances", scene.instances);
    bindMaterials(masked, scene);
    for (uint32_t v = 0; v < views.size(); ++v)
        drawView(masked, scene, scene.draws->cull(*scene.scene, firstSlot + v, views[v].clipFromWorld),
                 views[v].clipFromWorld, {views[v].origin, views[v].size, views[v].size},
                 DrawFilter::kMaskedOnly, Viewer::kLight);
}

}  // namespace

ShadowMaps addShadowMaps(FrameGraph& graph, const SceneView& scene, const ShadowMapSettings& settings) {
    ShadowMaps maps;
    Views views;
    const auto& lights = scene.scene->lights;
    const auto assign = [&](bool sun) {
        for (size_t i = 0; i < std::min<size_t>(lights.size(), io::kMaxLights); ++i) {
            const uint32_t count = viewsOf(lights[i], settings);
            const bool isSun = lights[i].kind == LightKind::kDirectional;
            if (count == 0 || isSun != sun || views.count + count > io::kMaxShadowViews) continue;
            maps.lights[i] = {views.count, count};
            if (sun)
                addSunViews(scene, lights[i], settings, views);
            else
                addLampViews(*scene.scene, lights[i], settings, views);
        }
    };
    assign(false);
    const uint32_t lampViews = views.count;
    assign(true);
    if (views.count == 0 || scene.scene->instances.empty()) return {};

    const std::span all(views.items.data(), views.count);
    const uint32_t lampSlot = scene.viewsClaimed;
    maps.lampAtlas = addAtlas(graph, scene, "shadow_maps.lamps", "shadow_maps.lamp_atlas",
                              all.first(lampViews), settings.resolution);
    addMasked(graph, scene, "shadow_maps.lamps_masked", maps.lampAtlas, all.first(lampViews), lampSlot);
    const uint32_t sunSlot = scene.viewsClaimed;
    maps.sunAtlas = addAtlas(graph, scene, "shadow_maps.suns", "shadow_maps.sun_atlas",
                             all.subspan(lampViews), settings.resolution);
    addMasked(graph, scene, "shadow_maps.suns_masked", maps.sunAtlas, all.subspan(lampViews), sunSlot);
    maps.views = graph.buffer("shadow_maps.views", {.sizeBytes = all.size_bytes()});
    graph.upload("shadow_maps.views", maps.views, std::as_bytes(all));
    return maps;
}

}  // namespace ag::gi
