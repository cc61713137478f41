#include "engine/renderer/blended_layers.h"

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "engine/renderer/indirect_light.h"

namespace ag::render {
namespace {

constexpr std::array<std::string_view, kMostBlendedLayers> kLayerScopes = {"blended0", "blended1", "blended2",
                                                                           "blended3"};
constexpr std::array<std::string_view, kMostBlendedLayers> kLayerMaps = {"layer0", "layer1", "layer2",
                                                                         "layer3"};
constexpr std::array<std::string_view, kMostBlendedLayers> kVeilMaps = {"veil0", "veil1", "veil2", "veil3"};
constexpr uint32_t kSteps = 4;             // of a window's size along an axis: images seldom change theirs
constexpr uint32_t kFramesToShrink = 120;  // after which it does
constexpr uint32_t kGrid = 32;             // pixels that its origin is a multiple of

struct Box {
    glm::vec2 low{1e30f}, high{-1e30f};  // pixels
};

// Of what is drawn, wherever jitter moves it. The whole picture where something reaches behind the near
// plane.
Box boxOnScreen(const SceneView& scene, const ViewDraws& draws) {
    constexpr float kJitter = 1;  // pixels, at most
    const RenderCamera& camera = scene.scene->camera;
    const glm::vec2 picture(scene.grid.size);
    Box box;
    for (const uint32_t row : draws.rows) {
        const Bounds b = scene.draws->boundsOf(row);
        for (uint32_t corner = 0; corner < 8; ++corner) {
            const glm::vec3 p(corner & 1 ? b.max.x : b.min.x, corner & 2 ? b.max.y : b.min.y,
                              corner & 4 ? b.max.z : b.min.z);
            const glm::vec4 h = camera.clipFromWorld * glm::vec4(p, 1);
            if (h.w < camera.near) return {glm::vec2(0), picture};
            const glm::vec2 at = (glm::vec2(h) / h.w * 0.5f + 0.5f) * picture;
            box.low = glm::min(box.low, at), box.high = glm::max(box.high, at);
        }
    }
    return {glm::clamp(glm::floor(box.low - kJitter), glm::vec2(0), picture),
            glm::clamp(glm::ceil(box.high + kJitter), glm::vec2(0), picture)};
}

PictureWindow chooseWindow(const SceneView& scene, const ViewDraws& draws, BlendedHistory& h) {
    const glm::uvec2 picture = scene.grid.size, step = (picture + kSteps - 1u) / kSteps;
    const Box box = boxOnScreen(scene, draws);
    glm::uvec2 origin = glm::uvec2(box.low) / kGrid * kGrid;
    const glm::uvec2 least = glm::max(glm::uvec2(box.high), origin + 1u) - origin;
    const glm::uvec2 fitting = glm::min((least + step - 1u) / step * step, picture);
    const glm::uvec2 before = h.size;
    const bool moved =
        std::exchange(h.cameraVersion, scene.scene->cameraVersion) != scene.scene->cameraVersion;
    h.size = glm::min(glm::max(before, fitting), picture);
    if (h.size == fitting)
        h.smallerFor = 0;
    else if (moved && ++h.smallerFor > kFramesToShrink)
        h.size = fitting;
    if (h.size != before) h.layers = {};  // their images are new
    origin = glm::min(origin, picture - h.size);
    return {origin, h.size};
}

// How many may lie one behind another: one where each is flat and alone on the screen.
uint32_t layersNeeded(const SceneView& scene, const ViewDraws& draws, uint32_t most) {
    const RenderScene& s = *scene.scene;
    const RenderInstance& first = s.instances[draws.rows.front()];
    if (draws.rows.size() > 1 || first.skinnedMesh != kNoSkinnedMesh) return most;
    const Bounds& b = s.geometry->primitives[first.primitive].boundsLocal;
    const glm::vec3 size = b.max - b.min;
    const bool flat = std::min({size.x, size.y, size.z}) < 1e-4f * std::max({size.x, size.y, size.z});
    return flat ? 1u : most;
}

struct BlendedLayer {
    BlendedSurfaces surfaces;
    ImageHandle radiance;
};
struct BlendedLayers {
    std::array<BlendedLayer, kMostBlendedLayers> items;  // the nearest first
    uint32_t count = 0;
};

// Of a layer's surfaces, as addFrame() has it of the opaque ones'.
ImageHandle addLight(GraphScope scope, const GBuffer& gbuffer, const SceneView& scene, const RenderFrame& f,
                     const LightClusters& clusters, const RenderSettings& s, BlendedLayerHistory& h) {
    const gi::Surfaces& surfaces = gbuffer.surfaces;
    const bool glossy = s.bounce.valShading.glossy;
    gi::BounceLight bounce;
    if (s.technique == Technique::kAreaLights)
        bounce = gi::addBounceLightOn(scope, surfaces, f.bounce, s.bounce);
    DirectLight direct = addSunLighting(scope, scene, surfaces, f.shadows, nullptr, glossy);
    const PunctualLights lights{
        addPunctualLists(scope, scene, surfaces, clusters, s.punctualLighting.tiles, h.punctualLists),
        f.punctual.shadows};
    direct = addPunctualLighting(scope, scene, surfaces, lights, direct, nullptr, glossy, s.punctualLighting);
    const gi::Occluders occluders = occludersOf(scene);
    const gi::SkyLight sky = gi::addSkyLight(scope, surfaces, s.bounce.spacing,
                                             {scene.sky, occluders, versionsOf(scene)}, s.bounce.sky, h.sky);
    return addRadiance(scope, gbuffer, {direct, sky, bounce, scene}, Behind::kMore);
}

// From the farthest to the nearest.
ImageHandle addOver(GraphScope scope, const BlendedLayers& layers, ImageHandle behind, glm::uvec2 origin) {
    const ImageHandle result = scope.image("composite.seen_through", scope.info(behind));
    PassBuilder pass = scope.fullscreen("composite.over", "composite/over.frag");
    pass.sample("behindMap", behind)
        .constant("kLayers", layers.count)
        .push(glm::ivec2(origin))
        .colorClear(result, glm::vec4(0));
    for (uint32_t i = 0; i < kMostBlendedLayers; ++i) {  // further ones are not read
        const BlendedLayer& layer = layers.items[std::min(i, layers.count - 1)];
        pass.sample(kLayerMaps[i], layer.radiance).sample(kVeilMaps[i], layer.surfaces.veil);
    }
    return result;
}

}  // namespace

RenderCamera windowed(const RenderCamera& camera, glm::uvec2 picture, const PictureWindow& window) {
    const glm::vec2 size(window.size), scale = glm::vec2(picture) / size,
                                       shift = scale - 2.0f * glm::vec2(window.origin) / size - 1.0f;
    const glm::mat4 move = glm::translate(glm::mat4(1), glm::vec3(shift, 0)),
                    grow = glm::scale(glm::mat4(1), glm::vec3(scale, 1)),
                    shrink = glm::scale(glm::mat4(1), glm::vec3(1.0f / scale, 1)),
                    back = glm::translate(glm::mat4(1), glm::vec3(-shift, 0));
    RenderCamera out = camera;
    out.clipFromWorld = move * grow * camera.clipFromWorld;
    out.worldFromClip = camera.worldFromClip * shrink * back;
    return out;
}

ImageHandle addBlendedLayers(GraphScope scope, const SceneView& scene, const RenderFrame& frame,
                             const LightClusters& lights, ImageHandle behind, const RenderSettings& settings,
                             BlendedHistory& history) {
    if (!scene.draws->hasBlended() || settings.blending.layers == 0) return behind;
    const ViewDraws& draws = scene.draws->blendedOf(*scene.scene, scene.slots.blended, scene.slots.camera);
    if (draws.rows.empty()) return behind;
    const PictureWindow window = chooseWindow(scene, draws, history);
    SceneView seen = scene;
    seen.grid.size = window.size;
    seen.eye = windowed(scene.eye, scene.grid.size, window);
    seen.camera = gi::addCamera(scope.nested(kLayerScopes[0]), "scene.camera", seen.eye, window.size);
    BlendedLayers layers;
    ImageHandle nearer;
    for (uint32_t count = layersNeeded(scene, draws, settings.blending.layers); layers.count < count;) {
        BlendedLayer& layer = layers.items[layers.count];
        const GraphScope own = scope.nested(kLayerScopes[layers.count]);
        const PeeledBetween between{frame.gbuffer.surfaces.depth, nearer, window.origin};
        layer.surfaces = addBlendedSurfaces(own, seen, draws, between, settings.bounce.valShading.glossy);
        layer.radiance = addLight(own, layer.surfaces.gbuffer, seen, frame, lights, settings,
                                  history.layers[layers.count]);
        nearer = layer.surfaces.gbuffer.surfaces.depth;
        ++layers.count;
    }
    return addOver(scope, layers, behind, window.origin);
}

}  // namespace ag::render
