#include "tools/scenegen/shining.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

void slab(SceneBuilder& b, const char* name, glm::vec3 least, glm::vec3 most, uint32_t material) {
    b.box(name, 0.5f * (least + most), most - least, material);
}

MeshParts sphere(uint32_t material, float radius) {
    constexpr int kRings = 24;
    std::array<glm::vec2, kRings + 1> profile;
    for (int i = 0; i <= kRings; ++i) {
        const float angle = (float(i) / kRings - 0.5f) * std::numbers::pi_v<float>;
        profile[size_t(i)] = {radius * std::cos(angle), radius * std::sin(angle)};
    }
    profile.front().x = profile.back().x = 0;
    MeshParts parts;
    addLathe(parts, material, profile, 48, glm::vec3(0));
    return parts;
}

// An arch on two piers about x = 0, its opening `wide` and `high` to the crown.
void arch(SceneBuilder& b, glm::vec3 at, float wide, float high, float deep, uint32_t stone) {
    constexpr int kStones = 12;
    const float radius = 0.5f * wide, spring = high - radius, pier = 0.35f;
    for (const float side : {-1.0f, 1.0f})
        slab(b, "pier", at + glm::vec3(side > 0 ? radius : -radius - pier, 0, -0.5f * deep),
             at + glm::vec3(side > 0 ? radius + pier : -radius, spring, 0.5f * deep), stone);
    MeshParts parts;
    for (const float face : {-0.5f, 0.5f})
        addSheet(
            parts, stone,
            [&](float u, float v) {
                const float angle = (face < 0 ? u : 1 - u) * std::numbers::pi_v<float>;
                const glm::vec2 inner = radius * glm::vec2(std::cos(angle), std::sin(angle));
                const float out = radius + pier;
                const float scale = out / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
                const glm::vec2 outer = scale * glm::vec2(std::cos(angle), std::sin(angle));
                const glm::vec2 p = glm::mix(inner, outer, v);
                return glm::vec3(p.x, p.y, face * deep);
            },
            4 * kStones, 1);
    addSheet(
        parts, stone,
        [&](float u, float v) {
            const float angle = (1 - u) * std::numbers::pi_v<float>;
            return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), (v - 0.5f) * deep);
        },
        kStones, 1);
    const uint32_t node = b.model("arch", parts, at + glm::vec3(0, spring, 0));
    b.materialAt(stone).doubleSided = true;
    (void)node;
}

}  // namespace

SceneAsset neon(uint32_t) {
    SceneBuilder b("neon");
    const uint32_t asphalt = b.material("asphalt", {0.18f, 0.18f, 0.19f}),
                   brick = b.material("brick", {0.45f, 0.24f, 0.17f}),
                   plaster = b.material("plaster", {0.62f, 0.60f, 0.56f}),
                   iron = b.material("iron", {0.25f, 0.26f, 0.28f}),
                   crate = b.material("crate", {0.50f, 0.36f, 0.20f});
    slab(b, "street", {-3, -0.2f, -6}, {3, 0, 6}, asphalt);
    slab(b, "left front", {-3.3f, 0, -6}, {-3, 5, 6}, brick);
    slab(b, "right front", {3, 0, -6}, {3.3f, 5, 6}, plaster);
    slab(b, "end", {-3, 0, -6.3f}, {3, 5, -6}, plaster);
    slab(b, "canopy", {-3, 2.6f, -1.6f}, {-1.7f, 2.68f, 1.2f}, iron);
    slab(b, "crate", {1.4f, 0, -2.4f}, {2.3f, 0.9f, -1.5f}, crate);
    slab(b, "crate", {1.7f, 0.9f, -2.2f}, {2.2f, 1.4f, -1.7f}, crate);
    slab(b, "bin", {-2.8f, 0, 1.6f}, {-2.1f, 1.1f, 2.3f}, iron);

    const uint32_t rose = b.emissive("rose", glm::vec3(0.1f), {9.0f, 1.6f, 3.2f}),
                   cyan = b.emissive("cyan", glm::vec3(0.1f), {0.9f, 6.5f, 7.5f}),
                   warm = b.emissive("warm", glm::vec3(0.1f), {5.0f, 3.2f, 1.3f}),
                   green = b.emissive("green", glm::vec3(0.1f), {1.2f, 7.0f, 1.5f});
    slab(b, "housing", {-3, 1.0f, -4.6f}, {-2.9f, 2.2f, -3.0f}, iron);
    b.quad("panel", {-2.899f, 1.04f, -4.56f}, {0, 1.12f, 0}, {0, 0, 1.52f}, rose);
    for (int i = 0; i < 3; ++i)
        slab(b, "tube", {2.86f, 2.4f + 0.35f * float(i), -3.8f + 0.3f * float(i)},
             {2.92f, 2.46f + 0.35f * float(i), -1.2f}, cyan);
    slab(b, "housing", {-2.55f, 2.53f, -0.95f}, {-2.15f, 2.6f, 0.55f}, iron);
    b.quad("lamp under the canopy", {-2.5f, 2.529f, -0.9f}, {0.3f, 0, 0}, {0, 0, 1.4f}, warm);
    slab(b, "cross", {2.55f, 2.9f, 1.2f}, {2.65f, 3.1f, 2.0f}, green);
    slab(b, "cross", {2.55f, 2.6f, 1.5f}, {2.65f, 2.899f, 1.7f}, green);
    slab(b, "cross", {2.55f, 3.101f, 1.5f}, {2.65f, 3.4f, 1.7f}, green);
    b.model("globe", sphere(warm, 0.22f), {0.6f, 3.1f, -4.6f});
    b.camera("camera", {0.4f, 1.65f, 4.6f}, {-0.2f, 1.5f, -2}, 62);
    return b.finish();
}

