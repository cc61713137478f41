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

// Numbers the rows anew; true if every entity kept its own.
bool numberRows(InstanceView& instances, ExtractState& state) {
    std::swap(state.rows, state.before);
    InstanceRows& rows = state.rows;
    for (std::vector<uint32_t>& chunks : rows.firstEntity)
        chunks.clear();
    rows.entities.clear();
    rows.firstRow.assign(1, 0);
    instances.chunks(
        [&](const RowRun& run, std::span<const WorldTransform>, std::span<const MeshInstance> meshes) {
            const uint32_t archetype = run.chunk->archetype->index;
            if (rows.firstEntity.size() <= archetype) rows.firstEntity.resize(archetype + 1);
            rows.firstEntity[archetype].push_back(uint32_t(rows.entities.size()));
            rows.entities.insert(rows.entities.end(), run.entities.begin(), run.entities.end());
            for (const MeshInstance& mesh : meshes)
                rows.firstRow.push_back(rows.firstRow.back() + mesh.primitiveCount);
        });
    return rows.entities == state.before.entities && rows.firstRow == state.before.firstRow;
}

// Writes the rows of a run of entities that differ from what they were, and marks them.
void writeRows(const RowRun& run, std::span<const WorldTransform> worlds,
               std::span<const MeshInstance> meshes, bool all, ExtractState& state, RenderScene& scene) {
    const uint32_t first =
        state.rows.firstEntity[run.chunk->archetype->index][run.chunk->ordinal] + run.first;
    uint64_t bits = 0;
    uint32_t word = 0;
    const auto flush = [&] {  // other threads mark rows in the first and the last word, too
        if (bits) std::atomic_ref(state.changed[word]).fetch_or(bits, std::memory_order_relaxed);
        bits = 0;
    };
    for (size_t i = 0; i < worlds.size(); ++i) {
        const glm::mat4x3 matrix = relativeTo(scene.originWorld, worlds[i]);
        uint32_t row = state.rows.firstRow[first + i];
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
    skinnedMeshes.chunks([&](const RowRun& run, std::span<const SkinnedMesh>,
                             std::span<const AnimationPlayer>, std::span<const MeshInstance> meshes) {
        const uint32_t first =
            state.rows.firstEntity[run.chunk->archetype->index][run.chunk->ordinal] + run.first;
        for (size_t i = 0; i < meshes.size(); ++i, ++skinnedMesh)
            for (uint32_t row = state.rows.firstRow[first + i]; row < state.rows.firstRow[first + i + 1];
                 ++row) {
                RenderInstance& instance = scene.instances[row];
                instance.skinnedMesh = skinnedMesh;
                const uint64_t bit = uint64_t(1) << (row % 64);
                if (!all && !state.poseChanged[skinnedMesh] && !(state.changed[row / 64] & bit)) continue;
                state.bounds.set(row, instance, scene.skinnedMeshes[skinnedMesh].boundsLocal);
                state.changed[row / 64] |= bit;
            }
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

// Rows in storage order. If the entities are the ones of before, only rows that differ are written; and if
// none came, went or got another mesh, only those that moved are looked at.
void extractInstances(InstanceView& instances, MovedInstances& moved, SkinnedRows& skinnedMeshes,
                      bool renumber, bool replaced, ExtractState& state, RenderScene& scene,
                      JobRunner& runner) {
    const bool same = (!renumber || numberRows(instances, state)) && !replaced;
    const uint32_t count = state.rows.firstRow.empty() ? 0 : state.rows.firstRow.back();
    if (!same) {
        scene.instances.resize(count);
        state.bounds.resize(count);
    }
    state.changed.assign((count + 63) / 64, 0);
    const auto write = [&](const RowRun& run, std::span<const WorldTransform> worlds,
                           std::span<const MeshInstance> meshes) {
        writeRows(run, worlds, meshes, !same, state, scene);
    };
    if (renumber || replaced)
        instances.parallelChunks(runner, write);
    else
        moved.parallelChunks(runner, write);
    if (!state.skinnedMeshes.empty()) placeSkinnedMeshes(skinnedMeshes, !same, state, scene);
    scene.allInstancesChanged = !same;
    if (same) toRanges(state.changed, scene.changedInstances);
    if (same && scene.changedInstances.empty()) return;
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
    scene->allInstancesChanged = false;
    const bool others = std::exchange(state->skinnedMeshesReplaced, false),
               replaced = followCamera(*scene, *state, camera->pose.position) || others;
    const bool renumber = !meshes.empty() || instances.count() != state->rows.entities.size();
    extractInstances(instances, moved, skinnedMeshes, renumber, replaced, *state, *scene, runner);
    extractLights(lights, bounces, names, *state, *scene);
    setCamera(*scene, camera->pose, camera->size);
}

}  // namespace ag
