#include "engine/scene/extract_system.h"

#include <algorithm>

#include "engine/core/log.h"
#include "engine/scene/light_check.h"

namespace ag {
namespace {

constexpr double kOriginStep = 1024;  // m

glm::mat4x3 relativeTo(const glm::dvec3& origin, const WorldTransform& world) {
    return {world.linear[0], world.linear[1], world.linear[2], glm::vec3(world.translation - origin)};
}

// True when the origin moved: then every position is another number.
bool followCamera(RenderScene& scene, ExtractState& state, const glm::dvec3& camera) {
    const glm::dvec3 away = glm::abs(camera - scene.originWorld);
    if (state.placed && std::max({away.x, away.y, away.z}) <= kOriginStep) return false;
    const glm::dvec3 origin = glm::round(camera / kOriginStep) * kOriginStep;
    const bool moved = !state.placed || origin != scene.originWorld;
    state.placed = true;
    scene.originWorld = origin;
    if (moved) ++scene.originVersion;
    return moved;
}

void addRange(std::vector<RenderScene::Range>& ranges, uint32_t row) {
    if (!ranges.empty() && ranges.back().end == row)
        ++ranges.back().end;
    else
        ranges.push_back({row, row + 1});
}

void refreshBounds(RenderScene& scene) {
    scene.bounds = {};
    for (const RenderInstance& instance : scene.instances) {
        const Bounds& local = scene.geometry->primitives[instance.primitive].boundsLocal;
        const glm::mat4x3& m = instance.worldFromLocal;
        const glm::vec3 c = m * glm::vec4((local.min + local.max) * 0.5f, 1.0f),
                        h = (local.max - local.min) * 0.5f;
        const glm::vec3 e = glm::abs(m[0]) * h.x + glm::abs(m[1]) * h.y + glm::abs(m[2]) * h.z;
        scene.bounds.add({c - e, c + e});
    }
}

// Rows in storage order. If the entities are the ones of before, only rows that differ are written.
void extractInstances(InstanceView& instances, ExtractState& state, RenderScene& scene, bool all) {
    state.seen.clear();
    instances.each([&](Entity entity, const WorldTransform&, const MeshInstance& mesh) {
        for (uint32_t p = 0; p < mesh.primitiveCount; ++p)
            state.seen.push_back(entity);
    });
    const bool same = !all && state.seen == state.rows;
    if (!same) {
        state.rows = state.seen;
        scene.instances.resize(state.rows.size());
    }
    uint32_t row = 0;
    instances.each([&](Entity, const WorldTransform& world, const MeshInstance& mesh) {
        const glm::mat4x3 matrix = relativeTo(scene.originWorld, world);
        for (uint32_t p = 0; p < mesh.primitiveCount; ++p, ++row) {
            RenderInstance& instance = scene.instances[row];
            const uint32_t primitive = mesh.firstPrimitive + p;
            if (same && instance.worldFromLocal == matrix && instance.primitive == primitive) continue;
            instance = {matrix, primitive, mesh.movable != 0};
            if (same) addRange(scene.changedInstances, row);
        }
    });
    scene.allInstancesChanged = !same;
    if (same && scene.changedInstances.empty()) return;
    ++scene.instancesVersion;
    refreshBounds(scene);
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

void extractScene(InstanceView instances, ChangedInstances changed, LightRows lights,
                  Lookup<const BounceLight> bounces, Lookup<const Name> names, Res<const ActiveCamera> camera,
                  Res<ExtractState> state, Res<RenderScene> scene) {
    scene->changedInstances.clear();
    scene->allInstancesChanged = false;
    const bool moved = followCamera(*scene, *state, camera->pose.position);
    const uint32_t rows = instances.count();
    if (moved || changed.count() > 0 || rows != state->entityCount)
        extractInstances(instances, *state, *scene, moved);
    state->entityCount = rows;
    extractLights(lights, bounces, names, *state, *scene);
    setCamera(*scene, camera->pose, camera->size);
}

}  // namespace ag
