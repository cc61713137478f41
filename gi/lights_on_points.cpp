#include "gi/lights_on_points.h"

#include <vector>

#include "gi/occluder_trees.h"
#include "gi/rsm_views.h"
#include "shaders/bvh/bvh_io.h"
#include "shaders/later_bounces/later_bounces_io.h"

namespace ag::gi {
namespace {

io::PointLight rowOf(const RsmLight& light) {
    const ConeCosines cone = coneCosines(light);
    return {.position = light.position,
            .range = light.range,
            .intensity = light.intensity,
            .directional = light.kind == LightKind::kDirectional,
            .direction = light.direction,
            .cosInner = cone.inner,
            .cosOuter = cone.outer};
}

}  // namespace

OtherLights addOtherLights(GraphScope scope, std::span<const RsmLight> lights) {
    if (lights.empty()) return {};
    static thread_local std::vector<io::PointLight> rows;  // keeps its memory from frame to frame
    rows.clear();
    for (const RsmLight& light : lights)
        rows.push_back(rowOf(light));
    const auto bytes = std::as_bytes(std::span(rows));
    const BufferHandle buffer = scope.buffer("later_bounces.point_lights", {.sizeBytes = bytes.size()});
    scope.upload("later_bounces.point_lights", buffer, bytes);
    return {buffer, uint32_t(rows.size())};
}

BufferHandle addLightsOnPoints(GraphScope scope, const SurfaceEmitters& emitters, const OtherLights& lights,
                               const Occluders& occluders) {
    const uint32_t count = emitters.reflecting.count();
    if (count == 0 || !lights.rows || !occluders.trees.moverNodes) return {};
    const BufferHandle irradiance =
        scope.buffer("later_bounces.straight",
                     {.sizeBytes = count * sizeof(glm::vec4), .texelFormat = VK_FORMAT_R32G32B32A32_SFLOAT});
    PassBuilder pass = scope.compute("later_bounces.lights", "later_bounces/lights.comp");
    pass.read("texels", emitters.texels)
        .read("lights", lights.rows)
        .write("irradiance", irradiance)
        .push(io::PointLightsPush{.count = count,
                                  .lightCount = lights.count,
                                  .offset = occluders.rayOffset,
                                  .reach = kRayReaches * occluders.extent})
        .dispatchThreads(count);
    readTrees(pass, occluders.trees);
    return irradiance;
}

}  // namespace ag::gi
