#include "tools/stress/stress.h"

#include "engine/core/image_difference.h"
#include "tools/stress/cases.h"

namespace ag::stress {

Still renderStill(const Bench& bench, const SceneAsset& asset, Prepare prepare) {
    const auto render = [&] {
        Stage stage(bench.device, asset, kSize, bench.options.mapResolution);
        prepare(stage);
        stage.frames(bench.options.frames);
        return Still{stage.radiance(), stage.fault()};
    };
    Still still = render();
    if (bench.options.twice && !still.fault && render().image.pixels != still.image.pixels)
        still.fault = "the same input gives other bits the second time";
    return still;
}

Still renderStill(const Bench& bench, const SceneAsset& asset) {
    return renderStill(bench, asset, [](Stage&) {});
}

double relativeRmse(const Image& truth, const Image& test) {
    const auto difference = compareImages(truth, test);
    return difference ? difference->relativeRmse : NAN;
}

double meanRadiance(const Image& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels)
        sum += double(p.x) + double(p.y) + double(p.z);
    return sum / (3 * double(image.pixels.size()));
}

void runStress(gpu::Device& device, const StressOptions& options,
               FunctionRef<void(const StressRow&)> report) {
    const Bench bench{device, options, report};
    runInvariances(bench);
    runDegenerates(bench);
    runBadGeometry(bench);
    runChanges(bench);
    runRandomMotion(bench);
}

}  // namespace ag::stress
