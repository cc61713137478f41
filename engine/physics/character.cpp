#include "engine/physics/character.h"

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

constexpr float kSkin = 0.015f;  // m kept from what is met
constexpr int kMostSlides = 4;
constexpr float kFlatOn = 0.9f;    // cosine between the way and what stops it, past which one slides along
constexpr float kShoulder = 1.5f;  // radii beside an obstacle's edge that one steps round it

Capsule capsuleOf(const Character& c, const CharacterSettings& s) {
    return {s.radius, c.height};
}

// Along `way` until something is in it; the hit, if any.
std::optional<BodyHit> advance(const PhysicsWorld& physics, Capsule capsule, glm::dvec3& feet,
                               glm::vec3 way) {
    const float length = glm::length(way);
    if (length < 1e-6f) return std::nullopt;
    const glm::vec3 direction = way / length;
    auto hit = physics.sweep(capsule, feet, feet + glm::dvec3(direction * (length + kSkin)));
    const float free = hit ? std::max(hit->share * (length + kSkin) - kSkin, 0.0f) : length;
    feet += glm::dvec3(direction * free);
    if (hit) hit->share = free / length;
    return hit;
}

// Ground, or the edge of ground: there a round foot meets a corner, so what lies behind it decides.
bool carries(const PhysicsWorld& physics, glm::dvec3 feet, const BodyHit& hit, const CharacterSettings& s) {
    if (hit.normal.y >= s.steepest) return true;
    glm::dvec3 outward = hit.position - feet;
    outward.y = 0;
    if (hit.normal.y < 0.1f || glm::length(outward) < 1e-4) return false;
    const glm::dvec3 behind = hit.position + glm::normalize(outward) * 0.03;
    const auto top = physics.ray(behind + glm::dvec3(0, 0.1, 0), behind - glm::dvec3(0, 0.1, 0));
    return top && top->normal.y >= s.steepest;
}

// How hard one walks: what is in the way is to move as fast.
struct Push {
    glm::vec3 velocity{0};  // m/s
    float seconds = 0;      // that it lasts
};

// What is walked into gives way, as far as the arms can.
void pushBody(PhysicsWorld& physics, const BodyHit& hit, const Push& push, const CharacterSettings& s) {
    if (physics.kind(hit.body) != BodyKind::kDynamic) return;
    glm::vec3 into = -hit.normal;
    into.y = 0;
    const float flat = glm::length(into);
    if (flat < 0.3f) return;
    into /= flat;
    const float wanted = std::min(glm::dot(push.velocity, into), s.pushSpeed),
                has = glm::dot(physics.pose(hit.body).velocity, into);
    const float impulse =
        std::clamp((wanted - has) * physics.mass(hit.body), 0.0f, s.pushForce * push.seconds);
    if (impulse > 0) physics.push(hit.body, into * impulse, hit.position);
}

// Along the ground or through the air, sliding along what stands upright; what gives way is pushed.
glm::vec3 slide(PhysicsWorld& physics, const Character& c, glm::dvec3& feet, glm::vec3 way,
                const CharacterSettings& s, const Push& push) {
    const glm::vec3 wanted = way;
    glm::vec3 met[kMostSlides];
    for (int i = 0; i < kMostSlides; ++i) {
        const auto hit = advance(physics, capsuleOf(c, s), feet, way);
        if (!hit) break;
        if (push.velocity != glm::vec3(0)) pushBody(physics, *hit, push, s);
        way *= 1 - hit->share;
        glm::vec3 normal = hit->normal;
        if (normal.y < s.steepest) normal.y = 0;  // walls are not climbed
        if (glm::length(normal) < 1e-3f) break;
        met[i] = glm::normalize(normal);
        for (int j = 0; j <= i; ++j)
            way -= met[j] * std::min(glm::dot(way, met[j]), 0.0f);
        if (glm::dot(way, wanted) <= 0) break;  // a corner
    }
    return way;
}

// Straight ahead; where that is blocked, up a step, ahead, and down again.
void walk(PhysicsWorld& physics, Character& c, glm::vec3 way, const Push& push, const CharacterSettings& s) {
    glm::dvec3 straight = c.feet, over = c.feet;
    slide(physics, c, straight, way, s, push);
    if (c.grounded) {
        advance(physics, capsuleOf(c, s), over, {0, s.stepHeight, 0});
        const double up = over.y - c.feet.y;
        slide(physics, c, over, way, s, {});
        const auto ground = advance(physics, capsuleOf(c, s), over, {0, -float(up) - 0.02f, 0});
        const auto gained = [&](glm::dvec3 p) {
            return glm::length(glm::dvec2(p.x - c.feet.x, p.z - c.feet.z));
        };
        const bool step =
            ground && physics.kind(ground->body) != BodyKind::kDynamic && carries(physics, over, *ground, s);
        if (step && gained(over) > gained(straight) + 1e-4) straight = over;
    }
    c.feet = straight;
}

