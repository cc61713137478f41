#include "tools/scenegen/openings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

struct Slab {
    glm::vec3 least, most;
};

void slab(SceneBuilder& b, const char* name, const Slab& s, uint32_t material) {
    b.box(name, 0.5f * (s.least + s.most), s.most - s.least, material);
}

// A closed box's six walls about its inside, each `thick`.
struct Walls {
    Slab inside;
    float thick;
    Slab floor() const { return side(1, false); }
    Slab ceiling() const { return side(1, true); }
    Slab left() const { return side(0, false); }
    Slab right() const { return side(0, true); }
    Slab back() const { return side(2, false); }
    Slab front() const { return side(2, true); }

  private:
    // Walls stand between floor and ceiling, those along x between those along z.
    Slab side(int axis, bool far) const {
        Slab s = inside;
        s.least[axis] = far ? inside.most[axis] : inside.least[axis] - thick;
        s.most[axis] = s.least[axis] + thick;
        for (const int other : {0, 2}) {
            const bool reaches = axis == 1 || (axis == 2 && other == 0);
            if (!reaches) continue;
            s.least[other] -= thick, s.most[other] += thick;
        }
        return s;
    }
};

// The wall at x without an opening's rectangle (y, z): below it, above it and beside it.
void wallWithOpening(SceneBuilder& b, const Slab& wall, glm::vec2 least, glm::vec2 most, uint32_t material) {
    Slab below = wall, above = wall, before = wall, behind = wall;
    below.most.y = before.least.y = behind.least.y = least.x;
    above.least.y = before.most.y = behind.most.y = most.x;
    before.most.z = least.y;
    behind.least.z = most.y;
    for (const Slab& s : {below, above, before, behind})
        slab(b, "wall", s, material);
}

constexpr Slab kRoom{{-2.5f, 0, -2}, {2.5f, 2.8f, 2}};
constexpr float kWindowDepth = 0.2f;
constexpr glm::vec2 kWindowLeast(1, -0.6f), kWindowMost(2.1f, 0.3f);  // y, z
constexpr float kWindowSun = 12;                                      // W/m²

glm::vec3 windowSun() {
    return glm::normalize(glm::vec3(-0.75f, -0.6f, 0.2f));
}

}  // namespace

SceneAsset window(uint32_t param) {
    SceneBuilder b("window");
    const uint32_t white = b.material("plaster", {0.74f, 0.72f, 0.68f}),
                   floor = b.material("floor", {0.52f, 0.38f, 0.25f}),
                   red = b.material("sofa", {0.55f, 0.08f, 0.06f}),
                   wood = b.material("wood", {0.40f, 0.28f, 0.16f});
    const Walls walls{kRoom, kWindowDepth};
    slab(b, "floor", walls.floor(), floor);
    for (const Slab& s : {walls.ceiling(), walls.left(), walls.back(), walls.front()})
        slab(b, "wall", s, white);
    wallWithOpening(b, walls.right(), kWindowLeast, kWindowMost, white);
    if (param != 1) {
        slab(b, "sofa", {{-2.4f, 0, -1.2f}, {-1.6f, 0.45f, 0.6f}}, red);
        slab(b, "back of the sofa", {{-2.48f, 0, -1.2f}, {-2.3f, 0.9f, 0.6f}}, red);
        slab(b, "table", {{-1.2f, 0.7f, -1.7f}, {-0.2f, 0.75f, -0.9f}}, wood);
        for (const float x : {-1.15f, -0.3f})
            for (const float z : {-1.65f, -1.0f})
                slab(b, "leg", {{x, 0, z}, {x + 0.06f, 0.7f, z + 0.06f}}, wood);
    }
    b.sun("sun", windowSun(), glm::vec3(kWindowSun));
    b.camera("camera", {-2.0f, 1.6f, 1.7f}, {0.5f, 0.7f, -0.8f}, 65);
    return b.finish();
}

