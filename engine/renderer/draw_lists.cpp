#include "engine/renderer/draw_lists.h"

#include <algorithm>
#include <bit>
#include <cmath>
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

// Of a word of 64 bits those of a range.
uint64_t bitsBetween(uint32_t begin, uint32_t end, uint32_t word) {
    const uint32_t first = word * 64;
    const uint64_t fromBegin = begin <= first ? ~uint64_t(0) : ~uint64_t(0) << (begin - first);
    return end >= first + 64 ? fromBegin : fromBegin & ((uint64_t(1) << (end - first)) - 1);
}

// Of hashes in their order (Fletcher's two sums): cheap where there are many.
class OrderedHash {
  public:
    void add(uint64_t hash) { sum_ += hash, sumOfSums_ += sum_; }
    uint64_t value() const { return combineHash(sum_, sumOfSums_); }

  private:
    uint64_t sum_ = 0, sumOfSums_ = 0;
};

}  // namespace

void ViewDraws::drawLast(uint32_t bucket, const VkDrawIndexedIndirectCommand& shape, uint32_t count,
                         bool movable) {
    BucketRange& range = buckets[bucket];
    if (range.commandCount == 0) range.firstCommand = uint32_t(commands.size());
    const bool layerBegins = movable && range.commandCount == range.staticCount;
    const bool same =
        range.commandCount > 0 && !layerBegins && commands.back().firstIndex == shape.firstIndex &&
        commands.back().indexCount == shape.indexCount && commands.back().vertexOffset == shape.vertexOffset;
    if (same) {
        commands.back().instanceCount += count;
    } else {
        commands.push_back(
            {shape.indexCount, count, shape.firstIndex, shape.vertexOffset, uint32_t(rows.size()) - count});
        ++range.commandCount;
        range.staticCount += !movable;
    }
}

