// The reference against closed forms.
#include "tests/reference/mean.h"
#include "tools/reference/reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/brdf.h"
#include "common/form_factors.h"
#include "engine/scene/static_scene.h"
#include "tools/reference/vpl_tracer.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::reference {
namespace {

struct Traced {
    explicit Traced(SceneAsset built, glm::uvec2 pixels = {64, 48})
        : asset(std::move(built)), scene(staticScene(asset)), size(pixels) {
        setCamera(scene, cameraOf(asset, 0), size);
    }
    Reference run(const ReferenceSettings& settings) {
        const RayScene rays(scene);
        JobRunner runner(2);
        const auto silent = [](double) {};
        return makeReference(rays, size, settings, runner, silent);
    }
    Reference run(uint32_t bounces, uint32_t samples, uint32_t seed = 1) {
        return run({.paths = {.bounces = bounces}, .samplesPerPixel = samples, .seed = seed});
    }
    SceneAsset asset;
    RenderScene scene;
    glm::uvec2 size;
};

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
    g.materials[0].doubleSided = true;   // to be seen from inside and outside
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
        const Image direct = t.run(0, 2).bounces[0];
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
                EXPECT_NEAR(double(direct.at(x, y).x), truth, 1e-3 * truth + 1e-6) << int(kind);
            }
    }
}

TEST(Reference, BouncesInASphereAreAGeometricSeries) {
    const float rho = 0.6f;
    Traced t(sphere(rho), {24, 16});
    const double e0 = meanOf(t.run(0, 2).bounces[0]);
    EXPECT_NEAR(e0, 3, 0.03) << "I / r²";
    EXPECT_NEAR(meanOf(t.run(1, 256).bounces[1]) / e0, rho, 0.005 * rho);
    EXPECT_NEAR(meanOf(t.run(2, 256).indirect) / e0, rho + rho * rho, 0.005 * (rho + rho * rho));
    EXPECT_NEAR(meanOf(t.run(60, 256).indirect) / e0, rho / (1 - rho), 0.005 * rho / (1 - rho));
}

TEST(Reference, CornerAgainstQuadrature) {
    Traced t(*scenegen::buildScene("corner", 0), {96, 54});
    const Image bounce = t.run(1, 1024).bounces[1];
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

// A convex body in light that is the same from everywhere: E = pi L, and rho L is what leaves it.
TEST(Reference, SphereUnderAConstantSky) {
    Traced t(sphere(0.6f), {48, 48});
    t.scene.lights.clear();
    CameraPose outside;
    outside.position = {0, 0, 4};
    outside.verticalFov = 0.4f;
    setCamera(t.scene, outside, t.size);
    for (VertexAttributes& a : t.asset.geometry.attributes)
        a.normal = -a.normal;
    t.scene.sky = std::make_shared<const Sky>(constantSky(glm::vec3(0.5f, 1, 2)));
    const Reference r = t.run({.paths = {.bounces = 0}, .samplesPerPixel = 4096});
    const double pi = std::numbers::pi;
    const auto share = [](double got, double truth) { return got / truth; };
    for (const glm::ivec2 at : {glm::ivec2(24, 24), glm::ivec2(30, 12), glm::ivec2(10, 30)}) {
        EXPECT_NEAR(share(double(r.sky.at(at.x, at.y).x), pi * 0.5), 1, 5e-3);
        EXPECT_NEAR(share(double(r.sky.at(at.x, at.y).z), pi * 2), 1, 5e-3);
        EXPECT_NEAR(share(double(r.radiance.at(at.x, at.y).y), 0.6), 1, 5e-3);
    }
    EXPECT_NEAR(double(r.radiance.at(0, 0).z), 2, 1e-5) << "the sky itself is seen";
}

// The GGX specular lobe by sampling against the same brdf by quadrature over the hemisphere.
TEST(Reference, GlossyPlaneUnderASkyByQuadrature) {
    for (const float roughness : {0.2f, 0.5f, 1.0f})
        for (const float metallic : {0.0f, 1.0f}) {
            scenegen::SceneBuilder builder("plane");
            builder.quad("floor", {-9, 0, -9}, {0, 0, 18}, {18, 0, 0},
                         builder.material("gray", glm::vec3(0.5f)));
            builder.camera("camera", {0, 2, 3}, {0, 0, 0}, 10);
            Traced t(builder.finish(), {9, 9});
            Material& m = t.asset.geometry.materials[0];
            m.roughness = roughness;
            m.metallic = metallic;
            m.specular = 1;
            t.scene.lights.clear();
            t.scene.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1)));
            const Reference r = t.run({.paths = {.bounces = 0, .glossy = true}, .samplesPerPixel = 16384});
            const glm::vec3 n(0, 1, 0), v = glm::normalize(glm::vec3(0, 2, 3));
            double truth = 0;
            constexpr int kSteps = 1000;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {  // equal steps of cos² and of the angle
                    const float c = std::sqrt((float(i) + 0.5f) / kSteps), sine = std::sqrt(1 - c * c),
                                phi = 2 * std::numbers::pi_v<float> * (float(j) + 0.5f) / kSteps;
                    const glm::vec3 l(sine * std::cos(phi), c, sine * std::sin(phi));
                    truth +=
                        double(io::metallicRoughnessBrdf(n, v, l, glm::vec3(0.5f), metallic, roughness, 1).x);
                }
            truth *= std::numbers::pi / (double(kSteps) * kSteps);
            EXPECT_NEAR(double(r.radiance.at(4, 4).x) / truth, 1, 0.01) << roughness << ' ' << metallic;
            EXPECT_LT(truth, 1) << "no more comes back than arrives";
        }
}

