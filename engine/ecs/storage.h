// Chunked archetypes: entities with the same components share chunks of up to 4,096 rows, one aligned column
// a component. Chunks are cut from 2 MiB slabs of huge pages. A removed row is filled with the archetype's
// last one.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstring>
#include <memory>
#include <span>
#include <vector>

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
    size_t slabBytes() const { return slabBytes_; }
    void swap(ChunkMemory& other);

  private:
    struct Free {
        std::byte* memory;
        size_t bytes;
    };
    std::vector<void*> slabs_;
    std::vector<Free> free_;
    std::byte* next_ = nullptr;
    size_t left_ = 0, slabBytes_ = 0;
};

struct Archetype;

// Where each component's column begins in a chunk, in bytes; 0: it has none.
using ChunkLayout = std::array<uint32_t, kMaxComponents>;

struct Chunk {
    std::byte* memory = nullptr;  // the entities, then the columns
    const ChunkLayout* layout = nullptr;
    Archetype* archetype = nullptr;
    size_t bytes = 0;
    uint32_t ordinal = 0;  // among the archetype's chunks
    uint32_t capacity = 0;
    uint32_t rows = 0;
    uint32_t structureVersion = 0;  // when rows last came, went or changed places
    Entity* entities = nullptr;
    std::vector<std::byte*> columns;    // parallel to the archetype's components
    std::vector<uint32_t> versions;     // of columns: when and by which system last written
    std::vector<uint64_t*> rowBits;     // of columns: which rows changed; null where not tracked
    std::unique_ptr<uint64_t[]> words;  // what rowBits point into
};

struct Archetype {
    static constexpr uint8_t kNoColumn = 255;
    static constexpr uint16_t kNoIndex = 0xffff;

    std::vector<std::unique_ptr<Chunk>> chunks;  // all full but the last
    Chunk* last = nullptr;
    uint32_t index = 0;  // in the world
    ComponentMask mask;
    std::vector<ComponentId> components;  // ascending
    std::vector<uint32_t> sizes;          // bytes of a row, parallel to components
    std::vector<uint8_t> trackedColumns;
    std::array<uint8_t, kMaxComponents> columnOf{};
    std::array<uint16_t, kMaxComponents> with{}, without{};  // archetypes one component away, once known
    uint32_t rowBytes = sizeof(Entity);
    std::array<std::unique_ptr<ChunkLayout>, 3> layouts;  // of the first chunk, the second and all others
    std::unique_ptr<Chunk> spare;  // emptied last: a world at a chunk's edge does not make and break it

    uint32_t rows() const;
};

struct RowPlace {
    Chunk* chunk = nullptr;
    uint32_t row = 0;
};

void initArchetype(Archetype& archetype, uint32_t index, const ComponentMask& mask);
// A chunk at the end; only when all before it are full.
Chunk& addChunk(Archetype& archetype, ChunkMemory& memory);
void dropLastChunk(Archetype& archetype, ChunkMemory& memory);

// Rows are short: cheaper than a call of memcpy with a size unknown to the compiler.
inline void copyRow(std::byte* to, const std::byte* from, size_t bytes) {
    for (; bytes >= 16; bytes -= 16, to += 16, from += 16)
        std::memcpy(to, from, 16);
    if (bytes & 8) std::memcpy(to, from, 8), to += 8, from += 8;
    if (bytes & 4) std::memcpy(to, from, 4), to += 4, from += 4;
    for (bytes &= 3; bytes > 0; --bytes)
        *to++ = *from++;
}

// Systems on other threads may mark other rows of the same chunk.
inline void stampVersion(uint32_t& version, uint32_t now) {
    std::atomic_ref(version).store(now, std::memory_order_relaxed);
}

inline void markRow(Chunk& chunk, uint32_t row) {
    for (const uint8_t column : chunk.archetype->trackedColumns)
        chunk.rowBits[column][row / 64] |= uint64_t(1) << (row % 64);
}

// Bits [begin, end) of a chunk's words.
void setBits(uint64_t* words, uint32_t begin, uint32_t end);
void markRows(Chunk& chunk, uint32_t begin, uint32_t end);

// A row at the end, its columns not yet written.
inline RowPlace pushRow(Archetype& archetype, ChunkMemory& memory, Entity entity, uint32_t version) {
    Chunk* chunk = archetype.last;
    if (!chunk || chunk->rows == chunk->capacity) chunk = &addChunk(archetype, memory);
    const uint32_t row = chunk->rows++;
    chunk->entities[row] = entity;
    chunk->structureVersion = version;
    if (!archetype.trackedColumns.empty()) markRow(*chunk, row);
    return {chunk, row};
}

// Fills the place with the last row and shortens; returns the entity that moved there (none if it was the
// last).
inline Entity removeRow(RowPlace place, ChunkMemory& memory, uint32_t version) {
    Chunk& chunk = *place.chunk;
    Archetype& archetype = *chunk.archetype;
    Chunk& last = *archetype.last;
    const uint32_t lastRow = --last.rows;
    chunk.structureVersion = version;
    last.structureVersion = version;  // the leaver may have been looked at as a neighbour
    Entity moved;
    if (&chunk != &last || place.row != lastRow) {
        moved = last.entities[lastRow];
        chunk.entities[place.row] = moved;
        for (size_t c = 0; c < archetype.sizes.size(); ++c) {
            const size_t size = archetype.sizes[c];
            copyRow(chunk.columns[c] + place.row * size, last.columns[c] + lastRow * size, size);
        }
        if (!archetype.trackedColumns.empty()) markRow(chunk, place.row);
    }
    if (lastRow == 0) dropLastChunk(archetype, memory);
    return moved;
}

}  // namespace ag
