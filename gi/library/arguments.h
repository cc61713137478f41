// What a host hands over, looked at and made ours: what cannot be is a BadArgument, before anything is
// changed.
#pragma once

#include <vector>

#include "gi/library/guest_scene.h"

namespace ag::guest {

std::vector<GuestMaterial> materialsOf(uint32_t count, const AgiMaterial* materials);
// `materials`: how many the scene has.
std::vector<GuestMesh> meshesOf(uint32_t count, const AgiMesh* meshes, size_t materials);
std::vector<GuestInstance> instancesOf(uint32_t count, const AgiInstance* instances, const GuestScene& scene);
std::vector<GuestLight> lightsOf(uint32_t count, const AgiLight* lights);
GuestSky skyOf(const AgiSky* sky);  // null: none
std::vector<GuestProbe> probesOf(uint32_t count, const AgiProbe* probes);
// `lastFrame`: the highest number so far.
void refuseBadFrame(const AgiFrame& frame, uint64_t lastFrame);

}  // namespace ag::guest
