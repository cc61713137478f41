#include "gi/draw_lists.h"

#include <algorithm>
#include <utility>

#include "engine/core/hash.h"

namespace ag::gi {
namespace {

constexpr uint32_t kNoBucket = ~0u;

DrawBucket bucketOf(const Material& material) {
    return {.textureClass = material.textureClass,
            .alphaMask = material.alphaMode == AlphaMode::kMask,
            .doubleSided = material.doubleSided,
            .normalMap = material.normalLayer >= 0};
}

Bounds transformed(const Bounds& local, const glm::mat4x3& m) {
    const glm::vec3 center = (local.min + local.max) * 0.5f, half = (local.max - local.min) * 0.5f;
    const glm::vec3 c = m * glm::vec4(center, 1.0f);
    const glm::vec3 h = glm::abs(m[0]) * half.x + glm::abs(m[1]) * half.y + glm::abs(m[2]) * half.z;
    return {c - h, c + h};
}

// Left, right, bottom, top, near and far plane of a reversed-depth clip matrix; with an infinite far plane
// nothing is beyond it.
std::array<glm::vec4, 6> frustumPlanes(const glm::mat4& m) {
    const glm::mat4 t = glm::transpose(m);
    return {t[3] + t[0], t[3] - t[0], t[3] + t[1], t[3] - t[1], t[3] - t[2], t[2]};
}

bool outside(const Bounds& b, const std::array<glm::vec4, 6>& planes) {
    for (const glm::vec4& p : planes) {
        const glm::vec3 far = {p.x > 0 ? b.max.x : b.min.x, p.y > 0 ? b.max.y : b.min.y,
                               p.z > 0 ? b.max.z : b.min.z};
        if (glm::dot(glm::vec3(p), far) + p.w < 0) return true;
    }
    return false;
}

}  // namespace

void DrawLists::rebuildBuckets(const RenderScene& scene) {
    const GeometryArrays& geometry = *scene.geometry;
    buckets_.clear();
    bucketCapacity_.clear();
    instanceBucket_.assign(scene.instances.size(), kNoBucket);
    instancePrimitive_.resize(scene.instances.size());
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        instancePrimitive_[i] = scene.instances[i].primitive;
        const Material& material =
            geometry.materials[geometry.primitives[scene.instances[i].primitive].material];
        if (material.alphaMode == AlphaMode::kBlend) continue;
        const DrawBucket bucket = bucketOf(material);
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
    worldBounds_.resize(scene.instances.size());
    transformHash_.resize(scene.instances.size());
    views_.clear();
    commands_.clear();
    ++generation_;
}

void DrawLists::refreshBounds(const RenderScene& scene, bool all) {
    const auto refresh = [&](uint32_t begin, uint32_t end) {
        for (uint32_t i = begin; i < end; ++i) {
            const RenderInstance& instance = scene.instances[i];
            worldBounds_[i] = transformed(scene.geometry->primitives[instance.primitive].boundsLocal,
                                          instance.worldFromLocal);
            transformHash_[i] = hashValue(instance.worldFromLocal, instance.primitive);
        }
    };
    if (all || scene.allInstancesChanged) return refresh(0, uint32_t(scene.instances.size()));
    for (const RenderScene::Range& range : scene.changedInstances)
        refresh(range.begin, range.end);
}

void DrawLists::beginFrame(const RenderScene& scene) {
    bool regroup =
        geometryVersion_ != scene.geometry->version || instanceBucket_.size() != scene.instances.size();
    if (instancesVersion_ != scene.instancesVersion && !regroup)
        for (size_t i = 0; i < scene.instances.size() && !regroup; ++i)
            regroup = instancePrimitive_[i] != scene.instances[i].primitive;
    if (regroup) rebuildBuckets(scene);
    if (regroup || instancesVersion_ != scene.instancesVersion)
        refreshBounds(scene, regroup || scene.instancesVersion != instancesVersion_ + 1);
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

const ViewDraws& DrawLists::cull(const RenderScene& scene, uint32_t slot, const glm::mat4& clipFromWorld) {
    ensureView(slot);
    View& view = views_[slot];
    if (view.generation == generation_ && view.instancesVersion == instancesVersion_ &&
        view.clipFromWorld == clipFromWorld)
        return view.draws;

    const auto planes = frustumPlanes(clipFromWorld);
    const uint32_t first = slot * commandsPerView();
    for (size_t b = 0; b < buckets_.size(); ++b)
        view.draws.buckets[b] = {first + bucketFirst_[b], 0};
    uint64_t version = combineHash(geometryVersion_, generation_);
    view.draws.instanceCount = 0;
    for (uint32_t i = 0; i < instanceBucket_.size(); ++i) {
        if (instanceBucket_[i] == kNoBucket || outside(worldBounds_[i], planes)) continue;
        const Primitive& p = scene.geometry->primitives[instancePrimitive_[i]];
        BucketRange& range = view.draws.buckets[instanceBucket_[i]];
        commands_[range.firstCommand + range.commandCount++] = {p.indexCount, 1, p.firstIndex, p.vertexOffset,
                                                                i};
        version = combineHash(combineHash(version, i), transformHash_[i]);
        ++view.draws.instanceCount;
    }
    view.dirty = view.dirty || version != view.draws.version;
    view.draws.version = version;
    view.clipFromWorld = clipFromWorld;
    view.instancesVersion = instancesVersion_;
    view.generation = generation_;
    return view.draws;
}

const ViewDraws& DrawLists::pick(uint32_t slot, const ViewDraws& from,
                                 std::span<const RenderScene::Range> rows) {
    ensureView(slot);
    View& view = views_[slot];
    view.draws.version = combineHash(from.version, instancesVersion_);
    view.draws.instanceCount = 0;
    for (size_t b = 0; b < buckets_.size(); ++b) {
        BucketRange& range = view.draws.buckets[b];
        range = {slot * commandsPerView() + bucketFirst_[b], 0};
        auto row = rows.begin();  // commands of a bucket ascend too
        for (uint32_t c = 0; c < from.buckets[b].commandCount; ++c) {
            const VkDrawIndexedIndirectCommand& command = commands_[from.buckets[b].firstCommand + c];
            while (row != rows.end() && row->end <= command.firstInstance)
                ++row;
            if (row == rows.end()) break;
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

}  // namespace ag::gi
