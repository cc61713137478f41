// Skinned meshes: meshes bent by joints (glTF's skins). What they are made of follows from an asset, how they
// are bent from an animation and a time alone: joints are no entities.
#pragma once

#include <span>

#include "engine/scene/scene_asset.h"

namespace ag {

// A mesh with a skin.
struct SkinnedModel {
    struct PoseNode {
        uint32_t node = 0;    // of the asset
        int32_t parent = -1;  // an earlier one of these, -1: the frame
    };
    struct PoseChannel {
        uint32_t channel = 0;  // of the animation
        uint32_t node = 0;     // of `nodes`
    };
    uint32_t mesh = 0, skin = 0;  // of the asset
    int32_t frame =
        -1;  // the node all joints hang from: the skinned mesh stands in its frame; -1: in the world's
    uint32_t firstVertex = 0, vertexCount = 0;         // of the geometry
    std::vector<PoseNode> nodes;                       // joints and what lies between them
    std::vector<uint32_t> jointNodes;                  // of `nodes`, by joint
    std::vector<Bounds> jointBounds;                   // of the vertices each joint moves, as modelled
    std::vector<std::vector<PoseChannel>> animations;  // what of each moves these nodes
};

struct SkinnedMeshLibrary {  // resource; the asset must outlive it
    const SceneAsset* asset = nullptr;
    std::vector<SkinnedModel> models;             // in the order of the nodes that first show them
    std::vector<int32_t> modelOfNode;             // -1: the node shows no skinned mesh
    std::vector<std::vector<uint32_t>> channels;  // of each animation, by the nodes they move
    std::span<const uint32_t> channelsOf(uint32_t animation, uint32_t node) const;
};

SkinnedMeshLibrary makeSkinnedMeshLibrary(const SceneAsset& asset);

// Rows of each joint's matrix; the rest pose where there is no such animation.
void poseSkinnedMesh(const SkinnedMeshLibrary& library, uint32_t model, int32_t animation, float seconds,
                     std::span<glm::mat3x4> joints);

// What holds all of the bent mesh: each vertex lies among where its joints would put it.
Bounds boundsOfPose(const SkinnedModel& model, std::span<const glm::mat3x4> joints);

// A skinned mesh's row and joints at the end of a scene's; returns its index. It has no pose yet.
uint32_t addSkinnedMesh(const SkinnedModel& model, RenderScene& scene);
// After its joints were written: bounds and version follow; false if they are what they were.
bool finishPose(const SkinnedModel& model, RenderScene& scene, uint32_t skinnedMesh);

}  // namespace ag