void DrawLists::startAnew(const RenderScene& scene) {
    geometryVersion_ = scene.geometry->version;
    chooseGrid(scene.bounds);
    buckets_.clear();
    kinds_.clear();
    cells_.clear();
    drawn_.clear();
    nearby_.clear();
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

// Cells are about 1/256 of what there is; beyond 1,024 of them along an axis all are one.
bool DrawLists::fitsGrid(const Bounds& bounds) const {
    if (bounds.empty()) return true;
    const glm::vec3 reach = glm::max(bounds.max - gridMiddle_, gridMiddle_ - bounds.min);
    const float farthest = std::max({reach.x, reach.y, reach.z});
    return farthest <= 512 * cell_ && farthest >= 16 * cell_;
}

void DrawLists::chooseGrid(const Bounds& bounds) {
    const glm::vec3 size = bounds.empty() ? glm::vec3(0) : bounds.max - bounds.min;
    const float longest = std::max({size.x, size.y, size.z});
    const bool some = longest > 0 && longest < 1e30f;
    gridMiddle_ = some ? 0.5f * (bounds.min + bounds.max) : glm::vec3(0);
    cell_ = some ? longest / 256 : 0;
}

// Along a curve through the cells.
uint32_t DrawLists::cellOf(const RenderScene& scene, const RenderInstance& instance) const {
    const Bounds local = boundsLocal(scene, instance);
    const glm::vec3 middle = instance.worldFromLocal * glm::vec4(0.5f * (local.min + local.max), 1);
    if (cell_ == 0 || !std::isfinite(glm::dot(middle, middle))) return 0;
    return gi::mortonCode(glm::clamp((middle - gridMiddle_) / cell_, -511.0f, 511.0f) + 512.0f,
                          {glm::vec3(0), glm::vec3(1023)});
}

// Of orders: all of them leave, and those that are there arrive.
void DrawLists::takeOut(std::span<const uint32_t> rows) {
    leaves_.assign(kinds_.size(), false);
    arrived_.clear();
    for (const uint32_t row : rows) {
        leaves_[row] = true;
        if (kinds_[row].bucket != kNoBucket) arrived_.push_back(row);
    }
}

// `rows`, ascending: those of another kind than they were, or that came or went.
void DrawLists::rankAnew(std::span<const uint32_t> rows) {
    takeOut(rows);
    const auto blended = [&](uint32_t i) { return buckets_[kinds_[i].bucket].blended; };
    drawn_.change(leaves_, arrived_, [&](uint32_t i) {
        const Kind& k = kinds_[i];
        return std::tuple(blended(i), k.bucket, k.movable, k.primitive, i);
    });
    firstBlended_ = drawn_.size();
    while (firstBlended_ > 0 && blended(drawn_[firstBlended_ - 1]))
        --firstBlended_;
    hashesBefore_.assign(drawn_.size(), 0);
    std::swap(hashes_, hashesBefore_);
    for (uint32_t rank = 0; rank < drawn_.size(); ++rank)
        if (drawn_.before()[rank] != KeptOrder::kNowhere)
            hashes_[rank] = hashesBefore_[drawn_.before()[rank]];
    findRuns();
    placeNearby();
    // So that what moves allocates nothing later on.
    boundsBefore_.resize(nearby_.size());
    arrived_.reserve(kinds_.size());
    astray_.reserve(kinds_.size());
}

// Takes what was taken out to where it is now. What moves is by itself, so that blocks of what is static do
// not change.
void DrawLists::placeNearby() {
    nearby_.change(leaves_, arrived_,
                   [&](uint32_t i) { return std::tuple(kinds_[i].movable, cells_[i], i); });
    std::swap(bounds_, boundsBefore_);
    bounds_.resize(nearby_.size());
    for (uint32_t place = 0; place < nearby_.size(); ++place)
        if (nearby_.before()[place] != KeptOrder::kNowhere)
            bounds_.copy(place, boundsBefore_, nearby_.before()[place]);
        else
            bounds_.clear(place);
    changed_.assign((nearby_.size() + 63) / 64, ~uint64_t(0));
    ++ranking_;
}

// What has left its cell goes to where it is now. No list changes by that.
void DrawLists::regroup(const RenderScene& scene) {
    std::vector<uint32_t>& astray = astray_;
    astray.clear();
    for (uint32_t row = 0; row < kinds_.size(); ++row) {
        if (kinds_[row].bucket == kNoBucket) continue;
        const uint32_t cell = cellOf(scene, scene.instances[row]);
        if (cell == cells_[row]) continue;
        cells_[row] = cell;
        astray.push_back(row);
    }
    if (astray.empty()) return;
    takeOut(astray);
    placeNearby();
    for (const uint32_t row : astray)
        bounds_.set(nearby_.placeOf(row), scene.instances[row], boundsLocal(scene, scene.instances[row]));
}

void DrawLists::findRuns() {
    runEnd_.resize(drawn_.size());
    for (uint32_t rank = drawn_.size(); rank-- > 0;) {
        const bool goesOn = rank + 1 < drawn_.size() && kinds_[drawn_[rank]] == kinds_[drawn_[rank + 1]];
        runEnd_[rank] = goesOn ? runEnd_[rank + 1] : rank + 1;
    }
}

void DrawLists::refreshBounds(const RenderScene& scene, std::span<const RenderScene::Range> rows) {
    for (const RenderScene::Range& range : rows)
        for (uint32_t i = range.begin; i < range.end; ++i) {
            const RenderInstance& instance = scene.instances[i];
            if (!instance.isPresent()) continue;
            const uint32_t place = nearby_.placeOf(i);
            bounds_.set(place, instance, boundsLocal(scene, instance));
            changed_[place / 64] |= uint64_t(1) << (place % 64);
            hashes_[drawn_.placeOf(i)] = combineHash(shapeHash(scene, instance), i);
        }
    bounds_.fold(changed_, *jobs_);
}

void DrawLists::beginFrame(const RenderScene& scene, JobRunner& jobs) {
    jobs_ = &jobs;
    if (geometryVersion_ != scene.geometry->version || kinds_.size() > scene.instances.size()) {
        startAnew(scene);
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
    std::vector<uint32_t> others;
    for (const RenderScene::Range& range : rows)
        for (uint32_t i = range.begin; i < range.end; ++i) {
            const Kind kind = kindOf(scene, scene.instances[i]);
            if (kind == kinds_[i]) continue;
            kinds_[i] = kind;
            if (kind.bucket != kNoBucket) cells_[i] = cellOf(scene, scene.instances[i]);
            others.push_back(i);
        }
    changed_.assign((nearby_.size() + 63) / 64, 0);
    const bool outgrown = !fitsGrid(scene.bounds);
    if (outgrown) chooseGrid(scene.bounds);
    if (!others.empty()) rankAnew(others);
    constexpr uint32_t kRegroupFrames = 256;
    if (outgrown || all || ++changedFrames_ % kRegroupFrames == 0) regroup(scene);
    refreshBounds(scene, rows);
    versionBefore_ = instancesVersion_;
    instancesVersion_ = scene.instancesVersion;
}

void DrawLists::ensureView(uint32_t slot) {
    while (views_.size() <= slot)
        views_.emplace_back().draws.buckets.resize(buckets_.size());
}

void DrawLists::cullAll(const RenderScene& scene, std::span<const ViewRequest> views) {
    if (views.size() * drawn_.size() < kWorthJobs) return;  // cull() does it
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
    addInSight(scene, whole, {firstBlended_, drawn_.size()}, view);
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

void DrawLists::markRanks(View& view) const {
    view.ranksInSight.assign((drawn_.size() + 63) / 64, 0);
    for (uint32_t word = 0; word < view.inSight.size(); ++word)
        for (uint64_t bits = view.inSight[word]; bits; bits &= bits - 1) {
            const uint32_t rank = drawn_.placeOf(nearby_[word * 64 + uint32_t(std::countr_zero(bits))]);
            view.ranksInSight[rank / 64] |= uint64_t(1) << (rank % 64);
        }
}

// Those of the ranks.
void DrawLists::addInSight(const RenderScene& scene, const View& seenBy, Ranks ranks, View& view) const {
    ViewDraws& draws = view.draws;
    draws.commands.clear();
    draws.rows.clear();
    draws.buckets.assign(buckets_.size(), {});
    OrderedHash ofStatic, ofMovable;
    for (uint32_t word = ranks.begin / 64; word * 64 < ranks.end; ++word) {
        uint64_t bits = seenBy.ranksInSight[word] & bitsBetween(ranks.begin, ranks.end, word);
        while (bits) {
            const uint32_t first = word * 64 + uint32_t(std::countr_zero(bits));
            const uint64_t ofRun = bits & bitsBetween(first, runEnd_[first], word);
            bits &= ~ofRun;
            const Kind& kind = kinds_[drawn_[first]];
            const auto count = uint32_t(std::popcount(ofRun));
            OrderedHash version = kind.movable ? ofMovable : ofStatic;
            draws.rows.resize(draws.rows.size() + count);
            uint32_t* row = draws.rows.data() + draws.rows.size() - count;
            for (uint64_t left = ofRun; left; left &= left - 1) {
                const uint32_t rank = word * 64 + uint32_t(std::countr_zero(left));
                *row++ = drawn_[rank];
                version.add(hashes_[rank]);
            }
            (kind.movable ? ofMovable : ofStatic) = version;
            const Primitive& p = scene.geometry->primitives[kind.primitive];
            const int32_t firstVertex = firstVertexOf(scene, kind.primitive, kind.skinnedMesh);
            draws.drawLast(kind.bucket, {p.indexCount, 1, p.firstIndex, firstVertex, 0}, count, kind.movable);
        }
    }
    const uint64_t start = combineHash(geometryVersion_, generation_);
    draws.staticVersion = combineHash(start, ofStatic.value());
    draws.movableVersion = combineHash(start, ofMovable.value());
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
    markRanks(view);
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
                if (!isPicked(row)) continue;
                draws.rows.push_back(row);
                draws.drawLast(b, command, 1, c >= from.buckets[b].staticCount);
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
