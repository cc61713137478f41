// The geometry of RSM faces: pure functions from lights to matrices and atlas places.
#pragma once

#include "gi/rsm.h"

namespace ag::gi {

struct RsmLayout {
    std::array<io::RsmMap, io::kMaxRsmMaps> maps{};
    std::array<io::RsmFace, io::kMaxRsmFaces> faces{};
    std::array<uint64_t, io::kMaxRsmMaps> lightIds{};  // of the maps of lights; levels of a sun have one
    uint32_t mapCount = 0, faceCount = 0;
    uint32_t lightMapCount = 0, lightFaceCount = 0;  // the first ones
    uint32_t emissiveClusters = 0;                   // of all the first ones
    glm::uvec2 atlasSize{0};
    uint32_t largestFace = 0;
};

// At most kMaxBounceLights lights; faces are powers of two and aligned to their size.
// After the lights' maps come that of emissive surfaces and that of surfaces that reflect, where there are
// such.
RsmLayout layoutRsm(const World& world, const RsmSettings& settings, uint32_t clusterBudget,
                    RsmHistory& history, const SurfaceEmitters& emitters = {}, const SunFocus& focus = {});

// Between which a light falls off: a spot's; of others below -1, so that none does.
struct ConeCosines {
    float inner, outer;
};
ConeCosines coneCosines(const RsmLight& light);

// Emitted flux of a light in W, for sharing budgets (mean of the channels; sun: onto the scene's bounds).
float emittedFlux(const RsmLight& light, const Bounds& sceneBounds);

}  // namespace ag::gi
