// The level as it is read: rooms from the entrance (z = 0) towards -z, joined by short corridors with a door
// each.
#include "tools/scenegen/gallery.h"

#include "tools/scenegen/gallery_parts.h"

namespace ag::scenegen {
namespace {

constexpr float kHeight = 3.6f, kWall = 0.3f;  // m
constexpr glm::vec2 kDoor(1.4f, 2.4f);         // m, width and height
constexpr float kPi = 3.14159265f;

struct Hall {
    int room;
    float left, right, front, back;  // x, x, z, z: front > back
    uint32_t wall;
};

// A wall across the way with a doorway in its middle; `z` is its side towards the room, it grows towards -z.
void crossWall(Furnisher& f, const Hall& h, float z, bool doorway) {
    const float middle = z - kWall / 2, half = kDoor.x / 2;
    if (!doorway) {
        f.solid("wall", {(h.left + h.right) / 2, kHeight / 2, middle},
                {h.right - h.left + 2 * kWall, kHeight, kWall}, h.wall);
        return;
    }
    f.solid("wall", {(h.left - kWall - half) / 2, kHeight / 2, middle},
            {-half - h.left + kWall, kHeight, kWall}, h.wall);
    f.solid("wall", {(h.right + kWall + half) / 2, kHeight / 2, middle},
            {h.right - half + kWall, kHeight, kWall}, h.wall);
    f.solid("lintel", {0, (kHeight + kDoor.y) / 2, middle}, {kDoor.x + 0.02f, kHeight - kDoor.y, kWall},
            h.wall);
    for (const float side : {-1.0f, 1.0f})  // the frame
        f.solid("jamb", {side * (half + 0.02f), kDoor.y / 2, middle}, {0.1f, kDoor.y, kWall + 0.1f},
                f.darkWood);
    f.solid("head", {0, kDoor.y + 0.03f, middle}, {kDoor.x + 0.3f, 0.12f, kWall + 0.1f}, f.darkWood);
}

void sideWall(Furnisher& f, const Hall& h, float side, float front, float back) {
    const float x = side < 0 ? h.left - kWall / 2 : h.right + kWall / 2, length = front - back;
    f.solid("wall", {x, kHeight / 2, (front + back) / 2}, {kWall, kHeight, length}, h.wall);
    const float inside = side < 0 ? h.left : h.right;
    f.solid("skirting", {inside - side * 0.03f, 0.09f, (front + back) / 2}, {0.06f, 0.18f, length},
            f.darkWood);
    f.solid("cornice", {inside - side * 0.06f, kHeight - 0.08f, (front + back) / 2}, {0.12f, 0.16f, length},
            f.stone);
}

void hallShell(SceneBuilder& b, Furnisher& f, const Hall& h, const char* name) {
    f.floor("floor", {h.left, h.back - kWall}, {h.right, h.front});
    f.ceiling("ceiling", {h.left - kWall, h.back - kWall}, {h.right + kWall, h.front}, kHeight);
    const uint32_t node = b.place(name, {(h.left + h.right) / 2, 0, (h.front + h.back) / 2});
    NodeExtras& extras = b.node(node).extras;
    extras.tag = "room";
    extras.room = h.room;
    extras.moveExtent = {(h.right - h.left) / 2, kHeight, (h.front - h.back) / 2};  // half its size
}

void lanterns(Furnisher& f, const Hall& h, int columns, int rows) {
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < columns; ++x)
            f.lantern(h.room,
                      {h.left + (h.right - h.left) * (float(x) + 0.5f) / float(columns), kHeight - 0.1f,
                       h.front + (h.back - h.front) * (float(z) + 0.5f) / float(rows)},
                      0.7f);
}

void corridor(Furnisher& f, uint32_t wall, float front, float back) {
    const Hall h{-1, -1.2f, 1.2f, front, back, wall};
    f.floor("corridor floor", {h.left, back}, {h.right, front});
    f.ceiling("corridor ceiling", {h.left - kWall, back}, {h.right + kWall, front}, kHeight);
    sideWall(f, h, -1, front, back);
    sideWall(f, h, 1, front, back);
    f.painting({-1.2f, 1.6f, (front + back) / 2}, kPi / 2, {0.7f, 0.9f}, uint32_t(-front));
    f.sconce({1.16f, 1.8f, (front + back) / 2}, {-1, 0, 0});
}

// Light that has bounced. Two white flowers: one by a wall, one behind a screen.
void foyer(SceneBuilder& b, Furnisher& f) {
    const Hall h{0, -4, 4, 0, -8, f.plaster};
    hallShell(b, f, h, "room of the first light");
    crossWall(f, h, kWall, false);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    for (const float x : {-2.5f, 2.5f})
        for (const float z : {-2.2f, -5.6f})
            f.column({x, 0, z}, kHeight);
    f.plinth({-2.9f, 0, -3.9f}, 0.7f);
    f.flower(0, kWhitePaint, 0.18f, {-2.9f, 0.7f, -3.9f}, 0.3f);
    f.plinth({3.2f, 0, -7.0f}, 0.5f);
    f.flower(0, kWhitePaint, 0.18f, {3.2f, 0.5f, -7.0f}, 1);
    f.solid("screen", {2.35f, 1.1f, -7.15f}, {0.08f, 2.2f, 1.7f}, f.wood);
    f.bench({3.4f, 0, -2.6f}, kPi / 2);
    f.bench({-3.4f, 0, -6.9f}, kPi / 2);
    f.painting({4, 1.7f, -3.9f}, -kPi / 2, {1.4f, 1.0f}, 3);
    f.painting({-4, 1.7f, -1.6f}, kPi / 2, {1.0f, 1.3f}, 5);
    f.painting({-2.5f, 1.7f, -8}, 0, {1.2f, 0.9f}, 8);
    f.sconce({-3.96f, 1.9f, -5.6f}, {1, 0, 0});
    f.sconce({3.96f, 1.9f, -1.4f}, {-1, 0, 0});
    f.crate(nullptr, {-1.3f, 0.3f, -2.7f}, 0.6f, 14);
    f.crate(nullptr, {-3.3f, 0.3f, -0.8f}, 0.6f, 14);
    f.crate(nullptr, {-2.6f, 0.3f, -0.7f}, 0.6f, 14);
    f.crate(nullptr, {-3.0f, 0.91f, -0.75f}, 0.6f, 14);
    lanterns(f, h, 3, 4);
    f.hint(0, {0, 0, -1},
           "Point the lamp at the bare wall beside the flower, so that its round spot does not touch the "
           "flower.");
    f.hint(0, {3, 0, -6}, "Behind the screen: light the wall, and the wall lights the flower.");
}

// Light takes the colour of what it bounces off.
void colours(SceneBuilder& b, Furnisher& f) {
    const Hall h{1, -5, 5, -11.3f, -20, f.plaster};
    hallShell(b, f, h, "room of colours");
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    f.tapestry(kRedPaint, {-5, 1.75f, -15.5f}, kPi / 2, {4.6f, 2.7f});
    f.tapestry(kBluePaint, {5, 1.75f, -15.5f}, -kPi / 2, {4.6f, 2.7f});
    f.tapestry(kGreenPaint, {2.9f, 1.75f, -20}, 0, {3.6f, 2.7f});
    f.tapestry(kGreenPaint, {-2.9f, 1.75f, -20}, 0, {3.6f, 2.7f});
    f.plinth({-3.4f, 0, -15.5f}, 0.6f);
    f.flower(1, kRedPaint, 0.06f, {-3.4f, 0.6f, -15.5f}, 0);
    f.plinth({3.4f, 0, -15.5f}, 0.6f);
    f.flower(1, kBluePaint, 0.04f, {3.4f, 0.6f, -15.5f}, 0.5f);
    f.plinth({2.7f, 0, -18.5f}, 0.6f);
    f.flower(1, kGreenPaint, 0.04f, {2.7f, 0.6f, -18.5f}, 1);
    for (const float x : {-1.9f, 1.9f})
        for (const float z : {-13.4f, -17.2f})
            f.column({x, 0, z}, kHeight);
    f.bench({0, 0, -15.3f}, 0);
    f.bench({-3.9f, 0, -12.2f}, 0);
    f.sconce({-4.96f, 1.9f, -12.4f}, {1, 0, 0});
    f.sconce({4.96f, 1.9f, -18.6f}, {-1, 0, 0});
    lanterns(f, h, 4, 3);
    f.hint(1, {0, 0, -12}, "Each flower wants a colour. Light takes the colour of the cloth it bounces off.");
}

// What stands between: a beam to be shaded, a panel to be opened, a curtain to pass under.
void shadows(SceneBuilder& b, Furnisher& f) {
    const Hall h{2, -5, 5, -23.3f, -32, f.plaster};
    hallShell(b, f, h, "room of shadows");
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, true);
    sideWall(f, h, 1, h.front, h.back);
    // The left wall has a niche from z = -29.3 to -30.7, 2.2 m deep, behind a panel.
    sideWall(f, h, -1, h.front, -29.3f);
    sideWall(f, h, -1, -30.7f, h.back);
    f.solid("niche lintel", {-5.15f, 2.95f, -30}, {kWall, 1.3f, 1.4f}, h.wall);
    f.solid("niche back", {-7.35f, kHeight / 2, -30}, {kWall, kHeight, 2}, h.wall);
    f.solid("niche side", {-6.2f, kHeight / 2, -29.15f}, {2.4f, kHeight, kWall}, h.wall);
    f.solid("niche side", {-6.2f, kHeight / 2, -30.85f}, {2.4f, kHeight, kWall}, h.wall);
    f.floor("niche floor", {-7.2f, -30.7f}, {-5, -29.3f});
    f.ceiling("niche ceiling", {-7.5f, -31}, {-5.3f, -29}, kHeight);
    MeshParts panel;
    addBox(panel, f.wood, {0, 1.1f, 0.66f}, {0.06f, 2.16f, 1.3f});
    for (const float y : {0.55f, 1.65f})
        addBox(panel, f.darkWood, {0, y, 0.66f}, {0.09f, 0.8f, 1.0f});
    const uint32_t leaf = b.model("panel", panel, {-5.05f, 0.03f, -30.67f});
    b.node(leaf).extras.tag = "panel";
    b.node(leaf).extras.mass = 18;
    b.node(leaf).extras.axis = {0, 1, 0};
    b.node(leaf).extras.least = -1.45f;
    b.node(leaf).extras.most = 0.02f;
    f.plinth({-6.85f, 0, -29.66f}, 0.5f);
    f.flower(2, kWhitePaint, 0.08f, {-6.85f, 0.5f, -29.66f}, 0);
    // The beam: a lamp on a tripod shines on a flower, and nothing but a crate is at hand.
    const glm::vec3 lamp(4.5f, 0.86f, -26.6f);
    MeshParts tripod;
    const glm::vec2 hood[] = {{0.05f, 0}, {0.06f, 0.1f}, {0.12f, 0.2f}};
    addLathe(tripod, f.iron, hood, 10, {0, -0.24f, 0});
    addBox(tripod, f.iron, {0, -0.5f, 0}, {0.05f, 0.6f, 0.05f});
    addBox(tripod, f.iron, {0, -0.82f, 0}, {0.4f, 0.05f, 0.4f});
    b.node(b.model("tripod", tripod, lamp + glm::vec3(0.15f, 0, 0))).extras.collider = true;
    b.node(b.spot("beam", lamp, {-1, 0, 0}, glm::vec3(46, 41, 33), {4, 8})).extras.tag = "beam";
    f.plinth({-2.6f, 0, -26.6f}, 0.3f);
    f.flower(2, kWhitePaint, 0.08f, {-2.6f, 0.3f, -26.6f}, 0.4f);
    f.crate(nullptr, {0.4f, 0.5f, -25.1f}, 1.0f, 24);
    // Behind a curtain that hangs low.
    f.solid("partition", {1.4f, kHeight / 2, -30.85f}, {0.2f, kHeight, 2.3f}, h.wall);
    f.curtain({1.4f, 0, -29.8f}, {5, 0, -29.8f}, 1.2f, 3.2f);
    f.plinth({4.2f, 0, -31.2f}, 0.5f);
    f.flower(2, kWhitePaint, 0.08f, {4.2f, 0.5f, -31.2f}, 1.2f);
    f.column({-3.6f, 0, -24.6f}, kHeight);
    f.column({2.6f, 0, -28.6f}, kHeight);
    f.bench({-4.3f, 0, -27.6f}, kPi / 2);
    f.painting({5, 1.7f, -25}, -kPi / 2, {1.3f, 1.0f}, 12);
    f.sconce({-4.96f, 1.9f, -28.4f}, {1, 0, 0});
    lanterns(f, h, 4, 3);
    f.hint(2, {0, 0, -24}, "Direct light closes a flower. Push the crate into the beam.");
    f.hint(2, {-3.4f, 0, -29.8f}, "Walk against the panel: it turns. Light the niche, not the flower.");
    f.hint(2, {3.2f, 0, -28.9f}, "Crouch to pass under the curtain.");
}

