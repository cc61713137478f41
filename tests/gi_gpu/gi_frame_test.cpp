// The GI frame on a device, against analytic truths and its own invariants.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <set>

#include "common/clustering_metric.h"
#include "engine/scene/static_scene.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

SceneAsset plane(float albedo) {
    scenegen::SceneBuilder b("plane");
    b.quad("floor", {-20, 0, -20}, {0, 0, 40}, {40, 0, 0}, b.material("gray", glm::vec3(albedo)));
    b.camera("camera", {0, 3, 4}, {0, 0, 0}, 50);
    return b.finish();
}

double totalFlux(const std::vector<io::RsmTexel>& texels) {
    double sum = 0;
    for (const io::RsmTexel& t : texels)
        sum += double(t.flux.x);
    return sum;
}

TEST(Rsm, SpotFluxOnAPlaneIsTheConesPower) {
    Bench b(plane(0.6f));
    const double inner = 0.3, outer = 0.6, intensity = 7;
    b.scene.lights = {{.kind = LightKind::kSpot,
                       .position = {0.3f, 2, -0.2f},
                       .direction = glm::normalize(glm::vec3(0.2f, -1, 0.1f)),
                       .intensity = glm::vec3(float(intensity)),
                       .innerConeAngle = float(inner),
                       .outerConeAngle = float(outer),
                       .bounces = true,
                       .id = 1}};
    b.frame();
    // Integral of t² over the cone, t linear in the cosine from outer to inner: a third of the rim's width
    // counts.
    const double rim = std::cos(inner) - std::cos(outer);
    const double truth = 0.6 * intensity * 2 * kPi * ((1 - std::cos(inner)) + rim / 3);
    EXPECT_NEAR(totalFlux(b.read<io::RsmTexel>(b.last.bounce.rsm.texels)) / truth, 1, 0.01);
}

TEST(Rsm, SunFluxOnAPlaneIsItsCrossSection) {
    Bench b(plane(0.6f));
    const glm::vec3 direction = glm::normalize(glm::vec3(0.3f, -1, 0.2f));
    b.scene.lights = {{.kind = LightKind::kDirectional,
                       .direction = direction,
                       .intensity = glm::vec3(5),
                       .bounces = true,
                       .id = 1}};
    b.frame();
    const double truth = 0.6 * 5 * 40 * 40 * double(-direction.y);
    const auto texels = b.read<io::RsmTexel>(b.last.bounce.rsm.texels);
    EXPECT_NEAR(totalFlux(texels) / truth, 1, 0.01);
    double area = 0;
    for (const io::RsmTexel& t : texels)
        area += t.weight > 0 ? double(t.area) : 0;
    EXPECT_NEAR(area / 1600, 1, 0.01) << "texel areas add up to the plane's";
}

// Turns the plane over as a mirrored node does: its front stays above.
void mirror(RenderScene& scene) {
    glm::mat4x3& m = scene.instances[0].worldFromLocal;
    m[2] = -m[2];
    scene.changedInstances = {{0, 1}};
    scene.allInstancesChanged = false;
    ++scene.instancesVersion;
}

TEST(Rsm, BacksOfSingleSidedSurfacesReflectNothing) {
    for (const bool doubleSided : {false, true}) {
        SceneAsset asset = plane(0.6f);
        asset.geometry.materials[0].doubleSided = doubleSided;
        Bench b(asset);
        const auto fluxFrom = [&](float height) {
            b.scene.lights = {{.kind = LightKind::kSpot,
                               .position = {0, height, 0},
                               .direction = {0, height > 0 ? -1 : 1, 0},
                               .intensity = glm::vec3(7),
                               .bounces = true,
                               .id = 1}};
            b.frame();
            return totalFlux(b.read<io::RsmTexel>(b.last.bounce.rsm.texels));
        };
        const double whole = fluxFrom(2);
        EXPECT_GT(whole, 1);
        for (int turn = 0; turn < 2; ++turn) {
            EXPECT_NEAR(fluxFrom(2) / whole, 1, 1e-4) << turn;
            EXPECT_NEAR(fluxFrom(-2) / whole, doubleSided ? 1 : 0, 1e-4) << turn;
            mirror(b.scene);
        }
    }
}

TEST(Rsm, PointLightsSixFacesCatchAllItsPower) {
    Bench b(*scenegen::buildScene("furnace", 50));
    b.frame();
    EXPECT_NEAR(totalFlux(b.read<io::RsmTexel>(b.last.bounce.rsm.texels)) / (0.5 * 4 * kPi), 1, 0.01);
}

// Direct irradiance at pixels of the plane y = 0 against E = I cos / d², E = E_perpendicular cos.
void checkDirect(const RenderLight& light, double most) {
    Bench b(plane(0.5f));
    b.scene.lights = {light};
    for (int i = 0; i < 2; ++i)
        b.renderer.render(b.scene, b.size, b.settings, b.options,
                          [&](GraphScope scope, const SceneView&, const RenderFrame& declared) {
                              b.last = declared;
                              scope.output(declared.direct.image);
                              scope.output(declared.gbuffer.surfaces.depth);
                          });
    const Image direct = readImage(b.renderer, b.last.direct.image);
    const Image depth = readImage(b.renderer, b.last.gbuffer.surfaces.depth);
    int checked = 0;
    for (int y = 20; y < 96; y += 5)
        for (int x = 2; x < 160; x += 7) {
            const glm::vec2 ndc = (glm::vec2(x, y) + 0.5f) / glm::vec2(b.size) * 2.0f - 1.0f;
            const glm::vec4 h = b.scene.camera.worldFromClip * glm::vec4(ndc, depth.at(x, y).x, 1);
            const glm::dvec3 p = glm::dvec3(h) / double(h.w);
            if (depth.at(x, y).x == 0 || glm::length(p) > 6) continue;
            const glm::dvec3 to = glm::dvec3(light.position) - p;
            double truth = light.kind == LightKind::kDirectional
                               ? double(light.intensity.x) * double(-light.direction.y)
                               : double(light.intensity.x) * to.y / std::pow(glm::length(to), 3);
            if (light.kind == LightKind::kSpot) {
                const double cosine = glm::dot(-glm::normalize(to), glm::dvec3(light.direction));
                const double inner = std::cos(double(light.innerConeAngle)),
                             outer = std::cos(double(light.outerConeAngle));
                const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
                truth *= t * t;
            }
            ASSERT_NEAR(double(direct.at(x, y).x), truth, most * truth + 1e-3) << x << ' ' << y;
            ++checked;
        }
    EXPECT_GT(checked, 100);
}

