// What each view draws: instances culled against its frustum, as indirect commands grouped into buckets of
// one pipeline variant each. A view's version is a hash of what it draws and where that stands, so that
// moving something the view does not see changes nothing for it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include "engine/gpu/functions.h"

#include "engine/scene/instance_bounds.h"

namespace ag::render {

// A pipeline variant of the scene's materials.
struct DrawBucket {
    TextureClass textureClass = TextureClass::kNone;
    bool alphaMask = false;
    bool doubleSided = false;
    bool normalMap = false;
    bool deformed = false;  // of skinned meshes: their own vertices
    bool mirrored = false;  // of instances whose transform turns triangles over

    bool operator==(const DrawBucket&) const = default;
};

// Of the instances, by RenderInstance::movable.
enum class DrawLayer { kAll, kStatic, kMovable };

struct BucketRange {
    uint32_t firstCommand = 0;  // within the whole command array
    uint32_t commandCount = 0;
    uint32_t staticCount = 0;  // the first ones are of what is static
};

struct ViewDraws {
    std::vector<BucketRange> buckets;  // parallel to DrawLists::buckets()
    // Of the commands, the transforms and the geometry behind them.
    uint64_t version = 0, staticVersion = 0, movableVersion = 0;
    uint32_t instanceCount = 0, movableCount = 0;

    uint64_t versionOf(DrawLayer layer) const {
        return layer == DrawLayer::kAll      ? version
               : layer == DrawLayer::kStatic ? staticVersion
                                             : movableVersion;
    }
};

// Slots keep their place in the command array; ViewSlots says whose they are.
struct ViewRequest {
    uint32_t slot = 0;
    glm::mat4 clipFromWorld{1};
};

class DrawLists {
  public:
    // Refreshes buckets and world bounds from the scene. Call once a frame, before any cull(). `jobs` must
    // last as long as the frame.
    void beginFrame(const RenderScene& scene, JobRunner& jobs);

    // Several views at once, a job each where that is worth it; cull() then finds them done.
    void cullAll(const RenderScene& scene, std::span<const ViewRequest> views);

    Bounds boundsOf(uint32_t instance) const { return bounds_.of(instance); }  // world

    // The result stays in place and is valid until the next cull of that slot.
    const ViewDraws& cull(const RenderScene& scene, uint32_t slot, const glm::mat4& clipFromWorld);

    // Into slot `slot` of what `from` draws the instances in `rows` (ascending) alone.
    const ViewDraws& pick(uint32_t slot, const ViewDraws& from, std::span<const RenderScene::Range> rows);

    std::span<const DrawBucket> buckets() const { return buckets_; }
    // All commands, a fixed region a view; changes are marked per view for the upload.
    std::span<const VkDrawIndexedIndirectCommand> commands() const { return commands_; }
    uint32_t commandsPerView() const { return uint32_t(instanceBucket_.size()); }
    uint32_t viewCount() const { return uint32_t(views_.size()); }
    bool takeDirty(uint32_t view);  // true once after the view's commands changed
    void markAllDirty();            // what was uploaded is gone

  private:
    struct View {
        ViewDraws draws;
        glm::mat4 clipFromWorld{0};
        uint64_t instancesVersion = 0;
        uint64_t generation = 0;
        bool dirty = true;
        std::vector<uint64_t> inSight;  // a bit an instance
    };
    void rebuildBuckets(const RenderScene& scene);
    bool refreshBounds(const RenderScene& scene, bool all);
    void ensureView(uint32_t view);
    void cullView(const RenderScene& scene, const ViewRequest& request);
    uint64_t addCommands(const RenderScene& scene, const ViewRequest& request, bool movable, View& view);

    std::vector<DrawBucket> buckets_;
    std::vector<uint32_t> bucketCapacity_;  // instances in each bucket
    std::vector<uint32_t> bucketFirst_;     // first command of each bucket within a view's region
    std::vector<uint32_t> instanceBucket_;  // ~0: drawn by no opaque bucket (blended)
    std::vector<uint32_t> instancePrimitive_, instanceSkinnedMesh_;
    InstanceBounds bounds_;
    std::vector<uint64_t> changed_;  // a bit an instance whose bounds were set anew
    std::vector<uint64_t> transformHash_;
    std::vector<uint64_t> movable_;  // a bit an instance
    std::vector<VkDrawIndexedIndirectCommand> commands_;
    std::deque<View> views_;  // references from cull() stay valid
    JobRunner* jobs_ = nullptr;
    uint64_t geometryVersion_ = 0;
    uint64_t instancesVersion_ = 0;
    uint64_t generation_ = 0;  // counts bucket rebuilds
};

}  // namespace ag::render