double windowPatchPower() {
    const glm::dvec3 d(windowSun());
    const double wide = double(kWindowMost.y - kWindowLeast.y) - double(kWindowDepth) * std::abs(d.z / d.x),
                 high = double(kWindowMost.x - kWindowLeast.x) - double(kWindowDepth) * std::abs(d.y / d.x);
    return double(kWindowSun) * std::abs(d.x) * wide * high;
}

// Along the sun through the corners of what is left of the opening at the wall's inner face.
FloorPatch windowPatch() {
    const glm::dvec3 d(windowSun());
    const double aside = double(kWindowDepth) * d.z / std::abs(d.x),
                 down = double(kWindowDepth) * d.y / std::abs(d.x);
    const glm::dvec2 least(double(kWindowLeast.x), double(kWindowLeast.y) + std::max(aside, 0.0)),
        most(double(kWindowMost.x) + down, double(kWindowMost.y) + std::min(aside, 0.0));
    const auto fallen = [&](double y, double z) {
        return glm::dvec2(double(kRoom.most.x) + d.x * y / -d.y, z + d.z * y / -d.y);
    };
    FloorPatch patch{glm::dvec2(1e30), glm::dvec2(-1e30)};
    for (const double y : {least.x, most.x})
        for (const double z : {least.y, most.y}) {
            patch.least = glm::min(patch.least, fallen(y, z));
            patch.most = glm::max(patch.most, fallen(y, z));
        }
    return patch;
}

namespace {

constexpr float kThin = 0.04f;
constexpr uint32_t kDomeSegments = 64;

// From a circle's edge to the square about it, at one height; its front looks up, or down.
void addRing(MeshParts& parts, uint32_t material, float radius, float half, float y, bool up) {
    const auto place = [=](float u, float v) {
        const float angle = 6.2831853f * (up ? u : 1 - u), c = std::cos(angle), s = std::sin(angle);
        const glm::vec2 circle(c * radius, s * radius),
            square = glm::vec2(c, s) * (half / std::max(std::abs(c), std::abs(s)));
        const glm::vec2 at = glm::mix(square, circle, v);
        return glm::vec3(at.x, y, -at.y);
    };
    addSheet(parts, material, place, kDomeSegments, 1);
}

// A half sphere of some thickness on a foot: up its outside, down its inside.
void addDome(MeshParts& parts, uint32_t material, float radius, float thick, float foot, glm::vec3 center) {
    constexpr int kSteps = 24;
    std::vector<glm::vec2> profile = {{radius, -foot}};
    for (int i = 0; i <= kSteps; ++i) {
        const float angle = 1.5707963f * float(i) / kSteps;
        profile.push_back({i == kSteps ? 0 : radius * std::cos(angle), radius * std::sin(angle)});
    }
    const float inner = radius - thick;
    for (int i = kSteps; i >= 0; --i) {
        const float angle = 1.5707963f * float(i) / kSteps;
        profile.push_back({i == kSteps ? 0 : inner * std::cos(angle), inner * std::sin(angle)});
    }
    profile.push_back({inner, -foot});
    profile.push_back({radius, -foot});
    addLathe(parts, material, profile, kDomeSegments, center);
}

}  // namespace

