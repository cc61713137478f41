#include "engine/renderer/gbuffer.h"

#include "engine/renderer/scene_draws.h"

namespace ag::render {
namespace {

// Targets that a scene has no use for are not written.
std::string_view fillShader(const SceneView& scene) {
    if (scene.hasGlossy)
        return scene.hasEmissive ? "gbuffer/fill_emissive_glossy.frag" : "gbuffer/fill_glossy.frag";
    return scene.hasEmissive ? "gbuffer/fill_emissive.frag" : "gbuffer/fill.frag";
}

}  // namespace

GBuffer addGBuffer(GraphScope scope, const SceneView& scene) {
    const auto target = [&](const char* name, VkFormat format) {
        return scope.image(name, {.format = format, .size = scene.grid.size});
    };
    gi::Surfaces g{.depth = target("gbuffer.depth", VK_FORMAT_D32_SFLOAT),
                   .normal = target("gbuffer.normal", VK_FORMAT_R16G16B16A16_SFLOAT),
                   .albedo = target("gbuffer.albedo", VK_FORMAT_R16G16B16A16_SFLOAT),
                   .size = scene.grid.size,
                   .normalMapped = scene.hasNormalMaps,
                   .view = scene.eye,
                   .camera = scene.camera};
    ImageHandle emissive;
    if (scene.hasEmissive) emissive = target("gbuffer.emissive", VK_FORMAT_R16G16B16A16_SFLOAT);
    if (scene.hasGlossy) g.reflectance = target("gbuffer.reflectance", VK_FORMAT_R16G16B16A16_SFLOAT);

    const glm::mat4& clipFromWorld = scene.eye.clipFromWorld;
    const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.slots.camera, clipFromWorld);
    PassBuilder pass = scope.raster("gbuffer.fill", "gbuffer/fill.vert", fillShader(scene),
                                    gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(g.normal, glm::vec4(0)).colorClear(g.albedo, glm::vec4(0));
    if (scene.hasEmissive) pass.colorClear(emissive, glm::vec4(0));
    if (scene.hasGlossy) pass.colorClear(g.reflectance, glm::vec4(0));
    pass.depthClear(g.depth)
        .geometry(scene.geometry)
        .read("instances", scene.instances)
        .read("drawnRows", scene.drawnRows);
    bindMaterials(pass, scene);
    drawView(pass, scene, draws, clipFromWorld, {.viewer = Viewer::kCamera});
    return {g, emissive};
}

ImageHandle addMotion(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces) {
    if (scene.moved.empty()) return {};
    const glm::mat4& clipFromWorld = scene.eye.clipFromWorld;
    const ViewDraws& all = scene.draws->cull(*scene.scene, scene.slots.camera, clipFromWorld);
    const ViewDraws& moved = scene.draws->pick(scene.slots.moved, all, scene.moved);
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
    drawView(pass, scene, moved, clipFromWorld, {.filter = DrawFilter::kShapes});
    return motion;
}

}  // namespace ag::render
