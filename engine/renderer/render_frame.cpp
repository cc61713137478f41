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
    if (needsMotion(s, bool(scene.sky))) surfaces.motion = addMotion(scope, scene, surfaces);

    // Indirect light
    f.bounce = addIndirectLight(scope, scene, surfaces, s, h);

    // Direct light
    f.shadows = addSunShadows(scope, scene, s.shadowMaps, h.sunShadows);
    const bool glossy = s.bounce.valShading.glossy;
    const gi::Occluders occluders = occludersOf(scene);
    const gi::Occluders* traced = f.bounce.still && s.shadowMaps.rays ? &occluders : nullptr;
    f.direct = addSunLighting(scope, scene, surfaces, f.shadows, traced, glossy);
    const LightClusters& lights =
        clusterLights(*scene.scene, h.punctualRelevance, s.lightClusters, h.lightClusters);
    f.punctual.shadows =
        addPunctualShadows(scope, scene, lights, s.lightClusters.most, s.punctualShadows, h.punctualShadows);
    f.punctual.lists =
        addPunctualLists(scope, scene, surfaces, lights, s.punctualLighting.tiles, h.punctualLists);
    f.direct =
        addPunctualLighting(scope, scene, surfaces, f.punctual, f.direct, traced, glossy, s.punctualLighting);
    if (s.lightClusters.strongFirst)
        addPunctualRelevance(scope, f.bounce.viewPoints, f.punctual.lists, h.punctualRelevance);

    // Light of the sky
    f.sky = gi::addSkyLight(scope, surfaces, s.bounce.spacing, {scene.sky, occluders, versionsOf(scene)},
                            s.bounce.sky, h.sky);

    // To the eye
    RenderOutputs& out = f.outputs;
    out.radiance = addRadiance(scope, f.gbuffer, {f.direct, f.sky, f.bounce, scene});
    out.radiance = addReflections(scope, scene, f.gbuffer, f.bounce, out.radiance, s.reflections);
    out.radiance = addBlendedLayers(scope, scene, f, lights, out.radiance, s, h.blended);
    out.radiance = addAntialiasing(scope, scene, surfaces, out.radiance, s.antialiasing, h.antialiasing);
    out.exposure = addExposure(scope, out.radiance, scene.units, s.composite.exposure, scene.grid.version,
                               s.exposure, h.exposure);
    const ImageHandle glaring = addBloom(scope, out.radiance, s.bloom);
    out.display = addDisplay(scope, f.gbuffer, glaring, out.exposure, s.composite);
    out.display = addSmoothEdges(scope, out.display, s.antialiasing);
    return f;
}

}  // namespace ag::render