// A board on a pendulum or a panel: `from` to `to` in its frame, painted on one side or both.
MeshParts paintedBoard(uint32_t front, uint32_t back, glm::vec3 middle, glm::vec2 size) {
    MeshParts parts;
    addBox(parts, front, middle + glm::vec3(0, 0, 0.02f), {size.x, size.y, 0.03f});
    addBox(parts, back, middle - glm::vec3(0, 0, 0.02f), {size.x, size.y, 0.03f});
    return parts;
}

// Paint that moves, between walls that give nothing back.
void movingPaint(SceneBuilder& b, Furnisher& f) {
    const Hall h{3, -5, 5, -35.3f, -44, f.charcoal};
    hallShell(b, f, h, "room of moving paint");
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    f.plinth({-3.6f, 0, -38.4f}, 0.3f);
    f.flower(3, kYellowPaint, 0.05f, {-3.6f, 0.3f, -38.4f}, 0);
    f.crate(&kYellowPaint, {0.6f, 0.45f, -38.4f}, 0.9f, 16);
    // A panel that turns: its paint looks away from the flower at first.
    const uint32_t panel = b.model(
        "painted panel", paintedBoard(f.paint(kMagentaPaint), f.charcoal, {0.75f, 1.05f, 0}, {1.4f, 2.0f}),
        {1.9f, 0.03f, -40.6f});
    NodeExtras& extras = b.node(panel).extras;
    extras.tag = "panel";
    extras.mass = 14;
    extras.axis = {0, 1, 0};
    extras.least = -0.02f;
    extras.most = 1.6f;
    f.solid("post", {1.86f, 1.2f, -40.6f}, {0.1f, 2.4f, 0.1f}, f.iron);
    f.plinth({3.4f, 0, -42.2f}, 0.5f);
    f.flower(3, kMagentaPaint, 0.04f, {3.4f, 0.5f, -42.2f}, 0);
    // A board that swings by the flower.
    MeshParts board = paintedBoard(f.paint(kCyanPaint), f.paint(kCyanPaint), {0, -2.1f, 0}, {1.1f, 1.1f});
    addBox(board, f.iron, {0, -0.78f, 0}, {0.03f, 1.56f, 0.03f});
    const uint32_t pendulum = b.model("pendulum", board, {-2.7f, 3.3f, -41.6f});
    NodeExtras& swing = b.node(pendulum).extras;
    swing.tag = "pendulum";
    swing.mass = 20;
    swing.axis = {0, 0, 1};
    swing.swing = 0.35f;
    f.plinth({-2.7f, 0, -43.1f}, 0.5f);
    f.flower(3, kCyanPaint, 0.04f, {-2.7f, 0.5f, -43.1f}, 0);
    f.column({-1.2f, 0, -36.8f}, kHeight);
    f.column({3.4f, 0, -37.4f}, kHeight);
    f.sconce({4.96f, 1.9f, -39}, {-1, 0, 0});
    f.sconce({-4.96f, 1.9f, -36.6f}, {1, 0, 0});
    lanterns(f, h, 4, 3);
    f.hint(3, {0, 0, -36},
           "Black walls give nothing back. Bring the paint to the flower: crates can be carried.");
    f.hint(3, {2.6f, 0, -39.6f}, "The panel turns: show its painted side to the flower.");
    f.hint(3, {-2.2f, 0, -40.4f}, "Light the swinging board from the flower's side.");
}

