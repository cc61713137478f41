#include "tools/scenegen/room.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

// The same numbers on every machine. Where several are thrown for one value, braces keep their order.
class Dice {
  public:
    explicit Dice(uint32_t seed) : engine_(seed) {}
    float in(float least, float most) { return least + (most - least) * float(engine_() >> 8) * 0x1p-24f; }
    uint32_t below(uint32_t count) { return engine_() % count; }
    glm::vec3 three(float least, float most) { return {in(least, most), in(least, most), in(least, most)}; }

  private:
    std::mt19937 engine_;
};

void slab(SceneBuilder& b, const char* name, glm::vec3 least, glm::vec3 most, uint32_t material) {
    b.box(name, 0.5f * (least + most), most - least, material);
}

// Along a wall and upward, m.
struct Window {
    glm::vec2 least, most;
};

std::vector<Window> windowsIn(Dice& dice, float length, float height) {
    std::vector<Window> windows;
    const uint32_t count = 1 + dice.below(3);
    const float part = length / float(count);
    for (uint32_t i = 0; i < count; ++i) {
        const float wide = dice.in(0.15f, 0.6f) * part;
        const float start = float(i) * part + dice.in(0.05f, 0.95f) * (part - wide);
        const std::array sills = {0.0f, 0.9f, 1.4f};
        const float sill = sills[dice.below(3)];
        windows.push_back({{start, sill}, {start + wide, std::min(height - 0.1f, sill + dice.in(0.4f, 2))}});
    }
    return windows;
}

// Upright slabs between windows, which are in order, and slabs below and above each. `at` (along, up): its
// box in the room.
template <class At>
void wall(SceneBuilder& b, glm::vec2 size, std::span<const Window> windows, uint32_t material, At&& at) {
    const auto part = [&](glm::vec2 least, glm::vec2 most) {
        if (most.x - least.x < 1e-4f || most.y - least.y < 1e-4f) return;
        const auto [low, high] = at(least, most);
        slab(b, "wall", low, high, material);
    };
    float from = 0;
    for (const Window& w : windows) {
        part({from, 0}, {w.least.x, size.y});
        part({w.least.x, 0}, {w.most.x, w.least.y});
        part({w.least.x, w.most.y}, {w.most.x, size.y});
        from = w.most.x;
    }
    part({from, 0}, size);
}

void walls(SceneBuilder& b, Dice& dice, glm::vec3 size, float thick) {
    slab(b, "floor", {-thick, -thick, -thick}, {size.x + thick, 0, size.z + thick},
         b.material("floor", dice.three(0.2f, 0.6f)));
    slab(b, "ceiling", {-thick, size.y, -thick}, {size.x + thick, size.y + thick, size.z + thick},
         b.material("ceiling", dice.three(0.6f, 0.9f)));
    for (int side = 0; side < 4; ++side) {
        const bool alongX = side >= 2, far = side % 2 == 1;
        const glm::vec2 face(alongX ? size.x : size.z, size.y);
        const float before = far ? (alongX ? size.z : size.x) : -thick;
        const bool open = !far || dice.below(5) == 0;
        const auto windows = open ? windowsIn(dice, face.x, face.y) : std::vector<Window>{};
        wall(b, face, windows, b.material("wall", dice.three(0.5f, 0.85f)),
             [&](glm::vec2 least, glm::vec2 most) {
                 const auto place = [&](glm::vec2 p, float across) {
                     return alongX ? glm::vec3(p.x, p.y, across) : glm::vec3(across, p.y, p.x);
                 };
                 return std::pair(place(least, before), place(most, before + thick));
             });
    }
}

void table(SceneBuilder& b, Dice& dice, glm::vec3 at, uint32_t material) {
    const float high = dice.in(0.4f, 0.9f);
    const glm::vec3 half{dice.in(0.3f, 0.9f), 0, dice.in(0.2f, 0.5f)};
    slab(b, "table", at + glm::vec3(-half.x, high, -half.z), at + glm::vec3(half.x, high + 0.03f, half.z),
         material);
    for (const float x : {-0.9f, 0.9f})
        for (const float z : {-0.9f, 0.9f}) {
            const glm::vec3 leg = at + glm::vec3(x * half.x, 0, z * half.z);
            slab(b, "leg", leg - glm::vec3(0.02f, 0, 0.02f), leg + glm::vec3(0.02f, high, 0.02f), material);
        }
}

void lathe(SceneBuilder& b, glm::vec3 at, std::span<const glm::vec2> profile, uint32_t material) {
    MeshParts parts;
    addLathe(parts, material, profile, 24, glm::vec3(0));
    b.model("turned", parts, at);
}

void thing(SceneBuilder& b, Dice& dice, glm::vec3 size) {
    const uint32_t material = b.material("thing", dice.three(0.05f, 0.9f));
    const glm::vec3 at{dice.in(0.3f, size.x - 0.3f), 0, dice.in(0.3f, size.z - 0.3f)};
    switch (dice.below(5)) {
        case 0: {
            const glm::vec3 half = dice.three(0.1f, 0.5f);
            b.box("crate", at + glm::vec3(0, half.y, 0), 2.0f * half, material, dice.in(0, 3));
            break;
        }
        case 1: {
            const float radius = dice.in(0.03f, 0.3f), high = dice.in(0.3f, size.y);
            lathe(b, at, std::array{glm::vec2(radius, 0), glm::vec2(radius, high), glm::vec2(0, high)},
                  material);
            break;
        }
        case 2: {
            const float radius = dice.in(0.1f, 0.4f), up = radius + dice.in(0, 1);
            std::vector<glm::vec2> profile;
            for (int i = 0; i <= 16; ++i) {
                const float angle = glm::pi<float>() * float(i) / 16;
                profile.emplace_back(radius * std::sin(angle), up - radius * std::cos(angle));
            }
            lathe(b, at, profile, material);
            break;
        }
        case 3:
            table(b, dice, at, material);
            break;
        default: {
            b.materialAt(material).doubleSided = true;
            const float turn = dice.in(0, 3), half = dice.in(0.3f, 1);
            const glm::vec3 along(half * std::cos(turn), 0, half * std::sin(turn));
            b.quad("sheet", at - along + glm::vec3(0, dice.in(0, 1), 0), 2.0f * along, {0, 1.5f, 0},
                   material);
        }
    }
}

}  // namespace

SceneAsset room(uint32_t param) {
    Dice dice(param);
    SceneBuilder b("room");
    const glm::vec3 size{dice.in(3, 9), dice.in(2.3f, 4.5f), dice.in(3, 10)};
    const std::array thicknesses = {0.01f, 0.05f, 0.15f, 0.3f};
    walls(b, dice, size, thicknesses[dice.below(4)]);
    for (uint32_t i = 4 + dice.below(11); i > 0; --i)
        thing(b, dice, size);
    b.sun("sun", {dice.in(0.2f, 1), -dice.in(0.3f, 1.2f), dice.in(0.2f, 1)}, glm::vec3(12, 11.4f, 10.6f));
    if (dice.below(5) < 2) {
        const glm::vec3 place{dice.in(0.2f, 0.8f) * size.x, 0.8f * size.y, dice.in(0.2f, 0.8f) * size.z};
        b.point("lamp", place, dice.in(1, 8) * glm::vec3(1, 0.8f, 0.6f));
    }
    b.camera("camera", {0.92f * size.x, std::min(1.6f, 0.7f * size.y), 0.92f * size.z},
             {0.15f * size.x, dice.in(0.5f, 1.5f), 0.15f * size.z}, 63);
    return b.finish();
}

}  // namespace ag::scenegen