TEST(DirectLight, PlaneAgainstTheFormulas) {
    checkDirect({.kind = LightKind::kPoint, .position = {0.4f, 2, -0.3f}, .intensity = glm::vec3(9), .id = 1},
                2e-3);
    checkDirect({.kind = LightKind::kSpot,
                 .position = {0.4f, 3, -0.3f},
                 .direction = glm::normalize(glm::vec3(0.1f, -1, 0.2f)),
                 .intensity = glm::vec3(9),
                 .innerConeAngle = 0.3f,
                 .outerConeAngle = 0.8f,
                 .id = 1},
                2e-3);
    checkDirect({.kind = LightKind::kDirectional,
                 .direction = glm::normalize(glm::vec3(0.5f, -1, 0.2f)),
                 .intensity = glm::vec3(9),
                 .id = 1},
                2e-3);
}

TEST(GBuffer, MirroredThingsShowTheirFronts) {
    Bench b(plane(0.5f));
    for (int turn = 0; turn < 2; ++turn) {
        b.renderer.render(b.scene, b.size, b.settings, b.options,
                          [&](GraphScope scope, const SceneView&, const RenderFrame& declared) {
                              b.last = declared;
                              scope.output(declared.gbuffer.surfaces.depth);
                              scope.output(declared.gbuffer.surfaces.normal);
                          });
        EXPECT_GT(readImage(b.renderer, b.last.gbuffer.surfaces.depth).at(80, 60).x, 0) << turn;
        EXPECT_NEAR(readImage(b.renderer, b.last.gbuffer.surfaces.normal).at(80, 60).y, 1, 1e-3) << turn;
        mirror(b.scene);
    }
}

// A box over the floor: the point straight below it gets nothing, one well beside it everything.
TEST(DirectLight, BoxesCastShadows) {
    for (const LightKind kind : {LightKind::kPoint, LightKind::kSpot, LightKind::kDirectional}) {
        scenegen::SceneBuilder builder("shadow");
        const uint32_t gray = builder.material("gray", glm::vec3(0.5f));
        builder.quad("floor", {-5, 0, -5}, {0, 0, 10}, {10, 0, 0}, gray);
        builder.box("box", {0, 1, 0}, {1, 0.2f, 1}, gray);
        builder.camera("camera", {0, 2.2f, 5}, {0, 0, 0}, 50);
        Bench b(builder.finish());
        b.scene.lights = {{.kind = kind,
                           .position = {0, 3, 0},
                           .direction = {0, -1, 0},
                           .intensity = glm::vec3(9),
                           .innerConeAngle = 0.6f,
                           .outerConeAngle = 0.9f,
                           .id = 1}};
        b.renderer.render(b.scene, b.size, b.settings, b.options,
                          [&](GraphScope scope, const SceneView&, const RenderFrame& declared) {
                              b.last = declared;
                              scope.output(declared.direct.image);
                          });
        const Image direct = readImage(b.renderer, b.last.direct.image);
        const auto at = [&](glm::vec3 p) {
            const glm::vec4 clip = b.scene.camera.clipFromWorld * glm::vec4(p, 1);
            const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(b.size);
            return direct.at(int(pixel.x), int(pixel.y)).x;
        };
        EXPECT_EQ(at({0, 0, 0.2f}), 0) << int(kind);
        EXPECT_GT(at({1.3f, 0, 0.6f}), 0.3f) << int(kind);
        EXPECT_GT(at({0, 1.1f, 0}), 1.0f) << "no acne on top, " << int(kind);
    }
}

// Every lit texel in one live cluster, fluxes add up, and the assignment is the CPU's.
void checkClusters(Bench& b) {
    const auto texels = b.read<io::RsmTexel>(b.last.bounce.rsm.texels);
    const auto clusters = b.read<io::Cluster>(b.last.bounce.clusters.clusters);
    const auto slots = b.read<uint32_t>(b.last.bounce.clusters.slotOfTexel);
    const auto candidates = b.read<uint32_t>(b.last.bounce.clusters.candidates);
    const auto counts = b.read<uint32_t>(b.last.bounce.clusters.candidateCounts);
    glm::dvec3 texelFlux(0), clusterFlux(0);
    std::vector<uint32_t> members(clusters.size(), 0);
    for (size_t i = 0; i < texels.size(); ++i) {
        const bool lit = texels[i].weight > 0;
        ASSERT_EQ(lit, slots[i] != io::kNoCluster) << "texel " << i;
        if (!lit) continue;
        const size_t tile = i / (io::kRsmTileSize * io::kRsmTileSize);
        ASSERT_LT(slots[i], counts[tile]);
        ++members[candidates[tile * io::kMaxCandidates + slots[i]]];
        texelFlux += glm::dvec3(texels[i].flux);
    }
    for (size_t c = 0; c < clusters.size(); ++c) {
        ASSERT_EQ(float(members[c]), clusters[c].texelCount) << "cluster " << c;
        ASSERT_TRUE(std::isfinite(clusters[c].position.x) && std::isfinite(clusters[c].area));
        clusterFlux += glm::dvec3(clusters[c].flux);
    }
    for (int channel = 0; channel < 3; ++channel)
        ASSERT_NEAR(clusterFlux[channel] / texelFlux[channel], 1, 1e-4);
}

