#include "engine/capture/world_source.h"

#include "engine/capture/schedule_spans.h"
#include "engine/scene/animation_system.h"
#include "engine/scene/spawn_scene.h"
#include "engine/scene/transform_system.h"

namespace ag::capture {
namespace {

struct Walk {           // resource
    glm::vec3 step{0};  // m a frame
};

void walkCamera(Res<const Walk> walk, Res<ActiveCamera> camera) {
    camera->pose.position += glm::dvec3(walk->step);
}

}  // namespace

WorldSource::WorldSource(const SceneAsset& asset, const RenderScene& asked, glm::uvec2 size, glm::vec3 step) {
    spawnScene(world_, asset);
    ActiveCamera& active = world_.setResource<ActiveCamera>();
    active.pose = poseOf(asked);
    active.size = size;
    world_.setResource<ExtractState>();
    world_.setResource<RenderScene>().geometry = &asset.geometry;
    world_.setResource<Walk>().step = step;

    schedule_.add("walkCamera", walkCamera);
    schedule_.add("updateRootTransforms", updateRootTransforms);
    schedule_.add("updateChildTransforms", updateChildTransforms);
    schedule_.add("poseSkinnedMeshes", poseSkinnedMeshes);
    schedule_.add("extractScene", extractScene);
}

const RenderScene& WorldSource::next(std::vector<Span>& systems) {
    schedule_.run(world_, runner_);
    noteSystems(schedule_, systems);
    return world_.resource<RenderScene>();
}

}  // namespace ag::capture
