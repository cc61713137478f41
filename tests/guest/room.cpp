#include "tests/guest/room.h"

#include <glm/gtc/constants.hpp>

namespace ag::test {
namespace {

// `facing`: 1 outwards, -1 inwards; counter-clockwise seen from where the normal points.
void addBox(Room& room, glm::vec3 min, glm::vec3 max, float facing) {
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            const int u = (axis + 1) % 3, v = (axis + 2) % 3;
            glm::vec3 normal(0);
            normal[axis] = side * facing;
            const auto first = uint16_t(room.vertices.size());
            for (int corner = 0; corner < 4; ++corner) {
                const int round = normal[axis] > 0 ? corner : 3 - corner;
                RoomVertex vertex{.normal = normal};
                vertex.position[axis] = side > 0 ? max[axis] : min[axis];
                vertex.position[u] = round == 1 || round == 2 ? max[u] : min[u];
                vertex.position[v] = round >= 2 ? max[v] : min[v];
                room.vertices.push_back(vertex);
            }
            for (const int k : {0, 1, 2, 0, 2, 3})
                room.indices.push_back(uint16_t(first + k));
        }
}

}  // namespace

Room makeRoom() {
    Room room;
    addBox(room, {-2, 0, -2.5f}, {2, 3, 2.5f}, -1);
    room.wallIndices = uint32_t(room.indices.size());
    addBox(room, {-0.9f, 0, -1.4f}, {0.1f, 1.1f, -0.5f}, 1);
    return room;
}

std::optional<RoomHit> castRay(const Room& room, glm::vec3 from, glm::vec3 direction) {
    std::optional<RoomHit> nearest;
    for (size_t i = 0; i < room.indices.size(); i += 3) {
        const RoomVertex& a = room.vertices[room.indices[i]];
        const glm::vec3 e1 = room.vertices[room.indices[i + 1]].position - a.position;
        const glm::vec3 e2 = room.vertices[room.indices[i + 2]].position - a.position;
        const glm::vec3 p = glm::cross(direction, e2), s = from - a.position, q = glm::cross(s, e1);
        const float det = glm::dot(e1, p);
        if (det < 1e-9f) continue;  // a back
        const float u = glm::dot(s, p) / det, v = glm::dot(direction, q) / det, t = glm::dot(e2, q) / det;
        constexpr float kSeam = -1e-5f;
        if (u < kSeam || v < kSeam || u + v > 1 - kSeam || t <= 0) continue;
        if (!nearest || t < nearest->distance) nearest = RoomHit{t, a.normal};
    }
    return nearest;
}

}  // namespace ag::test
