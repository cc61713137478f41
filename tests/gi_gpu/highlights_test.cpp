// Highlights of suns and punctual lights against the material's BRDF at each pixel.
#include <gtest/gtest.h>

#include "common/brdf.h"
#include "common/lights.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"

namespace ag::gi {
using namespace render;
namespace {

const glm::vec3 kBase(0.5f, 0.4f, 0.3f),
    kLampAt(0.4f, 1.2f, -0.3f), kSun = glm::normalize(glm::vec3(0.3f, -1, -0.5f));

// A plane through the origin.
struct Plane {
    glm::vec3 normal{0, 1, 0};
    glm::vec3 right() const { return glm::normalize(glm::cross(normal, glm::vec3(0, 0, 1))); }
    glm::vec3 down() const { return glm::cross(right(), normal); }
};

SceneAsset polishedFloor(float roughness, float metallic, bool sun, uint32_t lamps, const Plane& plane = {}) {
    scenegen::SceneBuilder b("floor");
    const uint32_t m = b.material("polish", kBase);
    b.materialAt(m).roughness = roughness;
    b.materialAt(m).metallic = metallic;
    b.materialAt(m).specular = 1;
    const glm::vec3 right = 6.0f * plane.right(), down = 6.0f * plane.down();
    b.quad("floor", -0.5f * (right + down), down, right, m);
    if (sun) b.sun("sun", kSun, glm::vec3(7));
    for (uint32_t i = 0; i < lamps; ++i)
        b.point("lamp", kLampAt + glm::vec3(0.01f * float(i), 0, 0), glm::vec3(4));
    b.camera("camera", {0, 1.1f, 2}, {0, 0, -0.2f}, 50);
    return b.finish();
}

// Relative to the brightest pixel.
double worstDifference(float roughness, float metallic, bool sun, uint32_t lamps, const Plane& plane = {}) {
    Bench b(polishedFloor(roughness, metallic, sun, lamps, plane), {64, 36});
    b.settings.technique = Technique::kNone;
    const Image got = renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kRadiance, 2);
    double worst = 0, most = 0;
    const glm::vec3 n = plane.normal;
    for (int y = 0; y < 36; ++y)
        for (int x = 0; x < 64; ++x) {
            const RenderCamera& c = b.scene.camera;
            const glm::vec4 h =
                c.worldFromClip *
                glm::vec4((glm::vec2(x, y) + 0.5f) / glm::vec2(b.size) * 2.0f - 1.0f, 0.5f, 1);
            const glm::vec3 d = glm::normalize(glm::vec3(h) / h.w - c.position);
            const glm::vec3 place = c.position - d * (glm::dot(n, c.position) / glm::dot(n, d));
            const glm::vec2 in(glm::dot(place, plane.right()), glm::dot(place, plane.down()));
            if (glm::dot(n, d) >= 0 || glm::length(in) > 2.9f) continue;
            glm::vec3 truth(0);
            const auto add = [&](glm::vec3 toLight, float irradiance) {
                truth += irradiance * std::max(glm::dot(n, toLight), 0.0f) *
                         io::metallicRoughnessBrdf(n, -d, toLight, kBase, metallic, roughness, 1);
            };
            if (sun) add(-kSun, 7);
            for (uint32_t i = 0; i < lamps; ++i) {
                const glm::vec3 to = kLampAt + glm::vec3(0.01f * float(i), 0, 0) - place;
                add(glm::normalize(to), 4 / glm::dot(to, to));
            }
            most = std::max(most, double(truth.x));
            for (int k = 0; k < 3; ++k)
                worst = std::max(worst, double(std::abs(got.at(x, y)[k] - truth[k])));
        }
    EXPECT_GT(most, 0.005);
    return worst / most;
}

TEST(Highlights, AreTheMaterialsBrdf) {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            EXPECT_LT(worstDifference(roughness, metallic, true, 0), 0.01) << roughness << ' ' << metallic;
            EXPECT_LT(worstDifference(roughness, metallic, false, 1), 0.01) << roughness << ' ' << metallic;
            EXPECT_LT(worstDifference(roughness, metallic, true, 1), 0.01) << roughness << ' ' << metallic;
        }
    // So many that shadows are found at one pixel of four: no shadow, no difference.
    EXPECT_LT(worstDifference(0.4f, 0, false, 12), 0.01);
}

// Half floats make a normal longer or shorter by about as much as a narrow lobe is wide.
TEST(Highlights, OfNarrowLobesAreSharpOnAnySurface) {
    const glm::vec3 mirrors = glm::normalize(-kSun + glm::normalize(glm::vec3(0, 1.1f, 2)));
    for (const float turn : {-0.02f, 0.0f, 0.03f}) {
        const Plane plane{glm::normalize(mirrors + turn * glm::vec3(1, 0.5f, 0.3f))};
        EXPECT_LT(worstDifference(0.1f, 1, true, 0, plane), 0.1) << turn;
    }
}

TEST(Highlights, CostNothingWhereNothingIsGlossy) {
    SceneAsset asset = polishedFloor(0.4f, 0, true, 1);
    for (Material& m : asset.geometry.materials)
        m.metallic = m.specular = 0;
    Bench b(std::move(asset), {64, 36});
    b.frame();
    EXPECT_FALSE(b.last.direct.highlights);
    EXPECT_FALSE(b.renderer.graph().findImage("direct_lighting.highlights"));
}

}  // namespace
}  // namespace ag::gi
