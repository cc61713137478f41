// What the loops compute: the same inline functions run over our store and over plain arrays.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace ag::ecs_bench {

struct Position {
    glm::vec3 m{0};
};
struct Velocity {
    glm::vec3 mPerS{0};
};
struct Acceleration {
    glm::vec3 mPerS2{0};
};
struct Rotation {
    glm::quat q{1, 0, 0, 0};
};
struct Spin {
    glm::vec3 radPerS{0};
};
struct Life {
    float s = 0;
};
struct Warmth {
    float k = 0;
};

constexpr float kStep = 1.0f / 60;  // s

inline void iterate1(Position& p) {
    p.m += glm::vec3(0.25f, 0.5f, 1);
}
inline void iterate2(Position& p, const Velocity& v) {
    p.m += v.mPerS * kStep;
}
inline void iterate3(Position& p, Velocity& v, const Acceleration& a) {
    v.mPerS += a.mPerS2 * kStep;
    p.m += v.mPerS * kStep;
}
inline void turn(glm::quat& q, const glm::vec3& radPerS) {
    const glm::quat change(0, radPerS * (0.5f * kStep));
    q = q + change * q;
    q = q * (1 / std::sqrt(glm::dot(q, q)));
}
inline void iterate7(Position& p, Velocity& v, const Acceleration& a, Rotation& r, const Spin& s, Life& life,
                     Warmth& warmth) {
    iterate3(p, v, a);
    turn(r.q, s.radPerS);
    life.s -= kStep;
    warmth.k *= 0.999f;
}

inline Position positionOf(uint32_t i) {
    return {glm::vec3(float(i % 1000), float(i % 77), 1)};
}
inline Velocity velocityOf(uint32_t i) {
    return {glm::vec3(1, float(i % 13), -1)};
}
inline Acceleration accelerationOf(uint32_t i) {
    return {glm::vec3(0, -9.81f, float(i % 3))};
}

}  // namespace ag::ecs_bench
