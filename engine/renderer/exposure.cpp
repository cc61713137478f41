#include "engine/renderer/exposure.h"

#include <cmath>

#include "shaders/exposure/exposure_io.h"

namespace ag::render {
namespace {

constexpr float kMeteredPixels = 16384;  // about

uint32_t strideFor(glm::uvec2 size) {
    return std::max(1u, uint32_t(std::sqrt(float(size.x) * float(size.y) / kMeteredPixels)));
}

}  // namespace

BufferHandle addExposure(GraphScope scope, ImageHandle radiance, const gi::RenderUnits& units,
                         float compensation, uint64_t inputsVersion, const ExposureSettings& s,
                         gi::Settling& settling) {
    if (!s.automatic) return {};
    const uint32_t step = settling.advance(inputsVersion, s.settleFrames);
    const HistoryBuffer exposure =
        scope.historyBuffer("exposure.metered", {.sizeBytes = sizeof(io::Exposure)});
    scope.compute("exposure.meter", "exposure/meter.comp")
        .sample("radianceMap", radiance)
        .readPrevious("before", exposure)
        .write("after", exposure.current)
        .push(io::MeterPush{.unitStops = std::log2(units.light),
                            .compensation = compensation,
                            .least = s.least,
                            .most = std::max(s.least, s.most),
                            .share = s.share,
                            .valid = exposure.valid,
                            .stride = strideFor(scope.info(radiance).size)})
        .step(step)
        .dispatchGroups(1);
    return exposure.current;
}

}  // namespace ag::render