void checkAssignmentTwin(Bench& b) {
    const auto texels = b.read<io::RsmTexel>(b.last.bounce.rsm.texels);
    const auto seeds = b.read<io::ClusterSeed>(b.last.bounce.clusters.seeds);
    const auto slots = b.read<uint32_t>(b.last.bounce.clusters.slotOfTexel);
    const auto candidates = b.read<uint32_t>(b.last.bounce.clusters.candidates);
    const auto counts = b.read<uint32_t>(b.last.bounce.clusters.candidateCounts);
    const ValClusteringSettings& s = b.settings.bounce.valClustering;
    const glm::vec4 weights = metricWeights(s);
    size_t checked = 0;
    for (size_t i = 0; i < texels.size(); i += 7) {
        const io::RsmTexel& t = texels[i];
        if (t.weight == 0) continue;
        const size_t tile = i / (io::kRsmTileSize * io::kRsmTileSize);
        const auto metric = [&](uint32_t slot) {
            const io::ClusterSeed& seed = seeds[candidates[tile * io::kMaxCandidates + slot]];
            return io::clusterMetric(t.position, t.normal, glm::normalize(t.flux), seed.position, seed.normal,
                                     seed.chroma, weights);
        };
        float best = 1e30f;
        for (uint32_t slot = 0; slot < counts[tile]; ++slot)
            best = std::min(best, metric(slot));
        ASSERT_NEAR(metric(slots[i]), best, 1e-5f + 1e-4f * best) << "texel " << i;
        ++checked;
    }
    EXPECT_GT(checked, 1000u);
}

TEST(ValClustering, KeepsFluxAndMembershipWhileTheLightMoves) {
    Bench b(*scenegen::buildScene("cornell", 0));
    const RenderLight start = b.scene.lights[0];
    for (int i = 0; i < 100; ++i) {
        RenderLight& light = b.scene.lights[0];
        light = start;
        light.position.x = 0.6f * std::sin(0.07f * float(i));
        light.direction = glm::normalize(glm::vec3(0.5f * std::cos(0.05f * float(i)), -1, 0.3f));
        ++b.scene.lightsVersion;
        b.frame();
        if (i % 10 != 9) continue;
        checkClusters(b);
        if (HasFatalFailure()) FAIL() << "in frame " << i;
    }
    checkAssignmentTwin(b);
}

// Splits come while there is time left to find a place; later only places that stayed empty are tried anew.
TEST(ValClustering, NoneIsSplitInTheSecondHalfOfSettling) {
    Bench b(*scenegen::buildScene("cornell", 0));
    const uint32_t frames = b.settings.bounce.valClustering.settleFrames;
    uint32_t youngest[2];
    for (uint32_t half = 0; half < 2; ++half) {
        for (uint32_t i = 0; i < frames / 2; ++i)
            b.frame();
        float least = 1e30f;
        for (const io::Cluster& c : b.read<io::Cluster>(b.last.bounce.clusters.clusters))
            if (c.texelCount > 0) least = std::min(least, c.age);
        youngest[half] = uint32_t(least);
    }
    EXPECT_LT(youngest[0], 8u) << "none was split at all";
    EXPECT_GE(youngest[1], frames / 2 - 2);
}

TEST(ValClustering, SeedsAreOtherArrangements) {
    const auto clustersOf = [](uint32_t seed) {
        Bench b(*scenegen::buildScene("cornell", 0));
        b.settings.bounce.valClustering.seed = seed;
        for (int i = 0; i < 40; ++i)
            b.frame();
        checkClusters(b);
        std::vector<glm::vec3> places;
        for (const io::Cluster& c : b.read<io::Cluster>(b.last.bounce.clusters.clusters))
            places.push_back(c.position);
        return places;
    };
    const auto first = clustersOf(0);
    EXPECT_EQ(first, clustersOf(0));
    EXPECT_NE(first, clustersOf(1));
}

TEST(ValClustering, PointLightAndFewTexelsKeepTheInvariants) {
    Bench furnace(*scenegen::buildScene("furnace", 50));
    for (int i = 0; i < 5; ++i)
        furnace.frame();
    checkClusters(furnace);
    checkAssignmentTwin(furnace);

    Bench few(*scenegen::buildScene("cornell", 0));
    few.settings.bounce.valClustering.count = 1024;  // more clusters than lit texels
    few.settings.bounce.rsm.resolution = 32;
    for (int i = 0; i < 5; ++i)
        few.frame();
    checkClusters(few);
    few.settings.bounce.laterBounces = {.enabled = true,
                                        .share = 0.8f};  // a map whose clusters all tiles consider
    for (int i = 0; i < 5; ++i)
        few.frame();
    checkClusters(few);
}

// Sampled point lights carry the RSMs' flux: each as much as its chance leaves it.
// m: the root of the flux-weighted mean square distance of texels from their clusters' planes.
double thicknessOfClusters(const SceneAsset& asset, float planeWeight) {
    Bench b(asset);
    if (planeWeight >= 0) b.settings.bounce.valClustering.planeWeight = planeWeight;
    b.settings.bounce.valClustering.count = 32;
    for (int i = 0; i < 40; ++i)
        b.frame();
    double sum = 0, flux = 0;
    for (const io::Cluster& c : b.read<io::Cluster>(b.last.bounce.clusters.clusters)) {
        if (c.texelCount == 0) continue;
        const glm::dvec3 n(c.normal), own(c.covarianceDiagonal), mixed(c.covarianceMixed);
        sum += double(c.flux.x) *
               (glm::dot(own, n * n) + 2 * (mixed.x * n.x * n.y + mixed.y * n.x * n.z + mixed.z * n.y * n.z));
        flux += double(c.flux.x);
    }
    return std::sqrt(std::max(sum, 0.0) / flux);
}

