// Surfaces that blend with what is behind them: alpha-blended ones and thin glass. The nearest few at each
// pixel are peeled off one after another (Everitt 2001), each lit as any other surface is, and put over what
// is behind them in order. They block no light and reflect none on. All of it happens in the part of the
// picture where there are such surfaces.
#pragma once

#include <array>

#include "engine/core/setting_fields.h"
#include "engine/renderer/punctual_lists.h"
#include "gi/sky.h"

namespace ag::render {

struct RenderFrame;
struct RenderSettings;

constexpr uint32_t kMostBlendedLayers = 4;

struct BlendingSettings {
    uint32_t layers = 2;

    static constexpr auto fields() {
        return std::tuple{SettingField{"layers", &BlendingSettings::layers, 0, kMostBlendedLayers, "surfaces",
                                       "that blend with what is behind them, at a pixel at most; farther "
                                       "ones are left out; 0: none is drawn"}};
    }

    bool operator==(const BlendingSettings&) const = default;
};

// A part of the picture, pixels.
struct PictureWindow {
    glm::uvec2 origin{0}, size{0};
};
// The camera whose picture that part is.
RenderCamera windowed(const RenderCamera& camera, glm::uvec2 picture, const PictureWindow& window);

struct BlendedLayerHistory {
    gi::SkyHistory sky;
    PunctualListsHistory punctualLists;
};
struct BlendedHistory {
    std::array<BlendedLayerHistory, kMostBlendedLayers> layers;
    glm::uvec2 size{0};  // of the window
    uint64_t cameraVersion = 0;
    uint32_t smallerFor = 0;  // frames of a moving camera in which a smaller one would have done
};

// `behind`, the radiance of what is opaque in `frame`, W/(m² sr), seen through them; itself where none is in
// sight.
ImageHandle addBlendedLayers(GraphScope scope, const SceneView& scene, const RenderFrame& frame,
                             const LightClusters& lights, ImageHandle behind, const RenderSettings& settings,
                             BlendedHistory& history);

}  // namespace ag::render
