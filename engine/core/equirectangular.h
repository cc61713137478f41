// Pictures of all directions: rows from the zenith (+Y) to the nadir, columns round from -X by -Z, +X and +Z.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <span>

namespace ag {

// The place in the picture that a unit direction looks at, both coordinates in [0, 1], and back.
inline glm::vec2 skyPlace(glm::vec3 d) {
    constexpr float kPi = std::numbers::pi_v<float>;
    return {std::atan2(d.z, d.x) / (2 * kPi) + 0.5f, std::acos(std::clamp(d.y, -1.0f, 1.0f)) / kPi};
}
inline glm::vec3 skyDirection(glm::vec2 place) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float phi = (place.x - 0.5f) * 2 * kPi, theta = place.y * kPi;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

// Solid angle in sr of a texel in row `row` of a picture of that size.
inline float skyTexelAngle(glm::ivec2 size, int row) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const float step = kPi / float(size.y);
    return 2 * kPi / float(size.x) * (std::cos(float(row) * step) - std::cos(float(row + 1) * step));
}

// Bilinear.
inline glm::vec3 lookUpDirection(glm::ivec2 size, std::span<const glm::vec3> pixels, glm::vec3 direction) {
    const glm::vec2 at = skyPlace(direction) * glm::vec2(size) - 0.5f, low = glm::floor(at), f = at - low;
    const auto texel = [&](int dx, int dy) {
        const int x = (int(low.x) + dx + size.x) % size.x, y = std::clamp(int(low.y) + dy, 0, size.y - 1);
        return pixels[size_t(y) * size_t(size.x) + size_t(x)];
    };
    return glm::mix(glm::mix(texel(0, 0), texel(1, 0), f.x), glm::mix(texel(0, 1), texel(1, 1), f.x), f.y);
}

}  // namespace ag
