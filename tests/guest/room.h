// A room with a box in it, as a host keeps it: strided vertices, 16-bit indices, and what a camera sees of
// it.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

namespace ag::test {

struct RoomVertex {  // positions and normals are not where, or as far apart, as one would guess
    float unused = 0;
    glm::vec3 position{0};
    uint32_t alsoUnused = 0;
    glm::vec3 normal{0};
    float color[2] = {};
};

struct Room {
    std::vector<RoomVertex> vertices;
    std::vector<uint16_t> indices;
    uint32_t wallIndices = 0;  // the first ones: the walls; then the box
};

// 4 m wide, 3 m high, 5 m deep, the origin in the middle of its floor; seen from inside.
Room makeRoom();

struct RoomHit {
    float distance = 0;
    glm::vec3 normal{0};
};
std::optional<RoomHit> castRay(const Room& room, glm::vec3 from, glm::vec3 direction);

}  // namespace ag::test