TEST(ValClustering, KeepsStepsOfAStairApart) {
    scenegen::SceneBuilder builder("stair");
    const uint32_t gray = builder.material("gray", glm::vec3(0.5f));
    for (int step = 0; step < 8; ++step)
        builder.box("step", {0, 0.15f * float(step), 0.3f * float(step)}, {3, 0.3f, 0.3f}, gray);
    builder.sun("sun", {0.02f, -1, 0.03f}, glm::vec3(5));
    builder.camera("camera", {0, 3, -3}, {0, 0.5f, 1}, 60);
    const SceneAsset asset = builder.finish();
    const double published = thicknessOfClusters(asset, 0), ours = thicknessOfClusters(asset, -1);
    EXPECT_GT(published, 0.03) << "steps 0.15 m high share clusters";
    EXPECT_LT(ours, 0.7 * published);
}

TEST(VplSampling, LightsCarryTheMapsFlux) {
    for (const char* name : {"cornell", "hall"}) {
        Bench b(*scenegen::buildScene(name, 0));
        applyPreset("ism", b.settings);
        b.settings.bounce.ismAtlas.enabled = false;
        b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.vals.vals); };
        b.frame();
        double lights = 0;
        for (const io::Val& val : b.read<io::Val>(b.last.bounce.vals.vals))
            lights += double(val.flux.x + val.flux.y + val.flux.z);
        double map = 0;
        for (const io::RsmTexel& t : b.read<io::RsmTexel>(b.last.bounce.rsm.texels))
            map += double(t.flux.x + t.flux.y + t.flux.z);
        EXPECT_NEAR(lights / map, 1, 0.01) << name;
    }
}

// Reveals of small windows that the sun shines past are a pixel wide, and many times as bright as all about
// them: no pixel that is gathered lies there.
TEST(Upsampling, PixelsLikeNoneAreGatheredThemselves) {
    std::array<Image, 2> images;
    for (const uint32_t spacing : {1u, 2u}) {
        Bench b(*scenegen::buildScene("window", 0), {160, 90});
        b.settings.bounce.spacing = spacing;
        for (int i = 0; i < 60; ++i)
            b.frame();
        images[spacing - 1] = readImage(b.renderer, b.last.bounce.bounce1.image);
    }
    double squares = 0;
    for (size_t i = 0; i < images[0].pixels.size(); ++i) {
        const glm::dvec3 off = images[1].pixels[i] - images[0].pixels[i];
        squares += glm::dot(off, off) / 3;
    }
    const double off = std::sqrt(squares / double(images[0].pixels.size())) / meanOf(images[0]);
    std::printf("every second pixel is off from all by %.3f of the mean\n", off);
    EXPECT_LT(off, 0.22);  // 0.31 when they took the light of what is most alike
}

struct KeptMaps {
    int kept = 0, live = 0;
};

KeptMaps keptMaps(Bench& b) {
    KeptMaps sum;
    const auto vals = b.read<io::Val>(b.last.bounce.vals.vals);
    const auto states = b.read<io::IsmMapState>(b.last.bounce.isms.states);
    for (size_t map = 0; map < states.size(); ++map) {
        sum.live += vals[map].flux != glm::vec3(0);
        sum.kept += states[map].kept != 0;
    }
    return sum;
}

// With a walking camera clusters come to rest, as they follow the view slowly; a wall's step moves the points
// of all maps.
TEST(IsmAtlas, MapsOfLightsThatStandStillAreKept) {
    Bench b(*scenegen::buildScene("hall", 0));
    b.output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.bounce.vals.vals);
        scope.output(f.bounce.isms.states);
    };
    CameraPose pose = cameraOf(b.asset, 0);
    KeptMaps camera;
    for (int i = 0; i < 140; ++i) {
        pose.position.x += 0.002;
        setCamera(b.scene, pose, b.size);
        b.frame();
        const KeptMaps now = keptMaps(b);
        if (i >= 120) camera = {camera.kept + now.kept, camera.live + now.live};
    }
    std::printf("camera moves: %.2f of the maps kept\n", double(camera.kept) / camera.live);
    EXPECT_GT(camera.live, 20 * 100);
    EXPECT_GT(camera.kept, camera.live / 2);
    b.scene.instances.back().worldFromLocal[3].y += 0.3f;
    ++b.scene.instancesVersion;
    b.frame();
    EXPECT_EQ(keptMaps(b).kept, 0);
}

// Above the light, so that the RSM and its clusters stay as they are.
std::unique_ptr<Bench> boxAboveALamp(bool traced, bool keep) {
    scenegen::SceneBuilder room("room");
    const uint32_t white = room.material("white", glm::vec3(0.7f));
    room.room("walls", {-1, 0, -1}, {1, 2, 1}, {white, white, white, white, white, white});
    room.box("box", {0.4f, 1.4f, 0.3f}, {0.4f, 0.2f, 0.4f}, white);
    room.spot("lamp", {0, 1, 0}, {0, -1, 0}, glm::vec3(10), {40, 60});
    room.camera("camera", {-0.9f, 1.5f, 0.9f}, {0, 0.8f, 0}, 70);
    auto b = std::make_unique<Bench>(room.finish());
    b->settings.bounce.ismAtlas = {};
    b->settings.bounce.ismAtlas.traced = traced;
    b->settings.bounce.ismAtlas.keepMaps = keep;
    b->settings.bounce.importance.viewWeight = 0;
    b->scene.instances.back().movable = true;
    b->output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.bounce.vals.vals);
        scope.output(f.bounce.isms.states);
        scope.output(f.bounce.isms.planes);
    };
    return b;
}

