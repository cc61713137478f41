// A window into the world: entities by name, the components and fields of one, and how archetypes fill
// memory.
#pragma once

#include <array>
#include <vector>

#include "engine/ecs/describe.h"

namespace ag {

class Inspector {
  public:
    // Inside an ImGui frame; only looks.
    void build(const World& world);

    void select(Entity entity) { selected_ = entity; }
    Entity selected() const { return selected_; }
    const std::vector<Entity>& listed() const { return listed_; }
    std::array<char, 64>& filter() { return filter_; }  // what names must contain

  private:
    void entityList(const World& world);
    std::array<char, 64> filter_{};
    std::vector<Entity> listed_;
    Entity selected_;
};

// "lamp (12.3)"; entities without a name are "entity 12.3".
std::string entityLabel(const World& world, Entity entity);

}  // namespace ag
