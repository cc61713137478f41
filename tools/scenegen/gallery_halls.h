// The shells of the gallery's rooms: walls with doorways, floor, ceiling, lanterns, and the corridors
// between.
#pragma once

#include "tools/scenegen/gallery_parts.h"

namespace ag::scenegen {

constexpr float kQuarterTurn = 3.14159265f / 2;    // radians
constexpr float kHeight = 3.6f, kWall = 0.3f;      // m
constexpr glm::vec2 kDoor(1.4f, 2.4f);             // m, width and height
constexpr glm::vec3 kCandle(1.15f, 0.82f, 0.50f);  // W/sr, of a sconce

// A room as a list of what makes it: its place, and what it is made of.
struct Hall {
    int room;
    float left, right, front, back;  // x, x, z, z: front > back
    uint32_t wall, ceiling;
    Tiles tiles;
    const char* name = "";
    const char* rule = "";  // its own sentence
    float height = kHeight;
    bool open = false;  // to the sky
};

// A wall across the way with a doorway in its middle; `z` is its side towards the room, it grows towards -z.
void crossWall(Furnisher& f, const Hall& h, float z, bool doorway);
void sideWall(Furnisher& f, const Hall& h, float side, float front, float back);
// Floor, ceiling, and the room's own node.
void hallShell(SceneBuilder& b, Furnisher& f, const Hall& h);
// All four walls, with a doorway in front and at the back.
void plainWalls(Furnisher& f, const Hall& h);
void lanterns(Furnisher& f, const Hall& h, int columns, int rows);
void corridor(Furnisher& f, uint32_t wall, float front, float back);

}  // namespace ag::scenegen
