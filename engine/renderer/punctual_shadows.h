// Depth maps of punctual light clusters: six faces of a cube about each cluster's centre, or one square round
// the cone of a spot that shares with none. They live in an atlas where each keeps its place while its centre
// stays one, and only faces in which something moved are drawn again.
#pragma once

#include "engine/core/setting_fields.h"
#include "engine/renderer/light_clusters.h"
#include "engine/renderer/scene_gpu.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {

struct PunctualShadowSettings {
    uint32_t faceResolution = 512;  // texels along a cube face's side, at most; smaller for many clusters
    uint32_t atlasSize = 4096;      // texels along the atlas's side
    uint32_t softTaps = 0;  // of the disk as large as a cluster that its shadow comes from; 0: its centre

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"face_resolution", &PunctualShadowSettings::faceResolution, 16, 2048, "texels",
                         "side of a cube's face, at most; a spot's map has twice"},
            SettingField{"atlas_size", &PunctualShadowSettings::atlasSize, 256, 16384, "texels",
                         "side of the atlas"},
            SettingField{"soft_taps", &PunctualShadowSettings::softTaps, 0, 64, "taps",
                         "of a disk as large as a cluster, for its shadow; 0: from its centre"}};
    }

    bool operator==(const PunctualShadowSettings&) const = default;
};

struct PunctualShadowHistory {
    std::vector<uint64_t> owners;  // one more than the id of the light whose place it is; 0: free
    std::vector<uint32_t> places;  // of this frame's clusters
    // Scratch
    std::vector<io::LightClusterRow> rows;
    std::vector<ViewRequest> views;  // faces that are drawn
    std::vector<glm::uvec4> rects;   // theirs
};

struct PunctualShadows {
    ImageHandle atlas;      // D32; invalid: no light casts shadows
    BufferHandle clusters;  // io::LightClusterRow; also a texel buffer of vec4
    uint32_t softTaps = 0;
    uint32_t places = 0;  // of clusters that may come to need one; steadier than how many do
};

PunctualShadows addPunctualShadows(GraphScope scope, const SceneView& scene, const LightClusters& clusters,
                                   uint32_t mostClusters, const PunctualShadowSettings& settings,
                                   PunctualShadowHistory& history);

// Whether a cluster's map is a spot's single view.
bool isSpotCluster(const RenderScene& scene, const LightCluster& cluster);

}  // namespace ag::render
