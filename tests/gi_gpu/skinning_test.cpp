// Skinned meshes on the device: the vertices are those of the CPU, only what moved is deformed, and what
// reads surfaces follows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "engine/renderer/scene_surfaces.h"
#include "engine/scene/deform.h"
#include "engine/scene/skinned_mesh.h"
#include "shaders/later_bounces/later_bounces_io.h"
#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/figures.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
using namespace render;
namespace {

struct SkinnedBench : Bench {
    SkinnedMeshLibrary library = makeSkinnedMeshLibrary(asset);

    explicit SkinnedBench(uint32_t count, glm::uvec2 pixels = {96, 64})
        : Bench(scenegen::figures(count), pixels) {
        settings.bounce.rsm.resolution = 64;
        settings.bounce.valClustering.count = 32;
        scene.allInstancesChanged = true;
    }
    // To another time of its animation; the frame after says so.
    void pose(uint32_t skinnedMesh, float seconds) {
        const RenderSkinnedMesh& row = scene.skinnedMeshes[skinnedMesh];
        poseSkinnedMesh(library, skinnedMesh, 0, seconds,
                        std::span(scene.joints).subspan(row.firstJoint, row.jointCount));
        if (!finishPose(library.models[skinnedMesh], scene, skinnedMesh)) return;
        for (uint32_t i = 0; i < scene.instances.size(); ++i)
            if (scene.instances[i].skinnedMesh == skinnedMesh) scene.changedInstances.push_back({i, i + 1});
    }
    void next() {
        if (!scene.changedInstances.empty()) ++scene.instancesVersion;
        frame();
        scene.changedInstances.clear();
        scene.allInstancesChanged = false;
    }
    const PassReport* pass(std::string_view name) {
        for (const PassReport& p : renderer.graph().report())
            if (p.name == name) return &p;
        return nullptr;
    }
    template <class T>
    std::vector<T> named(std::string_view name) {
        return read<T>(renderer.graph().findBuffer(name));
    }
    float scale() const {  // of the skinned meshes' positions
        return glm::length(scene.bounds.max - scene.bounds.min);
    }
};

void expectTwins(SkinnedBench& b) {
    const DeformedVertices cpu = deformSkinnedMeshes(b.scene);
    const auto positions = b.named<glm::vec3>("skinning.positions");
    const auto attributes = b.named<VertexAttributes>("skinning.attributes");
    ASSERT_GE(positions.size(), cpu.positions.size());
    for (const RenderSkinnedMesh& f : b.scene.skinnedMeshes)
        for (uint32_t v = f.firstDeformed; v < f.firstDeformed + f.vertexCount; ++v) {
            ASSERT_LT(glm::length(positions[v] - cpu.positions[v]),
                      1e-5f * (1 + glm::length(cpu.positions[v])));
            ASSERT_LT(glm::length(attributes[v].normal - cpu.attributes[v].normal), 1e-5f);
            ASSERT_LT(glm::length(attributes[v].tangent - cpu.attributes[v].tangent), 1e-5f);
            ASSERT_EQ(attributes[v].uv, cpu.attributes[v].uv);
        }
}

TEST(Skinning, TheDeviceDeformsAsTheCpuDoes) {
    SkinnedBench b(5);
    b.next();
    expectTwins(b);
    b.pose(1, 0.4f);
    b.pose(4, 2.2f);
    b.next();
    expectTwins(b);
}

TEST(Skinning, OnlySkinnedMeshesThatMovedAreDeformed) {
    SkinnedBench b(6);
    b.next();
    ASSERT_NE(b.pass("skinning.deform"), nullptr);
    EXPECT_EQ(b.pass("skinning.deform")->outcome, PassOutcome::kRan);
    EXPECT_EQ(b.pass("skinning.deform")->patches, 6u);
    EXPECT_EQ(b.pass("skinning.deform")->patchesDrawn, 6u);
    for (int i = 0; i < 4; ++i)
        b.next();
    EXPECT_NE(b.pass("skinning.deform")->outcome, PassOutcome::kRan);
    b.pose(2, 1.1f);
    b.next();
    EXPECT_EQ(b.pass("skinning.deform")->outcome, PassOutcome::kRan);
    EXPECT_EQ(b.pass("skinning.deform")->patchesDrawn, 1u);
    EXPECT_EQ(b.pass("gbuffer.fill")->outcome, PassOutcome::kRan);
    expectTwins(b);
    b.pose(2, 1.1f);
    b.next();
    EXPECT_NE(b.pass("skinning.deform")->outcome, PassOutcome::kRan) << "the same pose again";
}

TEST(Skinning, ScenesWithoutSkinnedMeshesHaveNoneOfIt) {
    Bench b(*scenegen::buildScene("crowd", 4), {64, 48});
    b.frame();
    for (const PassReport& p : b.renderer.graph().report())
        EXPECT_FALSE(p.name.starts_with("skinning.")) << p.name;
    for (const std::string_view name : b.renderer.graph().resourceNames())
        EXPECT_FALSE(name.starts_with("skinning.")) << name;
}

// Distance of a point from a triangle's plane, and whether it lies inside.
float distanceFrom(glm::vec3 p, const std::array<glm::vec3, 3>& c) {
    const glm::vec3 n = glm::normalize(glm::cross(c[1] - c[0], c[2] - c[0]));
    for (size_t i = 0; i < 3; ++i)
        if (glm::dot(glm::cross(n, c[(i + 1) % 3] - c[i]), p - c[i]) < -1e-4f) return 1e9f;
    return std::abs(glm::dot(n, p - c[0]));
}

// Every point on a skinned mesh lies on the triangle it was chosen on, as that is bent now, with its normal.
TEST(Skinning, PointsOnSurfacesFollow) {
    SkinnedBench b(3);
    b.output = [](GraphScope scope, const RenderFrame& f) { scope.output(f.bounce.surfacePoints.points); };
    const SurfaceSamples samples = render::sampleSurfaces(b.scene, 1u << 17);
    b.next();
    for (uint32_t f = 0; f < 3; ++f)
        b.pose(f, 0.3f + 0.9f * float(f));
    b.next();
    const DeformedVertices v = deformSkinnedMeshes(b.scene);
    const auto points = b.named<io::SurfacePoint>("surface_points.points");
    ASSERT_GE(points.size(), samples.samples.size());
    size_t checked = 0;
    for (size_t i = samples.staticCount; i < samples.samples.size(); i += 7, ++checked) {
        io::SkinnedSample on;
        std::memcpy(&on, &samples.samples[i], sizeof on);
        const glm::mat4x3& m = b.scene.instances[on.instance].worldFromLocal;
        std::array<glm::vec3, 3> corners;
        for (int c = 0; c < 3; ++c)
            corners[size_t(c)] = m * glm::vec4(v.positions[on.corners[c]], 1);
        ASSERT_LT(distanceFrom(points[i].position, corners), 2e-5f) << i;
        const glm::vec3 n = glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        ASSERT_GT(glm::dot(points[i].normal, n), 0.9999f) << i;
    }
    EXPECT_GT(checked, 1000u);
}

// Points that stand for light that bounces on are some of them.
TEST(Skinning, LaterBouncesFollow) {
    SkinnedBench b(3);
    b.settings.bounce.laterBounces.enabled = true;
    b.next();
    for (uint32_t f = 0; f < 3; ++f)
        b.pose(f, 0.5f + 0.8f * float(f));
    b.next();
    const DeformedVertices v = deformSkinnedMeshes(b.scene);
    struct Texel {
        glm::vec3 position;
        float area;
        glm::vec3 normal;
        float rest[5];
    };
    const auto texels = b.named<Texel>("surface_emitters.texels");
    const auto points = b.named<io::BouncePoint>("scene.bounce_points");
    size_t checked = 0;
    for (size_t i = 0; i < points.size(); ++i) {
        const RenderInstance& instance = b.scene.instances[points[i].instance];
        if (instance.skinnedMesh == kNoSkinnedMesh) continue;
        glm::uvec3 corners;
        std::memcpy(&corners, &points[i].normalLocal, sizeof corners);
        std::array<glm::vec3, 3> at;
        for (int c = 0; c < 3; ++c)
            at[size_t(c)] = instance.worldFromLocal * glm::vec4(v.positions[corners[c]], 1);
        EXPECT_LT(distanceFrom(texels[i].position, at), 2e-5f) << i;
        ++checked;
    }
    EXPECT_GT(checked, 50u);
}

// A way back that leads to where the surface was: both frames' places of each vertex the camera sees.
TEST(Skinning, MotionLeadsBackToTheFrameBefore) {
    SkinnedBench b(1, {160, 120});
    b.settings.bounce.denoiser.enabled = true;
    ImageHandle motion, depth;
    b.output = [&](GraphScope scope, const RenderFrame& f) {
        motion = f.gbuffer.surfaces.motion, depth = f.gbuffer.surfaces.depth;
        if (motion) scope.output(motion);
        scope.output(depth);
    };
    b.pose(0, 0.5f);
    b.next();
    EXPECT_FALSE(motion) << "nothing stood elsewhere before";
    b.next();
    const DeformedVertices before = deformSkinnedMeshes(b.scene);
    b.pose(0, 0.6f);
    b.next();
    ASSERT_TRUE(motion);
    const Image way = readImage(b.renderer, motion), depths = readImage(b.renderer, depth);
    const DeformedVertices now = deformSkinnedMeshes(b.scene);
    size_t checked = 0, off = 0;
    for (const RenderInstance& instance : b.scene.instances) {
        if (instance.skinnedMesh == kNoSkinnedMesh) continue;
        for (uint32_t v = 0; v < b.scene.skinnedMeshes[0].vertexCount; ++v) {
            const glm::vec3 p = instance.worldFromLocal * glm::vec4(now.positions[v], 1),
                            q = instance.worldFromLocal * glm::vec4(before.positions[v], 1);
            const glm::vec4 clip = b.scene.camera.clipFromWorld * glm::vec4(p, 1);
            const glm::vec2 uv = (glm::vec2(clip) / clip.w * 0.5f + 0.5f) * glm::vec2(b.size);
            if (glm::any(glm::lessThan(uv, glm::vec2(1))) ||
                glm::any(glm::greaterThan(uv, glm::vec2(b.size) - 2.0f)))
                continue;
            const size_t pixel = size_t(uv.y) * b.size.x + size_t(uv.x);
            if (std::abs(depths.pixels[pixel].x - clip.z / clip.w) > 1e-4f) continue;  // hidden
            ++checked;
            off += glm::length(way.pixels[pixel] - (q - p)) > 0.004f + 0.1f * glm::length(q - p);
        }
    }
    EXPECT_GT(checked, 40u);
    EXPECT_LT(off, checked / 20) << "but at the silhouette, where another vertex fills the pixel";
    b.next();
    b.next();
    EXPECT_FALSE(motion) << "at rest again";
}

}  // namespace
}  // namespace ag::gi
