#include "engine/ecs/world.h"

#include <algorithm>

#include "engine/core/hash.h"

namespace ag {

ResourceId nextResourceId() {
    static std::atomic<ResourceId> last{0};
    return last++;
}

uint32_t nextBundleId() {
    static std::atomic<uint32_t> last{0};
    return last++;
}

uint32_t nextQueryId() {
    static std::atomic<uint32_t> last{0};
    const uint32_t id = last++;
    AG_CHECK_LT(id, kMaxQueries);
    return id;
}

Archetype& World::archetypeFor(const ComponentMask& mask) {
    std::vector<uint32_t>& same = archetypeOfMask_[combineHash(mask.words[0], mask.words[1])];
    for (uint32_t index : same)
        if (archetypes_[index].mask == mask) return archetypes_[index];
    same.push_back(uint32_t(archetypes_.size()));
    Archetype& fresh = archetypes_.emplace_back();
    initArchetype(fresh, same.back(), mask);
    return fresh;
}

const Bundle& World::makeBundle(const BundleType& type) {
    ComponentMask mask;
    for (ComponentId id : type.components)
        mask.set(id);
    if (bundles_.size() <= type.id) bundles_.resize(type.id + 1);
    Bundle& bundle = bundles_[type.id];
    bundle.archetype = &archetypeFor(mask);
    for (size_t i = 0; i < type.components.size(); ++i)
        bundle.columns[i] = bundle.archetype->columnOf[type.components[i]];
    return bundle;
}

// Systems on several threads may ask at once; archetypes are only made while none run.
std::span<const QueryMatch> World::matches(const QueryShape& shape) {
    QueryMatches* known = queries_[shape.id].load(std::memory_order_acquire);
    if (known && known->seen.load(std::memory_order_acquire) == archetypes_.size()) return known->list;
    const std::lock_guard lock(queryMutex_);
    known = queries_[shape.id].load(std::memory_order_acquire);
    if (!known) {
        known = ownedQueries_.emplace_back(std::make_unique<QueryMatches>()).get();
        queries_[shape.id].store(known, std::memory_order_release);
    }
    for (uint32_t i = known->seen; i < archetypes_.size(); ++i) {
        Archetype& a = archetypes_[i];
        if (!a.mask.containsAll(shape.with) || a.mask.intersects(shape.without)) continue;
        QueryMatch& match = known->list.emplace_back(QueryMatch{&a, {}});
        for (uint32_t c = 0; c < shape.columnCount; ++c)
            match.columns[c] = a.columnOf[shape.columns[c]];
    }
    known->seen.store(uint32_t(archetypes_.size()), std::memory_order_release);
    return known->list;
}

// As many as fit the last chunk, at most `most`, with handles.
World::NewRows World::pushRows(Archetype& archetype, uint32_t most) {
    Chunk* chunk = archetype.last;
    if (!chunk || chunk->rows == chunk->capacity) chunk = &addChunk(archetype, memory_);
    const uint32_t begin = chunk->rows, count = std::min(most, chunk->capacity - begin);
    uint32_t i = 0;
    for (; i < count && freeHead_ != kNone; ++i) {
        const Entity entity = takeHandle();
        chunk->entities[begin + i] = entity;
        records_[entity.index].chunk = chunk;
        records_[entity.index].row = begin + i;
    }
    for (; i < count; ++i) {
        chunk->entities[begin + i] = {uint32_t(records_.size()), 0};
        records_.push_back({chunk, begin + i, 0});
    }
    chunk->rows += count;
    chunk->structureVersion = version();
    alive_ += count;
    ++editCount_;
    if (!archetype.trackedColumns.empty()) markRows(*chunk, begin, begin + count);
    return {chunk, begin, count};
}

void World::createRows(const BundleType& type, uint32_t count, const std::byte* const* columns) {
    const Bundle bundle = bundleOf(type);
    reserveHandles(count);
    for (uint32_t done = 0; done < count;) {
        const NewRows rows = pushRows(*bundle.archetype, count - done);
        for (size_t i = 0; i < type.components.size(); ++i) {
            const size_t size = bundle.archetype->sizes[bundle.columns[i]];
            if (size > 0)
                std::memcpy(rows.chunk->columns[bundle.columns[i]] + rows.begin * size,
                            columns[i] + done * size, rows.count * size);
        }
        done += rows.count;
    }
}

void World::takeOut(const Record& record) {
    const Entity moved = removeRow({record.chunk, record.row}, memory_, version());
    if (!moved) return;
    records_[moved.index].chunk = record.chunk;
    records_[moved.index].row = record.row;
}

void World::destroy(Entity entity) {
    if (!alive(entity)) return;
    Record& record = records_[entity.index];
    takeOut(record);
    record.chunk = nullptr;
    record.row = freeHead_;
    ++record.generation;
    freeHead_ = entity.index;
    --alive_;
    ++editCount_;
}

void World::prefetchRow(Entity entity) const {
    if (entity.index >= records_.size()) return;
    const Record& record = records_[entity.index];
    if (!record.chunk) return;
    __builtin_prefetch(record.chunk->entities + record.row, 1);
    const Archetype& archetype = *record.chunk->archetype;
    for (size_t c = 0; c < archetype.sizes.size(); ++c)
        __builtin_prefetch(record.chunk->columns[c] + record.row * size_t(archetype.sizes[c]), 1);
}

void World::destroy(std::span<const Entity> entities) {
    constexpr size_t kRecordAhead = 16, kRowAhead = 8;
    for (size_t i = 0; i < entities.size(); ++i) {
        if (i + kRecordAhead < entities.size()) prefetchRecord(entities[i + kRecordAhead]);
        if (i + kRowAhead < entities.size()) prefetchRow(entities[i + kRowAhead]);
        destroy(entities[i]);
    }
}

// Into an archetype that has `id` more or less, taking the others along.
World::Record& World::move(Entity entity, Archetype& to, ComponentId id) {
    Record& record = records_[entity.index];
    const Record old = record;
    const Archetype& from = *old.chunk->archetype;
    const RowPlace place = pushRow(to, memory_, entity, version());
    const bool gains = to.sizes.size() > from.sizes.size();
    const size_t differs = gains ? to.columnOf[id] : from.columnOf[id];
    const size_t count = from.sizes.size();
    std::byte* const* source = old.chunk->columns.data();
    std::byte* const* target = place.chunk->columns.data();
    const auto copy = [&](size_t c, size_t t) {
        const size_t size = from.sizes[c];
        copyRow(target[t] + place.row * size, source[c] + old.row * size, size);
    };
    for (size_t c = 0; c < differs; ++c)
        copy(c, c);
    for (size_t c = differs + !gains; c < count; ++c)
        copy(c, gains ? c + 1 : c - 1);
    takeOut(old);
    record.chunk = place.chunk;
    record.row = place.row;
    ++editCount_;
    return record;
}

void World::addFrom(Entity entity, ComponentValue value) {
    const Record* found = recordOf(entity);
    AG_CHECK(found);
    Archetype& from = *found->chunk->archetype;
    if (from.columnOf[value.id] != Archetype::kNoColumn) {
        void* existing = writeAt(entity, value.id, version());
        if (const size_t size = from.sizes[from.columnOf[value.id]]) std::memcpy(existing, value.bytes, size);
        ++editCount_;
        return;
    }
    if (from.with[value.id] == Archetype::kNoIndex) {
        ComponentMask mask = from.mask;
        mask.set(value.id);
        from.with[value.id] = uint16_t(archetypeFor(mask).index);
    }
    Archetype& to = archetypes_[from.with[value.id]];
    const Record& record = move(entity, to, value.id);
    const uint8_t column = to.columnOf[value.id];
    const size_t size = to.sizes[column];
    copyRow(record.chunk->columns[column] + record.row * size, static_cast<const std::byte*>(value.bytes),
            size);
}

void World::removeComponent(Entity entity, ComponentId id) {
    const Record* found = recordOf(entity);
    if (!found) return;
    Archetype& from = *found->chunk->archetype;
    if (from.columnOf[id] == Archetype::kNoColumn) return;
    if (from.without[id] == Archetype::kNoIndex) {
        ComponentMask mask = from.mask;
        mask.reset(id);
        from.without[id] = uint16_t(archetypeFor(mask).index);
    }
    move(entity, archetypes_[from.without[id]], id);
}

void* World::writeAt(Entity entity, ComponentId id, uint32_t version) {
    void* found = const_cast<void*>(find(entity, id));
    if (!found) return nullptr;
    const Record& record = records_[entity.index];
    Chunk& chunk = *record.chunk;
    const uint8_t column = chunk.archetype->columnOf[id];
    stampVersion(chunk.versions[column], version);
    if (uint64_t* bits = chunk.rowBits[column]) bits[record.row / 64] |= uint64_t(1) << (record.row % 64);
    return found;
}

uint32_t World::columnVersion(ComponentId id) const {
    uint32_t newest = 0;
    for (const Archetype& archetype : archetypes_) {
        if (!archetype.mask.has(id)) continue;
        for (const auto& chunk : archetype.chunks)
            for (const uint32_t version : {chunk->versions[archetype.columnOf[id]], chunk->structureVersion})
                if (newest == 0 || newerThan(version, newest)) newest = version;
    }
    return newest;
}

uint64_t World::stateHash() const {
    uint64_t hash = alive_;
    for (const Archetype& archetype : archetypes_) {
        hash = combineHash(combineHash(hash, archetype.mask.words[0]), archetype.mask.words[1]);
        for (const auto& chunk : archetype.chunks) {
            hash = hashBytes(std::as_bytes(std::span(chunk->entities, chunk->rows)), hash);
            for (size_t c = 0; c < archetype.sizes.size(); ++c)
                hash = hashBytes({chunk->columns[c], chunk->rows * size_t(archetype.sizes[c])}, hash);
        }
    }
    return hash;
}

// All but the resources and the frame.
void World::swapEntities(World& other) {
    std::swap(records_, other.records_);
    std::swap(freeHead_, other.freeHead_);
    std::swap(alive_, other.alive_);
    std::swap(archetypes_, other.archetypes_);
    std::swap(archetypeOfMask_, other.archetypeOfMask_);
    memory_.swap(other.memory_);
    for (World* world : {this, &other}) {
        ++world->editCount_;
        world->bundles_.clear();
        for (auto& query : world->queries_)
            query = nullptr;
        world->ownedQueries_.clear();
    }
}

}  // namespace ag
