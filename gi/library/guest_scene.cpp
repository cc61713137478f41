#include "gi/library/guest_scene.h"

#include <algorithm>

#include "common/sampling.h"
#include "engine/core/check.h"

namespace ag::guest {
namespace {

constexpr uint32_t kSurfaceSamples = 1u << 17;  // over the whole scene
constexpr uint32_t kBouncePoints = 1u << 12;    // of them, for light that bounces on
constexpr uint32_t kEmissivePoints = 1u << 12;  // on emissive surfaces

gi::SampledMesh sampledOf(const GuestMesh& mesh, bool doubleSided) {
    return {.positions = gi::Strided<glm::vec3>::of(mesh.positions.data()),
            .normals = gi::Strided<glm::vec3>::of(mesh.normals.data()),
            .uvs = mesh.uvs.empty() ? gi::Strided<glm::vec2>{} : gi::Strided<glm::vec2>::of(mesh.uvs.data()),
            .indices = mesh.indices,
            .blocksLight = mesh.there,
            .doubleSided = doubleSided};
}

// Of all its map.
glm::vec3 albedoOf(const GuestMaterial& m) {
    return m.map ? m.albedo * m.mean : m.albedo;
}

}  // namespace

uint32_t GuestScene::addMaterials(std::vector<GuestMaterial> materials) {
    const auto first = uint32_t(materials_.size());
    materials_.insert(materials_.end(), materials.begin(), materials.end());
    return first;
}

void GuestScene::updateMaterials(uint32_t first, std::vector<GuestMaterial> materials) {
    const auto from = materials_.begin() + first;
    if (std::equal(materials.begin(), materials.end(), from)) return;
    std::ranges::copy(materials, from);
    ++drawnVersion_;
    ++setVersion_;  // points know of holes and albedo
    ++staticVersion_;
}

uint32_t GuestScene::addMeshes(std::vector<GuestMesh> meshes) {
    const auto first = uint32_t(meshes_.size());
    meshes_.insert(meshes_.end(), std::make_move_iterator(meshes.begin()),
                   std::make_move_iterator(meshes.end()));
    for (size_t i = first; i < meshes_.size(); ++i)
        withoutBuffers_ += !meshes_[i].given.vertexBuffer;
    return first;
}

void GuestScene::removeMeshes(uint32_t first, uint32_t count) {
    for (uint32_t i = first; i < first + count; ++i) {
        withoutBuffers_ -= meshes_[i].there && !meshes_[i].given.vertexBuffer;
        meshes_[i] = {.there = false};
    }
}

void GuestScene::setInstance(const GuestInstance& given) {
    const auto known = rowOf_.find(given.id);
    if (known == rowOf_.end()) return addInstance(given);
    GuestInstance& old = instances_[known->second];
    if (old.standsAs(given)) return;
    if (old.mesh != given.mesh || old.movable != given.movable) {
        count(old, -1);
        count(given, 1);
        ++setVersion_;
    }
    staticVersion_ += !old.movable || !given.movable;
    old = given;
    old.moved = ++movedVersion_;
}

// A mesh that begins to move needs a tree of its own; one that no longer does keeps it until others are
// built.
void GuestScene::count(const GuestInstance& instance, int by) {
    GuestMesh& mesh = meshes_[instance.mesh];
    mesh.instances += uint32_t(by);
    if (!instance.movable || by < 0 || mesh.hasTree) return;
    mesh.hasTree = true;  // as soon as they are built anew
    ++movingVersion_;
}

void GuestScene::addInstance(const GuestInstance& given) {
    // Room first: the row is there as soon as its id is known.
    if (instances_.size() == instances_.capacity()) instances_.reserve(2 * instances_.size() + 1);
    rowOf_.emplace(given.id, instances_.size());
    instances_.push_back(given);
    instances_.back().moved = ++movedVersion_;
    count(given, 1);
    ++setVersion_;
    staticVersion_ += !given.movable;
}

void GuestScene::removeInstance(uint64_t id) {
    const auto known = rowOf_.find(id);
    const size_t row = known->second;
    count(instances_[row], -1);
    staticVersion_ += !instances_[row].movable;
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
    if (lights == lights_) return;
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

const GuestScene::DoubleBounds& GuestScene::bounds() {
    if (boundsOf_ == movedVersion_) return bounds_;
    bounds_ = {};
    for (const GuestInstance& instance : instances_) {
        const Bounds b = boundsOf(instance, meshes_[instance.mesh].bounds, instance.position);
        bounds_.min = glm::min(bounds_.min, instance.position + glm::dvec3(b.min));
        bounds_.max = glm::max(bounds_.max, instance.position + glm::dvec3(b.max));
    }
    boundsOf_ = movedVersion_;
    return bounds_;
}

glm::dvec3 GuestScene::middle() {
    const DoubleBounds& all = bounds();
    return instances_.empty() ? glm::dvec3(0) : 0.5 * (all.min + all.max);
}

// Passes all surfaces on, about `middle`, in m.
template <class Use>
void GuestScene::withSurfaces(glm::dvec3 middle, Use&& use) {
    std::vector<gi::SampledMesh> meshes;
    for (const GuestMesh& mesh : meshes_)
        meshes.push_back(sampledOf(mesh, mesh.there && materials_[mesh.given.material].doubleSided));
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
    const DoubleBounds& all = bounds();
    const Bounds box{glm::vec3(all.min - middle), glm::vec3(all.max - middle)};
    use(meshes, gi::SampledScene{meshes, instances, box, isCutOut});
}

const GuestPoints& GuestScene::points() {
    if (points_.set == setVersion_) return points_;
    const auto albedoAt = [&](uint32_t instance, glm::vec2) {
        return albedoOf(materialOf(instances_[instance].mesh));
    };
    const auto doubleSided = [&](uint32_t instance) {
        return materialOf(instances_[instance].mesh).doubleSided;
    };
    GuestPoints fresh{.set = setVersion_};
    withSurfaces(middle(), [&](std::span<gi::SampledMesh> meshes, const gi::SampledScene& scene) {
        fresh.samples = gi::sampleSurfaces(scene, kSurfaceSamples);
        if (!fresh.samples.samples.empty())
            fresh.reflecting =
                gi::chooseBouncePoints(scene.instances, fresh.samples, albedoAt, doubleSided, kBouncePoints);
        if (mostEmissive() > 0) fresh.emissive = chooseEmissivePoints(meshes, scene);
    });
    points_ = std::move(fresh);
    return points_;
}

const GuestMaterial& GuestScene::materialOf(uint32_t mesh) const {
    return materials_[meshes_[mesh].given.material];
}

float GuestScene::mostEmissive() const {
    float most = 0;
    for (const GuestMesh& mesh : meshes_) {
        if (!mesh.there || mesh.instances == 0) continue;
        const glm::vec3 e = materials_[mesh.given.material].emissive;
        most = std::max({most, e.x, e.y, e.z});
    }
    return most;
}

// As if nothing else were there.
std::vector<io::BouncePoint> GuestScene::chooseEmissivePoints(std::span<gi::SampledMesh> meshes,
                                                              const gi::SampledScene& scene) const {
    for (uint32_t i = 0; i < meshes.size(); ++i)
        meshes[i].blocksLight = meshes[i].blocksLight && materialOf(i).emissive != glm::vec3(0);
    const gi::SurfaceSamples samples = gi::sampleSurfaces(scene, 4 * kEmissivePoints);
    if (samples.samples.empty()) return {};
    const auto radianceAt = [&](uint32_t instance, glm::vec2) {
        return materialOf(scene.instances[instance].mesh).emissive;
    };
    const auto doubleSided = [&](uint32_t instance) {
        return materialOf(scene.instances[instance].mesh).doubleSided;
    };
    return gi::chooseBouncePoints(scene.instances, samples, radianceAt, doubleSided, kEmissivePoints);
}

const GuestTrees& GuestScene::trees() {
    if (trees_.version == treesVersion()) return trees_;
    GuestTrees fresh{.version = treesVersion(), .middle = middle()};
    const auto sentAt = [&](uint32_t mesh, glm::vec2) {
        const GuestMaterial& m = materialOf(mesh);
        return gi::SentAt{albedoOf(m), m.emissive};
    };
    withSurfaces(fresh.middle, [&](std::span<gi::SampledMesh>, const gi::SampledScene& scene) {
        fresh.trees = gi::buildOccluderTrees(scene, gi::TreesOf::kAll, sentAt);
    });
    trees_ = std::move(fresh);
    for (size_t i = 0; i < meshes_.size(); ++i)
        meshes_[i].hasTree = !trees_.trees.ofMesh[i].empty();
    return trees_;
}

}  // namespace ag::guest
