// What a world is made of, for people: fields of components by name, and how archetypes fill their chunks.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include <glm/fwd.hpp>

#include "engine/ecs/world.h"

namespace ag {

enum class FieldKind { kFloat, kDouble, kInt, kUint, kText, kEntity };

struct Field {
    std::string name;
    std::string unit;
    FieldKind kind = FieldKind::kFloat;
    uint32_t offset = 0;  // bytes
    uint32_t count = 1;   // numbers, or characters of a text
};

namespace detail {

template <class T>
constexpr FieldKind fieldKind() {
    if constexpr (std::is_same_v<T, Entity>)
        return FieldKind::kEntity;
    else if constexpr (std::is_enum_v<T>)
        return FieldKind::kUint;
    else if constexpr (std::is_array_v<T>)
        return FieldKind::kText;
    else if constexpr (std::is_arithmetic_v<T>)
        return std::is_same_v<T, double>     ? FieldKind::kDouble
               : std::is_floating_point_v<T> ? FieldKind::kFloat
               : std::is_signed_v<T>         ? FieldKind::kInt
                                             : FieldKind::kUint;
    else  // glm: matrices have columns of values
        return fieldKind<std::remove_cvref_t<decltype(std::declval<T>()[0])>>();
}
template <FieldKind kind>
constexpr size_t numberBytes() {
    return kind == FieldKind::kDouble || kind == FieldKind::kEntity ? 8 : kind == FieldKind::kText ? 1 : 4;
}

}  // namespace detail

// Numbers and enums of 32 bits, doubles, vectors, quaternions and matrices of them, texts and entities.
template <class C, class T>
Field field(std::string name, T C::*member, std::string unit = {}) {
    constexpr FieldKind kind = detail::fieldKind<T>();
    static_assert(sizeof(T) % detail::numberBytes<kind>() == 0 &&
                  (!std::is_arithmetic_v<T> || sizeof(T) >= 4));
    static const C sample{};
    const auto offset =
        reinterpret_cast<const std::byte*>(&(sample.*member)) - reinterpret_cast<const std::byte*>(&sample);
    return {std::move(name), std::move(unit), kind, uint32_t(offset),
            uint32_t(sizeof(T) / detail::numberBytes<kind>())};
}

void describeComponent(ComponentId id, std::vector<Field> fields);
template <class C>
void describe(std::vector<Field> fields) {
    describeComponent(componentId<C>(), std::move(fields));
}
std::span<const Field> fieldsOf(ComponentId id);  // empty: nobody described it
std::string fieldText(const Field& field, const void* component);

struct ArchetypeReport {
    std::string components;  // names, with commas
    uint32_t rows = 0, chunks = 0;
    uint64_t capacity = 0;  // rows its chunks hold
    uint64_t bytes = 0;
    double fill() const { return capacity ? double(rows) / double(capacity) : 0; }
};
struct WorldReport {
    uint32_t entities = 0;
    uint64_t chunks = 0, chunkBytes = 0, slabBytes = 0;  // slabs: what was asked of the system
    std::vector<ArchetypeReport> archetypes;             // in the order they were made
};
WorldReport reportWorld(const World& world);

// Without namespaces: "WorldTransform".
std::string_view shortTypeName(std::string_view name);
// Entities in storage order whose name has the filter in it, in any case; all, named or not, if it is empty.
void listEntities(const World& world, std::string_view filter, std::vector<Entity>& out);

}  // namespace ag
