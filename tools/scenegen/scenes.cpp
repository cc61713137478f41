#include "tools/scenegen/scenes.h"

#include <algorithm>
#include <array>

#include "engine/scene/gltf_import.h"
#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

constexpr glm::vec3 kRed(0.63f, 0.065f, 0.05f), kGreen(0.14f, 0.45f, 0.091f), kWhite(0.725f, 0.71f, 0.68f);

// The box of Goral et al. at Cornell, 2 m a side, open towards the camera; a spot in the ceiling's middle
// shines on the floor and the lower walls. param 1 leaves the two blocks out.
SceneAsset cornell(uint32_t param) {
    SceneBuilder b("cornell");
    const uint32_t red = b.material("red", kRed), green = b.material("green", kGreen),
                   white = b.material("white", kWhite);
    b.room("room", {-1, 0, -1}, {1, 2, 1}, {red, green, white, white, white, ~0u});
    if (param != 1) {
        b.box("tall", {-0.35f, 0.6f, -0.3f}, {0.6f, 1.2f, 0.6f}, white, 0.3f);
        b.box("short", {0.35f, 0.3f, 0.35f}, {0.6f, 0.6f, 0.6f}, white, -0.3f);
    }
    b.spot("lamp", {0, 1.98f, 0}, {0, -1, 0}, glm::vec3(10), 40, 70);
    b.camera("camera", {0, 1, 4.0f}, {0, 1, 0}, 36);
    return b.finish();
}

// A floor [0,2] x [-1,1] in the plane y = 0 and a wall in the plane x = 0, y in [0,2], z in [-1,1]. The sun
// falls straight down, so only the floor is lit: the wall's irradiance is the form factor of a uniform
// rectangle of radiosity rho E = 0.5 x 4 W/m².
SceneAsset corner(uint32_t) {
    SceneBuilder b("corner");
    const uint32_t gray = b.material("gray", glm::vec3(0.5f));
    b.quad("floor", {0, 0, -1}, {0, 0, 2}, {2, 0, 0}, gray);
    b.quad("wall", {0, 0, -1}, {0, 2, 0}, {0, 0, 2}, gray);
    b.sun("sun", {0, -1, 0}, glm::vec3(4));
    b.camera("camera", {3.2f, 1.8f, 0}, {0.4f, 0.6f, 0}, 42);
    return b.finish();
}

// A slab between the lit left wall and the rest of the room: most bounced light is blocked.
SceneAsset occluder(uint32_t) {
    SceneBuilder b("occluder");
    const uint32_t red = b.material("red", kRed), white = b.material("white", kWhite);
    b.room("room", {-2, 0, -1.5f}, {2, 2, 1.5f}, {red, white, white, white, white, ~0u});
    b.box("slab", {-0.6f, 0.7f, 0}, {0.2f, 1.4f, 2.0f}, white);
    b.spot("lamp", {-0.9f, 1.9f, 0}, {-1, -0.9f, 0}, glm::vec3(10), 20, 40);
    b.camera("camera", {0.6f, 1.1f, 4.2f}, {0, 0.9f, 0}, 40);
    return b.finish();
}

// A closed box of albedo rho = param / 100 (default 0.5) with a point light in its middle.
SceneAsset furnace(uint32_t param) {
    SceneBuilder b("furnace");
    const uint32_t gray = b.material("gray", glm::vec3(param ? float(param) / 100.0f : 0.5f));
    b.room("room", {-1, -1, -1}, {1, 1, 1}, {gray, gray, gray, gray, gray, gray});
    b.point("lamp", {0, 0, 0}, glm::vec3(1));
    b.camera("camera", {0.7f, 0.2f, 0.8f}, {-0.5f, -0.2f, -0.6f}, 60);
    return b.finish();
}

void mover(SceneBuilder& b, uint32_t node, glm::vec3 extent, float period, float spin) {
    b.node(node).extras = {.collider = true, .moveExtent = extent, .movePeriod = period, .spinSpeed = spin};
}