SceneAsset courtyard(uint32_t) {
    SceneBuilder b("courtyard");
    const uint32_t paving = b.material("paving", {0.48f, 0.45f, 0.40f}),
                   ochre = b.material("ochre", {0.66f, 0.48f, 0.26f}),
                   white = b.material("lime", {0.76f, 0.74f, 0.70f}),
                   tile = b.material("tile", {0.52f, 0.22f, 0.14f}),
                   stone = b.material("stone", {0.60f, 0.57f, 0.50f}),
                   leaf = b.material("leaf", {0.10f, 0.26f, 0.08f});
    slab(b, "ground", {-8, -0.3f, -8}, {8, 0, 8}, paving);
    slab(b, "west wing", {-8, 0, -8}, {-6, 5, 8}, ochre);
    slab(b, "east wing", {6, 0, -8}, {8, 4, 8}, white);
    slab(b, "south wing", {-6, 0, 6}, {6, 3.5f, 8}, white);
    slab(b, "back of the arcade", {-6, 0, -8}, {6, 5, -7.7f}, ochre);
    slab(b, "arcade's roof", {-6, 3.6f, -8}, {6, 3.85f, -5}, tile);
    for (int i = 0; i < 5; ++i)
        arch(b, {-4.8f + 2.4f * float(i), 0, -5.3f}, 1.7f, 3.25f, 0.4f, stone);
    slab(b, "well", {-0.9f, 0, -0.9f}, {0.9f, 0.7f, 0.9f}, stone);
    slab(b, "steps", {3.6f, 0, 1.0f}, {6, 0.3f, 3.4f}, stone);
    slab(b, "steps", {4.2f, 0.3f, 1.0f}, {6, 0.6f, 3.4f}, stone);
    b.model("tree", sphere(leaf, 0.9f), {-3.4f, 2.4f, 2.2f});
    slab(b, "trunk", {-3.5f, 0, 2.1f}, {-3.3f, 1.7f, 2.3f}, tile);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.55f, -0.75f, -0.35f));
    b.sun("sun", sun, glm::vec3(110, 104, 92));
    b.sky(analyticSky(sun, 3));
    b.camera("camera", {4.6f, 1.7f, 5.2f}, {-1.4f, 1.5f, -3.2f}, 62);
    return b.finish();
}

