#include "engine/renderer/gbuffer.h"

#include <utility>

#include "engine/core/hash.h"
#include "engine/renderer/scene_draws.h"

namespace ag::render {
namespace {

// Targets that a scene has no use for are not written.
std::string_view fillShader(const SceneView& scene) {
    if (scene.hasGlossy)
        return scene.hasEmissive ? "gbuffer/fill_emissive_glossy.frag" : "gbuffer/fill_glossy.frag";
    return scene.hasEmissive ? "gbuffer/fill_emissive.frag" : "gbuffer/fill.frag";
}

ImageHandle target(GraphScope scope, const SceneView& scene, std::string_view name) {
    return scope.image(name, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = scene.grid.size});
}

GBuffer targets(GraphScope scope, const SceneView& scene, bool emissive, bool glossy) {
    GBuffer g{.surfaces = {.depth = scope.image("gbuffer.depth",
                                                {.format = VK_FORMAT_D32_SFLOAT, .size = scene.grid.size}),
                           .normal = target(scope, scene, "gbuffer.normal"),
                           .albedo = target(scope, scene, "gbuffer.albedo"),
                           .size = scene.grid.size,
                           .normalMapped = scene.hasNormalMaps,
                           .view = scene.eye,
                           .camera = scene.camera}};
    if (emissive) g.emissive = target(scope, scene, "gbuffer.emissive");
    if (glossy) g.surfaces.reflectance = target(scope, scene, "gbuffer.reflectance");
    return g;
}

void drawCameras(PassBuilder& pass, const SceneView& scene, const ViewDraws& draws,
                 std::span<const std::byte> push) {
    pass.geometry(scene.geometry).read("instances", scene.instances).read("drawnRows", scene.drawnRows);
    bindMaterials(pass, scene, scene.sharp ? Sampler::kAnisotropicRepeat : Sampler::kTrilinearRepeat);
    drawView(pass, scene, draws, push, {.viewer = Viewer::kCamera});
}

const ViewDraws& seenByCamera(const SceneView& scene) {
    return scene.draws->cull(*scene.scene, scene.slots.camera, scene.eye.clipFromWorld);
}

PassBuilder fillPass(GraphScope scope, const GBuffer& g, std::string_view shader) {
    PassBuilder pass =
        scope.raster("gbuffer.fill", "gbuffer/fill.vert", shader, gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(g.surfaces.normal, glm::vec4(0)).colorClear(g.surfaces.albedo, glm::vec4(0));
    if (g.emissive) pass.colorClear(g.emissive, glm::vec4(0));
    if (g.surfaces.reflectance) pass.colorClear(g.surfaces.reflectance, glm::vec4(0));
    pass.depthClear(g.surfaces.depth);
    return pass;
}

}  // namespace

bool Standstill::next(const SceneView& scene) {
    const uint64_t now = combineHash(scene.scene->cameraVersion, seenByCamera(scene).version);
    const uint64_t before = std::exchange(before_, now);
    return before == 0 || before == now;
}

GBuffer addGBuffer(GraphScope scope, const SceneView& scene) {
    const GBuffer g = targets(scope, scene, scene.hasEmissive, scene.hasGlossy);
    const ViewDraws& draws = seenByCamera(scene);
    PassBuilder pass = fillPass(scope, g, fillShader(scene));
    drawCameras(pass, scene, draws, std::as_bytes(std::span(&scene.eye.clipFromWorld, 1)));
    return g;
}

BlendedSurfaces addBlendedSurfaces(GraphScope scope, const SceneView& scene, const ViewDraws& draws,
                                   const PeeledBetween& between, bool glossy) {
    const struct Push {
        glm::mat4 clipFromWorld;
        glm::ivec2 origin;
    } push{scene.eye.clipFromWorld, glm::ivec2(between.origin)};
    const BlendedSurfaces b{targets(scope, scene, true, true), target(scope, scene, "gbuffer.veil")};
    PassBuilder fill = fillPass(scope, b.gbuffer, "gbuffer/fill_blended.frag");
    fill.sample("opaqueDepth", between.opaque)
        .sample("nearerDepth", between.nearer ? between.nearer : between.opaque)
        .constant("kFollows", bool(between.nearer));
    drawCameras(fill, scene, draws, std::as_bytes(std::span(&push, 1)));
    PassBuilder veil = scope.raster("gbuffer.veil", "gbuffer/fill.vert", "gbuffer/veil.frag",
                                    gpu::VertexLayout::kPositionsAndAttributes);
    veil.colorClear(b.veil, glm::vec4(1, 1, 1, 0))
        .depthEqual(b.gbuffer.surfaces.depth)
        .constant("kGlossy", glossy)
        .read("camera", scene.camera);
    drawCameras(veil, scene, draws, std::as_bytes(std::span(&push.clipFromWorld, 1)));
    return b;
}

ImageHandle addMotion(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces) {
    if (scene.moved.empty()) return {};
    const ViewDraws& moved = scene.draws->pick(scene.slots.moved, seenByCamera(scene), scene.moved);
    if (moved.rows.empty()) return {};
    const ImageHandle motion = scope.image("gbuffer.motion", scope.info(surfaces.normal));
    const char* const vertexShader = scene.skin ? "gbuffer/motion_skinned.vert" : "gbuffer/motion.vert";
    PassBuilder pass =
        scope.raster("gbuffer.motion", vertexShader, "gbuffer/motion.frag", gpu::VertexLayout::kPositions);
    pass.colorClear(motion, glm::vec4(0)).depthEqual(surfaces.depth).geometry(scene.geometry);
    pass.read("instances", scene.instances)
        .read("drawnRows", scene.drawnRows)
        .read("previousInstances", scene.previousInstances);
    if (scene.skin)
        pass.read("previousJoints", scene.skin.previousJoints)
            .read("skinnedMeshes", scene.skin.skinnedMeshes)
            .read("skin", scene.skin.skin)
            .read("modelled", scene.skin.positions);
    drawView(pass, scene, moved, scene.eye.clipFromWorld, {.filter = DrawFilter::kShapes});
    return motion;
}

}  // namespace ag::render
