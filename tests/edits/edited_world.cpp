#include "tests/edits/edited_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/renderer/probe_systems.h"
#include "engine/scene/animation_system.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/transform_system.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/figures.h"
#include "tools/scenegen/scenes.h"

namespace ag::test {
namespace {

constexpr size_t kMostThings = 28, kMostLights = 7;

// Every kind of surface the passes tell apart.
SceneAsset variedHall() {
    scenegen::SceneBuilder b(*scenegen::buildScene("hall", 0));
    const scenegen::PillarShape shape{.joints = 3, .rings = 8, .sides = 8};
    const uint32_t skinnedMesh = b.model("skinned mesh", scenegen::pillarParts(shape, 2, 1), glm::vec3(0));
    b.attach(skinnedMesh, b.place("under a skinned mesh", {1, 0.2f, 1}));
    const auto mesh = uint32_t(b.node(skinnedMesh).mesh);
    SceneAsset asset = b.finish();
    scenegen::addChains(asset, mesh, shape, 1);
    asset.nodes[skinnedMesh].extras.clipSpeed = 0;
    asset.nodes[skinnedMesh].extras.clipLoops = false;  // comes to rest by itself
    std::vector<Material>& materials = asset.geometry.materials;
    materials[0].alphaMode = AlphaMode::kMask;
    materials[1].doubleSided = true;
    materials[2].emissive = {0.4f, 0.3f, 0.1f};
    return asset;
}

// Small, so that a frame is quick, and soon at rest.
render::RenderSettings smallSettings() {
    render::RenderSettings gi;
    gi.bounce.rsm.resolution = 64;
    gi.bounce.valClustering.count = 24;
    gi.bounce.valClustering.settleFrames = 2;
    gi.bounce.ismAtlas.tileSize = 32;
    gi.bounce.ismAtlas.pointsPerMap = 128;
    gi.bounce.laterBounces.settleFrames = 2;
    gi.bounce.stochasticRsm.samples = 4;
    gi.bounce.stochasticRsm.settleFrames = 2;
    gi.shadowMaps.resolution = 64;
    gi.shadowMaps.cascades = 2;
    gi.lightClusters.most = 4;
    gi.punctualShadows.faceResolution = 32;
    gi.punctualShadows.atlasSize = 512;
    gi.bounce.refresh = {.lightFrames = 5, .pixelFrames = 3, .small = 0.5f};
    return gi;
}

}  // namespace

EditedWorld::EditedWorld(uint32_t seed) : random_(seed), asset_(variedHall()), settings_(smallSettings()) {
    render::registerSettings(registry_, settings_);
    for (const Entity entity : spawnScene(world_, asset_)) {
        if (world_.has<MeshInstance>(entity)) things_.push_back(entity);
        if (world_.has<PunctualLight>(entity)) lights_.push_back(entity);
    }
    for (const Entity thing : things_) {
        meshes_.push_back(*world_.get<MeshInstance>(thing));
        if (world_.has<SkinnedMesh>(thing)) skinnedMeshMesh_ = meshes_.back();
    }
    spawnLight(LightKind::kDirectional);
    for (const glm::dvec3 place : {glm::dvec3(-2, 1, 0), glm::dvec3(3, 1, 2)})
        world_.create(LocalTransform{.translation = place}, WorldTransform{}, render::IrradianceProbe{});
    world_.setResource<ExtractState>();
    world_.setResource<ActiveCamera>(cameraOf(asset_, 0), size_);
    world_.setResource<RenderScene>().geometry = &asset_.geometry;
    schedule_.add("playAnimations",
                  [](View<AnimationPlayer> players, Res<const SkinnedMeshLibrary> library,
                     JobRunner& runner) { advancePlayers(players, *library, 1.0f / 30, runner); });
    schedule_.add("updateRootTransforms", updateRootTransforms);
    schedule_.add("updateChildTransforms", updateChildTransforms);
    schedule_.add("poseSkinnedMeshes", poseSkinnedMeshes);
    schedule_.add("extractScene", extractScene);
    schedule_.add("extractProbes", render::extractProbes);
}

std::string EditedWorld::step() {
    const std::string done = edit();
    world_.resource<ActiveCamera>().size = size_;
    schedule_.run(world_, runner_);
    return done;
}

std::string EditedWorld::edit() {
    struct Kind {
        uint32_t weight;
        std::string (EditedWorld::*apply)();
    };
    static constexpr std::array kKinds = {
        Kind{17, &EditedWorld::moveThing},   Kind{3, &EditedWorld::beginWalk},
        Kind{5, &EditedWorld::addThing},     Kind{5, &EditedWorld::removeThing},
        Kind{14, &EditedWorld::switchLight}, Kind{9, &EditedWorld::moveLight},
        Kind{4, &EditedWorld::addLight},     Kind{4, &EditedWorld::removeLight},
        Kind{14, &EditedWorld::moveCamera},  Kind{6, &EditedWorld::poseSkinnedMesh},
        Kind{3, &EditedWorld::resize},       Kind{9, &EditedWorld::changeSetting},
        Kind{3, &EditedWorld::resetSettings}};
    if (walkFrames_ > 0) return walk();
    uint32_t at = below(100);
    for (const Kind& kind : kKinds) {
        if (at < kind.weight) return (this->*kind.apply)();
        at -= kind.weight;
    }
    return "nothing";
}

std::string EditedWorld::moveThing() {
    if (things_.empty()) return addThing();
    const uint32_t pick = below(things_.size());
    LocalTransform& local = *world_.write<LocalTransform>(things_[pick]);
    local.translation += glm::dvec3{between(-1, 1), between(-0.3f, 0.3f), between(-1, 1)};
    if (below(3) == 0) local.rotation = glm::angleAxis(between(0, 6), glm::vec3(0, 1, 0));
    return fmt::format("moved thing {}", pick);
}

// For some frames nothing but one thing moves, a little: what may then be late is.
std::string EditedWorld::beginWalk() {
    if (things_.empty()) return addThing();
    walker_ = below(things_.size());
    walkFrames_ = 4 + below(12);
    return fmt::format("thing {} begins to walk", walker_);
}

std::string EditedWorld::walk() {
    --walkFrames_;
    if (below(4) == 0) return "the walker waits";
    LocalTransform& local = *world_.write<LocalTransform>(things_[walker_]);
    local.translation += glm::dvec3{between(-0.1f, 0.1f), 0, between(-0.1f, 0.1f)};
    return "the walker walks";
}

std::string EditedWorld::addThing() {
    if (things_.size() >= kMostThings) return removeThing();
    MeshInstance mesh = meshes_[below(meshes_.size())];
    mesh.movable = below(2);
    things_.push_back(
        world_.create(LocalTransform{.translation = glm::dvec3(inside()), .scale = glm::vec3(0.5f)},
                      WorldTransform{}, mesh));
    return fmt::format("added a thing, movable: {}", mesh.movable);
}

std::string EditedWorld::removeThing() {
    if (things_.empty()) return addThing();
    const uint32_t pick = below(things_.size());
    world_.destroy(things_[pick]);
    things_.erase(things_.begin() + pick);
    return fmt::format("removed thing {}", pick);
}

// Starts, stops, takes another pose or its rest; now and then another skinned mesh comes.
std::string EditedWorld::poseSkinnedMesh() {
    std::vector<Entity> skinnedMeshes;
    for (const Entity thing : things_)
        if (world_.has<SkinnedMesh>(thing)) skinnedMeshes.push_back(thing);
    if (skinnedMeshes.empty() || (skinnedMeshes.size() < 3 && below(5) == 0)) {
        things_.push_back(world_.create(LocalTransform{.translation = glm::dvec3(inside()), .node = 0},
                                        WorldTransform{}, skinnedMeshMesh_, SkinnedMesh{},
                                        AnimationPlayer{.seconds = between(0, 1), .speed = 0, .loops = 0}));
        return "added a skinned mesh";
    }
    const uint32_t pick = below(skinnedMeshes.size()), what = below(4);
    AnimationPlayer& player = *world_.write<AnimationPlayer>(skinnedMeshes[pick]);
    if (what < 2) player.speed = player.speed == 0 ? between(-1, 2) : 0;
    if (what == 2) player.seconds = between(0, 1);
    if (what == 3) player.clip = player.clip < 0 ? 0 : -1;
    return fmt::format("posed skinned mesh {} ({})", pick, what);
}

// Off and on again, or something about it that does not move it.
std::string EditedWorld::switchLight() {
    if (lights_.empty()) return addLight();
    const uint32_t pick = below(lights_.size());
    const Entity entity = lights_[pick];
    PunctualLight& light = *world_.write<PunctualLight>(entity);
    const uint32_t what = below(6);
    if (what == 0) light.castsShadow = !light.castsShadow;
    if (what == 1) light.range = light.range > 0 ? 0 : between(1, 8);
    if (what == 2) light.intensity *= between(0.3f, 3);
    if (what == 3 && !world_.has<BounceLight>(entity)) {
        world_.add(entity, BounceLight{.rsmResolution = 32u << below(3)});
    } else if (what == 3) {
        world_.remove<BounceLight>(entity);
    } else if (what > 3) {
        const bool dark = light.intensity == glm::vec3(0);
        light.intensity = dark ? glm::vec3{between(1, 40), between(1, 40), between(1, 40)} : glm::vec3(0);
    }
    return fmt::format("switched light {} ({})", pick, what);
}

std::string EditedWorld::moveLight() {
    if (lights_.empty()) return addLight();
    const uint32_t pick = below(lights_.size());
    LocalTransform& local = *world_.write<LocalTransform>(lights_[pick]);
    if (below(2)) local.translation += glm::dvec3(inside() * 0.1f);
    local.rotation =
        glm::normalize(local.rotation * glm::angleAxis(between(-0.3f, 0.3f), glm::vec3(1, 0, 0)));
    return fmt::format("moved light {}", pick);
}

Entity EditedWorld::spawnLight(LightKind kind) {
    const Entity entity = world_.create(
        LocalTransform{.translation = glm::dvec3(inside()),
                       .rotation = glm::angleAxis(between(-2, -1), glm::vec3(1, 0, 0))},
        WorldTransform{},
        PunctualLight{
            .intensity = glm::vec3(between(2, 20)), .outerConeAngle = between(0.3f, 1.2f), .kind = kind});
    lights_.push_back(entity);
    return entity;
}

std::string EditedWorld::addLight() {
    if (lights_.size() >= kMostLights) return removeLight();
    const LightKind kind = LightKind(below(3));
    const Entity entity = spawnLight(kind);
    const bool bounces = below(2);
    if (bounces) world_.add(entity, BounceLight{.rsmResolution = 64});
    return fmt::format("added a light of kind {}, bounces: {}", uint32_t(kind), bounces);
}

std::string EditedWorld::removeLight() {
    if (lights_.empty()) return addLight();
    const uint32_t pick = below(lights_.size());
    world_.destroy(lights_[pick]);
    lights_.erase(lights_.begin() + pick);
    return fmt::format("removed light {}", pick);
}

// A step, a turn, a jump; now and then so far that everything is placed about another origin, and back.
std::string EditedWorld::moveCamera() {
    CameraPose& pose = world_.resource<ActiveCamera>().pose;
    const uint32_t what = below(12);
    if (what == 0) {
        pose.position.x += pose.position.x > 1000 ? -3000 : 3000;
        return "sent the camera far";
    }
    if (what < 6) pose.position += glm::dvec3{between(-0.2f, 0.2f), 0, between(-0.2f, 0.2f)};
    if (what >= 6)
        pose.forward =
            glm::normalize(pose.forward + glm::vec3{between(-0.3f, 0.3f), 0, between(-0.3f, 0.3f)});
    if (what == 11) pose = {.position = glm::dvec3(inside()), .forward = glm::normalize(-inside())};
    return fmt::format("moved the camera ({})", what);
}

std::string EditedWorld::resize() {
    static constexpr std::array kSizes = {glm::uvec2(48, 32), glm::uvec2(31, 45), glm::uvec2(1, 1),
                                          glm::uvec2(65, 17)};
    size_ = kSizes[below(kSizes.size())];
    return fmt::format("resized to {}x{}", size_.x, size_.y);
}

// Any setting there is; numbers stay near or under the small ones this starts with.
std::string EditedWorld::changeSetting() {
    const Setting& s = registry_.all()[below(registry_.all().size())];
    const double usual = s.defaultValue;
    double value = std::holds_alternative<bool*>(s.value) ? 1 - settingValue(s)
                   : s.info.choices.empty()
                       ? std::clamp(usual * double(between(0.25f, 1.5f)), s.info.min, s.info.max)
                       : double(below(s.info.choices.size()));
    if (std::holds_alternative<uint32_t*>(s.value) || std::holds_alternative<int32_t*>(s.value))
        value = std::round(value);
    const std::string text = fmt::format("{}.{}={}", s.info.group, s.info.name, settingText(s, value));
    const Status set = registry_.set(text);
    return set ? text : text + " was refused: " + set.error().message;
}

std::string EditedWorld::resetSettings() {
    settings_ = smallSettings();
    if (below(2)) settings_.technique = render::Technique(below(5));
    settings_.bounce.spacing = 1 + below(3);
    settings_.bounce.laterBounces.enabled = below(3) == 0;
    settings_.bounce.denoiser.enabled = below(3) == 0;
    return fmt::format("settings anew: first bounce {}, spacing {}, later bounces {}, denoiser {}",
                       uint32_t(settings_.technique), settings_.bounce.spacing,
                       settings_.bounce.laterBounces.enabled, settings_.bounce.denoiser.enabled);
}

}  // namespace ag::test
