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

// Of pixels c spacing + spacing / 2: their centres are those of an image of `size` / spacing pixels.
RenderCamera thinned(const RenderCamera& camera, glm::uvec2 size, uint32_t spacing) {
    const glm::vec2 all(size), thin(glm::max(size / spacing, 1u) * spacing);
    const float aside =
        spacing % 2 == 0 ? 0.5f : 0.0f;  // pixels, of the chosen ones from the squares' middles
    const glm::vec2 scale = thin / all, shift = scale + 2 * aside / all - 1.0f;
    glm::mat4 allFromThin(1), thinFromAll(1);
    for (int i = 0; i < 2; ++i) {
        allFromThin[i][i] = scale[i], allFromThin[3][i] = shift[i];
        thinFromAll[i][i] = 1 / scale[i], thinFromAll[3][i] = -shift[i] / scale[i];
    }
    RenderCamera out = camera;
    out.clipFromWorld = thinFromAll * camera.clipFromWorld;
    out.worldFromClip = camera.worldFromClip * allFromThin;
    return out;
}

}  // namespace

GBuffer addGBuffer(GraphScope scope, const SceneView& scene) {
    const auto target = [&](const char* name, VkFormat format) {
        return scope.image(name, {.format = format, .size = scene.size});
    };
    GBuffer g{.depth = target("gbuffer.depth", VK_FORMAT_D32_SFLOAT),
              .normal = target("gbuffer.normal", VK_FORMAT_R16G16B16A16_SFLOAT),
              .albedo = target("gbuffer.albedo", VK_FORMAT_R16G16B16A16_SFLOAT),
              .size = scene.size,
              .bent = scene.hasNormalMaps,
              .view = scene.scene->camera,
              .camera = scene.camera};
    if (scene.hasEmissive) g.emissive = target("gbuffer.emissive", VK_FORMAT_R16G16B16A16_SFLOAT);
    if (scene.hasGlossy) g.reflectance = target("gbuffer.reflectance", VK_FORMAT_R16G16B16A16_SFLOAT);

    const glm::mat4& clipFromWorld = scene.scene->camera.clipFromWorld;
    const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.slots.camera, clipFromWorld);
    PassBuilder pass = scope.raster("gbuffer.fill", "gbuffer/fill.vert", fillShader(scene),
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

GBuffer addThinned(GraphScope scope, const GBuffer& all, uint32_t spacing, const ThinningNames& names) {
    if (spacing == 1) return all;
    const glm::uvec2 size = glm::max(all.size / spacing, 1u);
    GBuffer g{
        .depth = scope.image(names.depth, {.format = VK_FORMAT_R32_SFLOAT, .size = size}),
        .normal = addThinImage(scope, names.normal, all.normal, spacing),
        .size = size,
        .bent = all.bent,
        .spacing = all.spacing * spacing,
        .view = thinned(all.view, all.size, spacing),
    };
    g.camera = addCamera(scope, names.camera, g.view, size);
    scope.compute(names.depth, "gbuffer/thin_depth.comp")
        .sample("all", all.depth)
        .write("thin", g.depth)
        .push(int32_t(spacing))
        .dispatchThreads(size.x, size.y);
    return g;
}

ImageHandle addThinImage(GraphScope scope, std::string_view name, ImageHandle all, uint32_t spacing) {
    if (!all || spacing == 1) return all;
    const glm::uvec2 size = glm::max(scope.info(all).size / spacing, 1u);
    const ImageHandle thin = scope.image(name, {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = size});
    scope.compute(name, "gbuffer/thin_image.comp")
        .sample("all", all)
        .write("thin", thin)
        .push(int32_t(spacing))
        .dispatchThreads(size.x, size.y);
    return thin;
}

ImageHandle addMotion(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer) {
    if (scene.moved.empty()) return {};
    const ViewDraws& moved = scene.draws->pick(scene.slots.moved, *gbuffer.draws, scene.moved);
    if (moved.instanceCount == 0) return {};
    const ImageHandle motion = scope.image("gbuffer.motion", scope.info(gbuffer.normal));
    const char* const vertexShader = scene.skin ? "gbuffer/motion_figures.vert" : "gbuffer/motion.vert";
    PassBuilder pass =
        scope.raster("gbuffer.motion", vertexShader, "gbuffer/motion.frag", gpu::VertexLayout::kPositions);
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

BufferHandle addViewPoints(GraphScope scope, const SceneView& scene, const GBuffer& gbuffer) {
    const BufferHandle points =
        scope.buffer("gbuffer.view_points", {.sizeBytes = io::kViewPointCount * sizeof(io::ViewPoint),
                                             .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    scope.compute("gbuffer.sample_view", "gbuffer/sample_view.comp")
        .sample("normalMap", gbuffer.normal)
        .sample("depthMap", gbuffer.depth)
        .read("camera", scene.camera)
        .write("viewPoints", points)
        .dispatchThreads(io::kViewPointCount);
    return points;
}

}  // namespace ag::gi
