// Smooth edges. Temporal: each frame samples the pixels elsewhere, and the picture is the mean of a pixel's
// samples over frames, at the output's size, which may be larger than what is rendered; a still picture
// converges to the filtered one and then costs nothing. Spatial: edges of the finished picture are smoothed.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/renderer/gbuffer.h"
#include "engine/renderer/pixel_grid.h"
#include "gi/settling.h"

namespace ag::render {

enum class Antialiasing : uint32_t { kOff, kSpatial, kTemporal };

struct AntialiasingSettings {
    Antialiasing mode = Antialiasing::kOff;
    float scale = 1;       // of the output's width and height, rendered; temporal only
    uint32_t frames = 16;  // samples a pixel of the output, until it rests

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"mode", &AntialiasingSettings::mode, 0, 0, "",
                         "temporal: a pixel's mean over frames; spatial: along the edges of one frame",
                         "off|spatial|temporal"},
            SettingField{"scale", &AntialiasingSettings::scale, 0.5, 1, "",
                         "of the picture's width and height, rendered; the rest comes from other frames"},
            SettingField{"frames", &AntialiasingSettings::frames, 1, 256, "",
                         "samples a pixel of a still picture"}};
    }

    bool operator==(const AntialiasingSettings&) const = default;
};

struct AntialiasingHistory {
    gi::Settling settling;
    uint64_t instances = 0;
    bool moves = false;
    uint64_t stops = 0;  // how often all came to a stand
    // Of the frame before: its camera without jitter, and what must be equal for the picture to be.
    RenderCamera camera;
    uint64_t originVersion = 0, lightsVersion = 0, version = 0;
    bool stood = false, rested = false;
    bool relit = false;  // lights are among what changed since all stood
};

// Which pixels are rendered for an output of that size. `version` changes with whatever changes the picture
// but where things stand.
PixelGrid choosePixels(const AntialiasingSettings& settings, glm::uvec2 output, const RenderScene& scene,
                       uint64_t version, AntialiasingHistory& history);

// The picture at the output's size out of what was rendered; temporal only, else `radiance` itself.
ImageHandle addAntialiasing(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces,
                            ImageHandle radiance, const AntialiasingSettings& settings,
                            AntialiasingHistory& history);
// Spatial only, else `display` itself.
ImageHandle addSmoothEdges(GraphScope scope, ImageHandle display, const AntialiasingSettings& settings);

}  // namespace ag::render
