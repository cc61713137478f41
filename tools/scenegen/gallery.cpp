// The level as it is read: rooms from the entrance (z = 0) towards -z, joined by short corridors with a door
// each.
#include "tools/scenegen/gallery.h"

#include "tools/scenegen/gallery_halls.h"
#include "tools/scenegen/gallery_rooms.h"

namespace ag::scenegen {
namespace {

constexpr float kDusk = 0.004f;  // of full daylight

// Light that has bounced. Two white flowers: one by a wall, one behind a screen.
void foyer(SceneBuilder& b, Furnisher& f) {
    const Hall h{
        .room = 0,
        .left = -4,
        .right = 4,
        .front = 0,
        .back = -8,
        .wall = f.plaster,
        .ceiling = f.plaster,
        .tiles = {f.tileLight, f.tileDark},
        .name = "room of the first light",
        .rule = "A flower opens in light that comes off a wall. Point the lamp at the wall beside it."};
    hallShell(b, f, h);
    crossWall(f, h, kWall, false);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
    for (const float x : {-2.5f, 2.5f})
        for (const float z : {-2.2f, -5.6f})
            f.column({x, 0, z}, kHeight);
    f.plinth({-2.9f, 0, -3.9f}, 0.7f);
    f.flower(0, kWhitePaint, 0.10f, {-2.9f, 0.7f, -3.9f}, 0.3f);
    f.plinth({3.2f, 0, -7.0f}, 0.5f);
    f.flower(0, kWhitePaint, 0.10f, {3.2f, 0.5f, -7.0f}, 1);
    f.solid("screen", {2.35f, 1.1f, -7.15f}, {0.08f, 2.2f, 1.7f}, f.wood);
    f.bench({3.4f, 0, -2.6f}, kQuarterTurn);
    f.bench({-3.4f, 0, -6.9f}, kQuarterTurn);
    f.painting({4, 1.7f, -3.9f}, -kQuarterTurn, {1.4f, 1.0f}, 3);
    f.painting({-4, 1.7f, -1.6f}, kQuarterTurn, {1.0f, 1.3f}, 5);
    f.painting({-2.5f, 1.7f, -8}, 0, {1.2f, 0.9f}, 8);
    f.sconce({-3.96f, 1.9f, -5.6f}, {1, 0, 0}, kCandle);
    f.sconce({3.96f, 1.9f, -1.4f}, {-1, 0, 0}, kCandle);
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
    const uint32_t polished = f.substance("polished tile", {0.34f, 0.32f, 0.30f}),
                   black = f.substance("black polished tile", {0.10f, 0.10f, 0.11f});
    for (const uint32_t m : {polished, black}) {  // the floor shows the cloths once more
        b.materialAt(m).roughness = 0.25f;
        b.materialAt(m).specular = 1;
    }
    const Hall h{.room = 1,
                 .left = -5,
                 .right = 5,
                 .front = -11.3f,
                 .back = -20,
                 .wall = f.substance("ivory plaster", {0.72f, 0.66f, 0.54f}),
                 .ceiling = f.plaster,
                 .tiles = {polished, black},
                 .name = "room of colours",
                 .rule = "Light takes the colour of the cloth it comes off.",
                 .height = 4.2f};
    hallShell(b, f, h);
    plainWalls(f, h);
    f.tapestry(kRedPaint, {-5, 1.75f, -15.5f}, kQuarterTurn, {4.6f, 2.7f});
    f.tapestry(kBluePaint, {5, 1.75f, -15.5f}, -kQuarterTurn, {4.6f, 2.7f});
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
    f.sconce({-4.96f, 1.9f, -12.4f}, {1, 0, 0}, kCandle);
    f.sconce({4.96f, 1.9f, -18.6f}, {-1, 0, 0}, kCandle);
    lanterns(f, h, 4, 3);
    f.hint(1, {0, 0, -12}, "Each flower wants a colour. Light takes the colour of the cloth it bounces off.");
}

// What stands between: a beam to be shaded, a panel to be opened, a curtain to pass under.
void shadows(SceneBuilder& b, Furnisher& f) {
    const Hall h{.room = 2,
                 .left = -5,
                 .right = 5,
                 .front = -23.3f,
                 .back = -32,
                 .wall = f.substance("sand blocks", {0.62f, 0.53f, 0.40f}),
                 .ceiling = f.wood,
                 .tiles = {f.substance("pale stone", {0.46f, 0.42f, 0.36f}),
                           f.substance("brown stone", {0.26f, 0.20f, 0.15f})},
                 .name = "room of shadows",
                 .rule = "A beam closes what it falls on, and what stands in its way makes shade."};
    hallShell(b, f, h);
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
    f.floor("niche floor", {-7.2f, -30.7f}, {-5, -29.3f}, h.tiles);
    f.ceiling("niche ceiling", {-7.5f, -31}, {-5.3f, -29}, kHeight, f.plaster);
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
    f.flower(2, kWhitePaint, 0.07f, {-2.6f, 0.3f, -26.6f}, 0.4f);
    f.crate(nullptr, {0.4f, 0.5f, -25.1f}, 1.0f, 24);
    // Behind a curtain that hangs low.
    f.solid("partition", {1.4f, kHeight / 2, -30.85f}, {0.2f, kHeight, 2.3f}, h.wall);
    f.curtain({1.4f, 0, -29.8f}, {5, 0, -29.8f}, 1.2f, 3.2f);
    f.plinth({4.2f, 0, -31.2f}, 0.5f);
    f.flower(2, kWhitePaint, 0.08f, {4.2f, 0.5f, -31.2f}, 1.2f);
    f.column({-3.6f, 0, -24.6f}, kHeight);
    f.column({2.6f, 0, -28.6f}, kHeight);
    f.bench({-4.3f, 0, -27.6f}, kQuarterTurn);
    f.painting({5, 1.7f, -25}, -kQuarterTurn, {1.3f, 1.0f}, 12);
    f.sconce({-4.96f, 1.9f, -28.4f}, {1, 0, 0}, kCandle);
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
    const Hall h{.room = 3,
                 .left = -5,
                 .right = 5,
                 .front = -35.3f,
                 .back = -44,
                 .wall = f.charcoal,
                 .ceiling = f.substance("black plaster", {0.06f, 0.06f, 0.07f}),
                 .tiles = {f.substance("gray stone", {0.28f, 0.28f, 0.30f}),
                           f.substance("slate stone", {0.13f, 0.13f, 0.15f})},
                 .name = "room of moving paint",
                 .rule = "Black walls give nothing back. Paint that moves does."};
    hallShell(b, f, h);
    plainWalls(f, h);
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
    f.flower(3, kCyanPaint, 0.03f, {-2.7f, 0.5f, -43.1f}, 0);
    f.column({-1.2f, 0, -36.8f}, kHeight);
    f.column({3.4f, 0, -37.4f}, kHeight);
    f.sconce({4.96f, 1.9f, -39}, {-1, 0, 0}, kCandle);
    f.sconce({-4.96f, 1.9f, -36.6f}, {1, 0, 0}, kCandle);
    f.sconce({-4.96f, 1.9f, -42.4f}, {1, 0, 0}, kCandle);
    f.sconce({2.6f, 1.9f, -43.96f}, {0, 0, 1}, kCandle);
    lanterns(f, h, 4, 3);
    f.hint(3, {0, 0, -36},
           "Black walls give nothing back. Bring the paint to the flower: crates can be carried.");
    f.hint(3, {2.6f, 0, -39.6f}, "The panel turns: show its painted side to the flower.");
    f.hint(3, {-2.2f, 0, -40.4f}, "Light the swinging board from the flower's side.");
}

// Two cloths side by side: only both together have the flower's colour.
void mixing(SceneBuilder& b, Furnisher& f) {
    const Hall h{.room = 4,
                 .left = -4.5f,
                 .right = 4.5f,
                 .front = -47.3f,
                 .back = -55,
                 .wall = f.substance("violet plaster", {0.34f, 0.30f, 0.40f}),
                 .ceiling = f.plaster,
                 .tiles = {f.substance("oak wood", {0.40f, 0.26f, 0.14f}),
                           f.substance("walnut wood", {0.24f, 0.15f, 0.09f})},
                 .name = "room of mixing",
                 .rule = "No cloth here has the flower's colour. Two together do.",
                 .height = 3.2f};
    hallShell(b, f, h);
    plainWalls(f, h);
    f.tapestry(kRedPaint, {-4.5f, 1.6f, -49.9f}, kQuarterTurn, {2.2f, 2.5f});
    f.tapestry(kBluePaint, {-4.5f, 1.6f, -52.1f}, kQuarterTurn, {2.2f, 2.5f});
    f.plinth({-3.0f, 0, -51.0f}, 0.3f);
    f.flower(4, kMagentaPaint, 0.05f, {-3.0f, 0.3f, -51.0f}, 0);
    f.tapestry(kGreenPaint, {4.5f, 1.6f, -49.9f}, -kQuarterTurn, {2.2f, 2.5f});
    f.tapestry(kRedPaint, {4.5f, 1.6f, -52.1f}, -kQuarterTurn, {2.2f, 2.5f});
    f.plinth({3.0f, 0, -51.0f}, 0.3f);
    f.flower(4, kYellowPaint, 0.05f, {3.0f, 0.3f, -51.0f}, 1);
    f.bench({0, 0, -53.6f}, 0);
    f.painting({-2.6f, 1.6f, -55}, 0, {1.1f, 0.9f}, 21);
    f.painting({2.6f, 1.6f, -55}, 0, {1.1f, 0.9f}, 22);
    for (const float x : {-4.46f, 4.46f})
        f.sconce({x, 1.9f, -54.2f}, {x < 0 ? 1 : -1, 0, 0}, kCandle);
    f.sconce({2.8f, 1.9f, -47.34f}, {0, 0, -1}, kCandle);
    lanterns(f, h, 3, 3);
    f.hint(4, {0, 0, -51}, "Put the lamp's spot on the seam between two cloths, above the flower.");
}

// A thing that shines of itself, carried where no lamp reaches.
void signs(SceneBuilder& b, Furnisher& f) {
    const Hall h{.room = 5,
                 .left = -4,
                 .right = 4,
                 .front = -58.3f,
                 .back = -65.5f,
                 .wall = f.charcoal,
                 .ceiling = f.iron,
                 .tiles = {f.substance("wet gray tile", {0.22f, 0.24f, 0.26f}),
                           f.substance("wet dark tile", {0.09f, 0.10f, 0.11f})},
                 .name = "room of signs",
                 .rule = "A sign shines of itself. Carry it to those who want its colour.",
                 .height = 3.4f};
    for (const uint32_t m : {h.tiles.light, h.tiles.dark}) {
        b.materialAt(m).roughness = 0.3f;
        b.materialAt(m).specular = 1;
    }
    hallShell(b, f, h);
    plainWalls(f, h);
    for (const float side : {-1.0f, 1.0f}) {  // stalls
        f.solid("stall", {side * 2.9f, 0.9f, -61.3f}, {2.2f, 1.8f, 0.12f}, f.charcoal);
        f.plinth({side * 3.2f, 0, -62.6f}, 0.3f);
    }
    f.flower(5, kCyanPaint, 0.025f, {-3.2f, 0.3f, -62.6f}, 0);
    f.flower(5, kCyanPaint, 0.025f, {3.2f, 0.3f, -62.6f}, 1);
    f.bench({0, 0, -63.2f}, 0);
    f.sign(kCyanPaint, {0.5f, 5.0f, 5.2f}, {0, 0.65f, -63.2f});
    f.sconce({-3.96f, 1.9f, -60.2f}, {1, 0, 0}, kCandle);
    f.sconce({3.96f, 1.9f, -60.2f}, {-1, 0, 0}, kCandle);
    f.sconce({2.6f, 1.9f, -65.46f}, {0, 0, 1}, kCandle);
    lanterns(f, h, 3, 3);
    f.hint(5, {0, 0, -61},
           "Pick the sign up with the use key, walk round the stall and hold it before the flower.");
}

// What wants the dark, beside what wants light.
void night(SceneBuilder& b, Furnisher& f) {
    const Hall h{.room = 6,
                 .left = -4.5f,
                 .right = 4.5f,
                 .front = -68.8f,
                 .back = -76,
                 .wall = f.substance("night plaster", {0.20f, 0.26f, 0.42f}),
                 .ceiling = f.substance("blue plaster", {0.14f, 0.18f, 0.32f}),
                 .tiles = {f.substance("moon stone", {0.42f, 0.44f, 0.48f}),
                           f.substance("ink stone", {0.12f, 0.14f, 0.20f})},
                 .name = "room of the night",
                 .rule = "One flower here is shy: it opens in the dark. Take the light away from it.",
                 .height = 3.8f};
    hallShell(b, f, h);
    plainWalls(f, h);
    f.solid("screen", {-1.6f, 1.3f, -74.4f}, {0.12f, 2.6f, 3.2f}, f.wood);
    f.plinth({-3.3f, 0, -74.6f}, 0.5f);
    f.flower(6, kBluePaint, 0.03f, {-3.3f, 0.5f, -74.6f}, 0, true);
    f.sign(kYellowPaint, {3.2f, 2.5f, 0.8f}, {-2.7f, 0.3f, -73.5f});
    f.tapestry(kGreenPaint, {4.5f, 1.7f, -72.4f}, -kQuarterTurn, {3.0f, 2.6f});
    f.plinth({3.1f, 0, -72.4f}, 0.4f);
    f.flower(6, kGreenPaint, 0.04f, {3.1f, 0.4f, -72.4f}, 0);
    f.bench({-3.7f, 0, -70.6f}, kQuarterTurn);
    f.painting({-4.5f, 1.7f, -70.6f}, kQuarterTurn, {1.0f, 1.3f}, 31);
    f.sconce({4.46f, 1.9f, -69.6f}, {-1, 0, 0}, {0.7f, 0.8f, 1.1f});
    f.sconce({-4.46f, 1.9f, -69.4f}, {1, 0, 0}, {0.7f, 0.8f, 1.1f});
    f.sconce({3.2f, 1.9f, -75.96f}, {0, 0, 1}, {0.7f, 0.8f, 1.1f});
    lanterns(f, h, 3, 3);
    f.hint(6, {-3, 0, -73}, "Carry the sign out from behind the screen, and turn the lamp away.");
    f.hint(6, {3, 0, -72}, "The green one opens as in the room of colours.");
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
    corridor(f, f.plaster, -44.3f, -47);
    mixing(b, f);
    corridor(f, f.plaster, -55.3f, -58);
    signs(b, f);
    corridor(f, f.plaster, -65.8f, -68.5f);
    night(b, f);
    corridor(f, f.plaster, -76.3f, -79);
    greenhouse(b, f);
    garden(b, f);
    int room = 0;
    for (const float z : {-8.15f, -20.15f, -32.15f, -44.15f, -55.15f, -65.65f, -76.15f, -88.15f})
        f.door(room++, {0, 0, z}, kDoor);
    const uint32_t sky = b.place("sky", {0, 0, 0});
    b.node(sky).extras.tag = "sky";
    b.node(sky).extras.axis = glm::normalize(glm::vec3(-0.9f, -0.25f, 0.35f));
    b.node(sky).extras.amount = kDusk;
    b.spot("hand_lamp", {0.22f, 1.4f, -1.35f}, {-0.2f, -0.1f, -1}, kLampColor, {5, 25});
    const uint32_t camera = b.camera("player", {0, 1.65f, -1.2f}, {-0.4f, 1.5f, -8}, 65);
    b.node(camera).extras.tag = "spawn";
    return b.finish();
}

}  // namespace ag::scenegen
