#include "gi/gbuffer.h"

#include "shaders/gbuffer/view_points_io.h"

#include "gi/scene_draws.h"

namespace ag::gi {
namespace {

// Targets that a scene has no use for are not written.
std::string_view fillShader(const SceneView& scene) {
    if (scene.hasGlossy)
        return scene.hasEmissive ? "gbuffer/fill_emissive_glossy.frag" : "gbuffer/fill_glossy.frag";
    return scene.hasEmissive ? "gbuffer/fill_emissive.frag" : "gbuffer/fill.frag";
}

}  // namespace

GBuffer addGBuffer(FrameGraph& graph, const SceneView& scene) {
    const auto target = [&](const char* name, VkFormat format) {
        return graph.image(name, {.format = format, .size = scene.size});
    };
    GBuffer g{.depth = target("gbuffer.depth", VK_FORMAT_D32_SFLOAT),
              .normal = target("gbuffer.normal", VK_FORMAT_R16G16B16A16_SFLOAT),
              .albedo = target("gbuffer.albedo", VK_FORMAT_R16G16B16A16_SFLOAT),
              .size = scene.size};
    if (scene.hasEmissive) g.emissive = target("gbuffer.emissive", VK_FORMAT_R16G16B16A16_SFLOAT);
    if (scene.hasGlossy) g.reflectance = target("gbuffer.reflectance", VK_FORMAT_R16G16B16A16_SFLOAT);

    const glm::mat4& clipFromWorld = scene.scene->camera.clipFromWorld;
    const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.claimView(), clipFromWorld);
    PassBuilder pass = graph.raster("gbuffer.fill", "gbuffer/fill.vert", fillShader(scene),
                                    gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(g.normal, glm::vec4(0)).colorClear(g.albedo, glm::vec4(0));
    if (scene.hasEmissive) pass.colorClear(g.emissive, glm::vec4(0));
    if (scene.hasGlossy) pass.colorClear(g.reflectance, glm::vec4(0));
    pass.depthClear(g.depth).geometry(scene.geometry).read("instances", scene.instances);
    bindMaterials(pass, scene);
    drawView(pass, scene, draws, clipFromWorld, {}, DrawFilter::kAll, Viewer::kCamera);
    g.draws = &draws;
    return g;
}

ImageHandle addMotion(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer) {
    const uint32_t slot = scene.claimView();
    if (scene.moved.empty()) return {};
    const ViewDraws& moved = scene.draws->pick(slot, *gbuffer.draws, scene.moved);
    if (moved.instanceCount == 0) return {};
    scene.readsPrevious = true;
    const ImageHandle motion = graph.image("gbuffer.motion", graph.info(gbuffer.normal));
    const char* const vertexShader = scene.skin ? "gbuffer/motion_figures.vert" : "gbuffer/motion.vert";
    PassBuilder pass =
        graph.raster("gbuffer.motion", vertexShader, "gbuffer/motion.frag", gpu::VertexLayout::kPositions);
    pass.colorClear(motion, glm::vec4(0)).depthEqual(gbuffer.depth).geometry(scene.geometry);
    pass.read("instances", scene.instances).read("previousInstances", scene.previousInstances);
    if (scene.skin)
        pass.read("previousJoints", scene.skin.previousJoints)
            .read("figures", scene.skin.figures)
            .read("skin", scene.skin.skin)
            .read("modelled", scene.skin.positions);
    drawView(pass, scene, moved, scene.scene->camera.clipFromWorld, {}, DrawFilter::kShapes, Viewer::kLight);
    return motion;
}

BufferHandle addViewPoints(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer) {
    const BufferHandle points =
        graph.buffer("gbuffer.view_points", {.sizeBytes = io::kViewPointCount * sizeof(io::ViewPoint),
                                             .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    graph.compute("gbuffer.sample_view", "gbuffer/sample_view.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .write("viewPoints", points)
        .dispatchThreads(io::kViewPointCount);
    return points;
}

}  // namespace ag::gi
