#include "game/systems/move_boxes.h"

#include <numbers>

namespace ag::game {

void moveBoxes(View<LocalTransform, const Mover> boxes, Res<const GameTime> time) {
    boxes.each([&](LocalTransform& local, const Mover& mover) {
        const double phase =
            mover.period > 0 ? std::sin(2 * std::numbers::pi * time->seconds / double(mover.period)) : 0;
        const float yaw =
            mover.startYaw + float(std::fmod(double(mover.spinSpeed) * time->seconds, 2 * std::numbers::pi));
        local.translation = mover.origin + glm::dvec3(mover.extent) * phase;
        local.rotation = glm::angleAxis(yaw, glm::vec3(0, 1, 0));
    });
}

}  // namespace ag::game
