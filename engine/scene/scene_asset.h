// An imported or generated scene as plain data: geometry ready for the GPU, a node tree, lights, cameras,
// skins, animations.
#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/render_scene.h"

namespace ag {

struct NodeTransform {          // relative to the parent
    glm::dvec3 translation{0};  // m
    glm::quat rotation{1, 0, 0, 0};
    glm::vec3 scale{1};
};

// What a node's glTF extras may say; the game reads it.
struct NodeExtras {
    bool collider = false;    // solid for the player
    glm::vec3 moveExtent{0};  // m: slides to and fro by this much
    float movePeriod = 0;     // s, 0: stands still
    float spinSpeed = 0;      // rad/s about +Y
    // Of a light
    bool bounces = true;  // may be among those whose bounced light is found
    bool castsShadow = true;
    float flickerDepth = 0;   // part of it that comes and goes, 0 to 1
    float flickerPeriod = 0;  // s between turns, 0: burns steadily
    float flickerOff = 0;     // part of the turns in which it is off, 0 to 1
    // Of a thing in a game
    std::string tag;         // what it is: "flower", "door", ...
    std::string text;        // of a hint
    int32_t room = -1;       // it belongs to
    glm::vec3 wants{0};      // of a flower: colour of light, the greatest channel 1
    float amount = 0;        // of a flower: W/m²
    bool openToSky = false;  // of a room: it has no ceiling
    bool shy = false;        // of a flower: the amount is the most it bears
    float mass = 0;          // kg, 0: does not fall
    glm::vec3 pivot{0};      // m, of a hinge, in the node's frame
    glm::vec3 axis{0};       // of a hinge, unit; zero: none
    float least = 0;         // rad, where the hinge stops; least > most: it does not
    float most = 0;          // rad
    float swing = 0;         // rad, of a pendulum; its rest is straight down
    // Of a node that moves by an animation or whose mesh is bent by one
    int32_t clip = 0;     // the animation, -1: none
    float clipStart = 0;  // s
    float clipSpeed = 1;  // times its own; 0: it holds the pose
    bool clipLoops = true;
};

struct SceneNode {
    std::string name;
    int32_t parent = -1;  // an earlier node, -1: root
    uint32_t depth = 0;
    NodeTransform local;
    int32_t mesh = -1, light = -1, camera = -1, skin = -1;
    int32_t source = -1;  // the node of the file; -1: none, or a copy that its parent stands for there
    NodeExtras extras;
};

struct SceneMesh {
    std::string name;
    uint32_t firstPrimitive = 0, primitiveCount = 0;
};

struct SceneLight {  // KHR_lights_punctual; shines along the node's -Z
    std::string name;
    LightKind kind = LightKind::kPoint;
    glm::vec3 intensity{1};                                // W/sr; directional: W/m²
    float range = 0;                                       // m, 0: none
    float innerConeAngle = 0, outerConeAngle = 0.785398f;  // radians
};

struct SceneCamera {  // looks along the node's -Z
    std::string name;
    float verticalFov = 0.8f;      // radians
    float near = 0.05f;            // m
    float orthographicHeight = 0;  // m, of a picture without perspective; 0: it has one
};

enum class FeatureSupport : uint32_t { kUsed, kApproximated, kNotSupported };

// One thing that a file asks for, and what becomes of it.
struct SceneFeature {
    std::string name;   // of the extension, or in plain words
    uint64_t uses = 0;  // how often the file asks for it
    FeatureSupport support = FeatureSupport::kUsed;
    std::string note;  // how it is approximated, or what is missing without it
};

struct SceneSkin {
    std::string name;
    std::vector<uint32_t> joints;        // nodes
    std::vector<glm::mat4> inverseBind;  // one a joint
};

enum class ChannelPath : uint32_t { kTranslation, kRotation, kScale };
enum class Interpolation : uint32_t { kStep, kLinear, kCubic };

// What happens to one part of a node's transform.
struct SceneChannel {
    uint32_t node = 0;
    ChannelPath path = ChannelPath::kTranslation;
    Interpolation interpolation = Interpolation::kLinear;
    std::vector<float> times;       // s, rising
    std::vector<glm::vec4> values;  // rotations: x y z w; one a time, kCubic: tangent in, value, tangent out
};

struct SceneAnimation {
    std::string name;
    float duration = 0;  // s, when its last channel ends
    std::vector<SceneChannel> channels;
};

struct SceneAsset {
    std::string name;
    GeometryArrays geometry;
    std::vector<SceneNode> nodes;  // parents before children
    std::vector<SceneMesh> meshes;
    std::vector<SceneLight> lights;
    std::shared_ptr<const Sky> sky;  // null: black
    std::vector<SceneCamera> cameras;
    std::vector<SceneSkin> skins;
    std::vector<SceneAnimation> animations;
    std::vector<std::string> warnings;   // one sentence each
    std::vector<SceneFeature> features;  // of the file it came from
};

uint64_t triangleCount(const SceneAsset& asset);  // as drawn: counted for every instance

}  // namespace ag