void garden(SceneBuilder& b, Furnisher& f) {
    const Hall h{4, -3.5f, 3.5f, -44.3f, -51, f.plaster};
    hallShell(b, f, h, "garden");
    crossWall(f, h, h.back, false);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    MeshParts fountain;
    const glm::vec2 bowl[] = {{0.9f, 0},     {0.95f, 0.3f},  {1.05f, 0.36f}, {1.05f, 0.42f},
                              {0.9f, 0.42f}, {0.85f, 0.3f},  {0.2f, 0.28f},  {0.15f, 0.9f},
                              {0.4f, 1.05f}, {0.42f, 1.12f}, {0.1f, 1.08f},  {0, 1.25f}};
    addLathe(fountain, f.stone, bowl, 20, glm::vec3(0));
    b.node(b.model("fountain", fountain, {0, 0, -48.2f})).extras.collider = true;
    f.bench({-2.8f, 0, -48.2f}, kPi / 2);
    f.bench({2.8f, 0, -48.2f}, kPi / 2);
    for (const float x : {-2.6f, 2.6f})
        for (const float z : {-46.0f, -50.2f})
            f.column({x, 0, z}, kHeight);
    lanterns(f, h, 4, 4);
}

}  // namespace

SceneAsset gallery(uint32_t) {
    SceneBuilder b("gallery");
    Furnisher f(b);
    foyer(b, f);
    corridor(f, f.plaster, -8.3f, -11);
    colours(b, f);
    corridor(f, f.plaster, -20.3f, -23);
    shadows(b, f);
    corridor(f, f.plaster, -32.3f, -35);
    movingPaint(b, f);
    garden(b, f);
    int room = 0;
    for (const float z : {-8.15f, -20.15f, -32.15f, -44.15f})
        f.door(room++, {0, 0, z}, kDoor);
    b.spot("hand_lamp", {0.22f, 1.4f, -1.35f}, {-0.2f, -0.1f, -1}, kLampColor, {5, 25});
    const uint32_t camera = b.camera("player", {0, 1.65f, -1.2f}, {-0.4f, 1.5f, -8}, 65);
    b.node(camera).extras.tag = "spawn";
    return b.finish();
}

}  // namespace ag::scenegen
