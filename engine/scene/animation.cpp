#include "engine/scene/animation.h"

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

// sin(t x) / sin(x) of an angle x up to a right one, by its cosine less one: Eberly 2011, A Fast and Accurate
// Algorithm for Computing SLERP. The last term's factor evens out what the missing ones would add.
float sineShare(float t, float cosineLessOne) {
    constexpr float kLast = 1.90110745351730037f;
    float factor = 1;
    for (int i = 8; i >= 1; --i) {
        const float n = float(i), scale = i == 8 ? kLast : 1.0f;
        const float u = scale / (n * (2 * n + 1)), v = scale * n / (2 * n + 1);
        factor = 1 + factor * (u * t * t - v) * cosineLessOne;
    }
    return t * factor;
}

glm::quat quatOf(glm::vec4 v) {
    return {v.w, v.x, v.y, v.z};
}

glm::vec4 vectorOf(glm::quat q) {
    return {q.x, q.y, q.z, q.w};
}

// Hermite's spline over one span of `length` seconds.
glm::vec4 spline(const glm::vec4* before, const glm::vec4* after, float t, float length) {
    const float t2 = t * t, t3 = t2 * t;
    return (2 * t3 - 3 * t2 + 1) * before[1] + length * (t3 - 2 * t2 + t) * before[2] +
           (-2 * t3 + 3 * t2) * after[1] + length * (t3 - t2) * after[0];
}

}  // namespace

glm::quat slerpQuat(glm::quat a, glm::quat b, float t) {
    float cosine = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
    const float side = cosine < 0 ? -1.0f : 1.0f;
    cosine = std::min(cosine * side, 1.0f);
    const float shareA = sineShare(1 - t, cosine - 1), shareB = side * sineShare(t, cosine - 1);
    const glm::vec4 v = vectorOf(a) * shareA + vectorOf(b) * shareB;
    return quatOf(v / std::sqrt(glm::dot(v, v)));
}

glm::vec4 sampleChannel(const SceneChannel& c, float seconds) {
    const bool cubic = c.interpolation == Interpolation::kCubic, turns = c.path == ChannelPath::kRotation;
    const size_t stride = cubic ? 3 : 1, middle = cubic ? 1 : 0;
    const auto next = std::ranges::upper_bound(c.times, seconds);
    const size_t after = size_t(next - c.times.begin());
    if (after == 0) return c.values[middle];
    const size_t before = after - 1;
    if (after == c.times.size() || c.interpolation == Interpolation::kStep)
        return c.values[before * stride + middle];
    const float length = c.times[after] - c.times[before], t = (seconds - c.times[before]) / length;
    if (cubic) {
        const glm::vec4 v = spline(&c.values[before * 3], &c.values[after * 3], t, length);
        const float square = glm::dot(v, v);
        return turns ? (square > 1e-12f ? v / std::sqrt(square) : c.values[before * 3 + 1]) : v;
    }
    const glm::vec4 a = c.values[before], b = c.values[after];
    return turns ? vectorOf(slerpQuat(quatOf(a), quatOf(b), t)) : a + (b - a) * t;
}

void applyChannel(const SceneChannel& channel, float seconds, NodeTransform& transform) {
    const glm::vec4 v = sampleChannel(channel, seconds);
    if (channel.path == ChannelPath::kTranslation) transform.translation = glm::dvec3(v);
    if (channel.path == ChannelPath::kRotation) transform.rotation = quatOf(v);
    if (channel.path == ChannelPath::kScale) transform.scale = glm::vec3(v);
}

void poseAsset(SceneAsset& asset, uint32_t clip, float seconds) {
    for (SceneNode& node : asset.nodes) {
        node.extras.clip = int32_t(clip);
        node.extras.clipStart = seconds;
    }
    if (clip >= asset.animations.size()) return;
    for (const SceneChannel& channel : asset.animations[clip].channels)
        applyChannel(channel, seconds, asset.nodes[channel.node].local);
}

float advanceClip(float seconds, float step, float duration, bool loops) {
    const float next = seconds + step;
    if (!(duration > 0)) return 0;
    if (!loops) return std::clamp(next, 0.0f, duration);
    const float round = next - duration * std::floor(next / duration);
    return std::clamp(round, 0.0f, duration);
}

}  // namespace ag
