// Light of the sky, found by rays: each pixel that light is gathered at casts one a frame, to where its block
// of the screen found sky before; what rays found is averaged over frames and filtered over the screen by how
// uncertain it is. Rays meet triangles, so that nothing leaks, and whatever moves is in the way.
#pragma once

#include <span>
#include <vector>

#include "engine/core/setting_fields.h"
#include "gi/inputs.h"
#include "gi/settling.h"
#include "gi/surface_emitters.h"
#include "gi/val_shading.h"
#include "shaders/sky/sky_io.h"

namespace ag::gi {

struct SkySettings {
    bool enabled = true;
    uint32_t mostLength = 1024;   // frames that a pixel's mean stands for while nothing moves,
    uint32_t movingLength = 32;   // and while something does
    uint32_t settleFrames = 256;  // rays are cast so long after anything last changed,
    bool allPixels = true;        // and then as long at each of the pixels left out
    uint32_t rounds = 3;          // of the filter, each twice as wide
    float tolerance = 1;          // standard deviations by which the light of taps may differ
    bool glossy = true;           // specular lobes reflect it
    uint32_t pointRays = 8;       // of each point that light bounces on from, a frame

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"enabled", &SkySettings::enabled, 0, 0, "", "the sky shines"},
            SettingField{"most_length", &SkySettings::mostLength, 1, 65536, "frames",
                         "that a pixel's mean stands for"},
            SettingField{"moving_length", &SkySettings::movingLength, 1, 65536, "frames",
                         "that it stands for while something moves"},
            SettingField{"settle_frames", &SkySettings::settleFrames, 1, 1000000, "frames",
                         "rays are cast after anything last changed"},
            SettingField{"all_pixels", &SkySettings::allPixels, 0, 0, "",
                         "then cast rays at the pixels left out, too, while nothing changes"},
            SettingField{"rounds", &SkySettings::rounds, 0, 4, "rounds", "of the filter, each twice as wide"},
            SettingField{"tolerance", &SkySettings::tolerance, 0.1, 1000, "deviations",
                         "by which the light of the filter's taps may differ"},
            SettingField{"glossy", &SkySettings::glossy, 0, 0, "", "materials reflect it by their roughness"},
            SettingField{"point_rays", &SkySettings::pointRays, 1, 64, "rays",
                         "a frame of each point that light bounces on from"}};
    }

    bool operator==(const SkySettings&) const = default;
};

// As a host makes it, once for each sky.
struct SkyTable {
    std::vector<io::SkyTexel> texels;
    std::vector<float> cells;  // power of each, W/m² on a plane facing it
    std::vector<float> upTo;   // how likely a draw by power is a cell or one before
    bool empty() const { return texels.empty(); }
};
// Of a picture of all directions, W/(m² sr) (engine/core/equirectangular.h), turned into the world; the table
// is over `lightUnit`.
struct SkyPicture {
    glm::ivec2 size{0};
    std::span<const glm::vec3> radiance;
    glm::mat3 worldFromPicture{1};
};
SkyTable makeSkyTable(const SkyPicture& picture, float lightUnit);

// The same on the device.
struct SkyOnDevice {
    BufferHandle texels;  // io::SkyTexel, also a texel buffer of vec4
    BufferHandle cells, upTo;
    uint64_t version = 0;
    explicit operator bool() const { return bool(texels); }
};

struct SkyHistory {
    Settling settling;
    RenderCamera camera;
    uint64_t originVersion = 0, lightVersion = 0, viewVersion = 0;
    uint32_t sinceChange = 0, sinceStep = 0;  // frames: of the light's last change, and of the camera's
};

struct SkyInputs {
    const SkyOnDevice& sky;
    const Occluders& occluders;
    const Versions& versions;
};

struct SkyLight {
    ImageHandle image;  // irradiance, W/m²; invalid: no sky, or nothing to cast rays into yet
    ImageHandle gloss;  // what specular lobes reflect of it, W/(m² sr); invalid: no material has one
};

// Until it comes to rest once nothing changes.
uint32_t framesToRest(const SkySettings& settings, uint32_t spacing);

// On each pixel of `surfaces`, gathered at every spacing-th; while nothing changes at all, one after another.
SkyLight addSkyLight(GraphScope scope, const Surfaces& surfaces, uint32_t spacing, const SkyInputs& in,
                     const SkySettings& settings, SkyHistory& history);

// On the points that reflect; vec4: W/m², rays that it is the mean of. Invalid: none.
BufferHandle addSkyOnPoints(GraphScope scope, const SurfaceEmitters& emitters, const SkyInputs& in,
                            const SkySettings& settings, Settling& settling);

}  // namespace ag::gi
