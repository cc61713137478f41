// Every tunable of the frame: a plain struct per technique, gathered here and registered once.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>

#include "engine/gpu/functions.h"
#include "engine/renderer/antialiasing.h"
#include "engine/renderer/blended_layers.h"
#include "engine/renderer/bloom.h"
#include "engine/renderer/composite.h"
#include "engine/renderer/punctual_lighting.h"
#include "engine/renderer/reflections.h"
#include "engine/renderer/shadow_maps.h"
#include "gi/occluder_trees.h"
#include "gi/published/interleaved_shading.h"
#include "gi/published/ssvp.h"
#include "gi/settings.h"

namespace ag {
class Settings;
}

namespace ag::render {

// How indirect light is made: ours, or a paper's (gi/published).
enum class Technique : uint32_t {
    kNone,        // no indirect light, and nothing that only it needs
    kAreaLights,  // clusters of RSM texels as area lights: gi/bounce_light.cpp
    kStochastic,  // samples of the RSMs: gi/bounce_light.cpp
    kRsmBrute,
    kRsm400,
    kIrsm,
    kIsm,
    kRsmc,
    kAcrsm,
    kSsvp,
};

struct RenderSettings {
    Technique technique = Technique::kAreaLights;
    gi::BounceLightSettings bounce;
    gi::SsvpSettings ssvp;
    gi::InterleavedShadingSettings interleavedShading;  // of "ism" and "acrsm"
    ShadowMapSettings shadowMaps;
    LightClusterSettings lightClusters;
    PunctualShadowSettings punctualShadows;
    PunctualLightingSettings punctualLighting;
    ReflectionSettings reflections;
    BlendingSettings blending;
    AntialiasingSettings antialiasing;
    BloomSettings bloom;
    CompositeSettings composite;
    ExposureSettings exposure;

    bool operator==(const RenderSettings&) const = default;
};

// Named sets of settings: "none" (direct light only), "rsm-brute" (every texel of a 128² RSM),
// "rsm-400" (Dachsbacher & Stamminger 2005), "irsm" (few samples and a denoiser, as published), "stochastic"
// (that, ours), "ism" (Ritschel et al. 2008), "ssvp" (two bounces, as published), "rsmc" (RSM clustering) and
// "acrsm" (with adaption and shadows) as published, "afterglow" (the default), "afterglow-bounces" (with
// every later bounce), and the default by budget: "low", "medium" (the same), "high", "ultra". For the direct
// light of punctual lights, without bounces: "lights-reference" (a shadow map each), "lightcluster" as
// published, "afterglow-lights" (the default's). False if there is no such preset.
bool applyPreset(std::string_view name, RenderSettings& s);
std::span<const std::string_view> presetNames();

// Every later bounce, with as many area lights for them: out of the first's few, half of their light would be
// lost in a level of many rooms.
void addBounces(RenderSettings& s);

// Whether rays go to texels, and what rays of any kind are to meet; none: there are none.
bool castsTexelRays(const RenderSettings& settings);
std::optional<gi::TracedBy> tracedBy(const RenderSettings& settings, const RenderScene& scene);

// Smaller shadow maps where the device has no images of the size that was asked for.
void fitToDevice(const VkPhysicalDeviceLimits& limits, RenderSettings& s);

// Registers every group's settings. `s` must outlive `settings`.
void registerSettings(Settings& settings, RenderSettings& s);

}  // namespace ag::render
