#include "gi/direct_lighting.h"

#include <algorithm>
#include <cmath>

namespace ag::gi {
namespace {

io::Light lightRow(const RenderLight& light, const LightShadow& shadow) {
    return {.position = light.position,
            .kind = uint32_t(light.kind),
            .direction = light.direction,
            .range = light.range,
            .intensity = light.intensity,
            .cosInner = std::cos(light.innerConeAngle),
            .cosOuter = std::cos(light.outerConeAngle),
            .firstShadowView = shadow.firstView,
            .shadowViewCount = shadow.viewCount,
            .castsShadow = shadow.viewCount > 0};
}

// Pass names are literals, because the graph keeps views of them.
constexpr std::array<std::string_view, 16> kPassNames = {
    "direct_lighting.light0",  "direct_lighting.light1",  "direct_lighting.light2",
    "direct_lighting.light3",  "direct_lighting.light4",  "direct_lighting.light5",
    "direct_lighting.light6",  "direct_lighting.light7",  "direct_lighting.light8",
    "direct_lighting.light9",  "direct_lighting.light10", "direct_lighting.light11",
    "direct_lighting.light12", "direct_lighting.light13", "direct_lighting.light14",
    "direct_lighting.light15"};

}  // namespace

Irradiance addDirectLighting(FrameGraph& graph, const SceneView& scene, const GBuffer& gbuffer,
                             const ShadowMaps& shadows) {
    std::array<io::Light, kPassNames.size()> rows{};
    std::array<bool, kPassNames.size()> sun{};
    uint32_t count = 0;
    for (size_t i = 0; i < scene.scene->lights.size() && count < rows.size(); ++i) {
        const RenderLight& light = scene.scene->lights[i];
        if (light.intensity == glm::vec3(0)) continue;
        sun[count] = light.kind == LightKind::kDirectional;
        rows[count++] = lightRow(light, i < io::kMaxLights ? shadows.lights[i] : LightShadow{});
    }
    if (count == 0) return {};

    const Irradiance result{graph.image("direct_lighting.irradiance",
                                        {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = gbuffer.size})};
    const std::span used(rows.data(), count);
    const BufferHandle lights = graph.buffer("direct_lighting.lights", {.sizeBytes = used.size_bytes()});
    graph.upload("direct_lighting.lights", lights, std::as_bytes(used));
    for (uint32_t i = 0; i < count; ++i) {
        const bool shadow = rows[i].castsShadow != 0;
        PassBuilder pass = graph.compute(kPassNames[i], shadow ? "direct_lighting/add_shadowed.comp"
                                                               : "direct_lighting/add_unshadowed.comp");
        pass.sample("normalMap", gbuffer.normal)
            .sample("depthMap", gbuffer.depth)
            .read("camera", scene.camera)
            .read("lights", lights)
            .spec(0, rows[i].kind)
            .spec(1, i == 0)
            .push(i)
            .dispatchThreads(gbuffer.size.x, gbuffer.size.y);
        if (shadow)
            pass.read("shadowViews", shadows.views)
                .sample("shadowAtlas", sun[i] ? shadows.sunAtlas : shadows.lampAtlas);
        if (i == 0)
            pass.write("irradiance", result.image);
        else
            pass.readWrite("irradiance", result.image);
    }
    return result;
}

}  // namespace ag::gi
