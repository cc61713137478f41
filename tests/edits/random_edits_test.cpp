// Skipping shows in no bit of any image, whatever is done to a world: a renderer that skips and one that runs
// every pass see the same random edits. AFTERGLOW_EDITS: how many (the long run has 2,000); AFTERGLOW_SEED:
// which.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <deque>

#include "engine/gpu/transfer.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/static_scene.h"
#include "tests/edits/edited_world.h"
#include "tests/support/device_environment.h"
#include "tools/scenegen/scenes.h"

namespace ag::test {
namespace {

constexpr uint32_t kEdits = 400, kSeed = 1, kRemembered = 12;

uint32_t numberFrom(const char* variable, uint32_t usual) {
    const char* text = std::getenv(variable);
    return text ? uint32_t(std::strtoul(text, nullptr, 10)) : usual;
}

struct Pictures {
    std::vector<glm::vec3> display, radiance;
    bool operator==(const Pictures&) const = default;
};

struct Renderer {
    render::Renderer gi{device()};
    FrameGraphOptions options{.timing = TimingMode::kOff};
    render::RenderFrame last;
    uint64_t ran = 0;

    explicit Renderer(EditedWorld& world, bool skip) {
        options.skip = skip;
        gi.load(world.asset().geometry);
    }
    void frame(EditedWorld& world) {
        gi.render(world.scene(), world.size(), world.settings(), options,
                  [&](GraphScope scope, const render::SceneView&, const render::RenderFrame& declared) {
                      last = declared;
                      scope.output(declared.outputs.display);
                      scope.output(declared.outputs.radiance);
                  });
        for (const PassReport& pass : gi.graph().report())
            ran += pass.outcome == PassOutcome::kRan;
    }
    Pictures pictures() {
        return {readImage(gi, last.outputs.display).pixels, readImage(gi, last.outputs.radiance).pixels};
    }
    std::vector<std::byte> bytesOf(std::string_view buffer) {
        const gpu::Buffer& source = gi.graph().physical(gi.graph().findBuffer(buffer));
        std::vector<std::byte> bytes(source.sizeBytes());
        gi.waitIdle();
        gpu::downloadBuffer(gi.device(), source, bytes);
        return bytes;
    }
};

// Where to look for the fault: buffers that differ, first ones first, and what the skipping graph did.
std::string explain(Renderer& skipping, Renderer& whole) {
    std::string out = "buffers that differ:";
    for (const std::string_view name : skipping.gi.graph().resourceNames()) {
        const bool both = skipping.gi.graph().findBuffer(name) && whole.gi.graph().findBuffer(name);
        const bool imported = name.starts_with("scene.") && name != "scene.camera";
        if (both && !imported && skipping.bytesOf(name) != whole.bytesOf(name)) (out += ' ') += name;
    }
    out += "\nskipped:";
    for (const PassReport& pass : skipping.gi.graph().report())
        if (pass.outcome == PassOutcome::kSkipped) (out += ' ') += pass.name;
    out += "\nran:";
    for (const PassReport& pass : skipping.gi.graph().report())
        if (pass.outcome == PassOutcome::kRan) (out += ' ') += pass.name;
    return out;
}

bool probesAgree(EditedWorld& world, Renderer& a, Renderer& b) {
    for (const RenderProbe& probe : world.scene().probes)
        if (a.gi.probeReadings().of(probe.id) != b.gi.probeReadings().of(probe.id)) return false;
    return true;
}

TEST(RandomEdits, SkippingShowsInNoBit) {
    const uint32_t edits = numberFrom("AFTERGLOW_EDITS", kEdits), seed = numberFrom("AFTERGLOW_SEED", kSeed);
    EditedWorld world(seed);
    Renderer skipping(world, true), whole(world, false);
    std::deque<std::string> before;
    for (uint32_t i = 0; i < edits; ++i) {
        before.push_back(world.step());
        if (before.size() > kRemembered) before.pop_front();
        if (edits > kEdits && i % 100 == 0) std::printf("edit %u of %u\n", i, edits), std::fflush(stdout);
        skipping.frame(world);
        whole.frame(world);
        if (skipping.pictures() == whole.pictures() && probesAgree(world, skipping, whole)) continue;
        std::string story;
        for (const std::string& edit : before)
            (story += edit) += "; ";
        FAIL() << "edit " << i << " of seed " << seed << ": " << story << "\n" << explain(skipping, whole);
    }
    EXPECT_LT(skipping.ran, whole.ran * 3 / 4) << "there must have been something to skip";
    std::printf("%u edits, seed %u: %llu passes ran, %llu without skipping\n", edits, seed,
                static_cast<unsigned long long>(skipping.ran), static_cast<unsigned long long>(whole.ran));
}

// Enough things that views are culled as jobs.
TEST(Serial, RendersTheSameImages) {
    const SceneAsset asset = *scenegen::buildScene("crowd", 3000);
    RenderScene scene = staticScene(asset);
    const glm::uvec2 size(64, 36);
    setCamera(scene, cameraOf(asset, 0), size);
    render::Renderer serial(device(), 1), parallel(device(), 0);
    for (int i = 0; i < 3; ++i) {
        scene.instances[size_t(i) * 100].worldFromLocal[3].y += 0.5f;
        ++scene.instancesVersion;
        std::vector<std::vector<glm::vec3>> images;
        for (render::Renderer* renderer : {&serial, &parallel}) {
            if (i == 0) renderer->load(asset.geometry);
            images.push_back(renderLayer(*renderer, scene, size, {}, render::Layer::kRadiance, 1).pixels);
        }
        EXPECT_EQ(images[0], images[1]) << "frame " << i;
    }
}

}  // namespace
}  // namespace ag::test
