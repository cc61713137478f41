#include "tools/scenegen/town.h"

#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "common/sampling.h"
#include "tools/scenegen/builder.h"

namespace ag::scenegen {
namespace {

constexpr int kBlocks = 16;                                      // along a side
constexpr float kPitch = 62.5f, kStreet = 12, kPavement = 2.5f;  // m
constexpr float kSide = kBlocks * kPitch, kHalf = kSide / 2;     // m
constexpr uint32_t kLamps = 500, kMovers = 10'000, kHouseKinds = 8, kTreeKinds = 4;

// The middle of the street before block row or column `i`.
float streetAt(int i) {
    return float(i) * kPitch - kHalf;
}

struct HouseShape {
    glm::vec2 size{16, 14};  // m
    int floors = 2, windows = 3;
    float storey = 3;
    bool gabled = false;
};

// A wall of one storey along +X from the origin, its outer face at z = 0: window openings between a sill, a
// lintel and piers; a door in place of the middle opening.
struct WallBuilder {
    MeshParts& parts;
    uint32_t material;
    glm::vec3 origin;
    float yaw;

    void piece(float from, float to, float low, float high) const {
        const float thick = 0.3f;
        const glm::vec3 local((from + to) / 2, (low + high) / 2, -thick / 2);
        const glm::vec3 turned(std::cos(yaw) * local.x + std::sin(yaw) * local.z, local.y,
                               -std::sin(yaw) * local.x + std::cos(yaw) * local.z);
        addBox(parts, material, origin + turned, {to - from, high - low, thick}, yaw);
    }
    void storey(float length, float height, int windows, bool door) const {
        const float sill = 0.9f, lintel = 0.6f, bay = length / float(windows), opening = 0.45f * bay;
        piece(0, length, height - lintel, height);
        float at = 0;
        for (int i = 0; i < windows; ++i) {
            const float from = (float(i) + 0.5f) * bay - opening / 2, to = from + opening;
            piece(at, from, 0, height - lintel);
            if (!door || i != windows / 2) piece(from, to, 0, sill);
            at = to;
        }
        piece(at, length, 0, height - lintel);
    }
};

struct HouseColors {
    uint32_t wall, floor, roof;
};

// About its middle, standing on y = 0; its door looks along -Z.
MeshParts house(const HouseShape& h, const HouseColors& c) {
    MeshParts parts;
    const glm::vec2 half = 0.5f * h.size;
    constexpr float kQuarter = std::numbers::pi_v<float> / 2;
    for (int f = 0; f < h.floors; ++f) {
        const float y = float(f) * h.storey;
        const std::array<glm::vec3, 4> corners = {
            glm::vec3(half.x, y, -half.y), glm::vec3(-half.x, y, -half.y), glm::vec3(-half.x, y, half.y),
            glm::vec3(half.x, y, half.y)};
        for (size_t i = 0; i < 4; ++i)
            WallBuilder{parts, c.wall, corners[i], float(2 + i) * kQuarter}.storey(
                i % 2 ? h.size.y : h.size.x, h.storey, h.windows, f == 0 && i == 0);
        addBox(parts, c.floor, {0, y + 0.05f, 0}, {h.size.x - 0.6f, 0.1f, h.size.y - 0.6f});
        addBox(parts, c.wall, {0.15f * half.x, y + h.storey / 2, 0.3f},
               {0.2f, h.storey - 0.2f, h.size.y - 1.6f});
    }
    const float top = float(h.floors) * h.storey;
    addBox(parts, c.roof, {0, top + 0.1f, 0}, {h.size.x + 0.6f, 0.2f, h.size.y + 0.6f});
    if (!h.gabled) return parts;
    for (const float side : {-1.0f, 1.0f})
        addSheet(
            parts, c.roof,
            [&](float u, float v) {
                return glm::vec3(side * (u - 0.5f) * (h.size.x + 0.6f), top + 0.2f + v * 3.0f,
                                 side * (1 - v) * (half.y + 0.3f));
            },
            2, 2);
    return parts;
}

MeshParts tree(uint32_t trunk, uint32_t leaf, float height) {
    MeshParts parts;
    const std::array<glm::vec2, 2> stem = {glm::vec2(0.18f, 0), glm::vec2(0.12f, 0.45f * height)};
    const std::array<glm::vec2, 5> crown = {glm::vec2(0, 0.35f * height),
                                            glm::vec2(0.26f * height, 0.5f * height),
                                            glm::vec2(0.3f * height, 0.68f * height),
                                            glm::vec2(0.18f * height, 0.9f * height), glm::vec2(0, height)};
    addLathe(parts, trunk, stem, 6, glm::vec3(0));
    addLathe(parts, leaf, crown, 8, glm::vec3(0));
    return parts;
}

struct Box {
    uint32_t material;
    glm::vec3 center, size;  // m
};

MeshParts boxes(std::initializer_list<Box> all) {
    MeshParts parts;
    for (const Box& box : all)
        addBox(parts, box.material, box.center, box.size);
    return parts;
}

MeshParts lampPost(uint32_t iron, uint32_t shade) {
    return boxes({{iron, {0, 2, 0}, {0.12f, 4, 0.12f}}, {shade, {0, 4.45f, 0}, {0.5f, 0.08f, 0.5f}}});
}

MeshParts bench(uint32_t wood) {
    return boxes({{wood, {0, 0.45f, 0}, {1.8f, 0.08f, 0.5f}},
                  {wood, {0, 0.8f, 0.22f}, {1.8f, 0.4f, 0.06f}},
                  {wood, {-0.7f, 0.2f, 0}, {0.1f, 0.42f, 0.4f}},
                  {wood, {0.7f, 0.2f, 0}, {0.1f, 0.42f, 0.4f}}});
}

MeshParts table(uint32_t wood) {
    return boxes({{wood, {0, 0.75f, 0}, {1.6f, 0.06f, 0.9f}}, {wood, {0, 0.36f, 0}, {0.25f, 0.72f, 0.25f}}});
}

MeshParts cupboard(uint32_t wood, uint32_t other) {
    return boxes({{wood, {0, 0.9f, 0}, {1.2f, 1.8f, 0.5f}}, {other, {0, 1.9f, 0}, {0.4f, 0.2f, 0.3f}}});
}

MeshParts walker(uint32_t cloth, uint32_t skin) {
    return boxes({{cloth, {0, 0.75f, 0}, {0.42f, 1.4f, 0.28f}}, {skin, {0, 1.6f, 0}, {0.22f, 0.26f, 0.24f}}});
}

MeshParts cart(uint32_t wood, uint32_t load) {
    return boxes({{wood, {0, 0.55f, 0}, {1.2f, 0.3f, 2.2f}}, {load, {0, 0.95f, 0.1f}, {1.0f, 0.5f, 1.7f}}});
}

class TownBuilder {
  public:
    TownBuilder() {
        addGround();
        for (int z = 0; z < kBlocks; ++z)
            for (int x = 0; x < kBlocks; ++x)
                addBlock(glm::vec2(streetAt(x), streetAt(z)) + 0.5f * kPitch);
        addLamps();
    }

