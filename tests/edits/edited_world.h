// A world that random edits happen to: what they are follows from the seed alone.
#pragma once

#include <random>

#include "engine/core/settings.h"
#include "engine/ecs/schedule.h"
#include "engine/ecs/world.h"
#include "engine/jobs/job_graph.h"
#include "engine/renderer/render_settings.h"
#include "engine/scene/components.h"
#include "engine/scene/scene_asset.h"

namespace ag::test {

class EditedWorld {
  public:
    explicit EditedWorld(uint32_t seed);
    EditedWorld(const EditedWorld&) = delete;
    EditedWorld& operator=(const EditedWorld&) = delete;

    // One edit, or none, and the frame after it; says in words what was done.
    std::string step();

    const SceneAsset& asset() const { return asset_; }
    const RenderScene& scene() { return world_.resource<RenderScene>(); }
    glm::uvec2 size() const { return size_; }
    const render::RenderSettings& settings() const { return settings_; }

  private:
    std::string edit();
    std::string moveThing();
    std::string beginWalk();
    std::string walk();
    std::string addThing();
    std::string removeThing();
    std::string poseSkinnedMesh();
    std::string switchLight();
    std::string moveLight();
    std::string addLight();
    std::string removeLight();
    std::string moveCamera();
    std::string resize();
    std::string changeSetting();
    std::string resetSettings();
    Entity spawnLight(LightKind kind);

    uint32_t below(size_t count) { return uint32_t(random_() % count); }
    float between(float low, float high) { return low + (high - low) * float(random_() >> 8) * 0x1p-24f; }
    glm::vec3 inside() { return {between(-5, 5), between(0.5f, 3.5f), between(-3.5f, 3.5f)}; }

    std::mt19937 random_;
    SceneAsset asset_;
    World world_;
    Schedule schedule_;
    JobRunner runner_{1};
    std::vector<Entity> things_, lights_;  // skinned meshes are things too
    std::vector<MeshInstance> meshes_;     // that a new thing may have
    MeshInstance skinnedMeshMesh_;
    uint32_t walker_ = 0, walkFrames_ = 0;  // of the things, how long it walks on
    glm::uvec2 size_{48, 32};
    render::RenderSettings settings_;
    Settings registry_;  // defaults: small and quick
};

}  // namespace ag::test
