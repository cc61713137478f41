#include "engine/renderer/draw_lists.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "engine/core/hash.h"

namespace ag::render {
namespace {

constexpr uint32_t kNoBucket = ~0u;
constexpr uint64_t kWorthJobs = 1u << 13;  // instances over all views

bool isMirrored(const RenderInstance& instance) {
    return glm::determinant(glm::mat3(instance.worldFromLocal)) < 0;
}

DrawBucket bucketOf(const Material& material, const RenderInstance& instance) {
    return {.textureClass = material.textureClass,
            .alphaMask = material.alphaMode == AlphaMode::kMask,
            .doubleSided = material.doubleSided,
            .normalMap = material.normalLayer >= 0,
            .deformed = instance.skinnedMesh != kNoSkinnedMesh,
            .mirrored = isMirrored(instance)};
}

// Of what an instance draws and where that stands.
uint64_t shapeHash(const RenderScene& scene, const RenderInstance& instance) {
    const uint64_t hash = hashValue(instance.worldFromLocal, instance.primitive);
    if (instance.skinnedMesh == kNoSkinnedMesh) return hash;
    const RenderSkinnedMesh& skinnedMesh = scene.skinnedMeshes[instance.skinnedMesh];
    return combineHash(combineHash(hash, skinnedMesh.poseVersion), skinnedMesh.firstDeformed);
}

// Of a reversed-depth clip matrix; with an infinite far plane nothing is beyond it.
bool beyondFar(const Bounds& b, const glm::mat4& m) {
    const glm::vec4 p(m[0][2], m[1][2], m[2][2], m[3][2]);
    const glm::vec3 near(p.x > 0 ? b.max.x : b.min.x, p.y > 0 ? b.max.y : b.min.y,
                         p.z > 0 ? b.max.z : b.min.z);
    return glm::dot(glm::vec3(p), near) + p.w < 0;
}

}  // namespace

void DrawLists::rebuildBuckets(const RenderScene& scene) {
    const GeometryArrays& geometry = *scene.geometry;
    buckets_.clear();
    bucketCapacity_.clear();
    instanceBucket_.assign(scene.instances.size(), kNoBucket);
    instancePrimitive_.resize(scene.instances.size());
    instanceSkinnedMesh_.resize(scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        instancePrimitive_[i] = scene.instances[i].primitive;
        instanceSkinnedMesh_[i] = scene.instances[i].skinnedMesh;
        const Material& material =
            geometry.materials[geometry.primitives[scene.instances[i].primitive].material];
        if (material.alphaMode == AlphaMode::kBlend) continue;
        const DrawBucket bucket = bucketOf(material, scene.instances[i]);
        const auto found = std::find(buckets_.begin(), buckets_.end(), bucket);
        instanceBucket_[i] = uint32_t(found - buckets_.begin());
        if (found == buckets_.end()) {
            buckets_.push_back(bucket);
            bucketCapacity_.push_back(0);
        }
        ++bucketCapacity_[instanceBucket_[i]];
    }
    bucketFirst_.assign(buckets_.size(), 0);
    for (size_t b = 1; b < buckets_.size(); ++b)
        bucketFirst_[b] = bucketFirst_[b - 1] + bucketCapacity_[b - 1];
    bounds_.resize(scene.instances.size());
    transformHash_.resize(scene.instances.size());
    movable_.assign((scene.instances.size() + 63) / 64, 0);
    views_.clear();
    commands_.clear();
    ++generation_;
}

// False if an instance was turned over and belongs to another bucket now.
bool DrawLists::refreshBounds(const RenderScene& scene, bool all) {
    bool inPlace = true;
    changed_.assign((scene.instances.size() + 63) / 64, 0);
    const auto refresh = [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            const RenderInstance& instance = scene.instances[i];
            bounds_.set(i, instance, boundsLocal(scene, instance));
            transformHash_[i] = shapeHash(scene, instance);
            const uint64_t bit = uint64_t(1) << (i % 64);
            changed_[i / 64] |= bit;
            movable_[i / 64] = instance.movable ? movable_[i / 64] | bit : movable_[i / 64] & ~bit;
            const uint32_t bucket = instanceBucket_[i];
            inPlace &= bucket == kNoBucket || buckets_[bucket].mirrored == isMirrored(instance);
        }
    };
    if (all || scene.allInstancesChanged)
        refresh(0, uint32_t(scene.instances.size()));
    else
        for (const RenderScene::Range& range : scene.changedInstances)
            refresh(range.begin, range.end);
    bounds_.fold(changed_, *jobs_);
    return inPlace;
}

void DrawLists::beginFrame(const RenderScene& scene, JobRunner& jobs) {
    jobs_ = &jobs;
    bool regroup =
        geometryVersion_ != scene.geometry->version || instanceBucket_.size() != scene.instances.size();
    if (instancesVersion_ != scene.instancesVersion && !regroup)
        for (size_t i = 0; i < scene.instances.size() && !regroup; ++i)
            regroup = instancePrimitive_[i] != scene.instances[i].primitive ||
                      instanceSkinnedMesh_[i] != scene.instances[i].skinnedMesh;
    if (regroup) rebuildBuckets(scene);
    const bool all = regroup || scene.instancesVersion != instancesVersion_ + 1;
    if ((regroup || instancesVersion_ != scene.instancesVersion) && !refreshBounds(scene, all)) {
        rebuildBuckets(scene);
        refreshBounds(scene, true);
    }
    geometryVersion_ = scene.geometry->version;
    instancesVersion_ = scene.instancesVersion;
}

