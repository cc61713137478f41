#include "engine/ecs/world.h"

#include <atomic>

#include "engine/core/hash.h"

namespace ag {

ResourceId nextResourceId() {
    static std::atomic<ResourceId> last{0};
    return last++;
}

uint32_t World::archetypeFor(const ComponentMask& mask) {
    std::vector<uint32_t>& same = archetypeOfMask_[combineHash(mask.words[0], mask.words[1])];
    for (uint32_t index : same)
        if (archetypes_[index].mask == mask) return index;
    archetypes_.push_back(makeArchetype(mask));
    same.push_back(uint32_t(archetypes_.size() - 1));
    return same.back();
}

void World::setValue(const Record& record, ComponentValue value) {
    Archetype& archetype = archetypes_[record.archetype];
    const size_t size = componentType(value.id).sizeBytes;
    std::memcpy(archetype.chunks[record.place.chunk]->column(uint32_t(archetype.column(value.id))) +
                    record.place.row * size,
                value.bytes, size);
}

Entity World::createFrom(std::span<const ComponentValue> values) {
    ComponentMask mask;
    for (const ComponentValue& value : values)
        mask.set(value.id);
    Entity entity;
    if (freeIndices_.empty()) {
        entity.index = uint32_t(records_.size());
        records_.emplace_back();
    } else {
        entity.index = freeIndices_.back();
        freeIndices_.pop_back();
    }
    Record& record = records_[entity.index];
    entity.generation = record.generation;
    record.archetype = archetypeFor(mask);
    record.place = pushRow(archetypes_[record.archetype], memory_, entity, version());
    for (const ComponentValue& value : values)
        setValue(record, value);
    ++alive_;
    return entity;
}

void World::takeOut(const Record& record) {
    const Entity moved = removeRow(archetypes_[record.archetype], memory_, record.place, version());
    if (moved) records_[moved.index].place = record.place;
}

void World::destroy(Entity entity) {
    if (!alive(entity)) return;
    Record& record = records_[entity.index];
    takeOut(record);
    record.archetype = kNone;
    ++record.generation;
    freeIndices_.push_back(entity.index);
    --alive_;
}

// Into another archetype, taking along the components both have.
void World::move(Entity entity, uint32_t to) {
    Record& record = records_[entity.index];
    const Record old = record;
    Archetype& target = archetypes_[to];
    const Archetype& source = archetypes_[old.archetype];
    record.archetype = to;
    record.place = pushRow(target, memory_, entity, version());
    for (ComponentId id : target.components) {
        const int from = source.column(id);
        if (from < 0) continue;
        const size_t size = componentType(id).sizeBytes;
        setValue(record, {id, source.chunks[old.place.chunk]->column(uint32_t(from)) + old.place.row * size});
    }
    takeOut(old);
}

void World::addFrom(Entity entity, ComponentValue value) {
    AG_CHECK(alive(entity));
    if (void* existing = writeAt(entity, value.id, version())) {
        std::memcpy(existing, value.bytes, componentType(value.id).sizeBytes);
        return;
    }
    ComponentMask mask = archetypes_[records_[entity.index].archetype].mask;
    mask.set(value.id);
    move(entity, archetypeFor(mask));
    setValue(records_[entity.index], value);
}

void World::removeComponent(Entity entity, ComponentId id) {
    if (!alive(entity)) return;
    ComponentMask mask = archetypes_[records_[entity.index].archetype].mask;
    if (!mask.has(id)) return;
    mask.reset(id);
    move(entity, archetypeFor(mask));
}

const void* World::find(Entity entity, ComponentId id) const {
    if (!alive(entity)) return nullptr;
    const Record& record = records_[entity.index];
    const Archetype& archetype = archetypes_[record.archetype];
    const int column = archetype.column(id);
    if (column < 0) return nullptr;
    return archetype.chunks[record.place.chunk]->column(uint32_t(column)) +
           record.place.row * size_t(componentType(id).sizeBytes);
}

void* World::writeAt(Entity entity, ComponentId id, uint32_t version) {
    void* found = const_cast<void*>(find(entity, id));
    if (!found) return nullptr;
    const Record& record = records_[entity.index];
    Archetype& archetype = archetypes_[record.archetype];
    Chunk& chunk = *archetype.chunks[record.place.chunk];
    chunk.versions[size_t(archetype.column(id))] = version;
    if (componentTracked(id))
        chunk.dirtyRows[record.place.row / 64] |= uint64_t(1) << (record.place.row % 64);
    return found;
}

uint64_t World::stateHash() const {
    uint64_t hash = alive_;
    for (const Archetype& archetype : archetypes_) {
        hash = combineHash(combineHash(hash, archetype.mask.words[0]), archetype.mask.words[1]);
        for (const auto& chunk : archetype.chunks) {
            hash = hashBytes(std::as_bytes(std::span(chunk->entities(), chunk->rows)), hash);
            for (uint32_t c = 0; c < archetype.components.size(); ++c)
                hash = hashBytes({chunk->column(c),
                                  chunk->rows * size_t(componentType(archetype.components[c]).sizeBytes)},
                                 hash);
        }
    }
    return hash;
}

}  // namespace ag