// Where a shoulder is caught at an edge (a doorpost), sideways past it: to the side where the way ahead is
// free.
void stepAside(const PhysicsWorld& physics, Character& c, glm::vec3 way, const CharacterSettings& s) {
    const float length = glm::length(way);
    if (length < 1e-4f) return;
    const glm::vec3 ahead = way / length, right(-ahead.z, 0, ahead.x);
    glm::dvec3 reached = c.feet;
    const auto hit = advance(physics, capsuleOf(c, s), reached, way);
    const bool blocked = hit && hit->share < 0.5f && physics.kind(hit->body) == BodyKind::kStatic &&
                         glm::dot(hit->normal, ahead) < -kFlatOn;
    if (!blocked) return;
    for (const glm::vec3 side : {right, -right}) {
        glm::dvec3 beside = c.feet;
        if (advance(physics, capsuleOf(c, s), beside, side * kShoulder * s.radius)) continue;
        if (advance(physics, capsuleOf(c, s), beside, ahead * s.radius)) continue;
        advance(physics, capsuleOf(c, s), c.feet, side * length);
        return;
    }
}

void crouch(const PhysicsWorld& physics, Character& c, bool wanted, const CharacterSettings& s) {
    const float height = wanted ? s.crouchHeight : s.height;
    if (height > c.height) {  // only where there is room
        glm::dvec3 top = c.feet;
        advance(physics, capsuleOf(c, s), top, {0, height - c.height, 0});
        if (top.y - c.feet.y < double(height - c.height) - 1e-3) return;
    }
    c.height = height;
    c.crouched = wanted;
}

glm::vec2 wantedVelocity(const Character& c, const CharacterIntent& intent, const CharacterSettings& s) {
    const float length = glm::length(intent.way), most = c.crouched ? s.crouchSpeed : s.speed;
    return intent.way * (length > 1 ? most / length : most);
}

void accelerate(Character& c, glm::vec2 wanted, const CharacterSettings& s, float seconds) {
    const glm::vec2 has(c.velocity.x, c.velocity.z);
    glm::vec2 change = wanted - has;
    const float most = (c.grounded ? s.acceleration : s.airAcceleration) * seconds;
    if (const float length = glm::length(change); length > most) change *= most / length;
    c.velocity.x += change.x;
    c.velocity.z += change.y;
}

void fallOrStand(const PhysicsWorld& physics, Character& c, bool jump, const CharacterSettings& s,
                 float seconds) {
    if (c.grounded && jump) {
        c.velocity.y = std::sqrt(2 * kGravity * s.jumpHeight);
        c.grounded = 0;
    }
    // The mean of the speeds before and after: a jump is as high as its formula says.
    const float before = c.velocity.y;
    c.velocity.y -= kGravity * seconds;
    float fall = 0.5f * (before + c.velocity.y) * seconds;
    if (c.grounded) fall = -0.5f * s.stepHeight;  // down steps without leaving the ground
    glm::dvec3 feet = c.feet;
    const auto hit = advance(physics, capsuleOf(c, s), feet, {0, fall, 0});
    const bool ground = hit && carries(physics, feet, *hit, s);
    if (c.grounded && !ground) {  // walked over an edge
        c.velocity.y = 0;
        c.grounded = 0;
        return;
    }
    c.feet = feet;
    if (hit) c.velocity.y = 0;
    c.grounded = ground && fall <= 0;
}

}  // namespace

void moveCharacter(PhysicsWorld& physics, Character& c, const CharacterIntent& intent,
                   const CharacterSettings& s, float seconds) {
    c.feet += glm::dvec3(physics.wayOut(capsuleOf(c, s), c.feet));
    crouch(physics, c, intent.crouch, s);
    const glm::vec2 wanted = wantedVelocity(c, intent, s);
    accelerate(c, wanted, s, seconds);
    const glm::dvec3 before = c.feet;
    const glm::vec3 way = glm::vec3(c.velocity.x, 0, c.velocity.z) * seconds;
    // It is pushed as fast as one wants to go, not as one is let to.
    const Push push{.velocity = glm::vec3(intent.way.x, 0, intent.way.y) * s.speed, .seconds = seconds};
    walk(physics, c, way, push, s);
    if (c.grounded) stepAside(physics, c, glm::vec3(wanted.x, 0, wanted.y) * seconds, s);
    // What was stopped has no speed left.
    const glm::vec3 moved = glm::vec3(c.feet - before) / seconds;
    if (glm::length(glm::vec2(moved.x, moved.z)) < glm::length(glm::vec2(c.velocity.x, c.velocity.z))) {
        c.velocity.x = moved.x;
        c.velocity.z = moved.z;
    }
    fallOrStand(physics, c, intent.jump, s, seconds);
    if (c.walker != kNoBody) physics.moveWalker(c.walker, capsuleOf(c, s), c.feet);
}

}  // namespace ag
