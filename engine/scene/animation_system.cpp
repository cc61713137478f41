#include "engine/scene/animation_system.h"

#include <algorithm>

#include "engine/scene/animation.h"

namespace ag {
namespace {

const SceneAnimation* animationOf(const SkinnedMeshLibrary& library, const AnimationPlayer& player) {
    const auto& all = library.asset->animations;
    return player.clip >= 0 && size_t(player.clip) < all.size() ? &all[size_t(player.clip)] : nullptr;
}

std::vector<PosedSkinnedMesh> skinnedMeshesOf(SkinnedRows& rows) {
    std::vector<PosedSkinnedMesh> skinnedMeshes;
    rows.each([&](Entity entity, const SkinnedMesh& skinnedMesh, const AnimationPlayer& player,
                  const MeshInstance&) {
        skinnedMeshes.push_back({entity, skinnedMesh.model, player.clip, player.seconds});
    });
    return skinnedMeshes;
}

}  // namespace

void advancePlayers(View<AnimationPlayer> players, const SkinnedMeshLibrary& library, float step,
                    JobRunner& runner) {
    players.parallel(runner, [&](AnimationPlayer& player) {
        const SceneAnimation* animation = animationOf(library, player);
        if (!animation || player.speed == 0) return false;
        const float next =
            advanceClip(player.seconds, step * player.speed, animation->duration, player.loops != 0);
        return std::exchange(player.seconds, next) != next;
    });
}

void animateNodes(AnimatedNodes nodes, Res<const SkinnedMeshLibrary> library, JobRunner& runner) {
    nodes.parallel(runner, [&](LocalTransform& local, const AnimationPlayer& player) {
        const SceneAnimation* animation = animationOf(*library, player);
        if (!animation) return false;
        NodeTransform at{local.translation, local.rotation, local.scale};
        for (const uint32_t channel : library->channelsOf(uint32_t(player.clip), local.node))
            applyChannel(animation->channels[channel], player.seconds, at);
        const bool same =
            at.translation == local.translation && at.rotation == local.rotation && at.scale == local.scale;
        local.translation = at.translation, local.rotation = at.rotation, local.scale = at.scale;
        return !same;
    });
}

void poseSkinnedMeshes(SkinnedRows rows, Res<const SkinnedMeshLibrary> library, Res<ExtractState> state,
                       Res<RenderScene> scene, JobRunner& runner) {
    constexpr uint32_t kGrain = 8;  // skinned meshes
    std::vector<PosedSkinnedMesh> skinnedMeshes = skinnedMeshesOf(rows);
    const bool same = std::ranges::equal(
        skinnedMeshes, state->skinnedMeshes,
        [](const auto& a, const auto& b) { return a.entity == b.entity && a.model == b.model; });
    if (!same) {
        scene->skinnedMeshes.clear();
        scene->joints.clear();
        for (const PosedSkinnedMesh& skinnedMesh : skinnedMeshes)
            addSkinnedMesh(library->models[skinnedMesh.model], *scene);
        state->skinnedMeshesReplaced = true;
    }
    state->poseChanged.assign(skinnedMeshes.size(), 0);
    runner.parallelFor(uint32_t(skinnedMeshes.size()), kGrain, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            if (same && skinnedMeshes[i] == state->skinnedMeshes[i]) continue;
            const RenderSkinnedMesh& row = scene->skinnedMeshes[i];
            const SkinnedModel& model = library->models[skinnedMeshes[i].model];
            poseSkinnedMesh(*library, skinnedMeshes[i].model, skinnedMeshes[i].clip, skinnedMeshes[i].seconds,
                            std::span(scene->joints).subspan(row.firstJoint, row.jointCount));
            state->poseChanged[i] = finishPose(model, *scene, i);
        }
    });
    state->skinnedMeshes = std::move(skinnedMeshes);
}

}  // namespace ag
