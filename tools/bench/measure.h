// Measures techniques on one scene: error against the reference, time by timestamps, flicker.
#pragma once

#include <optional>

#include "engine/renderer/renderer.h"
#include "tools/bench/moving_light.h"
#include "tools/bench/report.h"
#include "tools/bench/techniques.h"

namespace ag::bench {

struct MeasureOptions {
    glm::uvec2 size{640, 360};
    glm::uvec2 flickerSize{160, 90};
    uint32_t frames = 30;              // timed, unless they take longer than `secondsPerTiming`
    double secondsPerTiming = 3;       // then at least five
    uint32_t referenceSamples = 4096;  // at most, a pixel, of both seeds
    double referenceError = 0.01;      // relative RMSE at which the references' mean is good enough
    bool flicker = true;
    uint32_t clusterings = 3;  // errors are means over so many: one moves by a tenth
};

class SceneBench {
  public:
    // All must outlive this. `progress`: share of the reference at hand.
    SceneBench(gpu::Device& device, const RenderScene& scene, std::string name, ReferenceSource references,
               const MeasureOptions& options, FunctionRef<void(double)> progress);

    Result<Row> measure(const Technique& technique, const Variant& variant);
    // Path tracing's error over time, see path_tracing.h.
    Result<std::vector<Row>> measurePathTracing(std::string_view term);
    // What that depends on; also on the machine, which is not in it.
    uint64_t hashPathTracing(std::string_view term) const;

  private:
    Result<const TwoReferences*> reference(std::string_view term);
    Result<const ReferenceTrend*> trend(std::string_view term);
    reference::ReferenceSettings referenceSettings(std::string_view term) const;
    // Pictures of each clustering, one where nothing is clustered.
    Result<std::vector<Image>> measureGpu(const Technique& technique, const Variant& variant, Row& row);
    Image measureEmitters(Row& row);
    Status compare(const std::vector<Image>& images, const TwoReferences& truth, Row& row);
    void timeFrames(const render::RenderSettings& settings, render::Layer layer, Row& row);
    Status measureFlicker(const render::RenderSettings& settings, render::Layer layer, Row& row);
    void settleBudget(double budgetMs, render::RenderSettings& settings, render::Layer layer, Row& row);
    void measureWalking(const render::RenderSettings& settings, render::Layer layer, Row& row);

    render::Renderer renderer_;
    const RenderScene& scene_;
    RenderScene flickerScene_;  // seen at the flicker's size
    std::string name_;
    ReferenceCache& cache_;
    JobRunner& runner_;
    MeasureOptions options_;
    FunctionRef<void(double)> progress_;
    reference::RayScene rays_;
    std::map<std::string, TwoReferences, std::less<>> references_;
    std::map<std::string, ReferenceTrend, std::less<>> trends_;
};

}  // namespace ag::bench
