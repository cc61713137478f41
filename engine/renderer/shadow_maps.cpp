#include "engine/renderer/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"
#include "engine/renderer/cascades.h"
#include "engine/renderer/scene_draws.h"

namespace ag::render {
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
    const float aspect = float(scene.grid.output.x) / float(scene.grid.output.y);
    const uint32_t count = std::clamp(settings.cascades, 1u, io::kMaxCascades);
    const float whole = sceneReach(*scene.scene), reach = whole * settings.cascadeReach;
    float begin = camera.near;
    for (uint32_t i = 0; i < count; ++i) {
        const float split =
            cascadeEnd(i, count, std::max(camera.near, kLeastSplit * reach), reach, settings.cascadeSplit);
        const float end = i + 1 == count ? whole : split;  // beyond it nothing would cast a shadow
        const Cascade c = fitCascade({.camera = camera, .aspect = aspect, .near = begin, .far = end},
                                     light.direction, scene.scene->bounds, scene.extent, settings.resolution);
        views.items[views.count++] = {
            .clipFromWorld = c.clipFromWorld,
            .size = settings.resolution,
            .texelSize = std::sqrt(c.size.x * c.size.y) / float(settings.resolution),
            .farDistance = c.farDistance};
        begin = end;
    }
}

// The views' places in the atlas, and what each draws.
struct Cascades {
    std::span<io::ShadowView> views;
    std::array<const ViewDraws*, io::kMaxShadowViews> draws{};
    glm::uvec2 atlasSize{0};
};

Cascades cullCascades(const SceneView& scene, std::span<io::ShadowView> views, uint32_t tile) {
    const Atlas atlas = atlasOf(tile, uint32_t(views.size()));
    Cascades c{.views = views, .atlasSize = atlas.size()};
    const uint32_t slot = scene.slots.firstCascade;
    std::array<ViewRequest, io::kMaxShadowViews> requests;
    for (uint32_t v = 0; v < views.size(); ++v)
        requests[v] = {slot + v, views[v].clipFromWorld};
    scene.draws->cullAll(*scene.scene, {requests.data(), views.size()});
    for (uint32_t v = 0; v < views.size(); ++v) {
        views[v].origin = atlas.place(v);
        c.draws[v] = &scene.draws->cull(*scene.scene, slot + v, views[v].clipFromWorld);
    }
    return c;
}

struct LayerNames {
    std::string_view opaque, masked;
};
constexpr LayerNames kAllNames = {"shadow_maps.cascades", "shadow_maps.cascades_masked"};
constexpr LayerNames kStaticNames = {"shadow_maps.static", "shadow_maps.static_masked"};
constexpr LayerNames kMovableNames = {"shadow_maps.movable", "shadow_maps.movable_masked"};

void drawCascades(PassBuilder& pass, const SceneView& scene, const Cascades& c, DrawFilter filter,
                  DrawLayer layer) {
    for (size_t v = 0; v < c.views.size(); ++v)
        drawView(pass, scene, *c.draws[v], c.views[v].clipFromWorld,
                 {.viewport = {c.views[v].origin, c.views[v].size, c.views[v].size},
                  .filter = filter,
                  .layer = layer});
}

// Masked surfaces need their textures: a second pass over the same atlas, only where the scene has any.
void addLayer(GraphScope scope, const SceneView& scene, const Cascades& c, DrawLayer layer,
              const LayerNames& names, ImageHandle image) {
    PassBuilder opaque =
        scope.raster(names.opaque, "shadow_maps/depth.vert", "", gpu::VertexLayout::kPositions);
    if (layer == DrawLayer::kMovable)
        opaque.depth(image);  // over what is static
    else
        opaque.depthClear(image);
    opaque.geometry(scene.geometry).read("instances", scene.instances).read("drawnRows", scene.drawnRows);
    drawCascades(opaque, scene, c, DrawFilter::kOpaqueOnly, layer);
    if (!hasMasked(scene)) return;
    PassBuilder masked = scope.raster(names.masked, "shadow_maps/masked.vert", "shadow_maps/masked.frag",
                                      gpu::VertexLayout::kPositionsAndUvs);
    masked.depth(image)
        .geometry(scene.geometry)
        .read("instances", scene.instances)
        .read("drawnRows", scene.drawnRows);
    bindMaterials(masked, scene);
    drawCascades(masked, scene, c, DrawFilter::kMaskedOnly, layer);
}

// Where the views or what is static changes from frame to frame, a layer of it would not last.
bool chooseLayered(const Cascades& c, SunShadowHistory& h) {
    uint64_t staticHash = hashBytes(std::as_bytes(c.views)), movable = 0;
    for (size_t v = 0; v < c.views.size(); ++v) {
        staticHash = combineHash(staticHash, c.draws[v]->staticVersion);
        movable = combineHash(movable, c.draws[v]->movableVersion);
    }
    if (staticHash != h.staticHash)
        h.layered = false;
    else if (movable != h.movableHash)
        h.layered = true;
    h.staticHash = staticHash;
    h.movableHash = movable;
    return h.layered;
}

ImageHandle addAtlas(GraphScope scope, const SceneView& scene, const Cascades& c, SunShadowHistory& history) {
    const ImageInfo info{.format = VK_FORMAT_D32_SFLOAT, .size = c.atlasSize};
    const ImageHandle atlas = scope.image("shadow_maps.atlas", info);
    if (!chooseLayered(c, history)) {
        addLayer(scope, scene, c, DrawLayer::kAll, kAllNames, atlas);
        return atlas;
    }
    const ImageHandle staticAtlas = scope.image("shadow_maps.static_atlas", info);
    addLayer(scope, scene, c, DrawLayer::kStatic, kStaticNames, staticAtlas);
    scope.copyImage("shadow_maps.copy", staticAtlas, atlas);
    addLayer(scope, scene, c, DrawLayer::kMovable, kMovableNames, atlas);
    return atlas;
}

}  // namespace

ShadowMaps addSunShadows(GraphScope scope, const SceneView& scene, const ShadowMapSettings& settings,
                         SunShadowHistory& history) {
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
    maps.atlas = addAtlas(scope, scene, cullCascades(scene, all, settings.resolution), history);
    maps.views = scope.buffer("shadow_maps.views", {.sizeBytes = sizeof views.items});
    scope.upload("shadow_maps.views", maps.views, std::as_bytes(std::span(views.items)));
    return maps;
}

}  // namespace ag::render
