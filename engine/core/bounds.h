// A box along the axes.
#pragma once

#include <glm/glm.hpp>

namespace ag {

struct Bounds {
    glm::vec3 min{1e30f}, max{-1e30f};
    bool empty() const { return min.x > max.x; }
    void add(glm::vec3 p) { min = glm::min(min, p), max = glm::max(max, p); }
    void add(const Bounds& b) { min = glm::min(min, b.min), max = glm::max(max, b.max); }
};

}  // namespace ag