void moveLastUp(Bench& b, float by) {
    b.scene.instances.back().worldFromLocal[3].y += by;
    b.scene.allInstancesChanged = false;
    const uint32_t last = uint32_t(b.scene.instances.size()) - 1;
    b.scene.changedInstances = {{last, last + 1}};
    ++b.scene.instancesVersion;
    b.frame();
}

// A box that moves is splatted over what is static, whose maps are kept; the result is what making all of it
// anew gives.
void boxLeavesTheStaticLayer(bool traced) {
    const auto kept = boxAboveALamp(traced, true), anew = boxAboveALamp(traced, false);
    for (Bench* b : {kept.get(), anew.get()}) {
        for (int i = 0; i < 40; ++i)
            b->frame();
        for (int step = 0; step < 3; ++step)
            moveLastUp(*b, 0.02f);
    }
    EXPECT_EQ(kept->outcome(traced ? "ism_atlas.trace" : "ism_atlas.choose"), PassOutcome::kSkipped)
        << "all static layers are kept";
    EXPECT_EQ(kept->outcome("ism_atlas.splat_movable"), PassOutcome::kRan);
    anew->settings.bounce.ismAtlas.keepMaps = true;  // but of the frames before none is
    anew->frame();
    const uint32_t regions = 9 * kept->last.bounce.isms.mapCount;
    const auto finished = [](Bench& b) {
        return b.read<glm::uvec3>(b.renderer.graph().findBuffer("ism_atlas.finished_groups")).front().x;
    };
    std::printf("regions finished anew while a box moves: %u of %u\n", finished(*kept), regions);
    EXPECT_EQ(finished(*anew), regions);
    EXPECT_GT(finished(*kept), 0u);
    EXPECT_LT(finished(*kept), regions / 2);
    EXPECT_EQ(keptMaps(*anew).kept, 0);
    const auto a = kept->read<glm::vec4>(kept->last.bounce.isms.planes),
               b = anew->read<glm::vec4>(anew->last.bounce.isms.planes);
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]), 0);
}

TEST(IsmAtlas, MovingBoxesLeaveTheStaticLayerAsItIs) {
    boxLeavesTheStaticLayer(false);
    boxLeavesTheStaticLayer(true);
}

// Things that come and go are no reason to build trees anew: maps of what is static stay, traced. Static ones
// are.
TEST(IsmAtlas, ThingsThatComeLeaveTheTracedMaps) {
    const auto b = boxAboveALamp(true, true);
    for (int i = 0; i < 40; ++i)
        b->frame();
    const auto add = [&](bool movable) {
        b->scene.instances.push_back(b->scene.instances.back());
        b->scene.instances.back().movable = movable;
        b->scene.instances.back().worldFromLocal[3] += glm::vec3(-0.5f, 0.1f, 0);
        b->scene.allInstancesChanged = true;
        ++b->scene.instancesVersion;
        b->frame();
    };
    add(true);
    const KeptMaps come = keptMaps(*b);
    EXPECT_GT(come.kept, come.live * 8 / 10) << "but those of lights that moved meanwhile";
    EXPECT_GT(come.live, 100);
    add(false);
    EXPECT_EQ(keptMaps(*b).kept, 0) << "splatted, until the tree is built anew";
    for (int i = 0; i < 20; ++i)
        b->frame();
    EXPECT_EQ(b->outcome("ism_atlas.trace"), PassOutcome::kSkipped) << "traced anew, and kept since";
}

// What a map holds where a box moved: the box, at its distance, and no longer where it was.
TEST(IsmAtlas, MovingBoxesShowInTracedMaps) {
    const auto moved = boxAboveALamp(true, true), fresh = boxAboveALamp(true, true);
    fresh->scene.instances.back().worldFromLocal[3].y += 0.3f;
    for (int i = 0; i < 40; ++i)
        moved->frame(), fresh->frame();
    const auto before = moved->read<glm::vec4>(moved->last.bounce.isms.planes);
    moveLastUp(*moved, 0.3f);
    const auto after = moved->read<glm::vec4>(moved->last.bounce.isms.planes),
               truth = fresh->read<glm::vec4>(fresh->last.bounce.isms.planes);
    const auto otherThanTruth = [&](const std::vector<glm::vec4>& planes) {
        int count = 0;
        for (size_t i = 0; i < truth.size(); ++i)
            count += std::abs(planes[i].w - truth[i].w) > 0.02f * truth[i].w;
        return count;
    };
    // Its points are others, so that its outline differs.
    std::printf("texels at another distance: %d before, %d after it moved, of %zu\n", otherThanTruth(before),
                otherThanTruth(after), truth.size());
    EXPECT_GT(otherThanTruth(before), 1000);
    EXPECT_LT(otherThanTruth(after), otherThanTruth(before) / 4);
}

struct PointDensity {  // of a map's points over those of its surroundings, nearer and farther than 1.5 m
    double nearBy = 0, farOff = 0;
};

