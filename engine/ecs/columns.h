// Every row that has a component, in storage order, for looking only: no system, no versions.
#pragma once

#include "engine/ecs/world.h"

namespace ag {

template <class T, class F>
void forRowsOf(const World& world, F&& f) {  // f(Entity, const T&)
    for (const Archetype& archetype : world.archetypes()) {
        const uint8_t column = archetype.columnOf[componentId<T>()];
        if (column == Archetype::kNoColumn) continue;
        for (const auto& chunk : archetype.chunks) {
            const auto* values = reinterpret_cast<const T*>(chunk->columns[column]);
            for (uint32_t row = 0; row < chunk->rows; ++row)
                f(chunk->entities[row], values[row]);
        }
    }
}

}  // namespace ag
