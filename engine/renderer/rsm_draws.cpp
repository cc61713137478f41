#include "engine/renderer/rsm_draws.h"

#include "engine/core/hash.h"
#include "engine/renderer/scene_draws.h"

namespace ag::render {

void drawRsm(GraphScope scope, const SceneView& scene, gi::RsmSet& rsm) {
    if (rsm.empty()) return;
    PassBuilder pass = scope.raster("rsm.render", "gbuffer/fill.vert", "rsm/render.frag",
                                    gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(rsm.normal, glm::vec4(0)).colorClear(rsm.albedo, glm::vec4(0)).depthClear(rsm.depth);
    pass.geometry(scene.geometry).read("instances", scene.instances).read("drawnRows", scene.drawnRows);
    bindMaterials(pass, scene);
    pass.constant("kWholeMaterials", scene.wholeMaterials);
    rsm.lobes = scene.wholeMaterials;
    const uint32_t slot = scene.slots.firstRsm;
    std::array<ViewRequest, io::kMaxRsmFaces> views;
    for (uint32_t f = 0; f < rsm.lightFaceCount; ++f)
        views[f] = {slot + f, rsm.faceInfo[f].clipFromWorld};
    scene.draws->cullAll(*scene.scene, {views.data(), rsm.lightFaceCount});
    for (uint32_t f = 0; f < rsm.lightFaceCount; ++f) {
        const io::RsmFace& face = rsm.faceInfo[f];
        const ViewDraws& draws = scene.draws->cull(*scene.scene, slot + f, face.clipFromWorld);
        rsm.inputsVersion = combineHash(rsm.inputsVersion, draws.version);
        drawView(pass, scene, draws, face.clipFromWorld, {.viewport = {face.origin, face.size, face.size}});
    }
}

}  // namespace ag::render
