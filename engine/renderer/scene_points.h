// The points that stand for the scene's surfaces in device memory (see PointPool): what changed is staged
// with the frame, nothing is waited for.
#pragma once

#include <memory>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/renderer/point_pool.h"
#include "gi/inputs.h"

namespace ag::render {

class ScenePoints {
  public:
    explicit ScenePoints(gpu::Device& device) : device_(device) {}

    void load(const GeometryArrays& geometry) { pool_.load(geometry); }
    // Other units or materials follow: all are chosen anew.
    void forget() { version_ = 0; }
    // Of this frame. `whole`: see chooseBouncePoints; `lightUnit`: chooseEmissivePoints.
    void update(const RenderScene& scene, bool whole, float lightUnit);
    // Fills in what there is of points.
    void import(GraphScope scope, gi::Occluders& occluders);
    using Stage = FunctionRef<void(std::span<const std::byte>, const gpu::Buffer&, uint64_t offset)>;
    void upload(Stage stage);

    uint64_t staticVersion() const { return pool_.staticVersion(); }
    uint64_t deviceBytes() const;

  private:
    void fitBuffers();

    gpu::Device& device_;
    PointPool pool_;
    uint64_t version_ = 0;  // RenderScene::instancesVersion; 0: nothing was chosen
    bool whole_ = false;
    uint64_t buffers_ = 0;  // counts those made
    std::unique_ptr<gpu::Buffer> samples_, areas_, bouncePoints_;
};

}  // namespace ag::render
