#include "tools/workbench/turntable.h"

#include <glm/gtc/quaternion.hpp>
#include <numbers>

namespace ag::workbench {
namespace {

bool holds(const Bounds& b, glm::vec3 p) {
    return glm::all(glm::greaterThanEqual(p, b.min)) && glm::all(glm::lessThanEqual(p, b.max));
}

}  // namespace

CameraPose turned(const CameraPose& start, const Bounds& bounds, glm::dvec3 origin, double share) {
    const glm::dquat turn = glm::angleAxis(share * 2 * std::numbers::pi, glm::dvec3(0, 1, 0));
    CameraPose pose = start;
    pose.forward = glm::vec3(turn * glm::dvec3(start.forward));
    pose.up = glm::vec3(turn * glm::dvec3(start.up));
    if (bounds.empty() || holds(bounds, glm::vec3(start.position - origin))) return pose;
    const glm::dvec3 middle = origin + glm::dvec3((bounds.min + bounds.max) * 0.5f);
    pose.position = middle + turn * (start.position - middle);
    return pose;
}

}  // namespace ag::workbench
