// The last two rooms of the gallery: the greenhouse, and the garden behind it.
#include <fmt/format.h>

#include "tools/scenegen/gallery_halls.h"
#include "tools/scenegen/gallery_rooms.h"

namespace ag::scenegen {
namespace {

// A porch behind a panel, with the evening sun in its window.
void porch(SceneBuilder& b, Furnisher& f, const Hall& h, float z, const Paint& glass, glm::vec3 sun) {
    const float x = h.right;
    f.solid("porch lintel", {x + 0.15f, (h.height + 2.3f) / 2, z}, {kWall, h.height - 2.3f, 1.4f}, h.wall);
    f.solid("porch back", {x + 2.35f, h.height / 2, z}, {kWall, h.height, 2}, h.wall);
    for (const float side : {-1.0f, 1.0f})
        f.solid("porch side", {x + 1.2f, h.height / 2, z + side * 0.85f}, {2.4f, h.height, kWall}, h.wall);
    f.floor("porch floor", {x, z - 0.7f}, {x + 2.2f, z + 0.7f}, h.tiles);
    f.ceiling("porch ceiling", {x + 0.3f, z - 1}, {x + 2.5f, z + 1}, h.height, h.ceiling);
    MeshParts panel;
    addBox(panel, f.wood, {0, 1.1f, 0.66f}, {0.06f, 2.16f, 1.3f});
    for (const float y : {0.55f, 1.65f})
        addBox(panel, f.darkWood, {0, y, 0.66f}, {0.09f, 0.8f, 1.0f});
    const uint32_t leaf = b.model("shutter", panel, {x + 0.05f, 0.03f, z - 0.67f});
    NodeExtras& extras = b.node(leaf).extras;
    extras.tag = "panel";
    extras.mass = 12;
    extras.axis = {0, 1, 0};
    extras.least = -0.02f;
    extras.most = 1.45f;
    // Its window, and the sun that comes in by it.
    const uint32_t pane = b.emissive(fmt::format("{} pane", glass.name), glass.albedo, glass.albedo * 0.9f);
    b.box("pane", {x + 2.18f, 1.75f, z}, {0.03f, 0.7f, 0.7f}, pane);
    const uint32_t light =
        b.spot(fmt::format("{} sun", glass.name), {x + 2.1f, 1.75f, z}, {-1, -0.02f, 0}, sun, {5, 8});
    b.node(light).extras.tag = "beam";
}

}  // namespace

void greenhouse(SceneBuilder& b, Furnisher& f) {
    const Hall h{.room = 7,
                 .left = -4.5f,
                 .right = 4.5f,
                 .front = -79.3f,
                 .back = -88,
                 .wall = f.substance("lime plaster", {0.66f, 0.68f, 0.60f}),
                 .ceiling = f.iron,
                 .tiles = {f.substance("terracotta tile", {0.48f, 0.24f, 0.15f}),
                           f.substance("brick tile", {0.32f, 0.15f, 0.10f})},
                 .name = "greenhouse",
                 .rule = "The evening sun stands behind coloured panes. Let it in.",
                 .height = 3.4f,
                 .open = true};
    hallShell(b, f, h);
    f.pergola({h.left - kWall, h.back - kWall}, {h.right + kWall, h.front}, h.height, f.iron, 0.8f);
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, -81.3f);
    sideWall(f, h, 1, -82.7f, -85.3f);
    sideWall(f, h, 1, -86.7f, h.back);
    porch(b, f, h, -82, kYellowPaint, {420, 290, 16});
    porch(b, f, h, -86, kRedPaint, {420, 40, 24});
    f.plinth({-3.3f, 0, -80.1f}, 0.4f);
    f.flower(7, kYellowPaint, 0.05f, {-3.3f, 0.4f, -80.1f}, 0);
    f.plinth({-3.3f, 0, -87.5f}, 0.3f);
    f.flower(7, kRedPaint, 0.05f, {-3.3f, 0.3f, -87.5f}, 1);
    f.hedge({-4.1f, 0.35f, -84}, {0.6f, 0.7f, 2.0f});
    f.hedge({2.2f, 0.3f, -87.4f}, {1.8f, 0.6f, 0.6f});
    f.tree({3.6f, 0, -84}, 2.4f);
    f.sconce({-4.46f, 2.2f, -84}, {1, 0, 0}, kCandle);
    f.sconce({2.6f, 2.0f, -79.34f}, {0, 0, -1}, kCandle);
    lanterns(f, h, 3, 3);
    f.hint(7, {3.4f, 0, -82}, "Walk against the shutter: it turns, and the sun falls on the wall.");
    f.hint(7, {3.4f, 0, -86}, "Walk against the shutter: it turns, and the sun falls on the wall.");
}

void garden(SceneBuilder& b, Furnisher& f) {
    const uint32_t gravel = f.substance("gravel stone", {0.50f, 0.47f, 0.41f}),
                   turf = f.substance("turf leaf", {0.16f, 0.30f, 0.09f});
    const Hall h{.room = 8,
                 .left = -6,
                 .right = 6,
                 .front = -88.3f,
                 .back = -99,
                 .wall = f.substance("garden blocks", {0.56f, 0.50f, 0.40f}),
                 .ceiling = f.plaster,
                 .tiles = {gravel, turf},
                 .name = "garden",
                 .height = 3.0f,
                 .open = true};
    hallShell(b, f, h);
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, false);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    MeshParts fountain;
    const glm::vec2 bowl[] = {{0.9f, 0},     {0.95f, 0.3f},  {1.05f, 0.36f}, {1.05f, 0.42f},
                              {0.9f, 0.42f}, {0.85f, 0.3f},  {0.2f, 0.28f},  {0.15f, 0.9f},
                              {0.4f, 1.05f}, {0.42f, 1.12f}, {0.1f, 1.08f},  {0, 1.25f}};
    addLathe(fountain, f.stone, bowl, 20, glm::vec3(0));
    b.node(b.model("fountain", fountain, {0, 0, -94})).extras.collider = true;
    f.bench({-2.8f, 0, -94}, kQuarterTurn);
    f.bench({2.8f, 0, -94}, kQuarterTurn);
    for (const float x : {-4.4f, 4.4f})
        for (const float z : {-90.6f, -93.8f, -97.2f})
            f.tree({x, 0, z}, 3.6f);
    for (const float x : {-5.6f, 5.6f})
        f.hedge({x, 0.45f, -93.6f}, {0.7f, 0.9f, 9.6f});
    f.hedge({0, 0.4f, -98.6f}, {9, 0.8f, 0.6f});
    f.pergola({-1.6f, -98}, {1.6f, -89.5f}, h.height, f.wood, 1.7f);
    lanterns(f, h, 2, 4);
}

}  // namespace ag::scenegen
