// The papers' systems, each a list of passes of its own over those of gi/: baselines to measure ours against.
// Light of the first bounce alone but where said otherwise. docs/techniques: sources, deviations, errors.
#pragma once

#include "gi/bounce_light.h"
#include "gi/published/interleaved_shading.h"
#include "gi/published/ssvp.h"

namespace ag::gi {

// Every texel of an RSM as a point emitter, without visibility.
BounceLight addRsmBrute(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                        BounceLightHistory& history);
// Reflective shadow maps: some hundred fixed samples of the RSMs a pixel (Dachsbacher & Stamminger
// 2005).
BounceLight addRsm400(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                      BounceLightHistory& history);
// Improved reflective shadow maps: few samples, others in each pixel and frame, and a denoiser.
BounceLight addIrsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                    BounceLightHistory& history);
// Imperfect shadow maps: point lights sampled from the RSMs (Keller 1997, Ritschel et al. 2008).
BounceLight addIsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                   const InterleavedShadingSettings& interleaved, BounceLightHistory& history);
// Reflective shadow map clustering, without visibility (Prutkin, Kaplanyan, Dachsbacher 2012).
BounceLight addRsmc(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                    BounceLightHistory& history);
// Adaptively clustered reflective shadow maps with imperfect shadow maps (Weinzierl-Heigl).
BounceLight addAcrsm(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                     const InterleavedShadingSettings& interleaved, BounceLightHistory& history);
// Screen-space VPL propagation (Aranha, Macedo, Apolinario): two bounces.
BounceLight addSsvpLight(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& settings,
                         const SsvpSettings& ssvp, DrawParaboloids draw, BounceLightHistory& history);

}  // namespace ag::gi
