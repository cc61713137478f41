#include "engine/renderer/ssvp_draws.h"

#include "engine/renderer/scene_draws.h"
#include "gi/light_views.h"
#include "shaders/published/ssvp/ssvp_io.h"

namespace ag::render {

void drawParaboloids(GraphScope scope, const SceneView& scene, const gi::Paraboloids& maps) {
    PassBuilder pass =
        scope.raster("ssvp.render_maps", "published/ssvp/render_maps.vert", "published/ssvp/render_maps.frag",
                     gpu::VertexLayout::kPositionsAndAttributes);
    pass.colorClear(maps.position, glm::vec4(0))
        .colorClear(maps.normal, glm::vec4(0))
        .colorClear(maps.albedo, glm::vec4(0))
        .depthClear(maps.depth)
        .geometry(scene.geometry)
        .read("instances", scene.instances)
        .read("drawnRows", scene.drawnRows)
        .read("clusters", maps.clusters);
    bindMaterials(pass, scene);
    const Bounds& bounds = scene.scene->bounds;
    const glm::mat4 everything = gi::sunView({0, -1, 0}, bounds, 0.1f).clipFromWorld;
    const ViewDraws& draws = scene.draws->cull(*scene.scene, scene.slots.everything, everything);
    for (uint32_t c = 0; c < maps.count; ++c) {
        const struct {
            uint32_t cluster;
            float farDistance;
        } push{c, glm::distance(bounds.min, bounds.max)};
        const glm::uvec2 origin = glm::uvec2(c % io::kSsvpMapColumns, c / io::kSsvpMapColumns) * maps.mapSize;
        drawView(pass, scene, draws, std::as_bytes(std::span(&push, 1)),
                 {.viewport = {origin, maps.mapSize, maps.mapSize}});
    }
}

}  // namespace ag::render
