#include "engine/scene/static_scene.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>
#include <utility>

#include "engine/core/projection.h"
#include "engine/scene/skinned_mesh.h"

namespace ag {
namespace {

constexpr size_t kMostBounceLights = 8;

glm::mat3 linearOf(const NodeTransform& t) {
    const glm::mat3 r = glm::mat3_cast(t.rotation);
    return glm::mat3(r[0] * t.scale.x, r[1] * t.scale.y, r[2] * t.scale.z);
}

Bounds boundsOf(const Bounds& local, const glm::mat4x3& m) {
    Bounds b;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? local.max.x : local.min.x, corner & 2 ? local.max.y : local.min.y,
                          corner & 4 ? local.max.z : local.min.z);
        b.add(m * glm::vec4(p, 1));
    }
    return b;
}

RenderLight lightOf(const SceneLight& light, const WorldPlacement& place, const glm::dvec3& origin,
                    uint64_t id) {
    RenderLight out{.kind = light.kind,
                    .position = glm::vec3(place.translation - origin),
                    .intensity = light.intensity,
                    .range = light.range,
                    .innerConeAngle = light.innerConeAngle,
                    .outerConeAngle = light.outerConeAngle,
                    .id = id};
    out.direction = glm::normalize(place.linear * glm::vec3(0, 0, -1));
    return out;
}

// As it is when its animation starts.
uint32_t placeSkinnedMesh(const SkinnedMeshLibrary& library, uint32_t model, const SceneNode& node,
                          RenderScene& scene) {
    const uint32_t skinnedMesh = addSkinnedMesh(library.models[model], scene);
    const RenderSkinnedMesh& row = scene.skinnedMeshes[skinnedMesh];
    poseSkinnedMesh(library, model, node.extras.clip, node.extras.clipStart,
                    std::span(scene.joints).subspan(row.firstJoint, row.jointCount));
    finishPose(library.models[model], scene, skinnedMesh);
    return skinnedMesh;
}

float strength(const RenderLight& light) {
    const float mean = (light.intensity.x + light.intensity.y + light.intensity.z) / 3;
    return light.kind == LightKind::kDirectional ? mean * 1e3f : mean;
}

// Of those that may, the strongest.
void chooseBounceLights(std::vector<RenderLight>& lights) {
    std::vector<size_t> order;
    for (size_t i = 0; i < lights.size(); ++i)
        if (std::exchange(lights[i].bounces, false)) order.push_back(i);
    std::ranges::stable_sort(order,
                             [&](size_t a, size_t b) { return strength(lights[a]) > strength(lights[b]); });
    for (size_t i = 0; i < std::min(order.size(), kMostBounceLights); ++i)
        lights[order[i]].bounces = true;
}

// A picture without perspective, nearly: from so far behind that what is two heights deeper looks 0.4 %
// smaller. What lies between is before the near plane.
CameraPose fromFarAway(const SceneCamera& camera, const WorldPlacement& place) {
    constexpr float kHeightsAway = 500;
    const glm::vec3 forward = glm::normalize(place.linear * glm::vec3(0, 0, -1));
    const float height = camera.orthographicHeight, distance = kHeightsAway * height;
    return {.position = place.translation - glm::dvec3(forward) * double(distance),
            .forward = forward,
            .up = place.linear * glm::vec3(0, 1, 0),
            .verticalFov = 2 * std::atan(0.5f * height / distance),
            .near = distance + camera.near};
}

}  // namespace

glm::vec3 rightOf(glm::vec3 forward, glm::vec3 up) {
    constexpr float kLeastSine = 1e-4f;
    const glm::vec3 across = glm::cross(forward, up);
    if (glm::length(across) > kLeastSine * glm::length(up)) return glm::normalize(across);
    const glm::vec3 tilted(0, 0, forward.y > 0 ? 1 : -1);
    const glm::vec3 right = glm::cross(forward, tilted);
    return glm::length(right) > kLeastSine ? glm::normalize(right) : glm::vec3(1, 0, 0);
}

