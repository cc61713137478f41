// Pictures of plaster, stone, wood, cloth and the like, computed: periodic noise, nothing is read from a
// file.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace ag::game {

constexpr int kTexels = 256;  // along a side

struct Substance {
    std::string_view name;
    float meters = 1;     // along a side of its picture
    float roughness = 1;  // 1: matt
    float bumps = 0;      // m, from the deepest to the highest
    // Of a texel: how light it is, 0 to 1, and how high, 0 to 1.
    glm::vec2 (*at)(glm::vec2 place) = nullptr;
};

// By the end of a material's name; none: it is plain.
std::optional<Substance> substanceOf(std::string_view material);

struct SubstancePictures {
    std::vector<uint8_t> color, normal;  // RGBA8, kTexels squared: sRGB and linear
    float mean = 1;                      // of the color, linear
};
SubstancePictures drawSubstance(const Substance& substance);

}  // namespace ag::game
