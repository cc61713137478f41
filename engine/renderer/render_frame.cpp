// What the GPU does each frame, top to bottom. Each line takes handles and settings and returns handles; the
// frame graph finds order, barriers and what can be skipped.
#include "engine/renderer/render_frame.h"

#include "engine/renderer/indirect_light.h"

namespace ag::render {

RenderFrame addFrame(GraphScope scope, const SceneView& scene, const RenderSettings& s, RenderHistory& h) {
    RenderFrame f;
    // Skinned meshes as they are bent now
    addSkinning(scope, scene);

    // What the camera sees
    f.gbuffer = addGBuffer(scope, scene);
    gi::Surfaces& surfaces = f.gbuffer.surfaces;
    if (needsMotion(s)) surfaces.motion = addMotion(scope, scene, surfaces);

    // Indirect light
    f.bounce = addIndirectLight(scope, scene, surfaces, s, h);

    // Direct light
    f.shadows = addSunShadows(scope, scene, s.shadowMaps, h.sunShadows);
    f.direct = addSunLighting(scope, scene, surfaces, f.shadows);
    const LightClusters& lamps =
        clusterLamps(*scene.scene, h.lampRelevance, s.lightClusters, h.lightClusters);
    f.lampShadows = addLampShadows(scope, scene, lamps, s.lightClusters.most, s.lampShadows, h.lampShadows);
    f.lampLists = addLampLists(scope, scene, surfaces, lamps, s.lampLighting.tiles, h.lampLists);
    f.direct = addLampLighting(scope, scene, surfaces, f.lampLists, f.lampShadows, f.direct, s.lampLighting);
    if (s.lightClusters.strongFirst)
        addLampRelevance(scope, f.bounce.viewPoints, f.lampLists, h.lampRelevance);

    // To the eye
    f.outputs = addComposite(scope, f.gbuffer, f.direct, f.bounce, s.composite);
    return f;
}

}  // namespace ag::render