void DrawLists::ensureView(uint32_t view) {
    if (view < views_.size()) return;
    views_.resize(view + 1);
    commands_.resize(views_.size() * commandsPerView());
    for (View& v : views_)
        v.draws.buckets.resize(buckets_.size());
}

void DrawLists::cullAll(const RenderScene& scene, std::span<const ViewRequest> views) {
    if (views.size() * instanceBucket_.size() < kWorthJobs) return;  // cull() does it
    for (const ViewRequest& view : views)
        ensureView(view.slot);
    jobs_->parallelFor(uint32_t(views.size()), 1, [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i)
            cullView(scene, views[i]);
    });
}

const ViewDraws& DrawLists::cull(const RenderScene& scene, uint32_t slot, const glm::mat4& clipFromWorld) {
    ensureView(slot);
    cullView(scene, {slot, clipFromWorld});
    return views_[slot].draws;
}

// What the view sees of a layer, after what is there; returns its version.
uint64_t DrawLists::addCommands(const RenderScene& scene, const ViewRequest& request, bool movable,
                                View& view) {
    uint64_t version = combineHash(geometryVersion_, generation_);
    for (uint32_t word = 0; word < view.inSight.size(); ++word)
        for (uint64_t bits = view.inSight[word] & (movable ? movable_[word] : ~movable_[word]); bits;
             bits &= bits - 1) {
            const uint32_t i = word * 64 + uint32_t(std::countr_zero(bits));
            if (instanceBucket_[i] == kNoBucket || beyondFar(bounds_.of(i), request.clipFromWorld)) continue;
            const Primitive& p = scene.geometry->primitives[instancePrimitive_[i]];
            BucketRange& range = view.draws.buckets[instanceBucket_[i]];
            commands_[range.firstCommand + range.commandCount++] = {
                p.indexCount, 1, p.firstIndex, firstVertexOf(scene, scene.instances[i]), i};
            range.staticCount += !movable;
            view.draws.movableCount += movable;
            version = combineHash(combineHash(version, i), transformHash_[i]);
            ++view.draws.instanceCount;
        }
    return version;
}

// Writes only what is the view's own: several may run at once.
void DrawLists::cullView(const RenderScene& scene, const ViewRequest& request) {
    View& view = views_[request.slot];
    if (view.generation == generation_ && view.instancesVersion == instancesVersion_ &&
        view.clipFromWorld == request.clipFromWorld)
        return;

    const uint32_t first = request.slot * commandsPerView();
    for (size_t b = 0; b < buckets_.size(); ++b)
        view.draws.buckets[b] = {.firstCommand = first + bucketFirst_[b]};
    view.draws.instanceCount = view.draws.movableCount = 0;
    bounds_.cull(viewPlanes(request.clipFromWorld), view.inSight, *jobs_);
    view.draws.staticVersion = addCommands(scene, request, false, view);
    view.draws.movableVersion = addCommands(scene, request, true, view);
    const uint64_t version = combineHash(view.draws.staticVersion, view.draws.movableVersion);
    view.dirty = view.dirty || version != view.draws.version;
    view.draws.version = version;
    view.clipFromWorld = request.clipFromWorld;
    view.instancesVersion = instancesVersion_;
    view.generation = generation_;
}

const ViewDraws& DrawLists::pick(uint32_t slot, const ViewDraws& from,
                                 std::span<const RenderScene::Range> rows) {
    ensureView(slot);
    View& view = views_[slot];
    view.draws.version = combineHash(from.version, instancesVersion_);
    view.draws.instanceCount = 0;
    for (size_t b = 0; b < buckets_.size(); ++b) {
        BucketRange& range = view.draws.buckets[b];
        range = {.firstCommand = slot * commandsPerView() + bucketFirst_[b]};
        auto row = rows.begin();  // commands of a bucket ascend too, those of each layer
        for (uint32_t c = 0; c < from.buckets[b].commandCount; ++c) {
            if (c == from.buckets[b].staticCount) row = rows.begin();
            const VkDrawIndexedIndirectCommand& command = commands_[from.buckets[b].firstCommand + c];
            while (row != rows.end() && row->end <= command.firstInstance)
                ++row;
            if (row == rows.end()) continue;
            if (command.firstInstance >= row->begin)
                commands_[range.firstCommand + range.commandCount++] = command;
        }
        view.draws.instanceCount += range.commandCount;
    }
    view.generation = 0;  // not a frustum's: culled anew if the slot becomes one
    view.dirty = true;
    return view.draws;
}

void DrawLists::markAllDirty() {
    for (View& view : views_)
        view.dirty = true;
}

bool DrawLists::takeDirty(uint32_t view) {
    return std::exchange(views_[view].dirty, false);
}

}  // namespace ag::render
