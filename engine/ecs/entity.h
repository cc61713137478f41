// Handles and component types.
#pragma once

#include <bit>
#include <cstdint>
#include <string_view>
#include <type_traits>

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
    std::string_view name;   // what saved worlds know it by
    uint32_t sizeBytes = 0;  // 0: an empty struct, a tag
    uint32_t alignment = 0;
    bool tracked = false;
};

// Which rows changed, not only which chunks, for components streamed elsewhere: specialise to true.
template <class T>
inline constexpr bool kTrackRows = false;

// Types are numbered in the order of first use in the process.
ComponentId nextComponentId(const ComponentType& type);
const ComponentType& componentType(ComponentId id);
uint32_t componentTypeCount();
ComponentId componentNamed(std::string_view name);  // kMaxComponents: no such type was used yet

// As the compiler spells it from here, so without this namespace: "WorldTransform", "game::Mover".
template <class T>
constexpr std::string_view typeName() {
    constexpr std::string_view spelt = __PRETTY_FUNCTION__;
    constexpr size_t begin = spelt.find("T = ") + 4;
    constexpr std::string_view name = spelt.substr(begin, spelt.find_first_of(";]", begin) - begin);
    return name.substr(name.starts_with("ag::") ? 4 : 0);
}

template <class T>
ComponentId componentId() {
    static_assert(std::is_trivially_copyable_v<T>, "components are moved as bytes");
    static_assert(alignof(T) <= 64, "columns start at cache lines");
    static const ComponentId id =
        nextComponentId({typeName<T>(), std::is_empty_v<T> ? 0 : sizeof(T), alignof(T), kTrackRows<T>});
    return id;
}

// Makes types known before their first use: a saved world is read by the names of its components.
template <class... Ts>
void registerComponents() {
    (componentId<Ts>(), ...);
}

// A set of component types.
struct ComponentMask {
    uint64_t words[2] = {0, 0};

    void set(ComponentId id) { words[id / 64] |= uint64_t(1) << (id % 64); }
    void reset(ComponentId id) { words[id / 64] &= ~(uint64_t(1) << (id % 64)); }
    bool has(ComponentId id) const { return words[id / 64] >> (id % 64) & 1; }
    uint32_t countBelow(ComponentId id) const {  // its place among the set's types
        const uint64_t below = (uint64_t(1) << (id % 64)) - 1;
        return id < 64 ? uint32_t(std::popcount(words[0] & below))
                       : uint32_t(std::popcount(words[0]) + std::popcount(words[1] & below));
    }
    bool containsAll(const ComponentMask& m) const {
        return (words[0] & m.words[0]) == m.words[0] && (words[1] & m.words[1]) == m.words[1];
    }
    bool intersects(const ComponentMask& m) const {
        return (words[0] & m.words[0]) || (words[1] & m.words[1]);
    }
    bool operator==(const ComponentMask&) const = default;
};

}  // namespace ag
