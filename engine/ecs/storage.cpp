#include "engine/ecs/storage.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <mutex>

namespace ag {
namespace {

constexpr size_t kSlabBytes = size_t(2) << 20;
constexpr size_t kChunkBytes = size_t(256) << 10;
constexpr uint32_t kLeastRows = 256, kMostRows = 4096;
constexpr size_t kColumnAlignment = 64;

size_t alignUp(size_t n) {
    return (n + kColumnAlignment - 1) / kColumnAlignment * kColumnAlignment;
}

struct Registry {
    std::mutex mutex;
    std::array<ComponentType, kMaxComponents> types;
    std::array<bool, kMaxComponents> tracked{};
    uint32_t count = 0;
};

Registry& registry() {
    static Registry instance;  // type identity is a fact of the process, not state
    return instance;
}

// An archetype's first chunks are small, so that rare combinations stay so.
uint32_t capacityOf(const Archetype& archetype) {
    if (archetype.chunks.empty()) return 64;
    if (archetype.chunks.size() == 1) return 256;
    const uint32_t fit = uint32_t(std::bit_floor(kChunkBytes / archetype.rowBytes));
    return std::clamp(fit, kLeastRows, kMostRows);
}

void addChunk(Archetype& archetype, ChunkMemory& memory) {
    auto chunk = std::make_unique<Chunk>();
    chunk->capacity = capacityOf(archetype);
    size_t at = alignUp(sizeof(Entity) * chunk->capacity);
    for (ComponentId id : archetype.components) {
        chunk->offsets.push_back(uint32_t(at));
        at += alignUp(size_t(componentType(id).sizeBytes) * chunk->capacity);
    }
    chunk->bytes = at;
    chunk->memory = memory.allocate(at);
    chunk->versions.assign(archetype.components.size(), 0);
    if (archetype.tracked) chunk->dirtyRows.assign((chunk->capacity + 63) / 64, 0);
    archetype.chunks.push_back(std::move(chunk));
}

void setDirty(Chunk& chunk, uint32_t row) {
    if (!chunk.dirtyRows.empty()) chunk.dirtyRows[row / 64] |= uint64_t(1) << (row % 64);
}

}  // namespace

ComponentId nextComponentId(ComponentType type, bool tracked) {
    Registry& r = registry();
    const std::lock_guard lock(r.mutex);
    AG_CHECK_LT(r.count, kMaxComponents);
    r.types[r.count] = type;
    r.tracked[r.count] = tracked;
    return r.count++;
}

const ComponentType& componentType(ComponentId id) {
    return registry().types[id];
}
bool componentTracked(ComponentId id) {
    return registry().tracked[id];
}

ChunkMemory::~ChunkMemory() {
    for (void* slab : slabs_)
        std::free(slab);
}

std::byte* ChunkMemory::allocate(size_t bytes) {
    const auto found = std::ranges::find(free_, bytes, &Free::bytes);
    if (found != free_.end()) {
        std::byte* memory = found->memory;
        *found = free_.back();
        free_.pop_back();
        return memory;
    }
    if (bytes > left_) {
        const size_t slab = std::max(kSlabBytes, (bytes + kSlabBytes - 1) / kSlabBytes * kSlabBytes);
        void* memory = std::aligned_alloc(kSlabBytes, slab);
        AG_CHECK(memory != nullptr);
        madvise(memory, slab, MADV_HUGEPAGE);
        slabs_.push_back(memory);
        next_ = static_cast<std::byte*>(memory);
        left_ = slab;
    }
    std::byte* memory = next_;
    next_ += bytes;
    left_ -= bytes;
    return memory;
}

void ChunkMemory::release(std::byte* memory, size_t bytes) {
    free_.push_back({memory, bytes});
}

Archetype makeArchetype(const ComponentMask& mask) {
    Archetype a;
    a.mask = mask;
    a.columnOf.fill(-1);
    for (ComponentId id = 0; id < kMaxComponents; ++id) {
        if (!mask.has(id)) continue;
        a.columnOf[id] = int16_t(a.components.size());
        a.components.push_back(id);
        a.rowBytes += componentType(id).sizeBytes;
        a.tracked = a.tracked || componentTracked(id);
    }
    return a;
}

RowPlace pushRow(Archetype& archetype, ChunkMemory& memory, Entity entity, uint32_t version) {
    if (archetype.chunks.empty() || archetype.chunks.back()->rows == archetype.chunks.back()->capacity)
        addChunk(archetype, memory);
    Chunk& chunk = *archetype.chunks.back();
    const uint32_t row = chunk.rows++;
    ++archetype.rows;
    chunk.entities()[row] = entity;
    for (uint32_t& v : chunk.versions)
        v = version;
    setDirty(chunk, row);
    return {uint32_t(archetype.chunks.size() - 1), row};
}

Entity removeRow(Archetype& archetype, ChunkMemory& memory, RowPlace place, uint32_t version) {
    Chunk& last = *archetype.chunks.back();
    Chunk& chunk = *archetype.chunks[place.chunk];
    const uint32_t lastRow = last.rows - 1;
    Entity moved;
    if (&chunk != &last || place.row != lastRow) {
        moved = last.entities()[lastRow];
        chunk.entities()[place.row] = moved;
        for (uint32_t c = 0; c < archetype.components.size(); ++c) {
            const size_t size = componentType(archetype.components[c]).sizeBytes;
            std::memcpy(chunk.column(c) + place.row * size, last.column(c) + lastRow * size, size);
        }
        for (uint32_t& v : chunk.versions)
            v = version;
        setDirty(chunk, place.row);
    }
    // The leaver may have been looked at as a neighbour: its chunk changed too.
    for (uint32_t& v : last.versions)
        v = version;
    --last.rows;
    --archetype.rows;
    if (last.rows == 0) {
        memory.release(last.memory, last.bytes);
        archetype.chunks.pop_back();
    }
    return moved;
}

}  // namespace ag
