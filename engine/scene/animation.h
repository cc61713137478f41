// What an animation makes of a transform at a time: glTF 2.0's three interpolations. Without the library's
// sines, which differ from machine to machine.
#pragma once

#include "engine/scene/scene_asset.h"

namespace ag {

// Before the first time its value holds, after the last that one's.
glm::vec4 sampleChannel(const SceneChannel& channel, float seconds);
void applyChannel(const SceneChannel& channel, float seconds, NodeTransform& transform);

// Along the shorter arc at even speed, within 1e-5 radians; both unit.
glm::quat slerpQuat(glm::quat a, glm::quat b, float t);

// The asset as it stands at a time of one of its animations: nodes are moved, skinned meshes will be posed
// so.
void poseAsset(SceneAsset& asset, uint32_t clip, float seconds);

// `seconds` further on by `step`, within the animation: round again, or held at its ends.
float advanceClip(float seconds, float step, float duration, bool loops);

}  // namespace ag
