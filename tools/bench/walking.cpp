#include "tools/bench/walking.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/static_scene.h"

namespace ag::bench {
namespace {

double grey(glm::vec3 p) {
    return double(p.x + p.y + p.z) / 3;
}

// Means of nine pixels along rows or columns, fewer at the edges.
std::vector<double> blurLine(const std::vector<double>& in, int width, int height, bool rows) {
    constexpr int kReach = 4;
    std::vector<double> out(in.size());
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double sum = 0;
            int count = 0;
            for (int d = -kReach; d <= kReach; ++d) {
                const int u = x + (rows ? d : 0), v = y + (rows ? 0 : d);
                if (u < 0 || v < 0 || u >= width || v >= height) continue;
                sum += in[size_t(v * width + u)];
                ++count;
            }
            out[size_t(y * width + x)] = sum / count;
        }
    return out;
}

}  // namespace

void placeOnWalk(RenderScene& scene, const RenderScene& start, glm::uvec2 size, uint32_t frame) {
    const float share = float(frame) / float(kWalkFrames - 1);
    const RenderCamera& from = start.camera;
    const float diagonal = glm::length(start.bounds.max - start.bounds.min);
    const glm::quat turn = glm::angleAxis(glm::radians(8.0f * share), glm::vec3(0, 1, 0));
    CameraPose pose = poseOf(start);
    pose.position += glm::dvec3(from.forward * (diagonal * share / 200));
    pose.forward = turn * from.forward;
    pose.up = turn * from.up;
    setCamera(scene, pose, size);
}

Walking compareWalk(const std::vector<Image>& walking, const std::vector<Image>& standing) {
    const size_t pixels = standing[0].pixels.size();
    const double n = double(standing.size());
    std::vector<double> sum(pixels, 0), squares(pixels, 0), difference(pixels);
    double mean = 0, ghosts = 0, deviation = 0;
    for (size_t f = 0; f < standing.size(); ++f) {
        for (size_t i = 0; i < pixels; ++i) {
            difference[i] = grey(walking[f].pixels[i]) - grey(standing[f].pixels[i]);
            mean += grey(standing[f].pixels[i]);
            sum[i] += difference[i];
            squares[i] += difference[i] * difference[i];
        }
        const int width = standing[f].width, height = standing[f].height;
        for (const double d : blurLine(blurLine(difference, width, height, true), width, height, false))
            ghosts += std::abs(d);
    }
    for (size_t i = 0; i < pixels; ++i)
        deviation += std::sqrt(std::max(squares[i] / n - sum[i] * sum[i] / (n * n), 0.0));
    if (mean <= 0) return {};
    return {.flicker = deviation * n / mean, .ghosting = ghosts / mean};
}

}  // namespace ag::bench