    void addMovers(uint32_t count) {
        for (uint32_t i = 0; i < count; ++i)
            addMover(i);
    }

    SceneAsset finish() {
        const glm::vec3 sun = glm::normalize(glm::vec3(0.45f, -0.75f, 0.35f));
        b_.sun("sun", sun, glm::vec3(100, 95, 85));
        b_.sky(analyticSky(sun, 3));
        addStops();
        return b_.finish();
    }

  private:
    float random() { return io::hashToUnit(next_++); }
    uint32_t random(uint32_t count) { return std::min(uint32_t(random() * float(count)), count - 1); }

    // Another node of a mesh that is made when it is first asked for.
    template <class Make>
    uint32_t put(uint32_t& model, const char* name, Make&& make, glm::vec3 at, float yaw) {
        if (model != ~0u) return b_.copy(model, name, at, yaw);
        return model = b_.model(name, make(), at, yaw);
    }

    // Piece by piece, so that what is far is not drawn.
    void addGround() {
        const uint32_t stone = b_.material("pavement", {0.45f, 0.43f, 0.40f}),
                       dirt = b_.material("street", {0.28f, 0.26f, 0.24f});
        const float inner = kPitch - kStreet + 2 * kPavement;
        uint32_t road = ~0u, slab = ~0u;
        const auto box = [](uint32_t material, glm::vec3 size) {
            MeshParts parts;
            addBox(parts, material, {0, -0.5f * size.y, 0}, size);
            return parts;
        };
        for (int z = 0; z < kBlocks; ++z)
            for (int x = 0; x < kBlocks; ++x) {
                const glm::vec3 middle(streetAt(x) + 0.5f * kPitch, 0, streetAt(z) + 0.5f * kPitch);
                put(
                    road, "street",
                    [&] {
                        return box(dirt, {kPitch, 1, kPitch});
                    },
                    middle - glm::vec3(0, 0.12f, 0), 0);
                put(
                    slab, "pavement",
                    [&] {
                        return box(stone, {inner, 0.3f, inner});
                    },
                    middle, 0);
            }
    }

