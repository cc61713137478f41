// The reference against closed forms.
#include "tools/reference/path_tracer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "engine/scene/static_scene.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::reference {
namespace {

struct Traced {
    explicit Traced(SceneAsset built, glm::uvec2 pixels = {64, 48})
        : asset(std::move(built)), scene(staticScene(asset)), size(pixels) {
        setCamera(scene, cameraOf(asset, 0), size);
    }
    ReferenceImages run(uint32_t bounces, uint32_t samples, uint32_t seed = 1) {
        const RayScene rays(scene);
        JobRunner runner(2);
        const auto silent = [](double) {};
        return tracePaths(rays, size, {.bounces = bounces, .samplesPerPixel = samples, .seed = seed}, runner,
                          silent);
    }
    SceneAsset asset;
    RenderScene scene;
    glm::uvec2 size;
};

double meanOf(const Image& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels)
        sum += double(p.x);
    return sum / double(image.pixels.size());
}

// Inside a closed sphere of albedo rho lit from its centre, irradiance is the same everywhere: E0 = I / r²,
// and each bounce carries rho times the one before.
SceneAsset sphere(float albedo) {
    scenegen::SceneBuilder b("sphere");
    const uint32_t gray = b.material("gray", glm::vec3(albedo));
    b.quad("inside", {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, gray);
    b.point("lamp", {0, 0, 0}, glm::vec3(3));
    b.camera("camera", {0.2f, 0.1f, 0.1f}, {-1, 0, 0}, 50);
    SceneAsset asset = b.finish();
    GeometryArrays& g = asset.geometry;  // the quad's geometry becomes the sphere's
    constexpr uint32_t kRings = 96, kSegments = 192;
    g.positions.clear();
    g.attributes.clear();
    g.indices.clear();
    for (uint32_t ring = 0; ring <= kRings; ++ring)
        for (uint32_t segment = 0; segment < kSegments; ++segment) {
            const double theta = std::numbers::pi * ring / kRings,
                         phi = 2 * std::numbers::pi * segment / kSegments;
            const glm::vec3 p(std::sin(theta) * std::cos(phi), std::cos(theta),
                              std::sin(theta) * std::sin(phi));
            g.positions.push_back(p);
            g.attributes.push_back({.normal = -p});
        }
    for (uint32_t ring = 0; ring < kRings; ++ring)
        for (uint32_t segment = 0; segment < kSegments; ++segment) {
            const uint32_t a = ring * kSegments + segment,
                           next = ring * kSegments + (segment + 1) % kSegments;
            for (uint32_t i : {a, next, a + kSegments, next, next + kSegments, a + kSegments})
                g.indices.push_back(i);
        }
    g.primitives[0].indexCount = uint32_t(g.indices.size());
    g.primitives[0].boundsLocal = {glm::vec3(-1), glm::vec3(1)};
    return asset;
}

TEST(Reference, DirectLightByTheFormulas) {
    scenegen::SceneBuilder builder("plane");
    builder.quad("floor", {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, builder.material("gray", glm::vec3(0.5f)));
    builder.camera("camera", {0, 3, 3}, {0, 0, 0}, 40);
    Traced t(builder.finish());
    for (const LightKind kind : {LightKind::kPoint, LightKind::kSpot, LightKind::kDirectional}) {
        const RenderLight light{.kind = kind,
                                .position = {0.5f, 2, 0},
                                .direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f)),
                                .intensity = glm::vec3(7),
                                .innerConeAngle = 0.5f,
                                .outerConeAngle = 1.2f};
        t.scene.lights = {light};
        const ReferenceImages images = t.run(0, 0);
        for (int y = 4; y < 48; y += 8)
            for (int x = 4; x < 64; x += 8) {
                const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(t.size) * 2.0f - 1.0f;
                const glm::dvec4 far =
                    glm::dmat4(t.scene.camera.worldFromClip) * glm::dvec4(glm::dvec2(ndc), 0.5, 1);
                const glm::dvec3 eye(t.scene.camera.position), d = glm::dvec3(far) / far.w - eye;
                const glm::dvec3 p = eye - d * (eye.y / d.y);
                const glm::dvec3 to = glm::dvec3(light.position) - p;
                double truth = 7 * to.y / std::pow(glm::length(to), 3);
                if (kind == LightKind::kDirectional) truth = 7 * double(-light.direction.y);
                if (kind == LightKind::kSpot) {
                    const double c = -glm::dot(glm::normalize(to), glm::dvec3(light.direction));
                    const double s =
                        std::clamp((c - std::cos(1.2)) / (std::cos(0.5) - std::cos(1.2)), 0.0, 1.0);
                    truth *= s * s;
                }
                EXPECT_NEAR(double(images.direct.at(x, y).x), truth, 1e-3 * truth + 1e-6) << int(kind);
            }
    }
}

TEST(Reference, BouncesInASphereAreAGeometricSeries) {
    const float rho = 0.6f;
    Traced t(sphere(rho), {24, 16});
    const double e0 = meanOf(t.run(0, 0).direct);
    EXPECT_NEAR(e0, 3, 0.03) << "I / r²";
    EXPECT_NEAR(meanOf(t.run(1, 256).bounce1) / e0, rho, 0.005 * rho);
    EXPECT_NEAR(meanOf(t.run(2, 256).indirect) / e0, rho + rho * rho, 0.005 * (rho + rho * rho));
    EXPECT_NEAR(meanOf(t.run(60, 256).indirect) / e0, rho / (1 - rho), 0.005 * rho / (1 - rho));
}

TEST(Reference, CornerAgainstQuadrature) {
    Traced t(*scenegen::buildScene("corner", 0), {96, 54});
    const Image bounce = t.run(1, 1024).bounce1;
    const auto truthAt = [](double y, double z) {
        constexpr int kSteps = 300;
        double sum = 0;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double dx = 2 * (i + 0.5) / kSteps, dz = -1 + 2 * (j + 0.5) / kSteps - z;
                const double d2 = dx * dx + y * y + dz * dz;
                sum += dx * y / (std::numbers::pi * d2 * d2);
            }
        return 2.0 * sum * 4 / (kSteps * kSteps);
    };
    double ratio = 0, truthSum = 0;
    for (double y = 0.3; y < 1.9; y += 0.2)
        for (double z = -0.8; z < 0.9; z += 0.2) {
            const glm::vec4 clip = t.scene.camera.clipFromWorld * glm::vec4(0, float(y), float(z), 1);
            const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(t.size);
            if (pixel.x < 0 || pixel.y < 0 || pixel.x >= 96 || pixel.y >= 54) continue;
            const double truth = truthAt(y, z), got = double(bounce.at(int(pixel.x), int(pixel.y)).x);
            EXPECT_NEAR(got, truth, 0.12 * truth) << y << ' ' << z;
            ratio += got;
            truthSum += truth;
        }
    EXPECT_NEAR(ratio / truthSum, 1, 0.01);
}

TEST(Reference, SameSeedSameImage) {
    Traced t(*scenegen::buildScene("cornell", 0), {32, 18});
    EXPECT_EQ(t.run(2, 8).indirect.pixels, t.run(2, 8).indirect.pixels);
    EXPECT_NE(t.run(2, 8, 1).indirect.pixels, t.run(2, 8, 2).indirect.pixels);
}

}  // namespace
}  // namespace ag::reference