SceneAsset shell(uint32_t param) {
    SceneBuilder b("shell");
    const uint32_t lime = b.material("lime", {0.78f, 0.76f, 0.72f}),
                   floor = b.material("floor", {0.36f, 0.33f, 0.30f}),
                   cloth = b.material("cloth", {0.12f, 0.20f, 0.55f});
    const Walls walls{{{-3, 0, -3}, {3, 3, 3}}, kThin};
    slab(b, "floor", walls.floor(), floor);
    for (const Slab& s : {walls.left(), walls.right(), walls.back(), walls.front()})
        slab(b, "wall", s, lime);
    // The ceiling ends within the dome's foot, so that no gap is left.
    constexpr float kDome = 2.4f, kDomeThick = 0.05f;
    MeshParts roof;
    addRing(roof, lime, kDome - 0.5f * kDomeThick, 3 + kThin, 0, false);
    addRing(roof, lime, kDome - 0.5f * kDomeThick, 3 + kThin, kThin, true);
    addDome(roof, lime, kDome, kDomeThick, 0.02f, {0, kThin, 0});
    b.model("roof", roof, {0, 3, 0});
    for (const float x : {-3 - kThin, 3.0f})
        slab(b, "eaves", {{x, 3, -3 - kThin}, {x + kThin, 3 + kThin, 3 + kThin}}, lime);
    for (const float z : {-3 - kThin, 3.0f})
        slab(b, "eaves", {{-3, 3, z}, {3, 3 + kThin, z + kThin}}, lime);
    slab(b, "plinth", {{-0.5f, 0, -0.5f}, {0.5f, 0.9f, 0.5f}}, lime);
    slab(b, "hanging", {{-2.99f, 0.6f, -1.2f}, {-2.95f, 2.6f, 0.6f}}, cloth);
    b.quad("ground", {-8, -kThin, 8}, {16, 0, 0}, {0, 0, -16}, floor);
    b.sun("sun", {0.5f, -0.7f, 0.3f}, glm::vec3(12));
    if (param != 1) b.spot("lamp", {1.6f, 2.6f, -2.2f}, {-0.5f, -1, -0.25f}, glm::vec3(4), {20, 35});
    b.camera("camera", {2.5f, 1.5f, 2.5f}, {-1.2f, 2.0f, -1.2f}, 75);
    return b.finish();
}

SceneAsset ledges(uint32_t) {
    SceneBuilder b("ledges");
    const uint32_t wall = b.material("wall", {0.68f, 0.62f, 0.54f}),
                   sill = b.material("sill", {0.74f, 0.66f, 0.52f}),
                   brick = b.material("brick", {0.60f, 0.20f, 0.12f}),
                   ground = b.material("ground", {0.08f, 0.08f, 0.09f});
    slab(b, "wall", {{-8, 0, -0.4f}, {8, 6.5f, 0}}, wall);
    b.quad("ground", {-12, 0, 8}, {24, 0, 0}, {0, 0, -16}, ground);
    // Each in a place of its own, so that none shades another.
    constexpr std::array<float, 4> kHeights = {1.2f, 3.6f, 2.4f, 4.8f};
    constexpr float kDeep = 0.08f, kHigh = 0.06f, kWide = 1.0f, kApart = 1.25f;
    for (int i = 0; i < 12; ++i) {
        const float x = (float(i) - 5.5f) * kApart, y = kHeights[size_t(i) % kHeights.size()];
        slab(b, "sill", {{x - kWide / 2, y - kHigh, 0}, {x + kWide / 2, y, kDeep}},
             i % 3 == 1 ? brick : sill);
    }
    // A little from behind: the wall's face is in its own shade, and lower sills are lit less deep.
    b.sun("sun", {0.1f, -1, 0.01f}, glm::vec3(12));
    b.camera("camera", {1.6f, 2.2f, 6.2f}, {-0.4f, 2.9f, 0}, 55);
    return b.finish();
}

