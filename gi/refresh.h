// Which of indirect light is made anew in a frame. What a small thing that moves changes of it is little, and
// far from the thing nobody sees it some frames late: lights are then clustered, and pixels whose surfaces
// are as they were are gathered, only every so many frames. All else follows at once: what the camera sees,
// direct light, shadow maps of area lights, pixels of what moved.
#pragma once

#include <vector>

#include "gi/inputs.h"
#include "gi/settings.h"

namespace ag::gi {

// What the decision goes by, from frame to frame.
struct RefreshHistory {
    struct Place {
        uint32_t id;       // of what moves
        glm::vec3 centre;  // when lights were clustered
    };
    BounceLightSettings settings;
    std::vector<RsmLight> lights, otherLights;
    glm::uvec2 size{0};
    Versions versions{0, 0, 0, 0, 0};
    uint32_t sinceLarge = 0;   // frames since anything but small things changed
    uint32_t sinceMoved = 0;   // frames since anything moved
    uint32_t sinceLights = 0;  // frames since lights were clustered
    std::vector<Place> places;
    uint32_t sincePatient = 1u << 20;  // frames since something could be late
};

struct Refresh {
    bool lights = true;  // RSMs, what the view asks of clusters, clusters
    PixelShare pixels;
};

// Once a frame; `size`: pixels of the camera's image.
Refresh chooseRefresh(const World& world, const RenderCamera& camera, glm::uvec2 size,
                      const BounceLightSettings& settings, RefreshHistory& history);

// The most that what moved since the frame before takes up of what the camera or a light sees, by balls round
// it: 1 is all, and may be passed.
float shareSeen(const World& world, const RenderCamera& camera, glm::uvec2 size);

}  // namespace ag::gi
