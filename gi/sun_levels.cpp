#include "gi/sun_levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>

namespace ag::gi {
namespace {

constexpr float kCoarse = 2.5f;       // times what was asked for: wider texels have a level more
constexpr float kDistanceBand = 2;    // within which what levels are made for stays
constexpr int32_t kStepsAlong = 8;    // of a level, of its width each, in which it follows the camera
constexpr float kOutOfPlace = 0.75f;  // of a step that a level is behind before it follows
constexpr size_t kLeastSeen = 32;     // with a surface, for a median

// The part of a map from `begin` (texels) on that is `kSunLevelRatio` times narrower.
LightView partOf(const LightView& whole, glm::ivec2 begin, uint32_t size) {
    const float ratio = kSunLevelRatio;
    const glm::vec2 low = glm::vec2(begin) / float(size) * 2.0f - 1.0f;  // in clip space, 2 / ratio wide
    glm::mat4 crop(1);
    for (int i = 0; i < 2; ++i) {
        crop[i][i] = ratio;
        crop[3][i] = -ratio * low[i] - 1;
    }
    return {crop * whole.clipFromWorld, whole.tanHalf / ratio};
}

// Where the level about `eye` begins, in texels of the one about it: on a grid of its own, not before it is
// some way out of place.
glm::ivec2 beginAbout(glm::vec3 eye, const LightView& around, uint32_t size, const glm::ivec2* before) {
    const int32_t width = int32_t(size / kSunLevelRatio), step = std::max(width / kStepsAlong, 1);
    const glm::vec2 at = glm::vec2(around.clipFromWorld * glm::vec4(eye, 1)) * 0.5f + 0.5f;
    const glm::vec2 wanted = glm::clamp(at, -1.0f, 2.0f) * float(size) - float(width) / 2;
    glm::ivec2 begin = glm::ivec2(glm::round(wanted / float(step))) * step;
    for (int i = 0; before && i < 2; ++i)
        if (std::abs(wanted[i] - float((*before)[i])) < kOutOfPlace * float(step)) begin[i] = (*before)[i];
    return glm::clamp(begin, 0, int32_t(size) - width);
}

// None: few of them show a surface.
std::optional<float> medianDistance(std::span<const std::byte> viewPoints, glm::vec3 eye) {
    std::array<float, io::kViewPointCount> distances;
    size_t count = 0;
    for (; viewPoints.size() >= sizeof(io::ViewPoint) && count < distances.size();
         viewPoints = viewPoints.subspan(sizeof(io::ViewPoint))) {
        io::ViewPoint point;
        std::memcpy(&point, viewPoints.data(), sizeof point);
        if (point.weight > 0) distances[count++] = glm::distance(point.position, eye);
    }
    if (count < kLeastSeen) return std::nullopt;
    const auto middle = distances.begin() + count / 2;
    std::nth_element(distances.begin(), middle, distances.begin() + count);
    return std::isfinite(*middle) ? std::optional(*middle) : std::nullopt;
}

}  // namespace

SunFocus followFocus(std::span<const std::byte> viewPoints, glm::vec3 eye, SunFocusHistory& history) {
    const bool known = history.known == history.eyes.size();
    const glm::vec3 eyeThen = history.eyes.front();
    std::ranges::rotate(history.eyes, history.eyes.begin() + 1);
    history.eyes.back() = eye;
    history.known = std::min(history.known + 1, uint32_t(history.eyes.size()));
    history.focus.eye = eye;
    if (known) history.focus.distance = medianDistance(viewPoints, eyeThen).value_or(history.focus.distance);
    return history.focus;
}

float steadyDistance(float distance, float before) {
    const bool near = distance < before * kDistanceBand && distance * kDistanceBand > before;
    return near ? before : distance;
}

std::span<const SunLevel> layOutSunLevels(const LightView& whole, uint32_t size, const SunFocus& focus,
                                          float detail, SunLevelsHistory& history,
                                          std::array<SunLevel, io::kMostSunLevels>& levels) {
    history.distance = steadyDistance(focus.distance, history.distance);
    const float wanted = detail * history.distance;
    levels[0] = {.view = whole};
    uint32_t count = 1;
    for (; wanted > 0 && count < levels.size(); ++count) {
        SunLevel& around = levels[count - 1];
        if (2 * around.view.tanHalf / float(size) < kCoarse * wanted) break;
        const glm::ivec2 begin = beginAbout(focus.eye, around.view, size,
                                            count < history.known ? &history.begins[count] : nullptr);
        history.begins[count] = begin;
        around.holeBegin = begin;
        around.holeSize = size / kSunLevelRatio;
        levels[count] = {.view = partOf(around.view, begin, size)};
    }
    history.known = count;
    return {levels.data(), count};
}

}  // namespace ag::gi
