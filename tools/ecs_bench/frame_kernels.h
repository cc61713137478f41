// A frame of 50,000 moving objects: what each step computes, and how each object begins. Ours and the plain
// arrays run the same functions and must end in the same bits.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x3.hpp>
#include <vector>

#include "engine/core/hash.h"
#include "engine/ecs/entity.h"
#include "tools/ecs_bench/kernels.h"

namespace ag::ecs_bench {

struct Local {
    glm::vec3 place{0};  // m
    float scale = 1;
    glm::quat turn{1, 0, 0, 0};
};
struct Matrix {
    glm::mat4x3 worldFromLocal{1};
};
struct Extent {  // of the mesh
    glm::vec3 center{0}, half{0.5f};
};
struct WorldBox {
    glm::vec3 center{0}, half{0};
};
struct Visible {
    uint32_t yes = 0;
};
struct Glow {
    glm::vec3 intensity{1};  // W/sr
};
struct Health {
    float points = 100;
};
struct Harm {
    float perS = 1;
};
struct Spark {
    float left = 0;  // s
    uint32_t seed = 0;
};
struct GatheredLight {
    glm::vec3 place, intensity;
};
using Planes = std::array<glm::vec4, 6>;

}  // namespace ag::ecs_bench

namespace ag {
template <>
inline constexpr bool kTrackRows<ecs_bench::Matrix> = true;
}

namespace ag::ecs_bench {

constexpr uint32_t kPlainThings = 16'000, kLamps = 1'000, kHarmed = 5'000, kSparks = 4'000, kRigs = 4'000,
                   kLimbsPerRig = 4, kObjects = kPlainThings + kLamps + kHarmed + kSparks + kRigs * 6;

inline void moveThing(Local& local, Velocity& v) {
    v.mPerS -= local.place * (0.05f * kStep);  // swings about the middle for ever
    local.place += v.mPerS * kStep;
}
inline void spinThing(Local& local, const Spin& s) {
    turn(local.turn, s.radPerS);
}
inline glm::mat4x3 matrixOf(const Local& local) {
    const glm::mat3 r = glm::mat3_cast(local.turn);
    return {r[0] * local.scale, r[1] * local.scale, r[2] * local.scale, local.place};
}
[[gnu::always_inline]] inline glm::mat4x3 below(const glm::mat4x3& parent, const Local& local) {
    const glm::mat3 p(parent[0], parent[1], parent[2]);
    const glm::mat4x3 m = matrixOf(local);
    return {p * m[0], p * m[1], p * m[2], p * m[3] + parent[3]};
}
// Without a branch; glm::abs compiles to one, and signs here are random.
inline glm::vec3 absolute(const glm::vec3& v) {
    return {std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
}
inline WorldBox boxOf(const glm::mat4x3& m, const Extent& e) {
    return {m[0] * e.center.x + m[1] * e.center.y + m[2] * e.center.z + m[3],
            absolute(m[0]) * e.half.x + absolute(m[1]) * e.half.y + absolute(m[2]) * e.half.z};
}
inline uint32_t inside(const WorldBox& box, const Planes& planes) {
    uint32_t yes = 1;
    for (const glm::vec4& p : planes) {
        const glm::vec3 n(p);
        yes &= uint32_t(glm::dot(n, box.center) + glm::dot(absolute(n), box.half) + p.w >= 0);
    }
    return yes;
}
inline void harm(Health& health, const Harm& by) {
    health.points -= by.perS * kStep;
    if (health.points < 0) health.points += 100;
}

inline float unit(uint32_t seed) {
    return float(uint32_t(mixHash(seed + 1) >> 40)) * 0x1p-24f;
}
inline glm::vec3 someVector(uint32_t seed) {
    return glm::vec3(unit(3 * seed), unit(3 * seed + 1), unit(3 * seed + 2)) * 2.0f - 1.0f;
}
inline Local localOf(uint32_t seed) {
    return {someVector(seed) * 60.0f, 0.5f + unit(seed), glm::quat(1, 0, 0, 0)};
}
inline Local limbOf(uint32_t seed) {
    return {someVector(seed), 0.9f, glm::quat(1, 0, 0, 0)};
}
inline Spin spinOf(uint32_t seed) {
    return {someVector(seed + 77)};
}
inline Velocity startOf(uint32_t seed) {
    return {someVector(seed + 99) * 4.0f};
}
inline Spark sparkOf(uint32_t seed) {
    return {0.02f + 0.36f * unit(seed), seed};
}
inline uint32_t nextSeed(uint32_t seed) {
    return uint32_t(mixHash(seed));
}
inline Planes cameraPlanes() {  // a frustum that sees about a third of the things
    Planes planes;
    for (int i = 0; i < 4; ++i) {
        const float side = i & 1 ? 1.0f : -1.0f;
        const glm::vec3 n = glm::normalize(i < 2 ? glm::vec3(side, 0, -0.9f) : glm::vec3(0, side, -0.9f));
        planes[size_t(i)] = glm::vec4(n, -glm::dot(n, glm::vec3(0, 0, 50)));
    }
    planes[4] = {0, 0, -1, 50};
    planes[5] = {0, 0, 1, 90};
    return planes;
}

// Of a set of objects, whatever their order.
inline uint64_t objectHash(const Matrix& m, const WorldBox& box, const Visible& visible) {
    return hashValue(m, hashValue(box, visible.yes));
}

}  // namespace ag::ecs_bench