    // Four houses, each with its door to a street, trees and benches between them.
    void addBlock(glm::vec2 middle) {
        constexpr float kTurn = std::numbers::pi_v<float>;
        for (int i = 0; i < 4; ++i) {
            const glm::vec2 off(i % 2 ? 13.5f : -13.5f, i / 2 ? 15.0f : -15.0f);
            addHouse(middle + off, i / 2 ? kTurn : 0);
        }
        for (int i = 0; i < 8; ++i) {
            const glm::vec2 at = middle + glm::vec2(-22 + 6.2f * float(i), (random() - 0.5f) * 6);
            const uint32_t kind = random(kTreeKinds);
            put(
                trees_[kind], "tree", [&] { return tree(trunk_, leaves_[kind % 2], 5 + 1.2f * float(kind)); },
                {at.x, 0, at.y}, 6.28f * random());
        }
        for (int i = 0; i < 4; ++i)
            put(
                bench_, "bench", [&] { return bench(wood_); },
                {middle.x + (i % 2 ? 24.3f : -24.3f), 0, middle.y + (i / 2 ? 8.0f : -8.0f)},
                i % 2 ? kTurn / 2 : -kTurn / 2);
    }

    void addHouse(glm::vec2 at, float yaw) {
        const uint32_t kind = random(kHouseKinds);
        const HouseShape shape{.size = {14 + 2.0f * float(kind % 4), 12 + 2.0f * float(kind % 3)},
                               .floors = 1 + int(kind + 1) % 3,
                               .windows = 3,
                               .gabled = kind % 2 == 0};
        put(
            houses_[kind], "house",
            [&] {
                return house(shape, {walls_[kind % 4], planks_, roofs_[kind % 2]});
            },
            {at.x, 0, at.y}, yaw);
        for (int floor = 0; floor < shape.floors; ++floor) {
            const float y = float(floor) * shape.storey + 0.1f;
            put(
                table_, "table", [&] { return table(wood_); },
                {at.x - 3 + random(), y, at.y + 2 * random() - 1}, random());
            for (const float side : {-1.0f, 1.0f})
                put(
                    cupboard_, "cupboard", [&] { return cupboard(wood_, planks_); },
                    {at.x + side * (0.5f * shape.size.x - 1.2f), y, at.y + side * 3}, 0);
        }
    }

    // Along the pavements, one after another on both sides.
    void addLamps() {
        const float spacing = 2 * float(kBlocks) * kSide / float(kLamps);
        for (uint32_t i = 0; i < kLamps; ++i) {
            const float along = (float(i) + 0.5f) * spacing;
            const auto street = uint32_t(along / kSide);
            const bool across = street % 2;
            const float line = streetAt(int(street / 2)) + (i % 2 ? 4.2f : -4.2f),
                        place = along - float(street) * kSide - kHalf;
            const glm::vec3 at = across ? glm::vec3(line, 0, place) : glm::vec3(place, 0, line);
            put(
                lamp_, "lamp post", [&] { return lampPost(iron_, iron_); }, at, 0);
            const uint32_t light =
                b_.point(fmt::format("lamp {}", i), at + glm::vec3(0, 4.3f, 0), glm::vec3(60, 45, 26), 14);
            b_.node(light).extras.bounces = false;
        }
    }

