#include "gi/library/scene_on_device.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

#include "engine/core/floating_origin.h"
#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"
#include "shaders/scene/scene_io.h"

namespace ag::guest {
namespace {

constexpr VkFormat kWords = VK_FORMAT_R32G32B32A32_UINT;

io::Instance rowOf(const GuestInstance& instance, uint32_t material, glm::vec3 at, float perMetre) {
    const glm::mat3 rows = glm::transpose(instance.linear * perMetre);
    return {.worldFromLocal0 = {rows[0], at.x},
            .worldFromLocal1 = {rows[1], at.y},
            .worldFromLocal2 = {rows[2], at.z},
            .ids = {material, instance.mesh, io::kNoSkinnedMesh, 0}};
}

// What shines, over the light's unit: a power of two, so that packing loses nothing.
std::vector<io::BvhTriangle> inLightUnits(std::vector<io::BvhTriangle> triangles, float lightUnit) {
    for (io::BvhTriangle& t : triangles)
        t.shines = std::copysign(io::packRadiance(io::radianceOf(t.shines) / lightUnit) + 1, t.shines);
    return triangles;
}

}  // namespace

SceneOnDevice::~SceneOnDevice() {
    for (auto* buffer : {&instances_, &samples_, &pointAreas_, &bouncePoints_, &treeNodes_, &treeTriangles_,
                         &treePlaces_, &moverNodes_, &skyTexels_, &skyCells_, &skyUpTo_})
        gpu::retire(context_, std::move(*buffer));
}

bool SceneOnDevice::update(GuestScene& scene, glm::dvec3 camera) {
    const bool other = scene_ != scene.id();
    if (other) {
        scene_ = scene.id();
        setVersion_ = movedVersion_ = lightsVersion_ = pointsSet_ = treesBuilt_ = skyVersion_ = 0;
        upkeep_.forget();
        originIsChosen_ = false;
        units_ = {};
        extent_ = 0;
    }
    if (camera_ != camera) ++cameras_;
    camera_ = camera;
    follow(camera);
    const gi::RenderUnits before = units_;
    chooseUnits(scene);
    allAnew_ = allAnew_ || setVersion_ != scene.setVersion() || !(units_ == before);
    takePoints(scene);
    takeInstances(scene);
    takeTrees(scene);
    takeSky(scene);
    takeLights(scene);
    return other || !(units_ == before);
}

// The origin moves rarely: all that is known in the world is lost then.
void SceneOnDevice::follow(glm::dvec3 camera) {
    const glm::dvec3 next = originIsChosen_ ? followingOrigin(origin_, camera) : camera;
    if (originIsChosen_ && next == origin_) return;
    origin_ = next;
    originIsChosen_ = true;
    allAnew_ = true;
    ++origins_;
}

void SceneOnDevice::chooseUnits(GuestScene& scene) {
    const auto& all = scene.bounds();
    bounds_ = {};
    if (scene.instances().empty()) return;
    const Bounds metres{glm::vec3(all.min - origin_), glm::vec3(all.max - origin_)};
    const float diagonal = glm::length(metres.max - metres.min);
    float most = std::numbers::pi_v<float> * std::max(scene.mostEmissive(), scene.sky().mean);
    for (const GuestLight& l : scene.lights())
        most = std::max(most, gi::irradianceOf(l.light.intensity, l.light.kind == LightKind::kDirectional,
                                               l.light.range, diagonal));
    units_ = gi::chooseUnits(metres, most, units_);
    bounds_ = {metres.min / units_.length, metres.max / units_.length};
    extent_ = gi::steadyExtent(bounds_, extent_);
}

void SceneOnDevice::stage(std::span<const std::byte> bytes, const gpu::Buffer& to, uint64_t offset) {
    copies_.push_back({&to, offset, bytes_.size(), bytes.size()});
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
}

template <class T>
std::unique_ptr<gpu::Buffer> SceneOnDevice::make(const char* name, std::span<const T> items,
                                                 VkFormat texelFormat) {
    auto buffer = std::make_unique<gpu::Buffer>(
        context_, gpu::BufferDesc{.name = name,
                                  .sizeBytes = std::max<uint64_t>(items.size_bytes(), 64),
                                  .texelFormat = texelFormat});
    if (!items.empty()) stage(std::as_bytes(items), *buffer, 0);
    return buffer;
}

// The same into a buffer with room for some more, where that suffices.
template <class T>
void SceneOnDevice::fill(std::unique_ptr<gpu::Buffer>& buffer, const char* name, const std::vector<T>& items,
                         VkFormat texelFormat) {
    const uint64_t bytes = std::max<uint64_t>(items.size() * sizeof(T), 64);
    if (!buffer || buffer->sizeBytes() < bytes) {
        gpu::retire(context_, std::move(buffer));
        buffer = std::make_unique<gpu::Buffer>(
            context_, gpu::BufferDesc{.name = name,
                                      .sizeBytes = bytes + bytes / 2 / sizeof(T) * sizeof(T),
                                      .texelFormat = texelFormat});
    }
    if (!items.empty()) stage(std::as_bytes(std::span(items)), *buffer, 0);
}

void SceneOnDevice::takePoints(GuestScene& scene) {
    const GuestPoints& points = scene.points();
    const uint64_t set =
        combineHash(points.set, combineHash(hashValue(units_.length), hashValue(units_.light)));
    if (pointsSet_ == set) return;
    pointsSet_ = 0;
    const float area = 1 / (units_.length * units_.length);
    std::vector<float> areas = points.samples.pointAreas;
    for (float& a : areas)
        a *= area;
    std::vector<io::BouncePoint> bounces = points.reflecting, emissive = points.emissive;
    for (io::BouncePoint& e : emissive)
        e.albedo /= units_.light;
    for (auto* all : {&bounces, &emissive})
        for (io::BouncePoint& b : *all)
            b.area *= area;
    bounceArea_ = gi::meanArea(bounces);
    emissiveArea_ = gi::meanArea(emissive);
    emissiveFlux_ = gi::emittedFlux(emissive);
    sampleCount_ = uint32_t(points.samples.samples.size());
    staticCount_ = points.samples.staticCount;
    bounceCount_ = uint32_t(bounces.size());
    emissiveCount_ = uint32_t(emissive.size());
    bounces.insert(bounces.end(), emissive.begin(), emissive.end());
    for (auto* buffer : {&samples_, &pointAreas_, &bouncePoints_})
        gpu::retire(context_, std::move(*buffer));
    samples_ =
        make("guest.samples", std::span<const io::SurfaceSample>(points.samples.samples), gpu::kVec4Texels);
    pointAreas_ = make("guest.point_areas", std::span<const float>(areas), VK_FORMAT_R32_SFLOAT);
    bouncePoints_ =
        make("guest.bounce_points", std::span<const io::BouncePoint>(bounces), VK_FORMAT_UNDEFINED);
    pointsSet_ = set;
}

void SceneOnDevice::takeInstances(GuestScene& scene) {
    moved_.clear();
    if (!allAnew_ && movedVersion_ == scene.movedVersion()) return;
    const auto& instances = scene.instances();
    const uint64_t bytes = std::max<uint64_t>(instances.size(), 1) * sizeof(io::Instance);
    if (!instances_ || instances_->sizeBytes() < bytes) {
        gpu::retire(context_, std::move(instances_));
        instances_ =
            std::make_unique<gpu::Buffer>(context_, gpu::BufferDesc{.name = "guest.instances",
                                                                    .sizeBytes = bytes + bytes / 2,
                                                                    .texelFormat = gpu::kVec4Texels});
        allAnew_ = true;
    }
    rowBounds_.resize(instances.size());
    rowVersions_.resize(instances.size());
    bool staticMoved = allAnew_;
    size_t movedCount = 0;
    const float perMetre = 1 / units_.length;
    for (size_t row = 0; row < instances.size(); ++row) {
        const GuestInstance& instance = instances[row];
        if (!allAnew_ && instance.moved <= movedVersion_) continue;
        ++movedCount;
        staticMoved = staticMoved || !instance.movable;
        const GuestMesh& mesh = scene.meshes()[instance.mesh];
        const io::Instance packed = rowOf(instance, mesh.given.material, toOurs(instance.position), perMetre);
        stage(std::as_bytes(std::span(&packed, 1)), *instances_, row * sizeof packed);
        const Bounds b = GuestScene::boundsOf(instance, mesh.bounds, origin_);
        rowBounds_[row] = {b.min * perMetre, b.max * perMetre};
        rowVersions_[row] = combineHash(instance.moved, origins_);
        if (movedCount <= gi::kMostMovedThings)
            moved_.push_back({uint32_t(row), 0.5f * (rowBounds_[row].min + rowBounds_[row].max),
                              0.5f * glm::length(rowBounds_[row].max - rowBounds_[row].min)});
    }
    if (allAnew_ || movedCount > gi::kMostMovedThings) moved_.clear();
    if (staticMoved) ++staticVersion_;
    allAnew_ = false;
    setVersion_ = scene.setVersion();
    movedVersion_ = scene.movedVersion();
}

// Where what is static moved they are those of before until they are built anew, good for rays to the sky
// alone.
void SceneOnDevice::takeTrees(GuestScene& scene) {
    treesAreStale_ = upkeep_.next(scene.treesVersion()) == gi::TreeUpkeep::Task::kNone;
    if (!treesAreStale_) uploadTrees(scene);
    if (treesBuilt_ != 0) placeTrees(scene);
}

void SceneOnDevice::uploadTrees(GuestScene& scene) {
    const GuestTrees& trees = scene.trees();
    const float lightUnit = scene.mostEmissive() > 0 ? units_.light : 1;
    const uint64_t built = combineHash(combineHash(scene_, trees.version), hashValue(lightUnit));
    if (treesBuilt_ == built) return;
    treesBuilt_ = treesPlaced_ = 0;
    for (auto* buffer : {&treeNodes_, &treeTriangles_})
        gpu::retire(context_, std::move(*buffer));
    treeNodes_ = make("guest.tree_nodes", std::span<const glm::uvec4>(trees.trees.nodes), kWords);
    const std::vector<io::BvhTriangle> triangles = inLightUnits(trees.trees.triangles, lightUnit);
    treeTriangles_ = make("guest.tree_triangles", std::span<const io::BvhTriangle>(triangles), kWords);
    ranges_.everythingStatic = trees.trees.everythingStatic;
    ranges_.ofMesh = trees.trees.ofMesh;
    treesMiddle_ = trees.middle;
    treesBuilt_ = built;
}

// The static one lies about a place of its own in the world, in m: only where that is changes with origin and
// units.
void SceneOnDevice::placeTrees(const GuestScene& scene) {
    const glm::dvec3 from = origin_ - treesMiddle_;
    const uint64_t stand = combineHash(treesBuilt_, combineHash(hashValue(from), hashValue(units_.length)));
    const uint64_t placed = combineHash(stand, scene.movedVersion());
    if (treesPlaced_ == placed) return;
    treesPlaced_ = 0;
    const float perMetre = 1 / units_.length;
    std::vector<gi::SampledInstance> instances;
    for (const GuestInstance& i : scene.instances())
        if (i.movable && i.mesh < ranges_.ofMesh.size())  // others came since they were built
            instances.push_back({.worldFromLocal = glm::mat4x3(i.linear[0] * perMetre, i.linear[1] * perMetre,
                                                               i.linear[2] * perMetre, toOurs(i.position)),
                                 .mesh = i.mesh,
                                 .movable = true});
    gi::placeTrees(ranges_, instances, movers_);
    glm::mat4x3 treeFromOurs(units_.length);
    treeFromOurs[3] = glm::vec3(from);
    movers_.places[io::kBvhStatic] = gi::placeOf(ranges_.everythingStatic, treeFromOurs);
    fill(treePlaces_, "guest.tree_places", movers_.places, kWords);
    fill(moverNodes_, "guest.mover_nodes", movers_.nodes, kWords);
    treesStand_ = stand;
    treesPlaced_ = placed;
}

void SceneOnDevice::takeSky(const GuestScene& scene) {
    const GuestSky& sky = scene.sky();
    const uint64_t version = sky.version ? combineHash(sky.version, hashValue(units_.light)) : 0;
    if (skyVersion_ == version) return;
    skyVersion_ = 0;
    for (auto* buffer : {&skyTexels_, &skyCells_, &skyUpTo_})
        gpu::retire(context_, std::move(*buffer));
    if (version == 0) return;
    gi::SkyTable table = sky.table;
    for (io::SkyTexel& texel : table.texels)
        texel.radiance /= units_.light;
    for (auto* powers : {&table.cells, &table.upTo})
        for (float& power : *powers)
            power /= units_.light;
    skyTexels_ = make("guest.sky_texels", std::span<const io::SkyTexel>(table.texels), gpu::kVec4Texels);
    skyCells_ = make("guest.sky_cells", std::span<const float>(table.cells), VK_FORMAT_UNDEFINED);
    skyUpTo_ = make("guest.sky_up_to", std::span<const float>(table.upTo), VK_FORMAT_UNDEFINED);
    skyVersion_ = version;
}

void SceneOnDevice::takeLights(const GuestScene& scene) {
    const float perMetre = 1 / units_.length, perWatt = 1 / units_.light;
    lightsVersion_ = scene.lightsVersion();
    lights_.clear();
    for (const GuestLight& l : scene.lights()) {
        gi::RsmLight light = l.light;
        light.position = toOurs(l.position);
        light.range *= perMetre;
        light.intensity *= light.kind == LightKind::kDirectional ? perWatt : perWatt * perMetre * perMetre;
        lights_.push_back(light);
    }
    probes_.clear();
    for (const GuestProbe& p : scene.probes())
        probes_.push_back({.position = toOurs(p.position), .normal = p.normal, .id = p.id});
}

void SceneOnDevice::upload(VkCommandBuffer commands) {
    if (copies_.empty()) return;
    auto staging = std::make_unique<gpu::Buffer>(
        context_, gpu::BufferDesc{.name = "guest.staging", .sizeBytes = bytes_.size(), .hostVisible = true});
    std::memcpy(staging->mapped(), bytes_.data(), bytes_.size());
    const auto barrier = [&](VkPipelineStageFlags2 from, VkAccessFlags2 written, VkPipelineStageFlags2 to,
                             VkAccessFlags2 access) {
        const VkMemoryBarrier2 memory{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2, nullptr, from, written, to, access};
        const VkDependencyInfo info{
            .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &memory};
        context_.vk().CmdPipelineBarrier2(commands, &info);
    };
    barrier(VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, 0, VK_PIPELINE_STAGE_2_COPY_BIT,
            VK_ACCESS_2_TRANSFER_WRITE_BIT);
    for (const Copy& copy : copies_) {
        const VkBufferCopy region{copy.from, copy.offset, copy.sizeBytes};
        context_.vk().CmdCopyBuffer(commands, staging->handle(), copy.to->handle(), 1, &region);
    }
    barrier(VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT,
            VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, VK_ACCESS_2_MEMORY_READ_BIT);
    gpu::retire(context_, std::move(staging));
    copies_.clear();
    bytes_.clear();
}

uint64_t SceneOnDevice::placesVersion() const {
    return combineHash(combineHash(movedVersion_, setVersion_),
                       combineHash(origins_, hashValue(units_.length)));
}

gi::World SceneOnDevice::world() const {
    return {.lights = lights_,
            .bounds = bounds_,
            .versions = {.scene = combineHash(scene_, setVersion_),
                         .instances = placesVersion(),
                         .lights = lightsVersion_ + 1,
                         .camera = cameras_ + 1,
                         .origin = origins_},
            .moved = moved_,
            .extent = extent_};
}

gi::Occluders SceneOnDevice::occluders(GraphScope scope) const {
    gi::Occluders o{.instances = scope.importBuffer("guest.instances", *instances_, 1),
                    .sampleCount = sampleCount_,
                    .staticSampleCount = staticCount_,
                    .staticVersion = combineHash(combineHash(pointsSet_, staticVersion_), origins_),
                    .extent = extent_,
                    .rayOffset = gi::rayOffset(bounds_, extent_)};
    if (sampleCount_ == 0) return o;
    o.samples = scope.importBuffer("guest.samples", *samples_, pointsSet_);
    o.pointAreas = scope.importBuffer("guest.point_areas", *pointAreas_, pointsSet_);
    o.bouncePoints = scope.importBuffer("guest.bounce_points", *bouncePoints_, pointsSet_);
    o.bouncePointCount = bounceCount_;
    o.emissivePointCount = emissiveCount_;
    o.emissiveFlux = emissiveFlux_;
    o.bouncePointArea = bounceArea_;
    o.emissivePointArea = emissiveArea_;
    if (treesPlaced_ != 0)
        o.trees = {.nodes = scope.importBuffer("guest.tree_nodes", *treeNodes_, treesBuilt_),
                   .triangles = scope.importBuffer("guest.tree_triangles", *treeTriangles_, treesBuilt_),
                   .places = scope.importBuffer("guest.tree_places", *treePlaces_, treesPlaced_),
                   .moverNodes = scope.importBuffer("guest.mover_nodes", *moverNodes_, treesPlaced_),
                   .staticVersion = treesStand_,
                   .snapping = std::exp2(-float(context_.info().limits.subPixelPrecisionBits)),
                   .stale = treesAreStale_};
    return o;
}

gi::SkyOnDevice SceneOnDevice::sky(GraphScope scope) const {
    if (skyVersion_ == 0) return {};
    return {.texels = scope.importBuffer("guest.sky_texels", *skyTexels_, skyVersion_),
            .cells = scope.importBuffer("guest.sky_cells", *skyCells_, skyVersion_),
            .upTo = scope.importBuffer("guest.sky_up_to", *skyUpTo_, skyVersion_),
            .version = skyVersion_};
}

}  // namespace ag::guest
