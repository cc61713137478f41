// Punctual lights that share a shadow map (LightCluster, Wiesenhütter, Klein, Nischwitz). Pure functions of
// lights and camera. Two passes: centres among the lights themselves by a minimum distance in proportion to
// the distance to the camera, then each other light to the nearest centre.
#pragma once

#include <vector>

#include "engine/core/setting_fields.h"
#include "engine/renderer/punctual_relevance.h"
#include "engine/scene/render_scene.h"

namespace ag::render {

constexpr uint32_t kMostLightClusters = 256;
// In view; of more the brightest as seen from the camera are taken.
constexpr uint32_t kMostPunctualLights = 16384;

struct LightClusterSettings {
    float growth = 0.02f;  // m between centres for each m to the camera: the error seen stays the same
    uint32_t most = 32;    // clusters; the distances are stretched until so many do
    // Lights that matter keep a map of their own longer; off: as published, in order.
    bool strongFirst = true;
    float hysteresis = 0.75f;  // a centre of the frame before needs this part of the distance; 1: none

    // Farther from the nearest centre than this part of its range a light goes without shadow: the centre's
    // says nothing of what is so near to the light. 0: no limit, as published.
    float shareWithin = 0.5f;

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"growth", &LightClusterSettings::growth, 0, 10, "",
                         "m between clusters' centres for each m to the camera"},
            SettingField{"most", &LightClusterSettings::most, 0, kMostLightClusters, "clusters",
                         "of lights, each with a shadow map"},
            SettingField{"strong_first", &LightClusterSettings::strongFirst, 0, 0, "",
                         "lights that matter keep a shadow map of their own longer"},
            SettingField{"hysteresis", &LightClusterSettings::hysteresis, 0, 1, "",
                         "part of the distance that a centre of before needs"},
            SettingField{
                "share_within", &LightClusterSettings::shareWithin, 0, 100, "",
                "part of its range that a light may be from the centre whose shadow it shares; 0: no limit"}};
    }

    bool operator==(const LightClusterSettings&) const = default;
};

struct LightCluster {
    uint32_t center = 0;  // index into the scene's lights
    float radius = 0;     // m: of its farthest light from the centre, the size of the light its shadows have
    float reach = 0;      // m from the centre, that light of its lights may go; 0: without limit
    uint32_t lightCount = 0;
};

struct LightClusters {
    std::vector<uint32_t> lights;     // indices into the scene's lights: those that may light what is seen
    std::vector<uint32_t> clusterOf;  // parallel to `lights`; kNoCluster: casts no shadow
    std::vector<LightCluster> clusters;
    float stretch = 1;     // what the distances were multiplied by to keep to the budget
    uint32_t leftOut = 0;  // lights in view beyond kMostPunctualLights
    static constexpr uint32_t kNoCluster = ~0u;
};

// What outlives a frame; also scratch, so that a steady frame allocates nothing.
struct LightClusterHistory {
    std::vector<uint64_t> centers;  // ids of lights, sorted
    std::vector<uint32_t> order;
    std::vector<float> weights;    // how much each light matters, 1: as the mean
    std::vector<float> distances;  // m that centres keep from each light
    LightClusters clusters;
    // What they were made for; while it is the same nothing is done.
    std::vector<RenderLight> lights;
    glm::mat4 clipFromWorld{0};
    LightClusterSettings settings;
    PunctualRelevance relevance;
};

// Whether a sphere reaches into a camera's view (its five planes; there is no far one).
bool sphereInView(const glm::mat4& clipFromWorld, glm::vec3 center, float radius);

// How many clusters may come to need a map: `most`, or the scene's casters, in powers of two, so that neither
// walking about nor lights that come and go change it often.
uint32_t mostClustersNeeded(const RenderScene& scene, uint32_t most);

// Spots and points with light whose range reaches into the view, clustered. The result lives in the history.
const LightClusters& clusterLights(const RenderScene& scene, const PunctualRelevance& relevance,
                                   const LightClusterSettings& settings, LightClusterHistory& history);

}  // namespace ag::render
