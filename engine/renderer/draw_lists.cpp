#include "engine/renderer/draw_lists.h"

#include <algorithm>
#include <bit>
#include <functional>
#include <iterator>
#include <tuple>
#include <utility>

#include "engine/core/hash.h"
#include "gi/morton.h"

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

// Where an instance is on a curve through cells of space: those of a primitive are ranked along it, so that
// blocks of ranks are small and few of them are in a view. In small scenes all are in one.
uint32_t cellOf(const RenderScene& scene, const RenderInstance& instance) {
    constexpr size_t kWorthCells = 4096;  // instances
    constexpr float kCell = 16;           // m
    if (scene.instances.size() < kWorthCells) return 0;
    const glm::vec3 at = glm::clamp(instance.worldFromLocal[3] / kCell, -511.0f, 511.0f) + 512.0f;
    return gi::mortonCode(at, {glm::vec3(0), glm::vec3(1023)});
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

void DrawLists::startAnew(uint64_t geometryVersion) {
    geometryVersion_ = geometryVersion;
    buckets_.clear();
    kinds_.clear();
    cells_.clear();
    rankOf_.clear();
    order_.clear();
    firstBlended_ = 0;
    views_.clear();
    commandPool_.clear();
    rowPool_.clear();
    ++generation_;
}

uint32_t DrawLists::bucketIndex(const DrawBucket& bucket) {
    const auto found = std::find(buckets_.begin(), buckets_.end(), bucket);
    const auto index = uint32_t(found - buckets_.begin());
    if (found != buckets_.end()) return index;
    buckets_.push_back(bucket);
    for (View& view : views_)
        view.draws.buckets.resize(buckets_.size());
    return index;
}

DrawLists::Kind DrawLists::kindOf(const RenderScene& scene, const RenderInstance& instance) {
    if (!instance.isPresent()) return {};
    const GeometryArrays& g = *scene.geometry;
    const Material& material = g.materials[g.primitives[instance.primitive].material];
    return {bucketIndex(bucketOf(material, instance)), instance.primitive, instance.skinnedMesh,
            instance.movable};
}

// The others keep their order. `rows`, ascending: those of another kind than they were, or that came or went.
void DrawLists::rankAnew(std::span<const uint32_t> rows) {
    const auto key = [&](uint32_t i) {
        const Kind& k = kinds_[i];
        return std::tuple(buckets_[k.bucket].blended, k.bucket, k.movable, k.primitive, cells_[i], i);
    };
    std::vector<uint32_t> arrived;
    std::vector<bool> leaves(kinds_.size(), false);
    for (const uint32_t row : rows) {
        leaves[row] = true;
        if (kinds_[row].bucket != kNoBucket) arrived.push_back(row);
    }
    std::ranges::sort(arrived, {}, key);
    std::swap(order_, orderBefore_);
    std::vector<uint32_t> order = orderBefore_;
    std::erase_if(order, [&](uint32_t i) { return leaves[i]; });
    order_.clear();
    std::ranges::merge(order, arrived, std::back_inserter(order_), {}, key, key);
    const auto blended = [&](uint32_t i) { return buckets_[kinds_[i].bucket].blended; };
    firstBlended_ = uint32_t(std::ranges::partition_point(order_, std::not_fn(blended)) - order_.begin());
    moveToRanks(orderBefore_);
}

// What is kept by rank, from the ranks it had in `before` to those it has now.
void DrawLists::moveToRanks(const std::vector<uint32_t>& before) {
    InstanceBounds bounds;
    bounds.resize(order_.size());
    std::vector<uint64_t> hashes(order_.size(), 0);
    for (uint32_t rank = 0; rank < order_.size(); ++rank) {
        const uint32_t old = rankOf_[order_[rank]];
        if (old >= before.size() || before[old] != order_[rank]) continue;
        bounds.copy(rank, bounds_, old);
        hashes[rank] = transformHash_[old];
    }
    for (uint32_t rank = 0; rank < order_.size(); ++rank)
        rankOf_[order_[rank]] = rank;
    std::swap(bounds_, bounds);
    std::swap(transformHash_, hashes);
    changed_.assign((order_.size() + 63) / 64, ~uint64_t(0));
}

void DrawLists::refreshBounds(const RenderScene& scene, std::span<const RenderScene::Range> rows) {
    for (const RenderScene::Range& range : rows)
        for (uint32_t i = range.begin; i < range.end; ++i) {
            const RenderInstance& instance = scene.instances[i];
            if (!instance.isPresent()) continue;
            const uint32_t rank = rankOf_[i];
            bounds_.set(rank, instance, boundsLocal(scene, instance));
            transformHash_[rank] = shapeHash(scene, instance);
            changed_[rank / 64] |= uint64_t(1) << (rank % 64);
        }
    bounds_.fold(changed_, *jobs_);
}

void DrawLists::beginFrame(const RenderScene& scene, JobRunner& jobs) {
    jobs_ = &jobs;
    if (geometryVersion_ != scene.geometry->version || kinds_.size() > scene.instances.size()) {
        startAnew(scene.geometry->version);
        instancesVersion_ = 0;
    }
    if (instancesVersion_ == scene.instancesVersion) return;
    const bool all =
        scene.allInstancesChanged || scene.instancesVersion != instancesVersion_ + 1 || kinds_.empty();
    const RenderScene::Range every{0, uint32_t(scene.instances.size())};
    const std::span<const RenderScene::Range> rows =
        all ? std::span(&every, 1) : std::span(scene.changedInstances);
    kinds_.resize(scene.instances.size());
    cells_.resize(scene.instances.size());
    rankOf_.resize(scene.instances.size(), ~0u);
    std::vector<uint32_t> others;
    for (const RenderScene::Range& range : rows)
        for (uint32_t i = range.begin; i < range.end; ++i) {
            const Kind kind = kindOf(scene, scene.instances[i]);
            if (kind == kinds_[i]) continue;
            kinds_[i] = kind;
            cells_[i] = cellOf(scene, scene.instances[i]);
            others.push_back(i);
        }
    changed_.assign((order_.size() + 63) / 64, 0);
    if (!others.empty()) {
        rankAnew(others);
        ++ranking_;
    }
    refreshBounds(scene, rows);
    versionBefore_ = instancesVersion_;
    instancesVersion_ = scene.instancesVersion;
}

void DrawLists::ensureView(uint32_t slot) {
    while (views_.size() <= slot)
        views_.emplace_back().draws.buckets.resize(buckets_.size());
}

void DrawLists::cullAll(const RenderScene& scene, std::span<const ViewRequest> views) {
    if (views.size() * order_.size() < kWorthJobs) return;  // cull() does it
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
    draws.buckets.assign(buckets_.size(), {});
    draws.staticVersion = draws.movableVersion = combineHash(geometryVersion_, generation_);
    for (uint32_t word = ranks.begin / 64; word < seenBy.inSight.size(); ++word)
        for (uint64_t bits = seenBy.inSight[word]; bits; bits &= bits - 1) {
            const uint32_t rank = word * 64 + uint32_t(std::countr_zero(bits));
            if (rank >= ranks.end) return;
            if (rank < ranks.begin) continue;
            const uint32_t i = order_[rank];
            const Kind& kind = kinds_[i];
            const Primitive& p = scene.geometry->primitives[kind.primitive];
            const int32_t firstVertex = firstVertexOf(scene, scene.instances[i]);
            draws.add(kind.bucket, {p.indexCount, 1, p.firstIndex, firstVertex, 0}, i, kind.movable);
            uint64_t& version = kind.movable ? draws.movableVersion : draws.staticVersion;
            version = combineHash(combineHash(version, i), transformHash_[rank]);
        }
}

// Writes only what is the view's own: several may run at once.
void DrawLists::cullView(const RenderScene& scene, const ViewRequest& request) {
    View& view = views_[request.slot];
    if (isCulled(view, request.clipFromWorld)) return;
    const bool knowsTheRest = view.generation == generation_ && view.ranking == ranking_ &&
                              view.instancesVersion == versionBefore_ &&
                              view.clipFromWorld == request.clipFromWorld;
    if (knowsTheRest) {
        if (!bounds_.cullChanged(viewPlanes(request.clipFromWorld), changed_, view.inSight)) {
            view.instancesVersion = instancesVersion_;
            return;
        }
    } else {
        bounds_.cull(viewPlanes(request.clipFromWorld), view.inSight, *jobs_);
    }
    view.ranking = ranking_;
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