void solid(SceneBuilder& b, uint32_t node) {
    b.node(node).extras.collider = true;
}

// The first room of the level: a dark hall, 12 x 4 x 8 m, with one wall of each colour, columns, and boxes
// that move. The lamp in the player's hand is the light to play with.
SceneAsset gallery(uint32_t) {
    SceneBuilder b("gallery");
    const uint32_t red = b.material("red", {0.70f, 0.08f, 0.06f}),
                   green = b.material("green", {0.12f, 0.52f, 0.14f}),
                   blue = b.material("blue", {0.08f, 0.16f, 0.62f}),
                   ochre = b.material("ochre", {0.74f, 0.50f, 0.14f}),
                   floor = b.material("floor", {0.42f, 0.38f, 0.34f}),
                   white = b.material("white", {0.75f, 0.74f, 0.72f});
    b.room("hall", {-6, 0, -4}, {6, 4, 4}, {red, green, floor, white, blue, ochre});
    for (const float x : {-3.0f, 0.0f, 3.0f})
        for (const float z : {-2.2f, 2.2f})
            solid(b, b.box("column", {x, 2, z}, {0.5f, 4, 0.5f}, white));
    solid(b, b.box("plinth red", {-4.6f, 0.5f, -2.8f}, {0.9f, 1, 0.9f}, red));
    solid(b, b.box("plinth green", {4.6f, 0.5f, 2.8f}, {0.9f, 1, 0.9f}, green));
    solid(b, b.box("screen", {1.5f, 1.2f, 0}, {0.15f, 2.4f, 2.2f}, ochre));
    mover(b, b.box("slider", {-1.5f, 0.4f, -0.4f}, {0.8f, 0.8f, 0.8f}, white), {0, 0, 1.6f}, 6, 0);
    mover(b, b.box("spinner", {4.2f, 0.9f, -1.6f}, {0.6f, 1.8f, 0.6f}, blue), {}, 0, 0.7f);
    mover(b, b.box("lift", {-4.4f, 1.0f, 1.6f}, {0.7f, 0.7f, 0.7f}, ochre), {0, 0.8f, 0}, 5, 0.5f);
    b.spot("ceiling lamp", {4.0f, 3.9f, -1.0f}, {0.3f, -1, -0.6f}, glm::vec3(40, 37, 31), 25, 50);
    b.spot("hand_lamp", {-1.2f, 1.5f, 1.0f}, {-1, -0.15f, -0.35f}, glm::vec3(90, 84, 72), 16, 34);
    b.camera("player", {0.8f, 1.65f, 1.4f}, {-4.0f, 1.3f, -1.0f}, 65);
    return b.finish();
}

struct Entry {
    std::string_view name;
    SceneAsset (*build)(uint32_t param);
};

constexpr std::array<Entry, 5> kScenes = {{{"cornell", cornell},
                                           {"corner", corner},
                                           {"occluder", occluder},
                                           {"furnace", furnace},
                                           {"gallery", gallery}}};
constexpr std::array<std::string_view, 5> kNames = {"cornell", "corner", "occluder", "furnace", "gallery"};

}  // namespace

std::span<const std::string_view> sceneNames() {
    return kNames;
}

bool isBuiltIn(std::string_view name) {
    return std::ranges::find(kNames, name) != kNames.end();
}

Result<SceneAsset> buildScene(std::string_view name, uint32_t param) {
    const auto found = std::ranges::find(kScenes, name, &Entry::name);
    if (found == kScenes.end()) return Error{"there is no built-in scene named " + std::string(name)};
    return found->build(param);
}

Result<SceneAsset> resolveScene(const std::string& nameOrPath, uint32_t param) {
    return isBuiltIn(nameOrPath) ? buildScene(nameOrPath, param) : importGltf(nameOrPath);
}

}  // namespace ag::scenegen
