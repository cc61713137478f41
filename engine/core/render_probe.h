// Where a host wants to know how much light falls.
#pragma once

#include <cstdint>

#include <glm/glm.hpp>

namespace ag {

// A point whose irradiance is measured for the host.
struct RenderProbe {
    glm::vec3 position{0};  // m, relative to the origin
    glm::vec3 normal{0};    // unit; zero: the mean over all directions
    uint64_t id = 0;        // stable identity (entity handle)

    bool operator==(const RenderProbe&) const = default;
};

}  // namespace ag