// Over all lights of cornell: how many of the surface points before each light its map is made of. No point
// twice.
PointDensity densityOfMaps(bool nearMore) {
    Bench b(*scenegen::buildScene("cornell", 0));
    b.settings.bounce.ismAtlas.traced = false;
    b.settings.bounce.ismAtlas.nearMore = nearMore;
    b.settings.bounce.ismAtlas.keepMaps = false;
    b.output = [](GraphScope scope, const RenderFrame& f) {
        scope.output(f.bounce.vals.vals);
        scope.output(f.bounce.surfacePoints.points);
        scope.output(f.bounce.isms.chosen);
        scope.output(f.bounce.isms.states);
    };
    for (int i = 0; i < 8; ++i)
        b.frame();
    const auto vals = b.read<io::Val>(b.last.bounce.vals.vals);
    const auto points = b.read<io::SurfacePoint>(b.last.bounce.surfacePoints.points);
    const auto chosen = b.read<uint32_t>(b.last.bounce.isms.chosen);
    const auto states = b.read<io::IsmMapState>(b.last.bounce.isms.states);
    double taken[2] = {}, all[2] = {};
    for (size_t map = 0; map < b.last.bounce.isms.mapCount; map += 8) {
        if (vals[map].flux == glm::vec3(0)) continue;
        const auto isFar = [&](uint32_t point) {
            return size_t(glm::distance(points[point].position, vals[map].position) > 1.5f);
        };
        const uint32_t budget = b.last.bounce.isms.pointsPerMap;
        const uint32_t count = states[map].pointCount;
        EXPECT_LE(count, budget);
        EXPECT_GT(count, budget * 95 / 100);
        std::set<uint32_t> once;
        for (size_t i = map * budget; i < map * budget + count; ++i) {
            const uint32_t point = chosen[i] & ((1u << io::kIsmPointBits) - 1);
            EXPECT_TRUE(once.insert(point).second) << "point " << point << " twice in map " << map;
            ++taken[isFar(point)];
        }
        for (uint32_t i = 0; i < points.size(); ++i)
            ++all[isFar(i)];
    }
    return {taken[0] / all[0], taken[1] / all[1]};
}

TEST(IsmAtlas, PointsFollowTheDistanceOrTheArea) {
    const PointDensity more = densityOfMaps(true), even = densityOfMaps(false);
    EXPECT_GT(more.nearBy, 3 * more.farOff);
    EXPECT_NEAR(even.nearBy / even.farOff, 1, 0.05);
}

// Irradiance over the walls a camera in the middle of the 2 m room sees ahead, W.
double powerOnWall(Bench& b, glm::vec3 forward) {
    setCamera(b.scene, {.position = {0, 0, 0}, .forward = forward, .verticalFov = float(kPi / 2)}, b.size);
    for (int i = 0; i < 40; ++i)
        b.frame();
    const Image bounce = readImage(b.renderer, b.last.bounce.bounce1.image);
    double sum = 0;
    for (const glm::vec3& e : bounce.pixels)
        sum += double(e.x);
    return sum * 4 / double(bounce.pixels.size());  // the image is the wall
}

// What the light leaves of itself on all walls arrives on them again.
TEST(Technique, ClosedRoomPowerAudit) {
    Bench b(*scenegen::buildScene("furnace", 50), {128, 128});
    const double wall = (powerOnWall(b, {1, 0, 0}) + powerOnWall(b, {0, 0, 1})) / 2;
    double flux = 0;
    for (const io::RsmTexel& t : b.read<io::RsmTexel>(b.last.bounce.rsm.texels))
        flux += double(t.flux.x);
    std::printf("arrives over sent: %.4f\n", 6 * wall / flux);
    EXPECT_NEAR(6 * wall / flux, 1, 0.01);
}

// Irradiance on the wall of `corner` at height y and depth z: a uniform Lambert rectangle [0,2] x [-1,1] of
// radiosity 2 W/m² in the plane y = 0, by midpoint quadrature.
double cornerIrradiance(double y, double z) {
    constexpr int kSteps = 400;
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
            const double dx = 2 * (i + 0.5) / kSteps, dz = -1 + 2 * (j + 0.5) / kSteps - z;
            const double d2 = dx * dx + y * y + dz * dz;
            sum += dx * y / (kPi * d2 * d2);
        }
    return 2.0 * sum * 4 / (kSteps * kSteps);
}

TEST(Technique, CornerAgainstQuadrature) {
    Bench b(*scenegen::buildScene("corner", 0), {320, 180});
    Image bounce;
    for (int i = 0; i < 40; ++i)
        b.frame();
    bounce = readImage(b.renderer, b.last.bounce.bounce1.image);
    double squares = 0, mean = 0, ratio = 0;
    int count = 0;
    for (double y = 0.1; y < 1.95; y += 0.2)
        for (double z = -0.8; z <= 0.81; z += 0.2) {
            const glm::vec4 clip = b.scene.camera.clipFromWorld * glm::vec4(0, float(y), float(z), 1);
            const glm::vec2 pixel = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(b.size);
            if (pixel.x < 0 || pixel.y < 0 || pixel.x >= 320 || pixel.y >= 180) continue;
            const double truth = cornerIrradiance(y, z);
            const double got = double(bounce.at(int(pixel.x), int(pixel.y)).x);
            squares += (got - truth) * (got - truth);
            mean += truth;
            ratio += got;
            ++count;
        }
    ASSERT_GT(count, 40);
    RecordProperty("relative_rmse", std::to_string(std::sqrt(squares / count) / (mean / count)));
    EXPECT_LT(std::sqrt(squares / count) / (mean / count), 0.03);
    EXPECT_NEAR(ratio / mean, 1, 0.02) << "energy";
}

TEST(Frame, ColourBleedsAndNothingIsBlack) {
    Bench b(*scenegen::buildScene("cornell", 0));
    for (int i = 0; i < 20; ++i)
        b.frame();
    const Image bounce = readImage(b.renderer, b.last.bounce.bounce1.image);
    const Image display = readImage(b.renderer, b.last.outputs.display);
    double left = 0, right = 0, lit = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 160; ++x) {
            const glm::vec3 e = bounce.at(x, y);
            ASSERT_TRUE(std::isfinite(e.x + e.y + e.z));
            (x < 80 ? left : right) += double(e.x - e.y);
            lit += display.at(x, y).x > 0.02f;
        }
    EXPECT_GT(left, right) << "redder by the red wall";
    EXPECT_GT(lit / (160 * 96), 0.4);
}

