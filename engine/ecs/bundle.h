// Lists of component types known at compile time: creating an entity from one looks its archetype up once.
#pragma once

#include <array>
#include <span>

#include "engine/ecs/storage.h"

namespace ag {

constexpr size_t kMostBundleTypes = 16;

struct BundleType {  // of the process
    uint32_t id = 0;
    std::span<const ComponentId> components;  // in the order of the list
};

uint32_t nextBundleId();

template <class... Ts>
const BundleType& bundleType() {
    static_assert(sizeof...(Ts) <= kMostBundleTypes);
    static const std::array<ComponentId, sizeof...(Ts)> ids = {componentId<Ts>()...};
    static const BundleType type{nextBundleId(), ids};
    return type;
}

struct Bundle {  // of one world
    Archetype* archetype = nullptr;
    std::array<uint8_t, kMostBundleTypes> columns{};  // where each type of the list lies
};

}  // namespace ag
