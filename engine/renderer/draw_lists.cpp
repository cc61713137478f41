#include "engine/renderer/draw_lists.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "engine/core/hash.h"

namespace ag::render {
namespace {

constexpr uint64_t kWorthJobs = 1u << 13;  // instances over all views

bool isMirrored(const RenderInstance& instance) {
    return glm::determinant(glm::mat3(instance.worldFromLocal)) < 0;
}

DrawBucket bucketOf(const Material& material, const RenderInstance& instance) {
    return {.textureClass = material.textureClass,
            .alphaMask = material.alphaMode == AlphaMode::kMask,
            .doubleSided = material.doubleSided,
            .normalMap = material.normalLayer >= 0,
            .vertexColors = material.vertexColors,
            .deformed = instance.skinnedMesh != kNoSkinnedMesh,
            .mirrored = isMirrored(instance),
            .blended = material.alphaMode == AlphaMode::kBlend};
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

void ViewDraws::add(uint32_t bucket, const VkDrawIndexedIndirectCommand& shape, uint32_t row, bool movable) {
    BucketRange& range = buckets[bucket];
    if (range.commandCount == 0) range.firstCommand = uint32_t(commands.size());
    const bool layerBegins = movable && range.commandCount == range.staticCount;
    const bool same =
        range.commandCount > 0 && !layerBegins && commands.back().firstIndex == shape.firstIndex &&
        commands.back().indexCount == shape.indexCount && commands.back().vertexOffset == shape.vertexOffset;
    if (same) {
        ++commands.back().instanceCount;
    } else {
        commands.push_back(
            {shape.indexCount, 1, shape.firstIndex, shape.vertexOffset, uint32_t(rows.size())});
        ++range.commandCount;
        range.staticCount += !movable;
    }
    rows.push_back(row);
}

void DrawLists::rebuildBuckets(const RenderScene& scene) {
    const GeometryArrays& geometry = *scene.geometry;
    const size_t count = scene.instances.size();
    buckets_.clear();
    instanceBucket_.resize(count);
    instancePrimitive_.resize(count);
    instanceSkinnedMesh_.resize(count);
    instanceMovable_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const RenderInstance& instance = scene.instances[i];
        instancePrimitive_[i] = instance.primitive;
        instanceSkinnedMesh_[i] = instance.skinnedMesh;
        instanceMovable_[i] = instance.movable;
        const Material& material = geometry.materials[geometry.primitives[instance.primitive].material];
        const DrawBucket bucket = bucketOf(material, instance);
        const auto found = std::find(buckets_.begin(), buckets_.end(), bucket);
        instanceBucket_[i] = uint32_t(found - buckets_.begin());
        if (found == buckets_.end()) buckets_.push_back(bucket);
    }
    rankInstances(scene);
    bounds_.resize(count);
    transformHash_.resize(count);
    views_.clear();
    commandPool_.clear();
    rowPool_.clear();
    ++generation_;
}

void DrawLists::rankInstances(const RenderScene& scene) {
    const uint32_t count = uint32_t(scene.instances.size());
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    const auto key = [&](uint32_t i) {
        const uint32_t bucket = instanceBucket_[i];
        return std::tuple(buckets_[bucket].blended, bucket, instanceMovable_[i], instancePrimitive_[i], i);
    };
    std::ranges::sort(order_, {}, key);
    rankOf_.resize(count);
    for (uint32_t rank = 0; rank < count; ++rank)
        rankOf_[order_[rank]] = rank;
    const auto blended = [&](uint32_t bucket) { return buckets_[bucket].blended; };
    firstBlended_ = count - uint32_t(std::ranges::count_if(instanceBucket_, blended));
}

// False if an instance was turned over or changed its layer: its rank is another one now.
bool DrawLists::refreshBounds(const RenderScene& scene, bool all) {
    bool inPlace = true;
    changed_.assign((scene.instances.size() + 63) / 64, 0);
    const auto refresh = [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            const RenderInstance& instance = scene.instances[i];
            const uint32_t rank = rankOf_[i];
            bounds_.set(rank, instance, boundsLocal(scene, instance));
            transformHash_[rank] = shapeHash(scene, instance);
            changed_[rank / 64] |= uint64_t(1) << (rank % 64);
            inPlace &= bool(instanceMovable_[i]) == instance.movable;
            inPlace &= buckets_[instanceBucket_[i]].mirrored == isMirrored(instance);
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

void DrawLists::ensureView(uint32_t slot) {
    while (views_.size() <= slot)
        views_.emplace_back().draws.buckets.resize(buckets_.size());
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
    place(views_[slot]);
    return views_[slot].draws;
}

const ViewDraws& DrawLists::blendedOf(const RenderScene& scene, uint32_t slot, uint32_t seenBy) {
    ensureView(slot);
    View& view = views_[slot];
    const View& whole = views_[seenBy];
    if (isCulled(view, whole.clipFromWorld)) return view.draws;
    addInSight(scene, whole, {firstBlended_, uint32_t(order_.size())}, view);
    noteCulled(view, whole.clipFromWorld);
    place(view);
    return view.draws;
}

bool DrawLists::isCulled(const View& view, const glm::mat4& clipFromWorld) const {
    return view.generation == generation_ && view.instancesVersion == instancesVersion_ &&
           view.clipFromWorld == clipFromWorld;
}

void DrawLists::noteCulled(View& view, const glm::mat4& clipFromWorld) const {
    ViewDraws& draws = view.draws;
    const uint64_t version = combineHash(draws.staticVersion, draws.movableVersion);
    view.dirty = view.dirty || version != draws.version;
    draws.version = version;
    view.clipFromWorld = clipFromWorld;
    view.instancesVersion = instancesVersion_;
    view.generation = generation_;
}

// Those of the ranks.
void DrawLists::addInSight(const RenderScene& scene, const View& seenBy, Ranks ranks, View& view) const {
    ViewDraws& draws = view.draws;
    draws.commands.clear();
    draws.rows.clear();
    std::ranges::fill(draws.buckets, BucketRange{});
    draws.staticVersion = draws.movableVersion = combineHash(geometryVersion_, generation_);
    for (uint32_t word = ranks.begin / 64; word < seenBy.inSight.size(); ++word)
        for (uint64_t bits = seenBy.inSight[word]; bits; bits &= bits - 1) {
            const uint32_t rank = word * 64 + uint32_t(std::countr_zero(bits));
            if (rank >= ranks.end) return;
            if (rank < ranks.begin || beyondFar(bounds_.of(rank), seenBy.clipFromWorld)) continue;
            const uint32_t i = order_[rank];
            const Primitive& p = scene.geometry->primitives[instancePrimitive_[i]];
            const int32_t firstVertex = firstVertexOf(scene, scene.instances[i]);
            draws.add(instanceBucket_[i], {p.indexCount, 1, p.firstIndex, firstVertex, 0}, i,
                      instanceMovable_[i]);
            uint64_t& version = instanceMovable_[i] ? draws.movableVersion : draws.staticVersion;
            version = combineHash(combineHash(version, i), transformHash_[rank]);
        }
}

// Writes only what is the view's own: several may run at once.
void DrawLists::cullView(const RenderScene& scene, const ViewRequest& request) {
    View& view = views_[request.slot];
    if (isCulled(view, request.clipFromWorld)) return;
    bounds_.cull(viewPlanes(request.clipFromWorld), view.inSight, *jobs_);
    view.clipFromWorld = request.clipFromWorld;
    addInSight(scene, view, {0, firstBlended_}, view);
    noteCulled(view, request.clipFromWorld);
}

void DrawLists::place(View& view) {
    ViewDraws& d = view.draws;
    const auto fit = [&](RangePool& pool, RangePool::Range& range, size_t count) {
        const RangePool::Range before = range;
        pool.fit(range, uint32_t(count));
        view.dirty = view.dirty || range != before;
    };
    fit(commandPool_, d.commandRange, d.commands.size());
    fit(rowPool_, d.rowRange, d.rows.size());
}

const ViewDraws& DrawLists::pick(uint32_t slot, const ViewDraws& from,
                                 std::span<const RenderScene::Range> rows) {
    ensureView(slot);
    View& view = views_[slot];
    ViewDraws& draws = view.draws;
    draws.version = combineHash(from.version, instancesVersion_);
    draws.commands.clear();
    draws.rows.clear();
    std::ranges::fill(draws.buckets, BucketRange{});
    const auto isPicked = [&](uint32_t row) {
        const auto range = std::ranges::upper_bound(rows, row, {}, &RenderScene::Range::end);
        return range != rows.end() && range->begin <= row;
    };
    for (uint32_t b = 0; b < buckets_.size(); ++b)
        for (uint32_t c = 0; c < from.buckets[b].commandCount; ++c) {
            const VkDrawIndexedIndirectCommand& command = from.commands[from.buckets[b].firstCommand + c];
            for (uint32_t k = 0; k < command.instanceCount; ++k) {
                const uint32_t row = from.rows[command.firstInstance + k];
                if (isPicked(row)) draws.add(b, command, row, c >= from.buckets[b].staticCount);
            }
        }
    view.generation = 0;  // not a frustum's: culled anew if the slot becomes one
    view.dirty = true;
    place(view);
    return draws;
}

void DrawLists::markAllDirty() {
    for (View& view : views_)
        view.dirty = true;
}

bool DrawLists::takeDirty(uint32_t slot) {
    return std::exchange(views_[slot].dirty, false);
}

}  // namespace ag::render
