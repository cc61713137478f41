// The cases by kind. Private to tools/stress.
#pragma once

#include "tools/scenegen/scenes.h"
#include "tools/stress/stage.h"
#include "tools/stress/stress.h"

namespace ag::stress {

constexpr glm::uvec2 kSize(160, 90);

inline SceneAsset cornell() {
    return *scenegen::buildScene("cornell", 0);
}

// What a case is run with.
struct Bench {
    gpu::Device& device;
    const StressOptions& options;
    FunctionRef<void(const StressRow&)> report;

    bool wants(const std::string& name) const { return name.find(options.only) != std::string::npos; }
};

// Scene and light in other units, at other places: the image must not change.
void runInvariances(const Bench& bench);
// Light, geometry and clusters at their limits.
void runDegenerates(const Bench& bench);
// Files with geometry that is none.
void runBadGeometry(const Bench& bench);
// What changes every frame.
void runChanges(const Bench& bench);
void runRandomMotion(const Bench& bench);

// A still image of `stage`, rendered again by `again` to see that the bits are the same.
struct Still {
    Image image;
    std::optional<std::string> fault;
};
using Prepare = FunctionRef<void(Stage&)>;
Still renderStill(const Bench& bench, const SceneAsset& asset, Prepare prepare);
Still renderStill(const Bench& bench, const SceneAsset& asset);

// RMSE over the mean of `truth`; NaN where they cannot be compared.
double relativeRmse(const Image& truth, const Image& test);
double meanRadiance(const Image& image);

}  // namespace ag::stress