TEST(Reference, EmissiveWallsLightTheRoom) {
    // Every wall of a closed room glows with L: each receives pi L straight, and rho pi L by one bounce.
    scenegen::SceneBuilder b("room");
    const uint32_t glow = b.emissive("glow", glm::vec3(0.4f), glm::vec3(3));
    b.room("room", {-1, -1, -1}, {1, 1, 1}, {glow, glow, glow, glow, glow, glow});
    b.camera("camera", {0.2f, 0.1f, 0.3f}, {-1, 0, 0}, 60);
    Traced t(b.finish(), {16, 12});
    const Reference r = t.run({.paths = {.bounces = 1}, .samplesPerPixel = 256});
    EXPECT_NEAR(meanOf(r.emissive), 3 * std::numbers::pi, 0.05);
    EXPECT_NEAR(meanOf(r.indirect), 0.4 * 3 * std::numbers::pi, 0.05);
    EXPECT_EQ(meanOf(r.bounces[0]), 0) << "no sun or lamp";
    const Reference dark = t.run({.paths = {.bounces = 1, .emission = false}, .samplesPerPixel = 2});
    EXPECT_EQ(meanOf(dark.irradiance), 0);
    EXPECT_EQ(dark.radiance.at(8, 6).x, 3) << "they are seen all the same";
}

