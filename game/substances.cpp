#include "game/substances.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/common/sampling.h"

namespace ag::game {
namespace {

constexpr float kTau = 6.2831853f;

float cell(int x, int y, int period, uint32_t seed) {
    const auto wrapped = [&](int i) { return uint32_t((i % period + period) % period); };
    return io::hashToUnit(io::hashUint(seed * 7919u + wrapped(y) * 4099u + wrapped(x)));
}

// Value noise, 0 to 1, that repeats after 1 in both directions.
float noise(glm::vec2 p, int period, uint32_t seed) {
    p *= float(period);
    const glm::vec2 f = glm::floor(p), t = p - f, s = t * t * (3.0f - 2.0f * t);
    const int x = int(f.x), y = int(f.y);
    return glm::mix(glm::mix(cell(x, y, period, seed), cell(x + 1, y, period, seed), s.x),
                    glm::mix(cell(x, y + 1, period, seed), cell(x + 1, y + 1, period, seed), s.x), s.y);
}

float clouds(glm::vec2 p, int period, uint32_t seed, int octaves = 4) {
    float sum = 0, weight = 0.5f, all = 0;
    for (int i = 0; i < octaves; ++i, period *= 2, weight *= 0.55f) {
        sum += weight * noise(p, period, seed + uint32_t(i));
        all += weight;
    }
    return sum / all;
}

// 1 on lines `period` times across, as wide as `width` of a field, soft at the edges.
float lines(float x, float period, float width) {
    const float d = std::abs(x * period - std::round(x * period));
    return 1 - glm::smoothstep(width * 0.5f, width, d);
}

glm::vec2 plaster(glm::vec2 p) {
    const float trowel = clouds(p * glm::vec2(1, 1) + 0.06f * noise(p, 4, 3), 4, 11), grain = noise(p, 96, 5);
    return {0.80f + 0.16f * trowel + 0.04f * grain, 0.8f * trowel + 0.2f * grain};
}

// Courses of cut blocks, every second one shifted by half a block.
glm::vec2 blocks(glm::vec2 p) {
    const float row = std::floor(p.y * 4), shift = 0.25f * std::fmod(row, 2.0f);
    const float joint = std::max(lines(p.y, 4, 0.035f), lines(p.x + shift, 2, 0.02f));
    const float block = cell(int(std::floor((p.x + shift) * 2)), int(row), 8, 31);
    const float grain = clouds(p, 8, 17);
    return {(0.70f + 0.18f * block + 0.12f * grain) * (1 - 0.45f * joint),
            (1 - joint) * (0.75f + 0.25f * grain)};
}

glm::vec2 stone(glm::vec2 p) {
    const float warp = clouds(p, 3, 41), vein = std::abs(std::sin(kTau * (p.x + 2 * p.y + 1.5f * warp)));
    const float dark = 1 - glm::smoothstep(0.0f, 0.12f, vein);
    return {0.78f + 0.20f * clouds(p, 6, 43) - 0.12f * dark, clouds(p, 24, 47)};
}

// Long grain along x, boards of a quarter.
glm::vec2 wood(glm::vec2 p) {
    const int board = int(std::floor(p.y * 4));
    const float ring = noise({p.x * 1.0f, p.y}, 4, 51) + 0.1f * noise(p, 16, 52);
    const float grain = 0.5f + 0.5f * std::sin(kTau * (p.y * 24 + 2.5f * ring));
    const float fibre = noise({p.x, p.y * 8}, 24, 53), gap = lines(p.y, 4, 0.03f);
    const float tone = 0.62f + 0.2f * cell(board, 7, 4, 54) + 0.12f * grain + 0.10f * fibre;
    return {tone * (1 - 0.6f * gap), (1 - gap) * (0.7f + 0.15f * grain + 0.15f * fibre)};
}

glm::vec2 cloth(glm::vec2 p) {
    const float weft = std::abs(std::sin(kTau * 32 * p.x)), warp = std::abs(std::sin(kTau * 32 * p.y));
    const bool over = (int(std::floor(p.x * 64)) + int(std::floor(p.y * 64))) % 2 == 0;
    const float thread = over ? weft : warp;
    // A broad pattern of lozenges, woven in.
    const float lozenge = glm::smoothstep(0.42f, 0.5f,
                                          std::abs(std::fmod(p.x * 4 + p.y * 4, 2.0f) - 1) *
                                              std::abs(std::fmod(p.x * 4 - p.y * 4 + 8, 2.0f) - 1) * 2);
    return {0.72f + 0.14f * thread + 0.14f * lozenge, thread};
}

// Brushed along x.
glm::vec2 metal(glm::vec2 p) {
    const float brushed = noise({p.x, p.y * 8}, 16, 61);
    return {0.82f + 0.12f * brushed + 0.06f * clouds(p, 4, 62), brushed};
}

glm::vec2 tile(glm::vec2 p) {
    const float joint = std::max(lines(p.x, 1, 0.012f), lines(p.y, 1, 0.012f)), speckle = noise(p, 64, 71);
    return {(0.76f + 0.14f * clouds(p, 5, 72) + 0.10f * speckle) * (1 - 0.5f * joint), 1 - joint};
}

glm::vec2 leaves(glm::vec2 p) {
    const float vein = std::abs(std::sin(kTau * 6 * p.x + 2 * noise(p, 8, 81)));
    return {0.68f + 0.22f * vein + 0.1f * noise(p, 32, 82), vein};
}

constexpr std::array<Substance, 11> kSubstances = {{{"plaster", 1.6f, 1, 0.004f, plaster},
                                                    {"charcoal", 1.2f, 1, 0.012f, blocks},
                                                    {"blocks", 1.2f, 1, 0.012f, blocks},
                                                    {"stone", 0.9f, 0.8f, 0.002f, stone},
                                                    {"wood", 1.1f, 0.7f, 0.003f, wood},
                                                    {"cloth", 0.8f, 1, 0.002f, cloth},
                                                    {"linen", 0.4f, 1, 0.002f, cloth},
                                                    {"brass", 0.5f, 0.4f, 0.0005f, metal},
                                                    {"iron", 0.5f, 0.6f, 0.0005f, metal},
                                                    {"tile", 1, 0.6f, 0.003f, tile},
                                                    {"leaf", 0.3f, 1, 0.001f, leaves}}};

uint8_t byteOf(float x) {
    return uint8_t(std::lround(std::clamp(x, 0.0f, 1.0f) * 255));
}

float encoded(float linear) {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace

std::optional<Substance> substanceOf(std::string_view material) {
    for (const Substance& s : kSubstances)
        if (material.ends_with(s.name)) return s;
    return std::nullopt;
}

SubstancePictures drawSubstance(const Substance& substance) {
    std::vector<glm::vec2> texels(size_t(kTexels) * kTexels);
    double sum = 0;
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) {
            glm::vec2& t = texels[size_t(y) * kTexels + size_t(x)];
            t = glm::clamp(substance.at((glm::vec2(x, y) + 0.5f) / float(kTexels)), 0.0f, 1.0f);
            sum += double(t.x);
        }
    const auto height = [&](int x, int y) {
        return texels[size_t((y + kTexels) % kTexels) * kTexels + size_t((x + kTexels) % kTexels)].y;
    };
    SubstancePictures out{.mean = float(sum / double(texels.size()))};
    const float slope = substance.bumps * float(kTexels) / (2 * substance.meters);
    for (int y = 0; y < kTexels; ++y)
        for (int x = 0; x < kTexels; ++x) {
            const uint8_t tone = byteOf(encoded(texels[size_t(y) * kTexels + size_t(x)].x));
            const glm::vec3 normal =
                glm::normalize(glm::vec3(slope * (height(x - 1, y) - height(x + 1, y)),
                                         slope * (height(x, y + 1) - height(x, y - 1)), 1));
            out.color.insert(out.color.end(), {tone, tone, tone, 255});
            for (int c = 0; c < 3; ++c)
                out.normal.push_back(byteOf(normal[c] * 0.5f + 0.5f));
            out.normal.push_back(255);
        }
    return out;
}

}  // namespace ag::game
