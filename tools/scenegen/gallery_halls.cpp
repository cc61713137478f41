#include "tools/scenegen/gallery_halls.h"

namespace ag::scenegen {

void crossWall(Furnisher& f, const Hall& h, float z, bool doorway) {
    const float middle = z - kWall / 2, half = kDoor.x / 2;
    if (!doorway) {
        f.solid("wall", {(h.left + h.right) / 2, h.height / 2, middle},
                {h.right - h.left + 2 * kWall, h.height, kWall}, h.wall);
        return;
    }
    f.solid("wall", {(h.left - kWall - half) / 2, h.height / 2, middle},
            {-half - h.left + kWall, h.height, kWall}, h.wall);
    f.solid("wall", {(h.right + kWall + half) / 2, h.height / 2, middle},
            {h.right - half + kWall, h.height, kWall}, h.wall);
    f.solid("lintel", {0, (h.height + kDoor.y) / 2, middle}, {kDoor.x + 0.02f, h.height - kDoor.y, kWall},
            h.wall);
    for (const float side : {-1.0f, 1.0f})  // the frame
        f.solid("jamb", {side * (half + 0.02f), kDoor.y / 2, middle}, {0.1f, kDoor.y, kWall + 0.1f},
                f.darkWood);
    f.solid("head", {0, kDoor.y + 0.03f, middle}, {kDoor.x + 0.3f, 0.12f, kWall + 0.1f}, f.darkWood);
}

void sideWall(Furnisher& f, const Hall& h, float side, float front, float back) {
    const float x = side < 0 ? h.left - kWall / 2 : h.right + kWall / 2, length = front - back;
    f.solid("wall", {x, h.height / 2, (front + back) / 2}, {kWall, h.height, length}, h.wall);
    const float inside = side < 0 ? h.left : h.right;
    f.solid("skirting", {inside - side * 0.03f, 0.09f, (front + back) / 2}, {0.06f, 0.18f, length},
            f.darkWood);
    f.solid("cornice", {inside - side * 0.06f, h.height - 0.08f, (front + back) / 2}, {0.12f, 0.16f, length},
            f.stone);
}

void hallShell(SceneBuilder& b, Furnisher& f, const Hall& h) {
    f.floor("floor", {h.left, h.back - kWall}, {h.right, h.front}, h.tiles);
    const glm::vec2 min(h.left - kWall, h.back - kWall), max(h.right + kWall, h.front);
    if (!h.open) f.ceiling("ceiling", min, max, h.height, h.ceiling);
    const uint32_t node = b.place(h.name, {(h.left + h.right) / 2, 0, (h.front + h.back) / 2});
    NodeExtras& extras = b.node(node).extras;
    extras.tag = "room";
    extras.room = h.room;
    extras.text = h.rule;
    extras.openToSky = h.open;
    extras.moveExtent = {(h.right - h.left) / 2, h.height, (h.front - h.back) / 2};  // half its size
}

void plainWalls(Furnisher& f, const Hall& h) {
    crossWall(f, h, h.front + kWall, true);
    crossWall(f, h, h.back, true);
    sideWall(f, h, -1, h.front, h.back);
    sideWall(f, h, 1, h.front, h.back);
}

void lanterns(Furnisher& f, const Hall& h, int columns, int rows) {
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < columns; ++x)
            f.lantern(h.room,
                      {h.left + (h.right - h.left) * (float(x) + 0.5f) / float(columns), h.height - 0.1f,
                       h.front + (h.back - h.front) * (float(z) + 0.5f) / float(rows)},
                      h.height - 2.9f);
}

void corridor(Furnisher& f, uint32_t wall, float front, float back) {
    const Hall h{-1, -1.2f, 1.2f, front, back, wall, f.plaster, {f.tileLight, f.tileDark}, "", "", 2.8f};
    f.floor("corridor floor", {h.left, back}, {h.right, front}, h.tiles);
    f.ceiling("corridor ceiling", {h.left - kWall, back}, {h.right + kWall, front}, h.height, h.ceiling);
    sideWall(f, h, -1, front, back);
    sideWall(f, h, 1, front, back);
    f.painting({-1.2f, 1.6f, (front + back) / 2}, kQuarterTurn, {0.7f, 0.9f}, uint32_t(-front));
    f.sconce({1.16f, 1.8f, (front + back) / 2}, {-1, 0, 0}, kCandle);
}

}  // namespace ag::scenegen