SceneAsset showroom(uint32_t) {
    SceneBuilder b("showroom");
    const uint32_t floor = b.material("terrazzo", {0.50f, 0.49f, 0.47f}),
                   white = b.material("plaster", {0.74f, 0.73f, 0.71f}),
                   plinth = b.material("plinth", {0.30f, 0.29f, 0.28f}),
                   frame = b.material("frame", {0.12f, 0.12f, 0.12f});
    b.materialAt(floor).roughness = 0.35f;
    b.materialAt(floor).specular = 1;
    slab(b, "floor", {-4, -0.2f, -3}, {4, 0, 3}, floor);
    slab(b, "ceiling", {-4, 3, -3}, {4, 3.2f, 3}, white);
    slab(b, "back", {-4, 0, -3.2f}, {4, 3, -3}, white);
    slab(b, "left", {-4.2f, 0, -3}, {-4, 3, 3}, white);
    slab(b, "right", {4, 0, -3}, {4.2f, 3, 3}, white);
    slab(b, "sill", {-4, 0, 3}, {4, 0.4f, 3.1f}, white);
    slab(b, "lintel", {-4, 2.7f, 3}, {4, 3, 3.1f}, white);
    for (const float x : {-4.0f, -1.35f, 1.25f, 3.9f})
        slab(b, "post", {x, 0.4f, 3}, {x + 0.1f, 2.7f, 3.1f}, frame);
    for (int row = 0; row < 2; ++row) {
        slab(b, "plinth", {-2.6f, 0, row ? 0.3f : -1.3f}, {2.6f, row ? 0.3f : 0.7f, row ? 0.9f : -0.7f},
             plinth);
        for (int i = 0; i < 5; ++i) {
            const uint32_t m = row ? b.material(fmt::format("enamel {}", i), {0.12f, 0.30f, 0.55f})
                                   : b.material(fmt::format("metal {}", i), {0.90f, 0.70f, 0.42f});
            b.materialAt(m).roughness = 0.1f + 0.2f * float(i);
            b.materialAt(m).metallic = row ? 0.0f : 1.0f;
            b.materialAt(m).specular = 1;
            b.model("ball", sphere(m, 0.3f), {-2.0f + float(i), row ? 0.6f : 1.0f, row ? 0.6f : -1.0f});
        }
    }
    const uint32_t sign = b.emissive("sign", glm::vec3(0.1f), {7.0f, 2.4f, 1.0f});
    slab(b, "housing", {-1.25f, 2.15f, -3}, {1.25f, 2.55f, -2.9f}, frame);
    b.quad("sign", {-1.2f, 2.2f, -2.899f}, {2.4f, 0, 0}, {0, 0.3f, 0}, sign);
    b.point("lamp", {-2.8f, 2.5f, -1.6f}, {14, 12, 9});
    const glm::vec3 sun = glm::normalize(glm::vec3(0.35f, -0.62f, -0.75f));
    b.sun("sun", sun, glm::vec3(90, 84, 74));
    b.sky(analyticSky(sun, 3));
    b.camera("camera", {0.3f, 1.75f, 2.7f}, {0, 0.85f, -1.2f}, 70);
    return b.finish();
}

SceneAsset panes(uint32_t) {
    SceneBuilder b("panes");
    const uint32_t floor = b.material("floor", {0.62f, 0.60f, 0.56f}),
                   back = b.material("back", {0.70f, 0.56f, 0.34f}),
                   side = b.material("side", {0.36f, 0.44f, 0.60f}),
                   block = b.material("block", {0.66f, 0.30f, 0.22f});
    slab(b, "floor", {-3, -0.2f, -3}, {3, 0, 3}, floor);
    slab(b, "back", {-3, 0, -3.2f}, {3, 3, -3}, back);
    slab(b, "side", {-3.2f, 0, -3}, {-3, 3, 3}, side);
    slab(b, "block", {-0.4f, 0, -2.4f}, {0.5f, 1.2f, -1.6f}, block);
    const auto pane = [&](const char* name, glm::vec2 least, glm::vec2 most, float z, uint32_t material) {
        b.materialAt(material).alphaMode = AlphaMode::kBlend;
        b.materialAt(material).doubleSided = true;
        b.quad(name, {least.x, least.y, z}, {most.x - least.x, 0, 0}, {0, most.y - least.y, 0}, material);
    };
    const auto glass = [&](const char* name, glm::vec3 tint, float roughness) {
        const uint32_t m = b.material(name, tint);
        b.materialAt(m).alphaMode = AlphaMode::kBlend;
        b.materialAt(m).transmission = 1;
        b.materialAt(m).specular = 1;
        b.materialAt(m).roughness = roughness;
        return m;
    };
    const uint32_t veil = b.material("veil", {0.80f, 0.16f, 0.12f}),
                   sign = b.emissive("sign", glm::vec3(0), {0.6f, 2.4f, 0.9f});
    b.materialAt(veil).baseColor.w = 0.4f;
    b.materialAt(sign).baseColor.w = 0.5f;
    pane("veil", {-2.2f, 0.3f}, {-0.2f, 2.2f}, 0.4f, veil);
    pane("blue glass", {-1.2f, 0.5f}, {0.9f, 2.5f}, -0.6f, glass("blue", {0.45f, 0.75f, 0.95f}, 0.2f));
    pane("sign", {1.0f, 0.4f}, {2.1f, 1.5f}, 0.2f, sign);
    b.model("ball", sphere(glass("green", {0.70f, 0.95f, 0.75f}, 0.3f), 0.5f), {1.5f, 0.5f, -1.2f});
    b.point("lamp", {0.3f, 2.6f, 1.6f}, {9, 8, 7});
    const glm::vec3 sun = glm::normalize(glm::vec3(-0.5f, -0.7f, -0.45f));
    b.sun("sun", sun, glm::vec3(20, 19, 17));
    b.sky(analyticSky(sun, 3));
    b.camera("camera", {0.2f, 1.5f, 4.6f}, {0, 1.2f, -1}, 45);
    return b.finish();
}

}  // namespace ag::scenegen
