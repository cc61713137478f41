// Handles and component types.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "engine/core/check.h"

namespace ag {

// Never reused: the generation tells a dead entity from the one that took its index.
struct Entity {
    uint32_t index = ~0u;
    uint32_t generation = 0;

    explicit operator bool() const { return index != ~0u; }
    bool operator==(const Entity&) const = default;
    uint64_t bits() const { return uint64_t(generation) << 32 | index; }
};

using ComponentId = uint32_t;
constexpr ComponentId kMaxComponents = 128;

struct ComponentType {
    uint32_t sizeBytes = 0;
    uint32_t alignment = 0;
};

// Which rows changed, not only which chunks, for components streamed elsewhere: specialise to true.
template <class T>
inline constexpr bool kTrackRows = false;

// Types are numbered in the order of first use in the process.
ComponentId nextComponentId(ComponentType type, bool tracked);
const ComponentType& componentType(ComponentId id);
bool componentTracked(ComponentId id);

template <class T>
ComponentId componentId() {
    static_assert(std::is_trivially_copyable_v<T>, "components are moved as bytes");
    static const ComponentId id = nextComponentId({sizeof(T), alignof(T)}, kTrackRows<T>);
    return id;
}

// A set of component types.
struct ComponentMask {
    uint64_t words[2] = {0, 0};

    void set(ComponentId id) { words[id / 64] |= uint64_t(1) << (id % 64); }
    void reset(ComponentId id) { words[id / 64] &= ~(uint64_t(1) << (id % 64)); }
    bool has(ComponentId id) const { return words[id / 64] >> (id % 64) & 1; }
    bool containsAll(const ComponentMask& m) const {
        return (words[0] & m.words[0]) == m.words[0] && (words[1] & m.words[1]) == m.words[1];
    }
    bool intersects(const ComponentMask& m) const {
        return (words[0] & m.words[0]) || (words[1] & m.words[1]);
    }
    bool operator==(const ComponentMask&) const = default;
};

}  // namespace ag
