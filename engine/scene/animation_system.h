// Animations in a world: players go on by ticks, nodes and figures' joints follow.
#pragma once

#include "engine/ecs/view.h"
#include "engine/scene/components.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/figure.h"

namespace ag {

// Of a tick; those at rest are not written.
void advancePlayers(View<AnimationPlayer> players, const FigureLibrary& library, float step,
                    JobRunner& runner);

using AnimatedNodes = View<LocalTransform, Changed<const AnimationPlayer>, Without<Figure>>;
void animateNodes(AnimatedNodes nodes, Res<const FigureLibrary> library, JobRunner& runner);

// Before extractScene: the joints of each figure whose player moved on.
void poseFigures(FigureRows figures, Res<const FigureLibrary> library, Res<ExtractState> state,
                 Res<RenderScene> scene, JobRunner& runner);

}  // namespace ag
