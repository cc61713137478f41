// Lets the headers beside it compile as GLSL and as C++ (GLM): the shipping formulas are the tested ones.
#ifndef AG_PORTABLE_H
#define AG_PORTABLE_H

#ifdef __cplusplus
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>

namespace ag::io {
using uint = uint32_t;
using glm::abs, glm::clamp, glm::cross, glm::dot, glm::floor, glm::fract, glm::greaterThan, glm::inversesqrt,
    glm::length, glm::max, glm::min, glm::mix, glm::normalize, glm::sign;
using glm::ivec4, glm::mat4, glm::uvec2, glm::uvec4, glm::vec2, glm::vec3, glm::vec4;
using std::acos, std::cos, std::exp2, std::log2, std::pow, std::sin, std::sqrt;
}  // namespace ag::io
#define AG_FUNCTION inline
#define AG_OUT(T) T&
#define AG_INOUT(T) T&
#define AG_BEGIN namespace ag::io {
#define AG_END }
#else
#define AG_FUNCTION
#define AG_OUT(T) out T
#define AG_INOUT(T) inout T
#define AG_BEGIN
#define AG_END
#endif

AG_BEGIN
const float kMostHalf = 65504.0f;  // of a half float: light that is stored as such ends here
const float kPi = 3.14159265f;
const float kInvPi = 0.318309886f;
AG_END

#endif
