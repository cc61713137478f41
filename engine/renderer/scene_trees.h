// The scene's occluders as trees for rays, in device memory: built when what is static changes, placed anew
// when anything moves.
#pragma once

#include <memory>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/scene/render_scene.h"
#include "gi/inputs.h"
#include "gi/occluder_trees.h"

namespace ag::render {

class SceneTrees {
  public:
    explicit SceneTrees(gpu::Device& device) : device_(device) {}

    // Of this frame. Blocking where static surfaces changed. Fails (failure.h) on a device that cannot trace
    // rays.
    gi::TracedOccluders import(GraphScope scope, const RenderScene& scene);
    using Stage = FunctionRef<void(std::span<const std::byte>, const gpu::Buffer&, uint64_t offset)>;
    void upload(Stage stage);
    // Another scene or other units follow.
    void forget() { builtOf_ = placedOf_ = 0; }
    uint64_t deviceBytes() const;

  private:
    void build(const RenderScene& scene);
    void place(const RenderScene& scene);

    gpu::Device& device_;
    uint64_t builtOf_ = 0;                // a hash of static surfaces and movable meshes; 0: of nothing
    uint64_t placedOf_ = 0;               // RenderScene::instancesVersion
    uint64_t builds_ = 0, placings_ = 0;  // versions of the buffers
    gi::OccluderTrees trees_;
    gi::MoverTree movers_;
    bool uploaded_ = true;
    std::unique_ptr<gpu::Buffer> nodes_, triangles_, places_, moverNodes_;
};

}  // namespace ag::render
