// What an entity is called, and who is called so.
#pragma once

#include <string_view>
#include <utility>
#include <vector>

#include "engine/ecs/world.h"

namespace ag {

struct Name {  // as in the file, cut to fit; ends with a zero
    char text[64] = {};
};

// Cuts between characters of UTF-8, never inside one.
Name makeName(std::string_view text);

// Entities by name; brought up to date when asked, if names changed since.
class NameIndex {
  public:
    // The first in storage order; Entity{} if none is called so. Names longer than fit are cut like
    // makeName's.
    Entity find(const World& world, std::string_view name);
    std::vector<Entity> findAll(const World& world, std::string_view name);

  private:
    using Entry = std::pair<uint64_t, Entity>;  // hash of the text
    std::span<const Entry> sameHash(const World& world, const Name& name);
    void refresh(const World& world);
    std::vector<Entry> entries_;  // by hash, then in storage order
    uint64_t editCount_ = ~uint64_t(0);
    uint32_t version_ = 0;
};

}  // namespace ag