namespace {

constexpr float kNaveHalf = 3, kAisleHalf = 6, kNaveHigh = 10, kAisleHigh = 5, kNaveEnd = 9, kBay = 3;
constexpr float kStone = 0.4f;  // m, thickness of walls

// Above the arcade, with a window a bay.
void clerestory(SceneBuilder& b, float x, uint32_t stone) {
    constexpr float kFoot = 4.5f, kSill = 7, kHead = 8.4f, kHalf = 0.4f;
    const float left = x < 0 ? x - kStone : x, right = left + kStone;
    slab(b, "clerestory", {{left, kFoot, -kNaveEnd}, {right, kSill, kNaveEnd}}, stone);
    slab(b, "clerestory", {{left, kHead, -kNaveEnd}, {right, kNaveHigh, kNaveEnd}}, stone);
    for (float z = -kNaveEnd; z <= kNaveEnd; z += kBay) {
        const float from = std::max(z - kBay / 2 + kHalf, -kNaveEnd),
                    to = std::min(z + kBay / 2 - kHalf, kNaveEnd);
        slab(b, "pier", {{left, kSill, from}, {right, kHead, to}}, stone);
    }
}

void columns(SceneBuilder& b, uint32_t stone) {
    constexpr std::array<glm::vec2, 10> kProfile = {{{0.55f, 0},
                                                     {0.55f, 0.25f},
                                                     {0.42f, 0.35f},
                                                     {0.34f, 0.45f},
                                                     {0.32f, 3.9f},
                                                     {0.40f, 4.0f},
                                                     {0.36f, 4.1f},
                                                     {0.52f, 4.35f},
                                                     {0.52f, 4.5f},
                                                     {0, 4.5f}}};
    MeshParts column;
    addLathe(column, stone, kProfile, 32, glm::vec3(0));
    uint32_t first = ~0u;
    for (const float side : {-1.0f, 1.0f})
        for (float z = -kNaveEnd + kBay; z < kNaveEnd; z += kBay) {
            const glm::vec3 at(side * (kNaveHalf + kStone / 2), 0, z);
            if (first == ~0u)
                first = b.model("column", column, at);
            else
                b.copy(first, "column", at);
        }
}

}  // namespace

SceneAsset nave(uint32_t) {
    SceneBuilder b("nave");
    const uint32_t stone = b.material("stone", {0.64f, 0.60f, 0.53f}),
                   floor = b.material("floor", {0.42f, 0.26f, 0.18f}),
                   vault = b.material("vault", {0.72f, 0.70f, 0.66f}),
                   banner = b.material("banner", {0.10f, 0.16f, 0.55f});
    const float outer = kAisleHalf + kStone;
    slab(b, "floor", {{-outer, -kStone, -kNaveEnd - kStone}, {outer, 0, kNaveEnd + kStone}}, floor);
    slab(b, "vault",
         {{-kNaveHalf - kStone, kNaveHigh, -kNaveEnd - kStone},
          {kNaveHalf + kStone, kNaveHigh + kStone, kNaveEnd + kStone}},
         vault);
    for (const float z : {-kNaveEnd - kStone, kNaveEnd}) {
        slab(b, "end", {{-outer, 0, z}, {outer, kAisleHigh, z + kStone}}, stone);
        slab(b, "gable", {{-kNaveHalf - kStone, kAisleHigh, z}, {kNaveHalf + kStone, kNaveHigh, z + kStone}},
             stone);
    }
    for (const float side : {-1.0f, 1.0f}) {
        const float wall = side < 0 ? -outer : kAisleHalf, roof = side < 0 ? -outer : kNaveHalf + kStone;
        slab(b, "aisle", {{wall, 0, -kNaveEnd}, {wall + kStone, kAisleHigh, kNaveEnd}}, stone);
        slab(b, "aisle's roof",
             {{roof, kAisleHigh, -kNaveEnd - kStone},
              {roof + kAisleHalf - kNaveHalf, kAisleHigh + kStone, kNaveEnd + kStone}},
             vault);
        clerestory(b, side * kNaveHalf, stone);
    }
    columns(b, stone);
    slab(b, "banner", {{-2.98f, 4.7f, -5.1f}, {-2.94f, 6.8f, -3.9f}}, banner);
    slab(b, "altar", {{-1.1f, 0, -8.2f}, {1.1f, 1.0f, -7.2f}}, stone);
    b.sun("sun", {-0.54f, -0.80f, 0.3f}, glm::vec3(14, 13, 11.5f));
    b.camera("camera", {1.2f, 1.7f, 8.3f}, {-1.0f, 3.4f, -6}, 65);
    return b.finish();
}

}  // namespace ag::scenegen
