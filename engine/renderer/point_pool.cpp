#include "engine/renderer/point_pool.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "engine/renderer/scene_surfaces.h"
#include "engine/scene/static_scene.h"

namespace ag::render {
namespace {

constexpr uint32_t kNearlyMeet = 4;         // elements apart
constexpr uint32_t kFirstSpare = 1u << 14;  // points
constexpr double kMostUnseen = 0.05;        // of the area, before bounce points are chosen anew
constexpr io::SurfaceSample kHole{.positionLocal = {}, .instance = io::kNoInstance};

bool isEmissive(const RenderScene& scene, uint32_t primitive) {
    const GeometryArrays& g = *scene.geometry;
    return primitive != kNoPrimitive &&
           g.materials[g.primitives[primitive].material].emissive != glm::vec3(0);
}

// By how much an instance's transform makes a piece of surface with that normal larger.
float growthOf(const glm::mat3& m, glm::vec3 normal) {
    return glm::length(normal.x * glm::cross(m[1], m[2]) + normal.y * glm::cross(m[2], m[0]) +
                       normal.z * glm::cross(m[0], m[1]));
}

// The k-th of n, evenly spread over the samples of a mesh.
uint32_t spread(uint32_t k, uint32_t n, size_t samples) {
    return uint32_t((2 * k + 1) * samples / (2 * n));
}

// A power of two near the number wanted, as ranges are.
uint32_t pointsFor(double wanted, size_t samples) {
    const auto count = uint32_t(std::clamp(wanted, double(kLeastMeshPoints), double(samples)));
    return std::bit_floor(std::min(count + count / 2, uint32_t(samples)));
}

}  // namespace

std::span<const RenderScene::Range> ChangedElements::merged() {
    std::ranges::sort(ranges_, {}, &RenderScene::Range::begin);
    size_t kept = 0;
    for (size_t i = 1; i < ranges_.size(); ++i)
        if (ranges_[i].begin <= ranges_[kept].end + kNearlyMeet)
            ranges_[kept].end = std::max(ranges_[kept].end, ranges_[i].end);
        else
            ranges_[++kept] = ranges_[i];
    ranges_.resize(std::min(ranges_.size(), kept + 1));
    return ranges_;
}

PointPool::Row PointPool::rowOf(const RenderInstance& instance) {
    return {
        .primitive = instance.primitive, .skinnedMesh = instance.skinnedMesh, .movable = instance.movable};
}

void PointPool::load(const GeometryArrays& geometry) {
    meshes_ = sampleMeshes(geometry);
}

void PointPool::start(const RenderScene& scene, bool whole, float lightUnit) {
    whole_ = whole;
    lightUnit_ = lightUnit;
    for (MeshPoints& mesh : meshes_)
        mesh.albedos.clear();
    gi::SurfaceSamples chosen = sampleSurfaces(scene, kSurfaceSamples);
    samples_ = std::move(chosen.samples);
    uvs_ = std::move(chosen.uvs);
    tints_ = std::move(chosen.tints);
    areas_ = std::move(chosen.pointAreas);
    const auto movable = uint32_t(samples_.size()) - chosen.staticCount;
    layers_[0] = {.curve = chosen.staticCount};
    layers_[1] = {.first = chosen.staticCount, .curve = movable};
    rows_.clear();
    for (const RenderInstance& instance : scene.instances)
        rows_.push_back(rowOf(instance));
    startArea_ = 0;
    for (const io::SurfaceSample& s : samples_) {
        rows_[s.instance].onCurve = true;
        startArea_ += double(areas_[s.instance]);
    }
    area_ = startArea_;
    density_ = startArea_ > 0 ? double(samples_.size()) / startArea_ : 0;
    firstCurvePoint_.clear();
    bounces_.clear();
    if (!samples_.empty()) chooseBounces(scene);
    changedSamples.add(0, uint32_t(samples_.size()));
    changedAreas.add(0, uint32_t(areas_.size()));
    ++layoutVersion_;
    ++staticVersion_;
}

void PointPool::chooseBounces(const RenderScene& scene) {
    const gi::SurfaceSamples all{samples_, uvs_, tints_, layers_[0].count(), areas_};
    bounces_ = chooseBouncePoints(scene, all, kBouncePoints, whole_);
    reflecting_ = uint32_t(bounces_.size());
    freeBounces_.clear();
    bouncesOf_.clear();
    unseen_ = 0;
    chooseEmissive(scene);
}

void PointPool::chooseEmissive(const RenderScene& scene) {
    bounces_.resize(reflecting_);
    const auto shining = chooseEmissivePoints(scene, kEmissivePoints, lightUnit_);
    emissiveFlux_ = gi::emittedFlux(shining);
    emissiveArea_ = gi::meanArea(shining);
    reflectingArea_ = gi::meanArea(bounces_);
    bounces_.insert(bounces_.end(), shining.begin(), shining.end());
    changedBounces.add(0, uint32_t(bounces_.size()));
    ++bounceVersion_;
}

void PointPool::indexCurves() {
    if (bouncesOf_.empty()) {
        bouncesOf_.resize(rows_.size());
        for (uint32_t i = 0; i < reflecting_; ++i)
            if (bounces_[i].area > 0)
                bouncesOf_[bounces_[i].instance].push_back(i);
            else
                freeBounces_.push_back(i);
    }
    bouncesOf_.resize(rows_.size());
    if (!firstCurvePoint_.empty()) return;
    firstCurvePoint_.assign(rows_.size() + 1, 0);
    const auto each = [&](auto&& f) {
        for (const Layer& layer : layers_)
            for (uint32_t i = 0; i < layer.curve; ++i)
                f(samples_[layer.first + i].instance, i);
    };
    each([&](uint32_t row, uint32_t) { ++firstCurvePoint_[row + 1]; });
    std::partial_sum(firstCurvePoint_.begin(), firstCurvePoint_.end(), firstCurvePoint_.begin());
    curvePoints_.resize(firstCurvePoint_.back());
    std::vector<uint32_t> next = firstCurvePoint_;
    each([&](uint32_t row, uint32_t i) { curvePoints_[next[row]++] = i; });
}

// Elements keep their order: what is static, its spare points, what may move, its spare points.
void PointPool::makeRoom(uint32_t which, uint32_t spare) {
    Layer& layer = layers_[which];
    const uint32_t more =
        std::max(layer.spare, kFirstSpare) + spare / io::kSegmentPoints * io::kSegmentPoints;
    const auto at = layer.first + layer.count();
    samples_.insert(samples_.begin() + at, more, kHole);
    uvs_.insert(uvs_.begin() + at, more, glm::vec2(0));
    tints_.insert(tints_.begin() + at, more, glm::vec3(0));
    layer.spare += more;
    if (which == 0) layers_[1].first += more;
    if (which == 0) ++staticVersion_;
    changedSamples.add(0, uint32_t(samples_.size()));
    ++layoutVersion_;
}

void PointPool::punch(uint32_t point) {
    samples_[point] = kHole;
    changedSamples.add(point, point + 1);
}

void PointPool::drop(uint32_t row) {
    Row& r = rows_[row];
    Layer& layer = layers_[r.movable];
    double points = 0;
    if (r.onCurve) {
        for (uint32_t i = firstCurvePoint_[row]; i < firstCurvePoint_[row + 1]; ++i)
            punch(layer.first + curvePoints_[i]);
        points = firstCurvePoint_[row + 1] - firstCurvePoint_[row];
    }
    for (uint32_t i = 0; i < r.range.capacity; ++i)
        punch(layer.first + layer.curve + r.range.first + i);
    points += r.range.capacity;
    layer.ranges.release(r.range);
    area_ -= points * double(areas_[row]);
    for (const uint32_t bounce : bouncesOf_[row]) {
        bounces_[bounce].area = 0;
        changedBounces.add(bounce, bounce + 1);
        freeBounces_.push_back(bounce);
        ++bounceVersion_;
    }
    bouncesOf_[row].clear();
    if (!r.movable) ++staticVersion_;
    r = {};
}

glm::vec3 PointPool::albedoOn(const RenderScene& scene, uint32_t row, MeshPoints& mesh, uint32_t sample) {
    if (mesh.albedos.empty()) mesh.albedos.assign(mesh.samples.size(), glm::vec3(NAN));
    glm::vec3& albedo = mesh.albedos[sample];
    if (std::isnan(albedo.x)) albedo = albedoOf(scene, row, mesh.uvs[sample], whole_) * mesh.tints[sample];
    return albedo;
}

void PointPool::addBounces(const RenderScene& scene, uint32_t row, MeshPoints& mesh, float area) {
    const double wanted = double(area) / startArea_ * kBouncePoints;
    const auto count =
        uint32_t(std::min<double>(std::max(std::round(wanted), 1.0), double(freeBounces_.size())));
    if (count == 0) unseen_ += double(area);
    const Material& material =
        scene.geometry->materials[scene.geometry->primitives[scene.instances[row].primitive].material];
    for (uint32_t k = 0; k < count; ++k) {
        const uint32_t bounce = freeBounces_.back(), sample = spread(k, count, mesh.samples.size());
        freeBounces_.pop_back();
        const io::SurfaceSample& s = mesh.samples[sample];
        bounces_[bounce] = {.positionLocal = s.positionLocal,
                            .instance = row,
                            .normalLocal = s.normalLocal,
                            .area = s.edgesLocal[0].distance < 0 ? 0 : area / float(count),
                            .albedo = albedoOn(scene, row, mesh, sample),
                            .edgesLocal = {s.edgesLocal[0], s.edgesLocal[1]}};
        // Of those that have one point, every other faces the back.
        if (material.doubleSided) gi::faceSide(bounces_[bounce], (k + row) % 2 == 1);
        bouncesOf_[row].push_back(bounce);
        changedBounces.add(bounce, bounce + 1);
        ++bounceVersion_;
    }
}

void PointPool::add(const RenderScene& scene, uint32_t row) {
    const RenderInstance& instance = scene.instances[row];
    Row& r = rows_[row];
    r = rowOf(instance);
    MeshPoints& mesh = meshes_[instance.primitive];
    if (mesh.samples.empty()) return;
    const glm::mat3 linear(instance.worldFromLocal);
    float growth = 0;
    for (uint32_t k = 0; k < kLeastMeshPoints; ++k)
        growth +=
            growthOf(linear, mesh.samples[spread(k, kLeastMeshPoints, mesh.samples.size())].normalLocal) /
            kLeastMeshPoints;
    const float area = mesh.area * growth;
    const uint32_t count = pointsFor(double(area) * density_, mesh.samples.size());
    Layer& layer = layers_[r.movable];
    layer.ranges.fit(r.range, count);
    if (layer.ranges.size() > layer.spare) makeRoom(r.movable, layer.ranges.size() - layer.spare);
    const uint32_t first = layer.first + layer.curve + r.range.first;
    for (uint32_t k = 0; k < r.range.capacity; ++k) {
        const uint32_t from = spread(k, r.range.capacity, mesh.samples.size());
        samples_[first + k] = mesh.samples[from];
        samples_[first + k].instance = row;
        uvs_[first + k] = mesh.uvs[from];
        tints_[first + k] = mesh.tints[from];
    }
    changedSamples.add(first, first + r.range.capacity);
    areas_[row] = area / float(r.range.capacity);
    changedAreas.add(row, row + 1);
    area_ += double(area);
    if (!r.movable) ++staticVersion_;
    addBounces(scene, row, mesh, area);
}

bool PointPool::follow(const RenderScene& scene, std::span<const RenderScene::Range> rows) {
    std::vector<uint32_t> others;
    const auto known = uint32_t(rows_.size());
    rows_.resize(scene.instances.size());
    areas_.resize(scene.instances.size(), 0);
    for (const RenderScene::Range& range : rows)
        for (uint32_t row = range.begin; row < range.end; ++row) {
            const Row now = rowOf(scene.instances[row]);
            if (now == rows_[row]) continue;
            if (now.skinnedMesh != kNoSkinnedMesh || rows_[row].skinnedMesh != kNoSkinnedMesh) return false;
            others.push_back(row);
        }
    if (others.empty()) return true;
    if (samples_.empty()) return false;
    indexCurves();
    firstCurvePoint_.resize(rows_.size() + 1, firstCurvePoint_.back());
    if (known < rows_.size()) changedAreas.add(known, uint32_t(rows_.size()));
    bool shining = false;
    for (const uint32_t row : others) {
        shining = shining || isEmissive(scene, rows_[row].primitive) ||
                  isEmissive(scene, scene.instances[row].primitive);
        if (rows_[row].primitive != kNoPrimitive) drop(row);
    }
    for (const uint32_t row : others)
        if (scene.instances[row].isPresent()) add(scene, row);
    if (area_ > 2 * startArea_) return false;
    if (unseen_ > kMostUnseen * area_)
        chooseBounces(scene);
    else if (shining)
        chooseEmissive(scene);
    return true;
}

}  // namespace ag::render
