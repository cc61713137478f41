#include "engine/scene/animation_system.h"

#include <algorithm>

#include "engine/scene/animation.h"

namespace ag {
namespace {

const SceneAnimation* animationOf(const FigureLibrary& library, const AnimationPlayer& player) {
    const auto& all = library.asset->animations;
    return player.clip >= 0 && size_t(player.clip) < all.size() ? &all[size_t(player.clip)] : nullptr;
}

std::vector<PosedFigure> figuresOf(FigureRows& rows) {
    std::vector<PosedFigure> figures;
    rows.each([&](Entity entity, const Figure& figure, const AnimationPlayer& player, const MeshInstance&) {
        figures.push_back({entity, figure.model, player.clip, player.seconds});
    });
    return figures;
}

}  // namespace

void advancePlayers(View<AnimationPlayer> players, const FigureLibrary& library, float step,
                    JobRunner& runner) {
    players.parallel(runner, [&](AnimationPlayer& player) {
        const SceneAnimation* animation = animationOf(library, player);
        if (!animation || player.speed == 0) return false;
        const float next =
            advanceClip(player.seconds, step * player.speed, animation->duration, player.loops != 0);
        return std::exchange(player.seconds, next) != next;
    });
}

void animateNodes(AnimatedNodes nodes, Res<const FigureLibrary> library, JobRunner& runner) {
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

void poseFigures(FigureRows rows, Res<const FigureLibrary> library, Res<ExtractState> state,
                 Res<RenderScene> scene, JobRunner& runner) {
    constexpr uint32_t kGrain = 8;  // figures
    std::vector<PosedFigure> figures = figuresOf(rows);
    const bool same = std::ranges::equal(figures, state->figures, [](const auto& a, const auto& b) {
        return a.entity == b.entity && a.model == b.model;
    });
    if (!same) {
        scene->figures.clear();
        scene->joints.clear();
        for (const PosedFigure& figure : figures)
            addFigure(library->models[figure.model], *scene);
        state->figuresReplaced = true;
    }
    state->poseChanged.assign(figures.size(), 0);
    runner.parallelFor(uint32_t(figures.size()), kGrain, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            if (same && figures[i] == state->figures[i]) continue;
            const RenderFigure& row = scene->figures[i];
            const FigureModel& model = library->models[figures[i].model];
            poseFigure(*library, figures[i].model, figures[i].clip, figures[i].seconds,
                       std::span(scene->joints).subspan(row.firstJoint, row.jointCount));
            state->poseChanged[i] = finishPose(model, *scene, i);
        }
    });
    state->figures = std::move(figures);
}

}  // namespace ag
