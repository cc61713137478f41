// Chunked archetypes: entities with the same components share chunks of up to 4,096 rows, one aligned column
// a component. Chunks are cut from 2 MiB slabs of huge pages. A removed row is filled with the archetype's
// last one.
#pragma once

#include <array>
#include <memory>
#include <span>

#include "engine/ecs/entity.h"

namespace ag {

// Slabs of memory for chunks; freed chunks are handed out again by size.
class ChunkMemory {
  public:
    ChunkMemory() = default;
    ~ChunkMemory();
    ChunkMemory(const ChunkMemory&) = delete;
    ChunkMemory& operator=(const ChunkMemory&) = delete;
    std::byte* allocate(size_t bytes);
    void release(std::byte* memory, size_t bytes);

  private:
    struct Free {
        std::byte* memory;
        size_t bytes;
    };
    std::vector<void*> slabs_;
    std::vector<Free> free_;
    std::byte* next_ = nullptr;
    size_t left_ = 0;
};

struct Chunk {
    std::byte* memory = nullptr;
    size_t bytes = 0;
    uint32_t capacity = 0;
    uint32_t rows = 0;
    std::vector<uint32_t> offsets;    // of columns, in bytes; parallel to the archetype's components
    std::vector<uint32_t> versions;   // of columns: when and by which system last written
    std::vector<uint64_t> dirtyRows;  // bits, for all tracked columns together
    uint32_t entityOffset = 0;

    Entity* entities() { return reinterpret_cast<Entity*>(memory + entityOffset); }
    const Entity* entities() const { return reinterpret_cast<const Entity*>(memory + entityOffset); }
    std::byte* column(uint32_t index) { return memory + offsets[index]; }
    const std::byte* column(uint32_t index) const { return memory + offsets[index]; }
};

struct Archetype {
    ComponentMask mask;
    std::vector<ComponentId> components;             // ascending
    std::array<int16_t, kMaxComponents> columnOf{};  // -1: has none
    uint32_t rowBytes = sizeof(Entity);
    bool tracked = false;
    std::vector<std::unique_ptr<Chunk>> chunks;  // all full but the last
    uint32_t rows = 0;

    int column(ComponentId id) const { return columnOf[id]; }
};

Archetype makeArchetype(const ComponentMask& mask);
// A row at the end; makes a chunk when the last is full.
struct RowPlace {
    uint32_t chunk = 0, row = 0;
};
RowPlace pushRow(Archetype& archetype, ChunkMemory& memory, Entity entity, uint32_t version);
// Fills the place with the last row and shortens; returns the entity that moved there (none if it was the
// last).
Entity removeRow(Archetype& archetype, ChunkMemory& memory, RowPlace place, uint32_t version);

}  // namespace ag
