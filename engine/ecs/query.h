// Which archetypes a kind of view meets: found when archetypes are made, not each time it is used.
#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "engine/ecs/storage.h"

namespace ag {

constexpr uint32_t kMaxQueries = 1024;
constexpr size_t kMostTerms = 12;

struct QueryShape {  // of the process: one a View type
    uint32_t id = 0;
    ComponentMask with, without;
    std::array<ComponentId, kMostTerms> columns{};  // of the terms that have one
    uint32_t columnCount = 0;
};

uint32_t nextQueryId();

struct QueryMatch {
    Archetype* archetype = nullptr;
    std::array<uint8_t, kMostTerms> columns{};
};

struct QueryMatches {               // of one world
    std::vector<QueryMatch> list;   // in the order the archetypes were made
    std::atomic<uint32_t> seen{0};  // archetypes looked at
};

}  // namespace ag