// A small square that shines, high over a floor: the form factor of its polygon. And one of several that is
// bright among dim ones, whose faces look away, or which is hidden behind another.
TEST(Reference, AnEmissiveSquareByItsFormFactor) {
    scenegen::SceneBuilder b("square");
    const uint32_t black = b.material("black", glm::vec3(0));
    b.quad("floor", {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, black);
    b.quad("square", {-0.25f, 1, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f},
           b.emissive("glow", glm::vec3(0), {6, 3, 0}));
    b.quad("looks up", {1, 0.5f, 1}, {0, 0, 0.5f}, {0.5f, 0, 0},
           b.emissive("up", glm::vec3(0), glm::vec3(90)));
    b.camera("camera", {0, 0.9f, 1.8f}, {0, 0, 0}, 50);
    Traced t(b.finish(), {32, 24});
    const Reference r = t.run({.paths = {.bounces = 0}, .samplesPerPixel = 1024});
    double got = 0, truth = 0;
    for (int y = 12; y < 24; ++y)
        for (int x = 0; x < 32; ++x) {
            const glm::vec4 h =
                t.scene.camera.worldFromClip *
                glm::vec4((glm::vec2(x, y) + 0.5f) / glm::vec2(t.size) * 2.0f - 1.0f, 0.5f, 1);
            const glm::vec3 d = glm::vec3(h) / h.w - t.scene.camera.position;
            const glm::vec3 place = t.scene.camera.position - d * (t.scene.camera.position.y / d.y);
            if (std::abs(place.x) > 1.9f || std::abs(place.z) > 1.9f || !(d.y < 0)) continue;
            double e = 0;
            constexpr int kSteps = 40;
            for (int i = 0; i < kSteps; ++i)
                for (int j = 0; j < kSteps; ++j) {
                    const glm::dvec3 to((i + 0.5) / kSteps * 0.5 - 0.25 - double(place.x), 1,
                                        (j + 0.5) / kSteps * 0.5 - 0.25 - double(place.z));
                    e += 6 * 0.25 / (kSteps * kSteps) / (glm::dot(to, to) * glm::dot(to, to));
                }
            const double here = double(r.emissive.at(x, y).x);
            EXPECT_NEAR(here / e, 1, 0.08) << x << ' ' << y;
            got += here, truth += e;
        }
    EXPECT_GT(truth, 100);
    EXPECT_NEAR(got / truth, 1, 0.005);
}

// A sky that shines from one side alone, on a floor: by quadrature; and the analytic one, which is uneven.
TEST(Reference, AnUnevenSkyByQuadrature) {
    scenegen::SceneBuilder b("floor");
    b.quad("floor", {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, b.material("gray", glm::vec3(0.5f)));
    b.camera("camera", {0, 2, 3}, {0, 0, 0}, 10);
    Traced t(b.finish(), {9, 9});
    Sky half{Image(64, 32)};
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            half.radiance.at(x, y) = glm::vec3(2, 1, float(x) / 16);
    const glm::vec3 sun = glm::normalize(glm::vec3(0.6f, -0.5f, 0.2f));
    for (const Sky& sky : {half, analyticSky(sun, 4)}) {
        t.scene.sky = std::make_shared<const Sky>(sky);
        const Reference r = t.run({.paths = {.bounces = 0}, .samplesPerPixel = 4096});
        glm::dvec3 truth(0);
        constexpr int kSteps = 1024;
        for (int i = 0; i < kSteps; ++i)
            for (int j = 0; j < kSteps; ++j) {
                const double c2 = (i + 0.5) / kSteps, phi = 2 * std::numbers::pi * (j + 0.5) / kSteps;
                const glm::vec3 d(float(std::sqrt(1 - c2) * std::cos(phi)), float(std::sqrt(c2)),
                                  float(std::sqrt(1 - c2) * std::sin(phi)));
                truth += glm::dvec3(skyRadiance(sky, d));
            }
        truth *= std::numbers::pi / (double(kSteps) * kSteps);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(double(r.sky.at(4, 4)[c]) / truth[c], 1, 0.01) << c;
    }
}

// A lamp behind a curtain lights the floor by what the curtain's back reflects, if it has one.
TEST(Reference, BacksOfSingleSidedSurfacesReflectNothing) {
    for (const bool doubleSided : {false, true})
        for (const bool mirrored : {false, true}) {
            scenegen::SceneBuilder b("curtain");
            const uint32_t gray = b.material("gray", glm::vec3(0.5f));
            b.quad("floor", {-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, b.material("floor", glm::vec3(0)));
            b.quad("curtain", {-1, 0, 1}, {2, 0, 0}, {0, 2, 0}, gray);  // faces +z
            b.spot("lamp", {0, 1, 0.5f}, {0, 0, 1}, glm::vec3(20), {20, 40});
            b.camera("camera", {0, 1.5f, -1}, {0, 0, 0.6f}, 50);
            Traced t(b.finish(), {24, 16});
            t.asset.geometry.materials[gray].doubleSided = doubleSided;
            t.scene = staticScene(t.asset);
            setCamera(t.scene, cameraOf(t.asset, 0), t.size);
            if (mirrored)  // about x = 0: still the same curtain
                t.scene.instances[1].worldFromLocal[0] *= -1.0f;
            const double bounced = meanOf(t.run(1, 64).bounces[1]);
            EXPECT_EQ(bounced > 0.01, doubleSided) << mirrored;
            EXPECT_EQ(bounced == 0, !doubleSided) << mirrored;
        }
}

// Points close to other surfaces are left out: there a map's texels are too few, and single ones count for
// too much to be a mean.
TEST(Reference, RsmTexelsAgreeWithPaths) {
    for (const char* name : {"cornell", "occluder"}) {
        Traced t(*scenegen::buildScene(name, 0), {48, 27});
        const RayScene rays(t.scene);
        JobRunner runner(2);
        uint64_t count = 0;
        FirstHits hits(t.size);
        traceFirstHits(rays, {}, {}, runner, hits, count);
        constexpr uint32_t kMap = 96, kMaps = 4, kPaths = 4096;
        std::vector<double> nearest(hits.surfaces.size(), 1e30);
        LightSums halves[2] = {{t.size, 1}, {t.size, 1}}, paths(t.size, 1);
        for (uint32_t map = 0; map < kMaps; ++map) {
            const auto emitters = traceEmitters(rays, kMap, map + 1, count);
            addEmitters(rays, hits, emitters, {.seed = map, .count = uint32_t(emitters.size())}, runner,
                        halves[map % 2]);
            for (size_t i = 0; i < nearest.size(); ++i)
                for (const Emitter& e : emitters)
                    if (io::vplTerm(hits.surfaces[i].position, hits.surfaces[i].normal, e.position,
                                    e.normal) > 0)
                        nearest[i] = std::min(nearest[i],
                                              double(glm::distance(e.position, hits.surfaces[i].position)));
        }
        addPaths(rays, hits, {}, {.seed = 5, .count = kPaths}, runner, paths);
        double sum = 0, truth = 0, squares = 0, noise = 0;
        int compared = 0;
        for (size_t i = 0; i < nearest.size(); ++i) {
            if (hits.surfaces[i].distance <= 0 || nearest[i] < 0.15) continue;
            const double a = double(halves[0].bounces[1].pixels[i].x) / halves[0].counts[i].paths.samples,
                         b = double(halves[1].bounces[1].pixels[i].x) / halves[1].counts[i].paths.samples,
                         p = double(paths.bounces[1].pixels[i].x) / paths.counts[i].paths.samples;
            sum += (a + b) / 2;
            truth += p;
            squares += ((a + b) / 2 - p) * ((a + b) / 2 - p);
            noise += (a - b) * (a - b) / 4;
            ++compared;
        }
        ASSERT_GT(compared, 300) << name;
        const double mean = truth / compared;
        std::printf("%s: %d pixels, ratio %.4f, relative RMSE %.4f (halves of the maps differ by %.4f)\n",
                    name, compared, sum / truth, std::sqrt(squares / compared) / mean,
                    std::sqrt(noise / compared) / mean);
        EXPECT_NEAR(sum / truth, 1, 0.003) << name;
        EXPECT_LT(std::sqrt(squares / compared) / mean, 0.03) << name;
    }
}

// Samples placed by the noise bring the same means as samples everywhere.
TEST(SamplingPlan, KeepsTheMean) {
    Traced t(*scenegen::buildScene("cornell", 0), {64, 36});
    const RayScene rays(t.scene);
    JobRunner runner(2);
    FirstHits hits(t.size);
    uint64_t count = 0;
    traceFirstHits(rays, {}, {}, runner, hits, count);
    constexpr uint32_t kPaths = 1024, kTrue = 1 << 14, kSeeds = 4;
    LightSums everywhere(t.size, 1);
    addPaths(rays, hits, {}, {.seed = 99, .count = kTrue}, runner, everywhere);
    const double truth = meanOf(everywhere.bounces[1]) / kTrue;
    double mean = 0;
    for (uint32_t seed = 1; seed <= kSeeds; ++seed) {
        ReferenceSettings settings{.samplesPerPixel = kPaths, .seed = seed, .layer = "bounce1"};
        settings.paths.litPoints = false;
        const Reference r = t.run(settings);
        EXPECT_NEAR(r.samples, kPaths, kPaths / 10.0);
        mean += meanOf(r.bounces[1]) / kSeeds;
    }
    EXPECT_NEAR(mean / truth, 1, 0.003);
}

// Neyman's allocation: samples as the deviation asks, cut at the bounds; places where direct light varies.
TEST(SamplingPlan, FollowsTheNoise) {
    constexpr glm::uvec2 kSize{64, 64};
    const FirstHits hits(kSize);
    LightSums sums(kSize, 1);
    for (uint32_t y = 0; y < kSize.y; ++y)
        for (uint32_t x = 0; x < kSize.x; ++x) {
            PixelCount& c = sums.counts[y * kSize.x + x];
            const bool left = x < 32, top = y < 32;
            for (int packet = 0; packet < 4; ++packet) {
                const float sign = packet % 2 ? 1 : -1;  // about a mean of 0
                c.paths.add(8, glm::vec3(sign * (left ? 1.0f : 4.0f)));
                c.places.add(8, glm::vec3(top ? sign * 20 : 0));
            }
        }
    SamplingPlan plan(hits, {.bounces = 1});
    plan.adapt(sums);
    const auto at = [&](uint32_t x, uint32_t y) { return plan.of(y * kSize.x + x); };
    EXPECT_EQ(at(48, 10).every, 1u) << "direct light and paths vary most";
    EXPECT_EQ(at(48, 48).every, 1u) << "less, but a packet costs less, too";
    EXPECT_EQ(at(10, 48).every, 4u) << "a quarter of the deviation at the same cost";
    EXPECT_EQ(at(10, 48).places, 1u);
    EXPECT_EQ(at(48, 10).places, 7u) << "root of 20²/4² times the cost of a path, 2.1 places";
    EXPECT_EQ(at(10, 10).places, 8u);
    uint32_t due = 0;
    for (uint32_t round = 0; round < 16; ++round)
        due += plan.isDue(48 * kSize.x + 10, round, 3);
    EXPECT_EQ(due, 4u);
}

TEST(Reference, StopsAtTheErrorAskedFor) {
    Traced t(*scenegen::buildScene("furnace", 50), {32, 18});
    const Reference rough = t.run({.samplesPerPixel = 1 << 16, .maxError = 0.02, .layer = "bounce1"});
    const Reference fine = t.run({.samplesPerPixel = 1 << 16, .maxError = 0.005, .layer = "bounce1"});
    EXPECT_LT(rough.noise, 0.02);
    EXPECT_LT(fine.noise, 0.005);
    EXPECT_LT(rough.samples, fine.samples);
    EXPECT_LT(fine.samples, 1u << 16);
}

TEST(Reference, EveryPixelHasAValueAfterAnyTime) {
    Traced t(*scenegen::buildScene("furnace", 50), {37, 21});
    const RayScene rays(t.scene);
    JobRunner runner(2);
    const double truth = meanOf(t.run(1, 256).bounces[1]);
    // Less time than any pass takes: one lattice, spread over its blocks.
    const double times[] = {1e-9, 0.2};
    std::vector<double> means, spent;
    traceOverTime(rays, t.size, {.bounces = 1}, times, runner, [&](double seconds, const Reference& r) {
        for (const glm::vec3& p : r.bounces[1].pixels)
            EXPECT_GE(p.x, 0);
        means.push_back(meanOf(r.bounces[1]) / truth);
        spent.push_back(seconds);
    });
    ASSERT_EQ(means.size(), 2u);
    EXPECT_NEAR(means[0], 1, 0.6);
    EXPECT_NEAR(means[1], 1, 0.05);
    EXPECT_GE(spent[1], 0.2);
}

TEST(Reference, SameSeedSameImage) {
    Traced t(*scenegen::buildScene("cornell", 0), {32, 18});
    EXPECT_EQ(t.run(2, 8).indirect.pixels, t.run(2, 8).indirect.pixels);
    EXPECT_NE(t.run(2, 8, 1).indirect.pixels, t.run(2, 8, 2).indirect.pixels);
}

}  // namespace
}  // namespace ag::reference
