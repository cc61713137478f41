#include "game/picture_check.h"

#include <algorithm>

namespace ag::game {

Extremes extremesOf(const Image& picture) {
    constexpr glm::vec3 kLuminance(0.2126f, 0.7152f, 0.0722f);
    size_t dark = 0, bright = 0;
    for (const glm::vec3& pixel : picture.pixels) {
        const float level = 255 * glm::dot(glm::clamp(pixel, 0.0f, 1.0f), kLuminance);
        dark += level < 16;
        bright += level >= 250;
    }
    const float all = float(std::max(picture.pixels.size(), size_t(1)));
    return {float(dark) / all, float(bright) / all};
}

}  // namespace ag::game