TEST(Frame, SameFramesGiveTheSameBits) {
    const auto render = [] {
        Bench b(*scenegen::buildScene("cornell", 0));
        for (int i = 0; i < 12; ++i)
            b.frame();
        return readImage(b.renderer, b.last.outputs.radiance).pixels;
    };
    EXPECT_EQ(render(), render());
}

TEST(Frame, NothingMovesNothingRuns) {
    Bench b(*scenegen::buildScene("hall", 0));
    b.settings.bounce.valClustering.settleFrames = 4;
    for (int i = 0; i < b.restFrames(); ++i)
        b.frame();
    const auto before = readImage(b.renderer, b.last.outputs.display).pixels;
    for (int i = 0; i < 3; ++i) {
        b.frame();
        EXPECT_EQ(b.passesRun(), 0);
    }
    EXPECT_EQ(readImage(b.renderer, b.last.outputs.display).pixels, before);
}

// Passes that ran though only the camera moved.
std::vector<std::string> runByTheCamera(float viewWeight) {
    Bench b(*scenegen::buildScene("hall", 0));
    b.settings.bounce.importance.viewWeight = viewWeight;
    b.settings.bounce.valClustering.settleFrames = 2;
    for (int i = 0; i < 4; ++i)
        b.frame();
    CameraPose pose = cameraOf(b.asset, 0);
    pose.position.x += 0.2;
    setCamera(b.scene, pose, b.size);
    b.frame();
    std::vector<std::string> ran;
    for (const PassReport& pass : b.renderer.graph().report())
        if (pass.outcome == PassOutcome::kRan) ran.emplace_back(pass.name);
    return ran;
}

bool anyStartsWith(const std::vector<std::string>& names, std::string_view prefix) {
    return std::ranges::any_of(names, [&](const std::string& n) { return n.starts_with(prefix); });
}

TEST(Frame, CameraAloneLeavesTheRsmsAlone) {
    for (const float viewWeight : {0.0f, 0.7f}) {
        const auto ran = runByTheCamera(viewWeight);
        EXPECT_TRUE(anyStartsWith(ran, "gbuffer.fill"));
        EXPECT_FALSE(anyStartsWith(ran, "rsm."));
        EXPECT_FALSE(anyStartsWith(ran, "punctual_shadows.faces"));
        for (const char* step : {"importance.", "val_clustering.", "ism_atlas."})
            EXPECT_EQ(anyStartsWith(ran, step), viewWeight > 0) << step;
    }
}

TEST(Frame, SkippingChangesNoBit) {
    const auto render = [](bool skip) {
        Bench b(*scenegen::buildScene("hall", 0));
        b.options.skip = skip;
        std::vector<glm::vec3> all;
        for (int i = 0; i < 14; ++i) {
            if (i == 4 || i == 9) {  // a box moves, then stands still again
                b.scene.instances.back().worldFromLocal[3].y += 0.3f;
                ++b.scene.instancesVersion;
            }
            if (i == 11) b.scene.lights[0].intensity *= 0.5f;
            if (i == 12) setCamera(b.scene, {.position = {0.1, 1.5, 3}}, b.size);
            b.frame();
            const auto pixels = readImage(b.renderer, b.last.outputs.radiance).pixels;
            all.insert(all.end(), pixels.begin(), pixels.end());
        }
        return all;
    };
    EXPECT_EQ(render(true), render(false));
}

using Ran = std::set<std::string>;

// Techniques ("rsm" of "rsm.render") of which a pass ran in the last frame.
Ran techniquesRun(Bench& b) {
    Ran names;
    for (const PassReport& pass : b.renderer.graph().report())
        if (pass.outcome == PassOutcome::kRan) names.emplace(pass.name.substr(0, pass.name.find('.')));
    return names;
}

// The hall with everything at rest.
std::unique_ptr<Bench> restingHall() {
    auto b = std::make_unique<Bench>(*scenegen::buildScene("hall", 0));
    b->settings.bounce.valClustering.settleFrames = 2;
    for (RenderInstance& instance : b->scene.instances)
        instance.movable = false;
    b->scene.instances.back().movable = true;
    for (int i = 0; i < b->restFrames(); ++i) {
        b->frame();
        b->scene.allInstancesChanged = false;
    }
    EXPECT_EQ(techniquesRun(*b), Ran{});
    return b;
}

void moveLast(Bench& b, glm::vec3 by) {
    const auto row = uint32_t(b.scene.instances.size() - 1);
    b.scene.instances[row].worldFromLocal[3] += by;
    b.scene.changedInstances = {{row, row + 1}};
    ++b.scene.instancesVersion;
    b.frame();
    b.scene.changedInstances.clear();
}

// What a thing is out of sight and out of reach of runs nothing but what indirect light may meet it with.
TEST(Frame, AThingOutOfSightLeavesViewAndRsmsAlone) {
    auto b = restingHall();
    CameraPose away = cameraOf(b->asset, 0);
    away.forward = {1, 0, 0.2f};
    setCamera(b->scene, away, b->size);
    for (RenderLight& light : b->scene.lights) {  // beams up into a corner
        light.position = {5, 3, 3};
        light.direction = glm::normalize(glm::vec3(1, 0.5f, 0.5f));
        light.outerConeAngle = 0.5f;
        light.innerConeAngle = 0.3f;
    }
    ++b->scene.lightsVersion;
    for (int i = 0; i < b->restFrames(); ++i)
        b->frame();
    ASSERT_EQ(techniquesRun(*b), Ran{});
    moveLast(*b, {0, 0.05f, 0});
    const Ran ran = techniquesRun(*b);
    for (const char* step : {"gbuffer", "rsm", "importance", "val_clustering", "val_fit"})
        EXPECT_FALSE(ran.contains(step)) << step;
    for (const char* step : {"surface_points", "ism_atlas", "val_shading"})
        EXPECT_TRUE(ran.contains(step)) << step;
}

