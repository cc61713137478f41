#include "engine/scene/extract_system.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <utility>

#include "engine/core/floating_origin.h"
#include "engine/core/log.h"
#include "engine/scene/light_check.h"

namespace ag {
namespace {

glm::mat4x3 relativeTo(const glm::dvec3& origin, const WorldTransform& world) {
    return {world.linear[0], world.linear[1], world.linear[2], glm::vec3(world.translation - origin)};
}

// True when the origin moved: then every position is another number.
bool followCamera(RenderScene& scene, ExtractState& state, const glm::dvec3& camera) {
    const glm::dvec3 origin = state.placed ? followingOrigin(scene.originWorld, camera) : camera;
    const bool moved = !state.placed || origin != scene.originWorld;
    state.placed = true;
    scene.originWorld = origin;
    if (moved) ++scene.originVersion;
    return moved;
}

// A bit more for rows that came to be since.
void mark(std::vector<uint64_t>& words, uint32_t row) {
    if (words.size() <= row / 64) words.resize(row / 64 + 1);
    words[row / 64] |= uint64_t(1) << (row % 64);
}

void giveBack(InstanceRows::Place& place, ExtractState& state, RenderScene& scene) {
    InstanceRows& rows = state.rows;
    if (rows.free.size() <= place.count) rows.free.resize(place.count + 1);
    if (place.count > 0) rows.free[place.count].push_back(place.first);
    for (uint32_t row = place.first; row < place.first + place.count; ++row) {
        scene.instances[row] = {.primitive = kNoPrimitive};
        state.bounds.clear(row);
        mark(state.changed, row);
        mark(state.replaced, row);
    }
    place = {};
}

void takeRows(Entity entity, uint32_t count, ExtractState& state, RenderScene& scene) {
    InstanceRows& rows = state.rows;
    InstanceRows::Place& place = rows.ofEntity[entity.index];
    place = {entity.generation, rows.end, count, rows.look};
    if (count < rows.free.size() && !rows.free[count].empty()) {
        place.first = rows.free[count].back();
        rows.free[count].pop_back();
    } else {
        rows.end += count;
        scene.instances.resize(rows.end, {.primitive = kNoPrimitive});
        state.bounds.resize(rows.end);
    }
    for (uint32_t row = place.first; row < place.first + count; ++row) {
        mark(state.changed, row);
        mark(state.replaced, row);
    }
}

// Takes rows back from entities that left or have another number of primitives, and gives rows to those that
// came.
void keepRows(InstanceView& instances, ExtractState& state, RenderScene& scene) {
    InstanceRows& rows = state.rows;
    ++rows.look;
    state.arrived.clear();
    std::vector<uint32_t> counts;
    instances.each([&](Entity entity, const WorldTransform&, const MeshInstance& mesh) {
        if (rows.ofEntity.size() <= entity.index) rows.ofEntity.resize(entity.index + 1);
        InstanceRows::Place& place = rows.ofEntity[entity.index];
        if (place.count == mesh.primitiveCount && place.generation == entity.generation) {
            place.look = rows.look;
        } else {
            state.arrived.push_back(entity);
            counts.push_back(mesh.primitiveCount);
        }
    });
    const auto left = [&](Entity entity) {
        InstanceRows::Place& place = rows.ofEntity[entity.index];
        if (place.look == rows.look) return false;
        giveBack(place, state, scene);
        return true;
    };
    std::erase_if(rows.entities, left);
    for (size_t i = 0; i < counts.size(); ++i)
        takeRows(state.arrived[i], counts[i], state, scene);
    rows.entities.insert(rows.entities.end(), state.arrived.begin(), state.arrived.end());
}

// Writes the rows of a run of entities that differ from what they were, and marks them.
void writeRows(const RowRun& run, std::span<const WorldTransform> worlds,
               std::span<const MeshInstance> meshes, bool all, ExtractState& state, RenderScene& scene) {
    uint64_t bits = 0;
    uint32_t word = 0;
    const auto flush = [&] {  // other threads mark rows in the same words, too
        if (bits) std::atomic_ref(state.changed[word]).fetch_or(bits, std::memory_order_relaxed);
        bits = 0;
    };
    for (size_t i = 0; i < worlds.size(); ++i) {
        const glm::mat4x3 matrix = relativeTo(scene.originWorld, worlds[i]);
        uint32_t row = state.rows.of(run.entities[i]).first;
        for (uint32_t p = 0; p < meshes[i].primitiveCount; ++p, ++row) {
            RenderInstance& instance = scene.instances[row];
            const uint32_t primitive = meshes[i].firstPrimitive + p;
            const bool movable = meshes[i].movable != 0;
            if (!all && instance.worldFromLocal == matrix && instance.primitive == primitive &&
                instance.movable == movable)
                continue;
            instance = {matrix, primitive, movable};
            state.bounds.set(row, instance, scene.geometry->primitives[primitive].boundsLocal);
            if (row / 64 != word) flush();
            word = row / 64;
            bits |= uint64_t(1) << (row % 64);
        }
    }
    flush();
}

// Gives the rows of skinned meshes their own vertices and bounds, and marks those whose joints moved.
void placeSkinnedMeshes(SkinnedRows& skinnedMeshes, bool all, ExtractState& state, RenderScene& scene) {
    if (skinnedMeshes.count() != state.skinnedMeshes.size()) return;  // nobody poses them
    uint32_t skinnedMesh = 0;
    skinnedMeshes.each([&](Entity entity, const SkinnedMesh&, const AnimationPlayer&, const MeshInstance&) {
        const InstanceRows::Place& place = state.rows.of(entity);
        for (uint32_t row = place.first; row < place.first + place.count; ++row) {
            RenderInstance& instance = scene.instances[row];
            instance.skinnedMesh = skinnedMesh;
            const uint64_t bit = uint64_t(1) << (row % 64);
            if (!all && !state.poseChanged[skinnedMesh] && !(state.changed[row / 64] & bit)) continue;
            state.bounds.set(row, instance, scene.skinnedMeshes[skinnedMesh].boundsLocal);
            state.changed[row / 64] |= bit;
        }
        ++skinnedMesh;
    });
}

// Half-open ranges of the rows marked.
void toRanges(std::span<const uint64_t> words, std::vector<RenderScene::Range>& ranges) {
    for (uint32_t w = 0; w < words.size(); ++w)
        for (uint64_t bits = words[w]; bits;) {
            const auto skip = uint32_t(std::countr_zero(bits)),
                       length = uint32_t(std::countr_one(bits >> skip));
            const uint32_t begin = w * 64 + skip;
            if (!ranges.empty() && ranges.back().end == begin)
                ranges.back().end += length;
            else
                ranges.push_back({begin, begin + length});
            bits = skip + length == 64 ? 0 : bits & (~uint64_t(0) << (skip + length));
        }
}

// Only rows that differ are written; if none came, went or got another mesh, only those that moved are looked
// at.
void extractInstances(InstanceView& instances, MovedInstances& moved, SkinnedRows& skinnedMeshes, bool others,
                      bool all, ExtractState& state, RenderScene& scene, JobRunner& runner) {
    const size_t words = (state.rows.end + 63) / 64;
    state.changed.assign(words, 0);
    state.replaced.assign(words, 0);
    if (others) keepRows(instances, state, scene);
    state.changed.resize((state.rows.end + 63) / 64);
    const auto write = [&](const RowRun& run, std::span<const WorldTransform> worlds,
                           std::span<const MeshInstance> meshes) {
        writeRows(run, worlds, meshes, all, state, scene);
    };
    if (others || all)
        instances.parallelChunks(runner, write);
    else
        moved.parallelChunks(runner, write);
    if (!state.skinnedMeshes.empty()) placeSkinnedMeshes(skinnedMeshes, all, state, scene);
    scene.allInstancesChanged = all;
    toRanges(state.replaced, scene.replacedInstances);
    if (!all) toRanges(state.changed, scene.changedInstances);
    if (!all && scene.changedInstances.empty()) return;
    ++scene.instancesVersion;
    scene.bounds = state.bounds.fold(state.changed, runner);
}

// Once for each light, not every frame.
void warnOf(Entity entity, const char* wrong, Lookup<const Name>& names, ExtractState& state) {
    if (!state.warned.insert(entity.bits()).second) return;
    const Name* name = names(entity);
    spdlog::warn("light '{}' {}", name ? name->text : "without a name", wrong);
}

void extractLights(LightRows& lights, Lookup<const BounceLight>& bounces, Lookup<const Name>& names,
                   ExtractState& state, RenderScene& scene) {
    size_t count = 0;
    bool changed = false;
    lights.each([&](Entity entity, const WorldTransform& world, const PunctualLight& light) {
        RenderLight out{.kind = light.kind,
                        .position = glm::vec3(world.translation - scene.originWorld),
                        .direction = glm::normalize(world.linear * glm::vec3(0, 0, -1)),
                        .intensity = light.intensity,
                        .range = light.range,
                        .innerConeAngle = light.innerConeAngle,
                        .outerConeAngle = light.outerConeAngle,
                        .castsShadow = light.castsShadow != 0,
                        .id = entity.bits()};
        if (const BounceLight* bounce = bounces(entity)) {
            out.bounces = true;
            out.rsmResolution = bounce->rsmResolution;
            out.budgetShare = bounce->budgetShare;
        }
        if (const char* wrong = mendLight(out)) warnOf(entity, wrong, names, state);
        if (count == scene.lights.size()) scene.lights.emplace_back();
        changed = changed || !(scene.lights[count] == out);
        scene.lights[count++] = out;
    });
    changed = changed || count != scene.lights.size();
    scene.lights.resize(count);
    if (changed) ++scene.lightsVersion;
}

}  // namespace

void extractScene(InstanceView instances, MovedInstances moved, ChangedMeshes meshes,
                  SkinnedRows skinnedMeshes, LightRows lights, Lookup<const BounceLight> bounces,
                  Lookup<const Name> names, Res<const ActiveCamera> camera, Res<ExtractState> state,
                  Res<RenderScene> scene, JobRunner& runner) {
    scene->changedInstances.clear();
    scene->replacedInstances.clear();
    scene->allInstancesChanged = false;
    const bool skinned = std::exchange(state->skinnedMeshesReplaced, false),
               all = followCamera(*scene, *state, camera->pose.position) || skinned;
    const bool others = skinned || !meshes.empty() || instances.count() != state->rows.entities.size();
    extractInstances(instances, moved, skinnedMeshes, others, all, *state, *scene, runner);
    extractLights(lights, bounces, names, *state, *scene);
    setCamera(*scene, camera->pose, camera->size);
}

}  // namespace ag
