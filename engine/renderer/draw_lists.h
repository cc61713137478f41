// What each view draws: instances culled against its frustum, as instanced indirect draws grouped into
// buckets of one pipeline variant each. A view's version is a hash of what it draws and where that stands, so
// that moving something the view does not see changes nothing for it. Culling is the host's because it needs
// that version before the frame is planned.
#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include "engine/gpu/functions.h"

#include "engine/renderer/kept_order.h"
#include "engine/renderer/range_pool.h"
#include "engine/scene/instance_bounds.h"

namespace ag::render {

// A pipeline variant of the scene's materials.
struct DrawBucket {
    TextureClass textureClass = TextureClass::kNone;
    bool alphaMask = false;
    bool doubleSided = false;
    bool normalMap = false;
    bool vertexColors = false;
    bool deformed = false;  // of skinned meshes: their own vertices
    bool mirrored = false;  // of instances whose transform turns triangles over
    bool blended = false;

    bool operator==(const DrawBucket&) const = default;
};

// Of the instances, by RenderInstance::movable.
enum class DrawLayer { kAll, kStatic, kMovable };

struct BucketRange {
    uint32_t firstCommand = 0;  // within the view's commands
    uint32_t commandCount = 0;
    uint32_t staticCount = 0;  // the first ones are of what is static
};

struct ViewDraws {
    std::vector<BucketRange> buckets;  // parallel to DrawLists::buckets()
    // Instances of one primitive are one command; firstInstance counts from the view's first row.
    std::vector<VkDrawIndexedIndirectCommand> commands;
    std::vector<uint32_t> rows;  // the instances, in the commands' order
    // Where both are among those of all views on the device.
    RangePool::Range commandRange, rowRange;
    // Of the commands, the transforms and the geometry behind them.
    uint64_t version = 0, staticVersion = 0, movableVersion = 0;

    uint64_t versionOf(DrawLayer layer) const {
        return layer == DrawLayer::kAll      ? version
               : layer == DrawLayer::kStatic ? staticVersion
                                             : movableVersion;
    }
    // The last `count` rows, of one shape each: more of the last command or one more, in the order of buckets
    // and layers.
    void drawLast(uint32_t bucket, const VkDrawIndexedIndirectCommand& shape, uint32_t count, bool movable);
};

// Slots keep their lists from frame to frame; ViewSlots says whose they are.
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

    // Of one that is there, world.
    Bounds boundsOf(uint32_t instance) const { return bounds_.of(nearby_.placeOf(instance)); }

    // The result stays in place and is valid until the next cull of that slot.
    const ViewDraws& cull(const RenderScene& scene, uint32_t slot, const glm::mat4& clipFromWorld);
    // Into slot `slot` what blends with what is behind it, of what the view in slot `seenBy`, just culled,
    // sees. No other list has any of that.
    const ViewDraws& blendedOf(const RenderScene& scene, uint32_t slot, uint32_t seenBy);

    // Into slot `slot` of what `from` draws the instances in `rows` (ascending) alone.
    const ViewDraws& pick(uint32_t slot, const ViewDraws& from, std::span<const RenderScene::Range> rows);

    std::span<const DrawBucket> buckets() const { return buckets_; }
    bool hasBlended() const { return firstBlended_ < drawn_.size(); }
    const ViewDraws& draws(uint32_t slot) const { return views_[slot].draws; }
    uint32_t viewCount() const { return uint32_t(views_.size()); }
    // Elements of all views' ranges.
    uint32_t commandCapacity() const { return commandPool_.size(); }
    uint32_t rowCapacity() const { return rowPool_.size(); }
    bool takeDirty(uint32_t slot);  // true once after the view's commands changed
    void markAllDirty();            // what was uploaded is gone

  private:
    struct View {
        ViewDraws draws;
        glm::mat4 clipFromWorld{0};
        uint64_t instancesVersion = 0;
        uint64_t generation = 0, ranking = 0;
        bool dirty = true;
        std::vector<uint64_t> inSight;       // a bit a place of nearby_
        std::vector<uint64_t> ranksInSight;  // the same by rank
    };
    // What an instance's place among the ranks follows from.
    struct Kind {
        uint32_t bucket = kNoBucket;  // none: nothing stands in the row
        uint32_t primitive = 0, skinnedMesh = 0;
        bool movable = false;
        bool operator==(const Kind&) const = default;
    };
    static constexpr uint32_t kNoBucket = ~0u;
    void startAnew(const RenderScene& scene);
    uint32_t bucketIndex(const DrawBucket& bucket);
    Kind kindOf(const RenderScene& scene, const RenderInstance& instance);
    bool fitsGrid(const Bounds& bounds) const;
    void chooseGrid(const Bounds& bounds);
    uint32_t cellOf(const RenderScene& scene, const RenderInstance& instance) const;
    void takeOut(std::span<const uint32_t> rows);
    void rankAnew(std::span<const uint32_t> rows);
    void regroup(const RenderScene& scene);
    void placeNearby();
    void refreshBounds(const RenderScene& scene, std::span<const RenderScene::Range> rows);
    void ensureView(uint32_t slot);
    void cullView(const RenderScene& scene, const ViewRequest& request);
    struct Ranks {
        uint32_t begin = 0, end = 0;
    };
    void findRuns();
    void markRanks(View& view) const;
    void addInSight(const RenderScene& scene, const View& seenBy, Ranks ranks, View& view) const;
    bool isCulled(const View& view, const glm::mat4& clipFromWorld) const;
    void noteCulled(View& view, const glm::mat4& clipFromWorld) const;
    void place(View& view);

    std::vector<DrawBucket> buckets_;
    std::vector<Kind> kinds_;      // by instance
    std::vector<uint32_t> cells_;  // by instance: where it was when it was grouped
    glm::vec3 gridMiddle_{0};
    float cell_ = 0;              // side, in units of length; 0: there is no grid
    uint32_t changedFrames_ = 0;  // in which instances changed
    // Instances that there are, twice: as they are drawn, by buckets, layers and primitives, blended ones
    // last; and by where they are, so that blocks of them are small and few of these cross a view's border.
    KeptOrder drawn_, nearby_;
    uint32_t firstBlended_ = 0;             // rank, which is a place of drawn_
    std::vector<uint32_t> runEnd_;          // by rank: of those from it on that are of one kind
    std::vector<uint64_t> hashes_;          // by rank: of what stands there, and where that is
    InstanceBounds bounds_, boundsBefore_;  // by places of nearby_; the latter: scratch
    std::vector<uint64_t> hashesBefore_;    // scratch, as these:
    std::vector<bool> leaves_;
    std::vector<uint32_t> arrived_, astray_;
    std::vector<uint64_t> changed_;  // a bit a place whose bounds were set anew
    std::deque<View> views_;         // references from cull() stay valid
    RangePool commandPool_, rowPool_;
    JobRunner* jobs_ = nullptr;
    uint64_t geometryVersion_ = 0;
    uint64_t instancesVersion_ = 0;
    uint64_t versionBefore_ = 0;  // of the instances, before those that `changed_` tells of
    uint64_t ranking_ = 0;        // counts changes of ranks
    uint64_t generation_ = 0;     // counts scenes
};

}  // namespace ag::render