TEST(Frame, LightsThatGoOutStopAllThatIsAboutThem) {
    auto b = restingHall();
    for (RenderLight& light : b->scene.lights)
        light.intensity = glm::vec3(0);
    ++b->scene.lightsVersion;
    b->frame();
    EXPECT_EQ(techniquesRun(*b), Ran{"composite"});
    for (const PassReport& pass : b->renderer.graph().report())
        for (const char* step :
             {"rsm.", "importance.", "val_clustering.", "val_fit.", "ism_atlas.", "val_shading."})
            EXPECT_FALSE(pass.name.starts_with(step)) << pass.name << " is not even declared";
}

TEST(Frame, AFlickeringLightLeavesTheOthersClustersAlone) {
    const auto oldClusters = [](bool flickers) {  // of the other light, after two dozen frames
        Bench b(*scenegen::buildScene("hall", 0), {64, 40});
        b.settings.bounce.valClustering.adaptive = false;
        b.settings.bounce.valClustering.settleFrames = 32;
        const glm::vec3 bright = b.scene.lights[0].intensity;
        for (int i = 0; i < 24; ++i) {
            const float flame = i % 5 == 3 ? 0.0f : i % 2 ? 0.8f : 1.2f;
            b.scene.lights[0].intensity = bright * (flickers ? flame : 1);
            ++b.scene.lightsVersion;
            b.frame();
            // RSMs come and go: their memory is used again, which the validation layer takes for a
            // hazard as it does not follow timeline semaphores.
            b.renderer.waitIdle();
        }
        int count = 0;
        for (const io::Cluster& c : b.read<io::Cluster>(b.last.bounce.clusters.clusters))
            count += c.texelCount > 0 && c.mapId == uint32_t(b.scene.lights[1].id) && c.age >= 12;
        return count;
    };
    const int steady = oldClusters(false);
    EXPECT_GT(steady, 16);
    EXPECT_GE(oldClusters(true), steady * 3 / 4) << "hardly any was seeded anew";
}

TEST(Frame, WithoutLightThereIsNoGlobalIllumination) {
    Bench b(*scenegen::buildScene("cornell", 0));
    b.scene.lights.clear();
    b.frame();
    for (const PassReport& pass : b.renderer.graph().report())
        EXPECT_TRUE(pass.name.starts_with("scene.") || pass.name.starts_with("gbuffer.") ||
                    pass.name.starts_with("composite."))
            << pass.name;
}

// Points of later bounces change in each frame, what lights see does not: its texels stay, trimmed at creases
// once.
TEST(Rsm, TexelsOfLightsStayWhilePointsChange) {
    std::vector<io::RsmTexel> texels[2];
    for (const bool skip : {false, true}) {
        Bench b(*scenegen::buildScene("cornell", 0), {48, 27});
        addBounces(b.settings);
        b.options.skip = skip;
        uint32_t parts = 0, built = 0;
        for (int i = 0; i < 6; ++i) {
            b.frame();
            const auto report = b.renderer.graph().report();
            const auto pass = std::ranges::find(report, "rsm.build_texels", &PassReport::name);
            ASSERT_NE(pass, report.end());
            ASSERT_EQ(pass->outcome, PassOutcome::kRan);
            parts = pass->patches, built = pass->patchesDrawn;
        }
        EXPECT_GT(parts, 1u);
        if (skip)
            EXPECT_LT(built, parts);
        else
            EXPECT_EQ(built, parts);
        texels[skip] = b.read<io::RsmTexel>(b.last.bounce.rsm.texels);
    }
    ASSERT_EQ(texels[0].size(), texels[1].size());
    EXPECT_EQ(std::memcmp(texels[0].data(), texels[1].data(), texels[0].size() * sizeof(io::RsmTexel)), 0);
}

// Materials are Lambert in the one and have gloss in the other.
TEST(Glossy, RunsOnlyWhereAMaterialIs) {
    for (const char* name : {"cornell", "glossy"}) {
        Bench b(*scenegen::buildScene(name, 0), {64, 36});
        b.frame();
        const bool glossy = std::string_view(name) == "glossy";
        EXPECT_EQ(bool(b.last.gbuffer.surfaces.reflectance), glossy);
        EXPECT_EQ(bool(b.last.bounce.gloss), glossy);
        b.settings.bounce.valShading.glossy = false;
        b.frame();
        EXPECT_FALSE(b.last.bounce.gloss);
    }
}

// Where neighbours reflect alike they share what they reflect; all else meets the lights by itself.
TEST(Glossy, OfEverySecondPixelIsThatOfAll) {
    for (const char* name : {"glossy", "showroom"}) {
        Image images[2];
        for (const uint32_t spacing : {1u, 2u}) {
            Bench b(*scenegen::buildScene(name, 0), {160, 96});
            b.settings.bounce.spacing = spacing;
            b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.gloss); };
            b.frame();
            images[spacing - 1] = readImage(b.renderer, b.last.bounce.gloss);
        }
        double off = 0, all = 0;
        for (size_t i = 0; i < images[0].pixels.size(); ++i) {
            const glm::dvec3 truth = images[0].pixels[i], apart = glm::dvec3(images[1].pixels[i]) - truth;
            off += glm::dot(apart, apart);
            all += glm::dot(truth, truth);
        }
        std::printf("%s: relative RMSE %.4f\n", name, std::sqrt(off / all));
        // What is left are borders of lights in smooth floors and of shadows: pixels are large here.
        EXPECT_LT(std::sqrt(off / all), 0.15) << name;
        EXPECT_NEAR(meanOf(images[1]) / meanOf(images[0]), 1, 0.015) << name;
    }
}

}  // namespace
}  // namespace ag::gi
