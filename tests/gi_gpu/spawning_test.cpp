// Things that come and go in every frame: no transfer is waited for, and what is there then is lit as if it
// had been loaded.
#include <gtest/gtest.h>

#include "tests/gi_gpu/bench.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

double relativeRmse(const Image& a, const Image& truth) {
    double squares = 0, mean = 0;
    for (size_t i = 0; i < truth.pixels.size(); ++i) {
        const glm::vec3 d = a.pixels[i] - truth.pixels[i];
        squares += double(glm::dot(d, d)) / 3;
        mean += double(truth.pixels[i].x + truth.pixels[i].y + truth.pixels[i].z) / 3;
    }
    const double n = double(truth.pixels.size());
    return std::sqrt(squares / n) / (mean / n);
}

// The crowd's boxes in the rows from `first` on stand a little aside, or nothing does.
void replaceBoxes(RenderScene& scene, const RenderScene& loaded, uint32_t first, uint32_t turn) {
    for (uint32_t row = first; row < scene.instances.size(); ++row)
        if (loaded.instances[row].skinnedMesh == kNoSkinnedMesh && (row + turn) % 3 != 0)
            scene.instances[row] = {.primitive = kNoPrimitive};
        else
            scene.instances[row] = loaded.instances[row];
    scene.changedInstances = {{first, uint32_t(scene.instances.size())}};
    scene.replacedInstances = scene.changedInstances;
    scene.allInstancesChanged = false;
    ++scene.instancesVersion;
}

TEST(Spawning, NoTransferIsWaitedForAndTheLightIsThatOfTheScene) {
    Bench b(*scenegen::buildScene("crowd", 200), {64, 36});
    const RenderScene loaded = b.scene;
    const uint32_t first = uint32_t(loaded.instances.size()) - 150;
    b.frame();
    const uint64_t waited = b.renderer.device().transfersWaitedFor();
    for (uint32_t turn = 0; turn < 9; ++turn) {
        replaceBoxes(b.scene, loaded, first, turn);
        b.frame();
    }
    EXPECT_EQ(b.renderer.device().transfersWaitedFor(), waited);
    for (int i = 0; i < 24; ++i)
        b.frame();
    Bench anew(*scenegen::buildScene("crowd", 200), {64, 36});
    anew.scene.instances = b.scene.instances;
    for (int i = 0; i < 34; ++i)
        anew.frame();
    Bench otherwise(*scenegen::buildScene("crowd", 200),
                    {64, 36});  // by another clustering: what that alone changes
    otherwise.scene.instances = b.scene.instances;
    otherwise.settings.bounce.valClustering.seed = 77;
    for (int i = 0; i < 34; ++i)
        otherwise.frame();
    const auto light = [](Bench& of) { return readImage(of.renderer, of.last.bounce.bounce1.image); };
    const Image truth = light(anew);
    const double error = relativeRmse(light(b), truth), noise = relativeRmse(light(otherwise), truth);
    std::printf(
        "light where things came and went beside that of the scene loaded anew: %.3f, of another clustering "
        "%.3f\n",
        error, noise);
    EXPECT_LT(error, 1.3 * noise);
}

}  // namespace
}  // namespace ag::gi
