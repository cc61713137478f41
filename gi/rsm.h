// Reflective shadow maps (Dachsbacher & Stamminger 2005) of the bounce lights, in one atlas. A spot light has
// one square face round its cone, a sun one over the scene's bounds (the first one levels in large scenes,
// sun_levels.h), a point light all six faces of a cube
// at half the resolution each; where lights together would have more than six faces of 512² texels, all are
// halved. A texel becomes an emitter with its flux in W and its area in m² (units:
// docs/techniques).
#pragma once

#include <array>

#include "engine/core/setting_fields.h"
#include "gi/inputs.h"
#include "gi/sun_levels.h"
#include "gi/surface_emitters.h"
#include "shaders/rsm/rsm_io.h"

namespace ag::gi {

struct RsmSettings {
    uint32_t resolution = 0;       // texels along a map's side; 0: as each light says
    float sunMargin = 0.02f;       // part of the scene's width added round a sun's map
    float sunDetail = 1.0f / 160;  // texels near the camera, of the distance seen (sun_levels.h)

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"resolution", &RsmSettings::resolution, 0, 1024, "texels",
                         "side of an RSM, rounded down to a power of two, less with many lights; "
                         "0: as each light says"},
            SettingField{"sun_margin", &RsmSettings::sunMargin, 0, 1, "",
                         "part of the scene's width added round a sun's map"},
            SettingField{"sun_detail", &RsmSettings::sunDetail, 0, 1, "",
                         "texels of a sun's map, of the distance that the camera sees: in a larger scene "
                         "finer maps lie about the camera; 0: one map"}};
    }

    bool operator==(const RsmSettings&) const = default;
};

// Of a light's reflective shadow maps, at most.
constexpr uint32_t mostFacesOf(LightKind kind) {
    if (kind == LightKind::kPoint) return 6;
    return kind == LightKind::kDirectional ? io::kMostSunLevels : 1;
}

struct RsmSet {
    ImageHandle normal, albedo, depth;  // of the atlas, as rasterised
    bool lobes = false;     // alphas of normal and albedo tell of specular lobes (shaders/rsm/render.frag)
    BufferHandle texels;    // io::RsmTexel, tile by tile; also a texel buffer of vec4. See addRsmTexels
    BufferHandle faces;     // io::RsmFace
    BufferHandle maps;      // io::RsmMap
    BufferHandle tileMaps;  // per tile: its map, or ~0
    io::RsmAtlas atlas{};   // zero maps: no light bounces, nothing else is valid
    uint32_t tileCount = 0;
    uint32_t largestFace = 0;    // texels
    uint64_t inputsVersion = 0;  // changes when the texels do
    std::array<io::RsmMap, io::kMaxRsmMaps> mapInfo{};
    std::array<io::RsmFace, io::kMaxRsmFaces> faceInfo{};
    std::array<uint64_t, io::kMaxRsmMaps> lightIds{};  // of the maps of lights
    uint32_t lightRsmCount = 0, lightFaceCount = 0;    // the first ones; those of surfaces may follow
    // Clusters of emissive surfaces come before those of lights, those of surfaces that reflect after them.
    uint32_t emissiveCount = 0, firstLater = ~0u;
    bool empty() const { return atlas.mapCount == 0; }
};

// Lives on the CPU from frame to frame: the flux by which each light has its share of the clusters. It
// follows the light's own only when that has left it far behind, and a light that goes out keeps its share
// for a while: so a light that flickers takes no clusters from the others.
struct ClusterShares {
    struct Light {
        uint64_t id = 0;
        float flux = 0;           // W, times the light's weight
        uint32_t darkFrames = 0;  // since it went out
    };
    std::array<Light, io::kMaxBounceLights> lights{};  // in the scene's order
    uint32_t count = 0;
};

struct RsmHistory {
    ClusterShares shares;
    SunLevelsHistory sunLevels;
};

// The maps, not drawn yet: whoever has the surfaces draws the faces of lights (faceInfo: clip matrices,
// rectangles of the atlas) into normal, albedo and depth, all cleared to zero, and adds to inputsVersion what
// that depends on. `clusterBudget`: clusters to share out over the maps by emitted flux, at least 8 each.
// `emitters`: further maps.
RsmSet planRsm(GraphScope scope, const World& world, const RsmSettings& settings, uint32_t clusterBudget,
               const SurfaceEmitters& emitters, const SunFocus& focus, RsmHistory& history);

// Texels of the maps that were drawn, and of `emitters`.
void addRsmTexels(GraphScope scope, const RsmSet& rsm, const SurfaceEmitters& emitters);

// What a pass reads of the maps' texels and of where these send their light: texels, maps, tileMaps,
// rsmNormals, rsmAlbedos, kTexelLobes.
void readRsmTexels(PassBuilder& pass, const RsmSet& rsm);

}  // namespace ag::gi
