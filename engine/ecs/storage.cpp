#include "engine/ecs/storage.h"

#include <sys/mman.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace ag {
namespace {

constexpr size_t kSlabBytes = size_t(2) << 20;
constexpr size_t kChunkBytes = size_t(256) << 10;
constexpr uint32_t kLeastRows = 1024, kMostRows = 4096;
constexpr size_t kColumnAlignment = 64;

// Columns of equal power-of-two length would all start in the same cache set, and a load would wait for
// stores to another column that end in the same twelve bits. Short chunks are not worth the bytes.
size_t columnSkew(uint32_t capacity) {
    return capacity < kLeastRows ? kColumnAlignment : 17 * kColumnAlignment;
}

size_t alignUp(size_t n) {
    return (n + kColumnAlignment - 1) / kColumnAlignment * kColumnAlignment;
}

// An archetype's first chunks are small, so that rare combinations stay so.
uint32_t capacityOf(const Archetype& archetype, size_t ordinal) {
    if (ordinal == 0) return 64;
    if (ordinal == 1) return 256;
    const uint32_t fit = uint32_t(std::bit_floor(kChunkBytes / archetype.rowBytes));
    return std::clamp(fit, kLeastRows, kMostRows);
}

size_t chunkBytes(const Archetype& archetype, uint32_t capacity) {
    size_t bytes = alignUp(sizeof(Entity) * capacity);
    for (const uint32_t size : archetype.sizes)
        bytes += alignUp(size_t(size) * capacity) + columnSkew(capacity);
    AG_CHECK_MSG(bytes < ~0u, "a component is too large for a chunk");
    return bytes;
}

const ChunkLayout& layoutOf(Archetype& archetype, size_t ordinal, uint32_t capacity) {
    std::unique_ptr<ChunkLayout>& layout = archetype.layouts[std::min<size_t>(ordinal, 2)];
    if (layout) return *layout;
    layout = std::make_unique<ChunkLayout>();
    size_t at = alignUp(sizeof(Entity) * capacity);
    for (size_t c = 0; c < archetype.components.size(); ++c) {
        (*layout)[archetype.components[c]] = uint32_t(at);
        at += alignUp(size_t(archetype.sizes[c]) * capacity) + columnSkew(capacity);
    }
    return *layout;
}

std::unique_ptr<Chunk> makeChunk(Archetype& archetype, ChunkMemory& memory, size_t ordinal) {
    auto chunk = std::make_unique<Chunk>();
    chunk->archetype = &archetype;
    chunk->capacity = capacityOf(archetype, ordinal);
    chunk->bytes = chunkBytes(archetype, chunk->capacity);
    chunk->memory = memory.allocate(chunk->bytes);
    chunk->layout = &layoutOf(archetype, ordinal, chunk->capacity);
    chunk->entities = reinterpret_cast<Entity*>(chunk->memory);
    for (const ComponentId id : archetype.components)
        chunk->columns.push_back(chunk->memory + (*chunk->layout)[id]);
    chunk->versions.assign(archetype.components.size(), 0);
    chunk->rowBits.assign(archetype.components.size(), nullptr);
    const size_t words = (chunk->capacity + 63) / 64;
    if (!archetype.trackedColumns.empty())
        chunk->words = std::make_unique<uint64_t[]>(words * archetype.trackedColumns.size());
    for (size_t i = 0; i < archetype.trackedColumns.size(); ++i)
        chunk->rowBits[archetype.trackedColumns[i]] = chunk->words.get() + i * words;
    return chunk;
}

}  // namespace

ChunkMemory::~ChunkMemory() {
    for (void* slab : slabs_)
        std::free(slab);
}

void ChunkMemory::swap(ChunkMemory& other) {
    std::swap(slabs_, other.slabs_);
    std::swap(free_, other.free_);
    std::swap(next_, other.next_);
    std::swap(left_, other.left_);
    std::swap(slabBytes_, other.slabBytes_);
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
        slabBytes_ += slab;
    }
    std::byte* memory = next_;
    next_ += bytes;
    left_ -= bytes;
    return memory;
}

void ChunkMemory::release(std::byte* memory, size_t bytes) {
    free_.push_back({memory, bytes});
}

void initArchetype(Archetype& a, uint32_t index, const ComponentMask& mask) {
    AG_CHECK_LT(index, Archetype::kNoIndex);
    a.index = index;
    a.mask = mask;
    a.columnOf.fill(Archetype::kNoColumn);
    a.with.fill(Archetype::kNoIndex);
    a.without.fill(Archetype::kNoIndex);
    for (ComponentId id = 0; id < kMaxComponents; ++id) {
        if (!mask.has(id)) continue;
        const ComponentType& type = componentType(id);
        a.columnOf[id] = uint8_t(a.components.size());
        if (type.tracked) a.trackedColumns.push_back(a.columnOf[id]);
        a.components.push_back(id);
        a.sizes.push_back(type.sizeBytes);
        a.rowBytes += type.sizeBytes;
    }
}

uint32_t Archetype::rows() const {
    uint32_t sum = 0;
    for (const auto& chunk : chunks)
        sum += chunk->rows;
    return sum;
}

Chunk& addChunk(Archetype& archetype, ChunkMemory& memory) {
    const size_t ordinal = archetype.chunks.size();
    if (archetype.spare && archetype.spare->ordinal == ordinal)
        archetype.chunks.push_back(std::move(archetype.spare));
    else
        archetype.chunks.push_back(makeChunk(archetype, memory, ordinal));
    archetype.last = archetype.chunks.back().get();
    archetype.last->ordinal = uint32_t(ordinal);
    return *archetype.last;
}

void dropLastChunk(Archetype& archetype, ChunkMemory& memory) {
    if (archetype.spare) memory.release(archetype.spare->memory, archetype.spare->bytes);
    archetype.spare = std::move(archetype.chunks.back());
    archetype.chunks.pop_back();
    archetype.last = archetype.chunks.empty() ? nullptr : archetype.chunks.back().get();
}

void setBits(uint64_t* words, uint32_t begin, uint32_t end) {
    if (begin >= end) return;
    const uint32_t first = begin / 64, last = (end - 1) / 64;
    const uint64_t head = ~uint64_t(0) << (begin % 64), tail = ~uint64_t(0) >> (63 - (end - 1) % 64);
    if (first == last) {
        words[first] |= head & tail;
        return;
    }
    words[first] |= head;
    std::fill(words + first + 1, words + last, ~uint64_t(0));
    words[last] |= tail;
}

void markRows(Chunk& chunk, uint32_t begin, uint32_t end) {
    for (const uint8_t column : chunk.archetype->trackedColumns)
        setBits(chunk.rowBits[column], begin, end);
}

}  // namespace ag