    // Walkers on the pavements, every eighth a cart on the street.
    void addMover(uint32_t i) {
        const bool drives = i % 8 == 7, across = random(2);
        const float line = streetAt(int(random(kBlocks))), place = (random() - 0.5f) * (kSide - 60),
                    aside = (random(2) ? 1.0f : -1.0f) * (drives ? 1.6f : 4.6f + 1.4f * random());
        const float reach = 8 + 18 * random(), speed = drives ? 3.0f : 1.3f;
        const glm::vec3 at = across ? glm::vec3(line + aside, 0, place) : glm::vec3(place, 0, line + aside);
        const float yaw = across ? 0 : std::numbers::pi_v<float> / 2;
        const uint32_t kind = random(4);
        const uint32_t node =
            drives ? put(
                         carts_[kind % 2], "cart", [&] { return cart(wood_, walls_[kind]); },
                         at - glm::vec3(0, 0.12f, 0), yaw)
                   : put(
                         walkers_[kind], "walker", [&] { return walker(cloths_[kind], skin_); }, at, yaw);
        b_.node(node).extras.moveExtent = across ? glm::vec3(0, 0, reach) : glm::vec3(reach, 0, 0);
        b_.node(node).extras.movePeriod = 2 * std::numbers::pi_v<float> * reach / speed;
    }

    // Round nine blocks, two stops a block.
    void addStops() {
        constexpr int kFirst = 6, kAround = 3;
        const float low = streetAt(kFirst), length = kAround * kPitch;
        const std::array<glm::vec2, 4> ways = {glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(-1, 0),
                                               glm::vec2(0, -1)};
        glm::vec2 corner(low, low);
        for (size_t side = 0; side < 4; ++side) {
            const glm::vec2 way = ways[side], before = ways[(side + 3) % 4];
            for (int stop = 0; stop < 2 * kAround; ++stop) {
                const glm::vec2 at = corner + way * (0.5f * kPitch * float(stop));
                const glm::vec2 looks = stop == 0 ? way + before : way;
                b_.camera(fmt::format("stop {}", side * 2 * kAround + size_t(stop)), {at.x, 1.7f, at.y},
                          {at.x + looks.x, 1.65f, at.y + looks.y}, 60);
            }
            corner += way * length;
        }
    }

    SceneBuilder b_{"town"};
    uint32_t next_ = 1;
    uint32_t wood_ = b_.material("wood", {0.42f, 0.28f, 0.15f}),
             planks_ = b_.material("planks", {0.52f, 0.40f, 0.27f}),
             trunk_ = b_.material("trunk", {0.25f, 0.18f, 0.12f}),
             iron_ = b_.material("iron", {0.12f, 0.12f, 0.13f}),
             skin_ = b_.material("skin", {0.62f, 0.45f, 0.36f});
    std::array<uint32_t, 4> walls_ = {
        b_.material("lime", {0.74f, 0.70f, 0.62f}), b_.material("ochre", {0.70f, 0.52f, 0.28f}),
        b_.material("brick", {0.52f, 0.22f, 0.16f}), b_.material("blue wash", {0.42f, 0.52f, 0.62f})};
    std::array<uint32_t, 2> roofs_ = {b_.material("tiles", {0.42f, 0.17f, 0.11f}),
                                      b_.material("slate", {0.20f, 0.21f, 0.24f})};
    std::array<uint32_t, 2> leaves_ = {b_.material("leaf", {0.16f, 0.32f, 0.08f}),
                                       b_.material("young leaf", {0.26f, 0.40f, 0.12f})};
    std::array<uint32_t, 4> cloths_ = {
        b_.material("red cloth", {0.55f, 0.10f, 0.08f}), b_.material("blue cloth", {0.12f, 0.18f, 0.45f}),
        b_.material("grey cloth", {0.35f, 0.35f, 0.36f}), b_.material("green cloth", {0.14f, 0.34f, 0.18f})};
    std::array<uint32_t, kHouseKinds> houses_ = filled<kHouseKinds>();
    std::array<uint32_t, kTreeKinds> trees_ = filled<kTreeKinds>();
    std::array<uint32_t, 4> walkers_ = filled<4>();
    std::array<uint32_t, 2> carts_ = filled<2>();
    uint32_t bench_ = ~0u, table_ = ~0u, cupboard_ = ~0u, lamp_ = ~0u;

    template <size_t N>
    static std::array<uint32_t, N> filled() {
        std::array<uint32_t, N> none;
        none.fill(~0u);
        return none;
    }
};

}  // namespace

SceneAsset town(uint32_t param) {
    TownBuilder builder;
    builder.addMovers(param ? param : kMovers);
    return builder.finish();
}

}  // namespace ag::scenegen
