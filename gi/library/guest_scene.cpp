#include "gi/library/guest_scene.h"

#include <algorithm>

#include "common/sampling.h"
#include "engine/core/check.h"

namespace ag::guest {
namespace {

constexpr uint32_t kSurfaceSamples = 1u << 17;  // over the whole scene
constexpr uint32_t kBouncePoints = 1u << 12;    // of them, for light that bounces on

gi::SampledMesh sampledOf(const GuestMesh& mesh) {
    return {.positions = gi::Strided<glm::vec3>::of(mesh.positions.data()),
            .normals = gi::Strided<glm::vec3>::of(mesh.normals.data()),
            .uvs = mesh.uvs.empty() ? gi::Strided<glm::vec2>{} : gi::Strided<glm::vec2>::of(mesh.uvs.data()),
            .indices = mesh.indices,
            .blocksLight = mesh.there};
}

}  // namespace

uint32_t GuestScene::addMaterials(std::vector<GuestMaterial> materials) {
    const auto first = uint32_t(materials_.size());
    materials_.insert(materials_.end(), materials.begin(), materials.end());
    return first;
}

void GuestScene::updateMaterials(uint32_t first, std::vector<GuestMaterial> materials) {
    std::ranges::copy(materials, materials_.begin() + first);
    ++drawnVersion_;
    ++setVersion_;  // points know of holes and albedo
}

uint32_t GuestScene::addMeshes(std::vector<GuestMesh> meshes) {
    const auto first = uint32_t(meshes_.size());
    std::ranges::move(meshes, std::back_inserter(meshes_));
    return first;
}

void GuestScene::removeMeshes(uint32_t first, uint32_t count) {
    for (uint32_t i = first; i < first + count; ++i)
        meshes_[i] = {.there = false};
}

void GuestScene::setInstance(const GuestInstance& given) {
    GuestInstance instance = given;
    instance.moved = ++movedVersion_;
    const auto [known, added] = rowOf_.try_emplace(instance.id, instances_.size());
    if (added) {
        instances_.push_back(instance);
        ++meshes_[instance.mesh].instances;
        ++setVersion_;
        return;
    }
    GuestInstance& old = instances_[known->second];
    if (old.mesh != instance.mesh || old.movable != instance.movable) {
        --meshes_[old.mesh].instances;
        ++meshes_[instance.mesh].instances;
        ++setVersion_;
    }
    old = instance;
}

void GuestScene::removeInstance(uint64_t id) {
    const auto known = rowOf_.find(id);
    const size_t row = known->second;
    --meshes_[instances_[row].mesh].instances;
    rowOf_.erase(known);
    if (row + 1 != instances_.size()) {
        instances_[row] = instances_.back();
        rowOf_[instances_[row].id] = row;
    }
    instances_.pop_back();
    ++setVersion_;
    ++movedVersion_;
}

void GuestScene::setLights(std::vector<GuestLight> lights) {
    lights_ = std::move(lights);
    ++lightsVersion_;
}

Bounds GuestScene::boundsOf(const GuestInstance& instance, const Bounds& local, glm::dvec3 origin) {
    const glm::vec3 centre = 0.5f * (local.min + local.max), half = 0.5f * (local.max - local.min);
    const glm::vec3 at = glm::vec3(instance.position - origin) + instance.linear * centre;
    glm::vec3 reach(0);
    for (int axis = 0; axis < 3; ++axis)
        reach += glm::abs(instance.linear[axis]) * half[axis];
    return {at - reach, at + reach};
}

GuestScene::DoubleBounds GuestScene::bounds() const {
    DoubleBounds all;
    for (const GuestInstance& instance : instances_) {
        const Bounds b = boundsOf(instance, meshes_[instance.mesh].bounds, instance.position);
        all.min = glm::min(all.min, instance.position + glm::dvec3(b.min));
        all.max = glm::max(all.max, instance.position + glm::dvec3(b.max));
    }
    return all;
}

const GuestPoints& GuestScene::points() {
    if (points_.set == setVersion_) return points_;
    std::vector<gi::SampledMesh> meshes;
    for (const GuestMesh& mesh : meshes_)
        meshes.push_back(sampledOf(mesh));
    const DoubleBounds all = bounds();
    const glm::dvec3 middle = instances_.empty() ? glm::dvec3(0) : 0.5 * (all.min + all.max);
    std::vector<gi::SampledInstance> instances;
    for (const GuestInstance& instance : instances_)
        instances.push_back(
            {.worldFromLocal = glm::mat4x3(instance.linear[0], instance.linear[1], instance.linear[2],
                                           glm::vec3(instance.position - middle)),
             .mesh = instance.mesh,
             .movable = instance.movable});
    // Holes have their share of the points, wherever in the texture they are.
    uint32_t number = 0;
    const auto isCutOut = [&](uint32_t mesh, glm::vec2) {
        const GuestMaterial& m = materials_[meshes_[mesh].given.material];
        return m.alphaCutoff > 0 && float(io::hashUint(++number) >> 8) * 0x1p-24f >= m.coverage;
    };
    const Bounds box{glm::vec3(all.min - middle), glm::vec3(all.max - middle)};
    GuestPoints fresh{.set = setVersion_};
    fresh.samples = gi::sampleSurfaces({meshes, instances, box, isCutOut}, kSurfaceSamples);
    const auto albedoAt = [&](uint32_t instance, glm::vec2) {
        const GuestMaterial& m = materials_[meshes_[instances_[instance].mesh].given.material];
        return m.map ? m.albedo * m.mean : m.albedo;
    };
    if (!fresh.samples.samples.empty())
        fresh.bounces = gi::chooseBouncePoints(instances, fresh.samples, albedoAt, kBouncePoints);
    points_ = std::move(fresh);
    return points_;
}

}  // namespace ag::guest