uint64_t triangleCount(const SceneAsset& asset) {
    uint64_t count = 0;
    for (const SceneNode& node : asset.nodes) {
        if (node.mesh < 0) continue;
        const SceneMesh& mesh = asset.meshes[size_t(node.mesh)];
        for (uint32_t p = 0; p < mesh.primitiveCount; ++p)
            count += asset.geometry.primitives[mesh.firstPrimitive + p].indexCount / 3;
    }
    return count;
}

std::vector<WorldPlacement> placeNodes(const SceneAsset& asset) {
    std::vector<WorldPlacement> places(asset.nodes.size());
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const SceneNode& node = asset.nodes[i];
        const WorldPlacement parent = node.parent < 0 ? WorldPlacement{} : places[size_t(node.parent)];
        places[i] = {parent.linear * linearOf(node.local),
                     parent.translation + glm::dmat3(parent.linear) * node.local.translation};
    }
    return places;
}

glm::dvec3 likelyView(const SceneAsset& asset) {
    const auto firstWith = [&](int32_t SceneNode::*part) {
        return std::ranges::find_if(asset.nodes, [&](const SceneNode& n) { return n.*part >= 0; });
    };
    auto node = firstWith(&SceneNode::camera);
    if (node == asset.nodes.end()) node = firstWith(&SceneNode::mesh);
    if (node == asset.nodes.end()) return glm::dvec3(0);
    return placeNodes(asset)[size_t(node - asset.nodes.begin())].translation;
}

CameraPose framingCamera(const Bounds& bounds) {
    if (bounds.empty()) return {};
    constexpr float kMargin = 1.1f;
    const glm::vec3 center = (bounds.min + bounds.max) * 0.5f, half = (bounds.max - bounds.min) * 0.5f;
    const float radius = std::max(glm::length(half), 1e-4f);
    const glm::vec3 forward = glm::normalize(glm::vec3(-0.5f, -0.35f, -0.8f));
    const glm::vec3 right = rightOf(forward, {0, 1, 0}), top = glm::cross(right, forward);
    CameraPose pose;
    const float slope = std::tan(pose.verticalFov * 0.5f) / kMargin;
    float distance = 0;  // at which every corner of the box is within the picture, of any shape
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 c = half * glm::vec3(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float aside = std::max(std::abs(glm::dot(c, right)), std::abs(glm::dot(c, top)));
        distance = std::max(distance, aside / slope - glm::dot(c, forward));
    }
    pose.position = glm::dvec3(center - forward * distance);
    pose.forward = forward;
    pose.near = std::min(0.05f, radius * 0.01f);
    return pose;
}

CameraPose cameraOf(const SceneAsset& asset, size_t index) {
    const std::vector<WorldPlacement> places = placeNodes(asset);
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        if (asset.nodes[i].camera != int32_t(index)) continue;
        const SceneCamera& camera = asset.cameras[index];
        if (camera.orthographicHeight > 0) return fromFarAway(camera, places[i]);
        return {.position = places[i].translation,
                .forward = glm::normalize(places[i].linear * glm::vec3(0, 0, -1)),
                .up = places[i].linear * glm::vec3(0, 1, 0),
                .verticalFov = camera.verticalFov,
                .near = camera.near};
    }
    const RenderScene scene = staticScene(asset, likelyView(asset));
    CameraPose pose = framingCamera(scene.bounds);
    pose.position += scene.originWorld;
    return pose;
}

