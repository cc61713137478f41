#include "tools/scenegen/scenes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "common/false_color.h"
#include "engine/core/near_name.h"
#include "engine/core/number.h"
#include "engine/core/safe_file.h"
#include "engine/scene/gltf_import.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/figures.h"
#include "tools/scenegen/gallery.h"
#include "tools/scenegen/openings.h"
#include "tools/scenegen/room.h"
#include "tools/scenegen/shining.h"
#include "tools/scenegen/town.h"

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
    b.spot("lamp", {0, 1.98f, 0}, {0, -1, 0}, glm::vec3(10), {40, 70});
    // A little off the middle, so that the room's edges do not run exactly through pixel centres.
    b.camera("camera", {0.03f, 1.02f, 4.0f}, {0.01f, 1, 0}, 36);
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
    b.spot("lamp", {-0.9f, 1.9f, 0}, {-1, -0.9f, 0}, glm::vec3(10), {20, 40});
    b.camera("camera", {0.6f, 1.1f, 4.2f}, {0, 0.9f, 0}, 40);
    return b.finish();
}

// A lit wall in two colours before a glossy floor and a metal ball, of roughness param / 100 (default 0.3).
// The lamp reaches Lambert surfaces alone, so that gloss shows in receivers and nowhere else.
SceneAsset glossy(uint32_t param) {
    SceneBuilder b("glossy");
    const float roughness = param ? float(param) / 100.0f : 0.3f;
    const uint32_t red = b.material("red", kRed), green = b.material("green", kGreen),
                   white = b.material("white", kWhite), floor = b.material("floor", glm::vec3(0.2f)),
                   metal = b.material("metal", {0.9f, 0.7f, 0.4f});
    b.materialAt(floor).roughness = b.materialAt(metal).roughness = roughness;
    b.materialAt(floor).specular = 1;
    b.materialAt(metal).metallic = 1;
    b.room("room", {-2, 0, -1.5f}, {2, 2, 1.5f}, {white, white, floor, white, ~0u, ~0u});
    b.quad("left", {-2, 0, -1.5f}, {2, 0, 0}, {0, 2, 0}, red);
    b.quad("right", {0, 0, -1.5f}, {2, 0, 0}, {0, 2, 0}, green);
    std::vector<glm::vec2> arc;
    for (int i = 0; i <= 32; ++i) {
        const float angle = 3.14159265f * float(i) / 32;
        arc.push_back({0.35f * std::sin(angle), -0.35f * std::cos(angle)});
    }
    MeshParts ball;
    addLathe(ball, metal, arc, 64, glm::vec3(0));
    b.model("ball", ball, {0.7f, 0.35f, 0.1f});
    b.spot("lamp", {0, 1.7f, 0.6f}, {0, -0.15f, -1}, glm::vec3(10), {20, 28});
    b.camera("camera", {0.05f, 1.1f, 4.1f}, {0, 0.6f, 0}, 38);
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

// A dark hall, 12 x 4 x 8 m, with one wall of each colour, columns, and boxes that move. Two lamps.
SceneAsset hall(uint32_t) {
    SceneBuilder b("hall");
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
    b.spot("ceiling lamp", {4.0f, 3.9f, -1.0f}, {0.3f, -1, -0.6f}, glm::vec3(40, 37, 31), {25, 50});
    b.spot("hand_lamp", {-1.2f, 1.5f, 1.0f}, {-1, -0.15f, -0.35f}, glm::vec3(90, 84, 72), {16, 34});
    b.camera("player", {0.8f, 1.65f, 1.4f}, {-4.0f, 1.3f, -1.0f}, 65);
    return b.finish();
}

// An arcade 12 m long: the sun falls through the openings between piers onto a floor and onto three curtains,
// red, green and blue, that hang before the far wall. Nearly all its light is the curtains' and the floor's.
SceneAsset corridor(uint32_t) {
    SceneBuilder b("corridor");
    const uint32_t stone = b.material("stone", {0.62f, 0.58f, 0.52f}),
                   floor = b.material("floor", {0.45f, 0.40f, 0.35f}),
                   red = b.material("red curtain", {0.70f, 0.06f, 0.05f}),
                   green = b.material("green curtain", {0.08f, 0.48f, 0.12f}),
                   blue = b.material("blue curtain", {0.07f, 0.13f, 0.60f});
    constexpr uint32_t kOpen = ~0u;
    b.room("hall", {-6, 0, -1.5f}, {6, 3.2f, 1.5f}, {stone, stone, floor, stone, stone, kOpen});
    for (int i = 0; i <= 6; ++i)
        b.box("pier", {-6 + 2.0f * float(i), 1.3f, 1.65f}, {0.6f, 2.6f, 0.3f}, stone);
    b.box("lintel", {0, 2.9f, 1.65f}, {12.6f, 0.6f, 0.3f}, stone);
    b.box("sill", {0, 0.15f, 1.65f}, {12.6f, 0.3f, 0.3f}, stone);
    for (int i = 0; i < 3; ++i) {
        const uint32_t cloth = i == 0 ? red : i == 1 ? green : blue;
        const float x = -3.6f + 3.6f * float(i);
        for (int fold = 0; fold < 8; ++fold)  // a zigzag of narrow boxes
            b.box("fold", {x - 0.875f + 0.25f * float(fold), 1.35f, -1.3f}, {0.27f, 2.3f, 0.02f}, cloth,
                  fold % 2 ? 0.45f : -0.45f);
    }
    b.sun("sun", {0.3f, -0.38f, -0.87f}, glm::vec3(12, 11.2f, 10));
    b.camera("camera", {5.4f, 1.7f, 0.4f}, {-4, 1.2f, -0.4f}, 55);
    return b.finish();
}

// A columned hall, 24 x 5 x 16 m, under `param` lamps (default 14): points of light in a jittered grid, each
// with its own colour and a range that lets about ten of them reach any place. Boxes move among the columns;
// some lamps flicker, go on and off or swing.
SceneAsset lamps(uint32_t param) {
    const uint32_t count = param ? param : 14;
    SceneBuilder b("lamps");
    const uint32_t stone = b.material("stone", {0.60f, 0.58f, 0.55f}),
                   floor = b.material("floor", {0.50f, 0.46f, 0.42f}),
                   wall = b.material("wall", {0.66f, 0.60f, 0.50f}),
                   crate = b.material("crate", {0.62f, 0.42f, 0.20f});
    const glm::vec3 half(12, 5, 8);
    b.room("hall", {-half.x, 0, -half.z}, half, {wall, wall, floor, stone, wall, wall});
    uint32_t column = ~0u;
    for (int x = -2; x <= 2; ++x)
        for (const float z : {-4.5f, 0.0f, 4.5f}) {
            const glm::vec3 at(4.4f * float(x), 2.5f, z);
            column =
                column == ~0u ? b.box("column", at, {0.6f, 5, 0.6f}, stone) : b.copy(column, "column", at);
        }
    for (int i = 0; i < 6; ++i)
        mover(b, b.box("crate", {-9 + 3.6f * float(i), 0.5f, i % 2 ? 2.2f : -2.2f}, {0.9f, 1, 0.9f}, crate),
              {0, 0, i % 2 ? -1.2f : 1.2f}, 5 + 0.7f * float(i), 0.4f);
    const float area = 4 * half.x * half.z, spacing = std::sqrt(area / float(count)),
                range = std::max(1.8f * spacing, 2.5f);
    for (uint32_t i = 0; i < count; ++i) {
        const float r1 = io::hashToUnit(2 * i), r2 = io::hashToUnit(2 * i + 1);
        const glm::vec2 at = io::hammersley(i, count);
        const glm::vec3 place((2 * at.x - 1) * (half.x - 0.6f), 1.6f + 2.6f * r1,
                              (2 * at.y - 1) * (half.z - 0.6f));
        const glm::vec3 tint = glm::mix(glm::vec3(1), io::hueFromIndex(i), 0.6f);
        const uint32_t lamp =
            b.point(fmt::format("lamp {}", i), place, tint * (0.35f + 0.5f * r2) * spacing * spacing, range);
        NodeExtras& extras = b.node(lamp).extras;
        if (i % 4 == 1) extras = {.flickerDepth = 0.5f, .flickerPeriod = 0.15f};  // a flame
        if (i % 8 == 3)
            extras = {.flickerDepth = 0.1f, .flickerPeriod = 2 + r1, .flickerOff = 0.3f};     // on and off
        if (i % 8 == 6) extras = {.moveExtent = {0.4f, 0, 0.3f * r2}, .movePeriod = 4 + r1};  // swings
    }
    b.camera("camera", {-11, 2.4f, 6.6f}, {4, 1.2f, -2}, 60);
    return b.finish();
}

constexpr uint32_t kSkinnedMeshEvery = 32, kMostCrowdSkinnedMeshes = 64;
constexpr float kCrowdSway = 3;  // s

bool isSkinnedMesh(uint32_t i) {
    const uint32_t row = i / kSkinnedMeshEvery;
    return row < kMostCrowdSkinnedMeshes &&
           i % kSkinnedMeshEvery == (11 * row + kSkinnedMeshEvery - 1) % kSkinnedMeshEvery;
}

// `param` moving things (default 256) over a floor among four coloured walls, lit by a strong spot: boxes of
// one mesh, and in a place of every 32 a swaying skinned mesh, 64 at most.
SceneAsset crowd(uint32_t param) {
    const uint32_t count = param ? param : 256;
    SceneBuilder b("crowd");
    const uint32_t floor = b.material("floor", {0.55f, 0.53f, 0.50f}), red = b.material("red", kRed),
                   green = b.material("green", kGreen), white = b.material("white", kWhite),
                   box = b.material("box", {0.60f, 0.50f, 0.34f});
    const float side = std::sqrt(float(count)), half = 0.6f * side + 1;
    b.room("walls", {-half, 0, -half}, {half, 0.6f * half + 2, half}, {red, green, floor, ~0u, white, ~0u});
    const PillarShape pillar;
    uint32_t first = ~0u, firstSkinnedMesh = ~0u;
    for (uint32_t i = 0; i < count; ++i) {
        const auto columns = uint32_t(std::ceil(side));
        const glm::vec3 at((float(i % columns) + 0.5f - 0.5f * float(columns)) * 1.2f, 0.25f,
                           (float(i / columns) + 0.5f - 0.5f * float(columns)) * 1.2f);
        const float yaw = 6.2831853f * io::hashToUnit(i);
        uint32_t node;
        if (isSkinnedMesh(i)) {
            node = b.place("place", at - glm::vec3(0, 0.25f, 0), yaw);
            const uint32_t figure = firstSkinnedMesh == ~0u
                                        ? b.model("figure", pillarParts(pillar, box, red), glm::vec3(0))
                                        : b.copy(firstSkinnedMesh, "figure", glm::vec3(0));
            if (firstSkinnedMesh == ~0u) firstSkinnedMesh = figure;
            b.attach(figure, node);
            b.node(figure).extras.clipStart = kCrowdSway * io::hashToUnit(7 * i + 1);
        } else {
            node = first == ~0u ? b.box("box", at, glm::vec3(0.5f), box, yaw) : b.copy(first, "box", at, yaw);
            if (first == ~0u) first = node;
        }
        mover(b, node, {0.3f * io::hashToUnit(3 * i), 0.2f, 0}, 2 + 3 * io::hashToUnit(5 * i), 0.5f);
    }
    const float height = half + 2;
    b.spot("lamp", {-0.5f * half, height, 0.6f * half}, {0.4f, -1, -0.5f}, glm::vec3(6 * height * height),
           {30, 50});
    b.camera("camera", {0, 0.5f * half + 1.5f, 1.25f * half + 2}, {0, 0.3f, 0}, 55);
    if (firstSkinnedMesh == ~0u) return b.finish();
    const auto mesh = uint32_t(b.node(firstSkinnedMesh).mesh);
    SceneAsset asset = b.finish();
    addChains(asset, mesh, pillar, kCrowdSway);
    return asset;
}

struct Entry {
    std::string_view name;
    SceneAsset (*build)(uint32_t param);
    uint32_t mostParam = 0;  // 0: it takes no number
};

// Percent below a hundred, so that light in a closed box comes to an end; things within what an import
// allows.
constexpr std::array<Entry, 21> kScenes = {{{"cornell", cornell},
                                            {"corner", corner},
                                            {"occluder", occluder},
                                            {"corridor", corridor},
                                            {"glossy", glossy, 100},
                                            {"furnace", furnace, 99},
                                            {"lamps", lamps, 100'000},
                                            {"crowd", crowd, 500'000},
                                            {"figures", figures, 10'000},
                                            {"hall", hall},
                                            {"gallery", gallery},
                                            {"window", window, 1},
                                            {"shell", shell, 1},
                                            {"ledges", ledges},
                                            {"nave", nave},
                                            {"neon", neon},
                                            {"courtyard", courtyard},
                                            {"showroom", showroom},
                                            {"panes", panes},
                                            {"room", room, 1'000'000},
                                            {"town", town, 100'000}}};
constexpr auto kNames = [] {
    std::array<std::string_view, kScenes.size()> names;
    for (size_t i = 0; i < names.size(); ++i)
        names[i] = kScenes[i].name;
    return names;
}();

}  // namespace

std::span<const std::string_view> sceneNames() {
    return kNames;
}

bool isBuiltIn(std::string_view name) {
    return std::ranges::find(kNames, name) != kNames.end();
}

Result<SceneAsset> buildScene(std::string_view name, uint32_t param) {
    const auto found = std::ranges::find(kScenes, name, &Entry::name);
    if (found == kScenes.end()) return Error{missingName("built-in scene", name, kNames)};
    if (found->mostParam > 0 && param > found->mostParam)
        return Error{fmt::format("scene {} takes a number up to {}, not {}", name, found->mostParam, param)};
    return found->build(param);
}

// "town:500" is the scene of that name with that number.
std::optional<std::pair<std::string, uint32_t>> numberedScene(const std::string& text) {
    const size_t colon = text.find(':');
    if (colon == std::string::npos || !isBuiltIn(text.substr(0, colon))) return std::nullopt;
    const auto number = parseNumber(std::string_view(text).substr(colon + 1), 1, 1e6, true);
    if (!number) return std::nullopt;
    return std::pair(text.substr(0, colon), uint32_t(*number));
}

Result<SceneAsset> resolveScene(const std::string& nameOrPath, uint32_t param) {
    if (isBuiltIn(nameOrPath)) return buildScene(nameOrPath, param);
    if (const auto numbered = numberedScene(nameOrPath)) return buildScene(numbered->first, numbered->second);
    const bool name = nameOrPath.find_first_of("./") == std::string::npos;
    if (name && !fileExists(nameOrPath))
        return Error{fmt::format("{}: the file does not exist, and {}", nameOrPath,
                                 missingName("built-in scene", nameOrPath, kNames))};
    return importGltf(nameOrPath);
}

}  // namespace ag::scenegen
