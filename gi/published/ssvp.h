// Two bounces as published in Screen-space VPL propagation (Aranha, Macedo, Apolinario): virtual point
// lights, k-means over them, one paraboloid of the scene a cluster, and second-bounce lights sampled from
// those. The paraboloids shadow the first bounce; the second has no shadows. A baseline beside our later
// bounces.
#pragma once

#include "engine/core/function_ref.h"
#include "engine/core/setting_fields.h"
#include "gi/ism_atlas.h"
#include "gi/rsm.h"
#include "gi/val_fit.h"

namespace ag::gi {

struct SsvpSettings {
    uint32_t clusters = 8;
    uint32_t secondCount = 256;  // lights of the second bounce, over all clusters
    uint32_t rounds = 5;         // of k-means
    uint32_t mapSize = 256;      // texels along a paraboloid's square
    uint32_t interleave = 4;     // blocks of so many pixels squared share the lights
    bool disk = true;            // sample the paraboloids' disks; off: the squares round them

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"clusters", &SsvpSettings::clusters, 1, 64, "clusters",
                         "of point lights, each with a paraboloid map"},
            SettingField{"second_count", &SsvpSettings::secondCount, 0, 4096, "lights",
                         "of the second bounce"},
            SettingField{"rounds", &SsvpSettings::rounds, 1, 20, "rounds", "of k-means a frame"},
            SettingField{"map_size", &SsvpSettings::mapSize, 16, 512, "texels",
                         "side of a paraboloid's square, a multiple of 16"},
            SettingField{"interleave", &SsvpSettings::interleave, 1, 4, "pixels",
                         "blocks of n x n pixels share the lights"},
            SettingField{"disk", &SsvpSettings::disk, 0, 0, "",
                         "sample the paraboloids' disks; off: the squares round them"}};
    }

    bool operator==(const SsvpSettings&) const = default;
};

struct Ssvp {
    Vals vals;                // points of light
    uint32_t firstCount = 0;  // of them, the first bounce's
    IsmAtlas maps;            // one a cluster; a light's shape row says which and from where
};

// What each cluster sees of the scene, a paraboloid each in one atlas; whoever has the surfaces draws it.
struct Paraboloids {
    ImageHandle position, normal, albedo;  // rgba32f: m; rgba16f: unit normal; rgba16f: albedo
    ImageHandle depth;
    BufferHandle clusters;  // io::SsvpCluster: where each looks from and to
    uint32_t count = 0, mapSize = 0;
};
using DrawParaboloids = FunctionRef<void(GraphScope, const Paraboloids&)>;

// `firstCount` lights of the first bounce, as the RSMs share them.
Ssvp addSsvp(GraphScope scope, const RsmSet& rsm, uint32_t firstCount, const SsvpSettings& settings,
             DrawParaboloids draw);

}  // namespace ag::gi