RenderScene staticScene(const SceneAsset& asset, glm::dvec3 originWorld) {
    RenderScene scene;
    scene.geometry = &asset.geometry;
    const std::vector<WorldPlacement> places = placeNodes(asset);
    const SkinnedMeshLibrary library = makeSkinnedMeshLibrary(asset);
    scene.originWorld = originWorld;
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        const SceneNode& node = asset.nodes[i];
        if (node.light >= 0) {
            scene.lights.push_back(lightOf(asset.lights[size_t(node.light)], places[i], scene.originWorld,
                                           scene.lights.size() + 1));
            scene.lights.back().bounces = scene.lights.back().reflects = node.extras.bounces;
            scene.lights.back().castsShadow = node.extras.castsShadow;
        }
        if (node.mesh < 0) continue;
        const int32_t model = library.modelOfNode[i];
        const uint32_t skinnedMesh =
            model < 0 ? kNoSkinnedMesh : placeSkinnedMesh(library, uint32_t(model), node, scene);
        const int32_t frame = model < 0 ? int32_t(i) : library.models[size_t(model)].frame;
        const WorldPlacement place = frame < 0 ? WorldPlacement{} : places[size_t(frame)];
        const SceneMesh& mesh = asset.meshes[size_t(node.mesh)];
        const glm::mat3& m = place.linear;
        const glm::mat4x3 world(m[0], m[1], m[2], glm::vec3(place.translation - scene.originWorld));
        for (uint32_t p = mesh.firstPrimitive; p < mesh.firstPrimitive + mesh.primitiveCount; ++p) {
            scene.instances.push_back({world, p, model >= 0, skinnedMesh});
            scene.bounds.add(worldBounds(scene, scene.instances.back()));
        }
    }
    scene.sky = asset.sky;
    chooseBounceLights(scene.lights);
    return scene;
}

std::vector<int32_t> placingNodes(const SceneAsset& asset) {
    const SkinnedMeshLibrary library = makeSkinnedMeshLibrary(asset);
    std::vector<int32_t> nodes;
    for (size_t i = 0; i < asset.nodes.size(); ++i) {
        if (asset.nodes[i].mesh < 0) continue;
        const int32_t model = library.modelOfNode[i];
        nodes.insert(nodes.end(), asset.meshes[size_t(asset.nodes[i].mesh)].primitiveCount,
                     model < 0 ? int32_t(i) : library.models[size_t(model)].frame);
    }
    return nodes;
}

Bounds worldBounds(const RenderScene& scene, const RenderInstance& instance) {
    return boundsOf(boundsLocal(scene, instance), instance.worldFromLocal);
}

void setCamera(RenderScene& scene, const CameraPose& pose, glm::uvec2 size) {
    const float aspect = float(size.x) / float(size.y);
    const glm::vec3 position(pose.position - scene.originWorld);
    const glm::vec3 right = rightOf(pose.forward, pose.up);
    const glm::vec3 top = glm::cross(right, pose.forward);
    glm::dmat4 view(1);
    for (int i = 0; i < 3; ++i)
        view[i] = glm::dvec4(right[i], top[i], -pose.forward[i], 0);
    view[3] =
        glm::dvec4(-glm::dot(right, position), -glm::dot(top, position), glm::dot(pose.forward, position), 1);
    const glm::dmat4 clip =
        glm::dmat4(reversedInfinitePerspective(pose.verticalFov, aspect, pose.near)) * view;
    const glm::mat4 clipFromWorld(clip);
    if (scene.camera.clipFromWorld == clipFromWorld && scene.camera.position == position) return;
    scene.camera = {.clipFromWorld = clipFromWorld,
                    .worldFromClip = glm::mat4(glm::inverse(clip)),
                    .position = position,
                    .forward = pose.forward,
                    .up = top,
                    .verticalFov = pose.verticalFov,
                    .near = pose.near};
    ++scene.cameraVersion;
}

void shiftCamera(RenderScene& scene, glm::vec3 step) {
    RenderCamera& camera = scene.camera;
    camera.position += step;
    camera.clipFromWorld = glm::translate(camera.clipFromWorld, -step);
    camera.worldFromClip = glm::inverse(camera.clipFromWorld);
    ++scene.cameraVersion;
}

bool hasEmissive(const RenderScene& scene) {
    const GeometryArrays& g = *scene.geometry;
    return std::any_of(scene.instances.begin(), scene.instances.end(), [&](const RenderInstance& i) {
        return i.isPresent() && g.materials[g.primitives[i.primitive].material].emissive != glm::vec3(0);
    });
}

CameraPose poseOf(const RenderScene& scene) {
    const RenderCamera& c = scene.camera;
    return {.position = glm::dvec3(c.position) + scene.originWorld,
            .forward = c.forward,
            .up = c.up,
            .verticalFov = c.verticalFov,
            .near = c.near};
}

}  // namespace ag
