// The scene's occluders as trees for rays, in device memory: built when what is static changes, placed anew
// when anything moves.
#pragma once

#include <memory>
#include <vector>

#include "engine/core/function_ref.h"
#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/renderer/scene_surfaces.h"
#include "engine/scene/render_scene.h"
#include "gi/inputs.h"
#include "gi/occluder_trees.h"

namespace ag::render {

class SceneTrees {
  public:
    explicit SceneTrees(gpu::Device& device) : device_(device) {}

    // Of this frame. Blocking where a scene is new. Where what is static is moved none, until it has rested
    // for some frames: then they are built anew. `staticVersion`: changes when it may have moved. `by`: of
    // all if rays are to meet what moves, too.
    gi::TracedOccluders import(GraphScope scope, const RenderScene& scene, uint64_t staticVersion,
                               gi::TracedBy by, SurfaceLight sent);
    using Stage = FunctionRef<void(std::span<const std::byte>, const gpu::Buffer&, uint64_t offset)>;
    void upload(Stage stage);
    // Another scene or other units follow.
    void forget() {
        upkeep_.forget();
        staticVersion_ = placedOf_ = 0;
    }
    uint64_t deviceBytes() const;

  private:
    void build(const RenderScene& scene);
    void place(const RenderScene& scene);
    bool follow(const RenderScene& scene, uint64_t staticVersion, gi::TreesOf of, SurfaceLight sent);

    gpu::Device& device_;
    gi::TreeUpkeep upkeep_;
    gi::TreesOf of_ = gi::TreesOf::kStatic;
    SurfaceLight sent_;
    uint64_t staticVersion_ = 0, from_ = 0;  // from_: a hash of what they are built of
    uint64_t placedOf_ = 0, before_ = 0;     // RenderScene::instancesVersion, if that matters; last frame's
    uint64_t builds_ = 0, placings_ = 0;     // versions of the buffers
    gi::OccluderTrees trees_;
    std::vector<gi::SampledInstance> moving_;
    gi::MoverTree movers_;
    std::vector<bool> movingPrimitives_;  // room for a frame's
    bool uploaded_ = true;
    std::unique_ptr<gpu::Buffer> nodes_, triangles_, masks_, places_, moverNodes_;
};

}  // namespace ag::render
