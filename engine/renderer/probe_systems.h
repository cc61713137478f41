// The only part of gi/ that knows the World: entities' probes to the renderer, and what it measured back to
// them.
//
//   s.add("readProbes", gi::readProbes);          // early in a tick
//   s.add("extractProbes", gi::extractProbes);    // after extractScene
//   renderer.render(scene, ...);
//   world.resource<gi::ProbeReadings>() = renderer.probeReadings();
#pragma once

#include "engine/ecs/view.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/components.h"
#include "gi/probes.h"

namespace ag::render {

void extractProbes(View<const WorldTransform, const IrradianceProbe> probes, Res<RenderScene> scene);
void readProbes(View<const IrradianceProbe, ProbeLight> probes, Res<const gi::ProbeReadings> readings);

}  // namespace ag::render
