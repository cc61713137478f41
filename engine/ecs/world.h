// Entities, their components and the world's resources.
//
// Every column of every chunk carries a version: frame x 256 + position of the writing system. Because it
// holds the position and not the time, it is the same on one thread and on many, and a writer late in a frame
// is seen by an early reader of the next. Structure changes (create, destroy, add, remove) happen here
// directly, or from systems through Commands at a flush. Pointers to components last until the next of these.
#pragma once

#include <deque>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

#include "engine/ecs/bundle.h"
#include "engine/ecs/query.h"

namespace ag {

constexpr uint32_t kVersionsPerFrame = 256;
constexpr uint32_t kEndOfFrame = 255;  // position of what happens after all systems

inline bool newerThan(uint32_t version, uint32_t than) {
    return int32_t(version - than) > 0;
}

using ResourceId = uint32_t;
ResourceId nextResourceId();
template <class T>
ResourceId resourceId() {
    static const ResourceId id = nextResourceId();
    return id;
}

struct ComponentValue {
    ComponentId id;
    const void* bytes;
};

class World {
  public:
    World() = default;
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    template <class... Ts>
    Entity create(const Ts&... components);
    // Many at once, the cheapest way: fill(std::span<const Entity>, std::span<Ts>...) is called for each run
    // of new rows and must write every one.
    template <class... Ts, class F>
    void createMany(uint32_t count, F&& fill);
    // The same from columns of bytes, parallel to the bundle's components.
    void createRows(const BundleType& type, uint32_t count, const std::byte* const* columns);
    void destroy(Entity entity);  // nothing if it is not alive
    void destroy(std::span<const Entity> entities);
    bool alive(Entity entity) const { return recordOf(entity) != nullptr; }
    // Hints for work on many entities in random order: first its record, some turns later its row.
    void prefetchRecord(Entity entity) const {
        if (entity.index < records_.size()) __builtin_prefetch(&records_[entity.index], 1);
    }
    void prefetchRow(Entity entity) const;

    template <class T>
    void add(Entity entity, const T& value) {
        addFrom(entity, {componentId<T>(), &value});
    }
    void addFrom(Entity entity, ComponentValue value);  // overwrites one it has
    template <class T>
    void remove(Entity entity) {
        removeComponent(entity, componentId<T>());
    }
    void removeComponent(Entity entity, ComponentId id);

    template <class T>
    bool has(Entity entity) const {
        return find(entity, componentId<T>()) != nullptr;
    }
    template <class T>
    const T* get(Entity entity) const {  // null if it is dead or has none
        const Record* record = recordOf(entity);
        if (!record) return nullptr;
        const uint32_t offset = (*record->chunk->layout)[componentId<T>()];
        if (offset == 0) return nullptr;
        return reinterpret_cast<const T*>(record->chunk->memory + offset) + record->row;
    }
    // For writing: stamps the column and, if tracked, the row with the version now.
    template <class T>
    T* write(Entity entity) {
        ++editCount_;
        return static_cast<T*>(writeAt(entity, componentId<T>(), version()));
    }
    void* writeAt(Entity entity, ComponentId id, uint32_t version);
    // Null if it is dead or has none.
    const void* find(Entity entity, ComponentId id) const {
        const Record* record = recordOf(entity);
        if (!record) return nullptr;
        const uint32_t offset = (*record->chunk->layout)[id];
        if (offset == 0) return nullptr;
        return record->chunk->memory + offset + record->row * size_t(componentType(id).sizeBytes);
    }
    // Whether the chunk the entity is in had the component written, or its rows moved, since a version.
    bool writtenSince(Entity entity, ComponentId id, uint32_t version) const {
        const Record* record = recordOf(entity);
        if (!record) return false;
        const Chunk& chunk = *record->chunk;
        const uint8_t column = chunk.archetype->columnOf[id];
        if (column == Archetype::kNoColumn) return false;
        // Other rows of the chunk may be written, and stamped, by other threads meanwhile.
        const uint32_t written =
            std::atomic_ref(const_cast<uint32_t&>(chunk.versions[column])).load(std::memory_order_relaxed);
        return newerThan(written, version) || newerThan(chunk.structureVersion, version);
    }
    const Archetype* archetypeOf(Entity entity) const {  // null if it is dead
        return alive(entity) ? records_[entity.index].chunk->archetype : nullptr;
    }

    // One of each type; made by setResource, read by Res<T>.
    template <class T, class... Args>
    T& setResource(Args&&... args) {
        const ResourceId id = resourceId<T>();
        if (resources_.size() <= id) resources_.resize(id + 1);
        resources_[id] = std::shared_ptr<void>(new T{std::forward<Args>(args)...},
                                               [](void* p) { delete static_cast<T*>(p); });
        return *static_cast<T*>(resources_[id].get());
    }
    template <class T>
    T* findResource() const {  // null if it was never set
        const ResourceId id = resourceId<T>();
        return id < resources_.size() ? static_cast<T*>(resources_[id].get()) : nullptr;
    }
    template <class T>
    T& resource() const {
        T* found = findResource<T>();
        AG_CHECK_MSG(found, "the resource was never set");
        return *found;
    }

    uint32_t entityCount() const { return alive_; }
    std::deque<Archetype>& archetypes() { return archetypes_; }
    const std::deque<Archetype>& archetypes() const { return archetypes_; }
    // The newest of a component's columns: an index made of them is stale if this or the edit count differs.
    uint32_t columnVersion(ComponentId id) const;
    std::span<const QueryMatch> matches(const QueryShape& shape);
    size_t chunkMemoryBytes() const { return memory_.slabBytes(); }
    uint32_t frame() const { return frame_; }
    void advanceFrame() { ++frame_; }
    // Stamped on what is changed on the world itself: between frames as before all systems of the next,
    // during a frame at the position of the system that runs alone.
    uint32_t version() const { return frame_ * kVersionsPerFrame + position_; }
    void setPosition(uint32_t position) { position_ = position; }
    // Moves with every create, destroy, add, remove and write called on the world itself; what systems write
    // is in the versions of columns.
    uint64_t editCount() const { return editCount_; }

    // Over all rows in storage order: equal for equal worlds however many threads made them.
    uint64_t stateHash() const;

  private:
    friend struct WorldSnapshot;
    static constexpr uint32_t kNone = ~0u;
    struct Record {
        Chunk* chunk = nullptr;  // null: free
        uint32_t row = 0;        // free: the next free index
        uint32_t generation = 0;
    };
    struct NewRows {
        Chunk* chunk;
        uint32_t begin, count;
    };
    const Record* recordOf(Entity entity) const {  // null if it is dead
        if (entity.index >= records_.size()) return nullptr;
        const Record& record = records_[entity.index];
        return record.generation == entity.generation && record.chunk ? &record : nullptr;
    }
    Entity takeHandle() {
        if (freeHead_ == kNone) {
            records_.emplace_back();
            return {uint32_t(records_.size() - 1), 0};
        }
        const uint32_t index = freeHead_;
        freeHead_ = records_[index].row;
        return {index, records_[index].generation};
    }
    const Bundle& bundleOf(const BundleType& type) {
        if (type.id < bundles_.size() && bundles_[type.id].archetype) return bundles_[type.id];
        return makeBundle(type);
    }
    const Bundle& makeBundle(const BundleType& type);
    void reserveHandles(uint32_t count) {
        if (records_.capacity() < records_.size() + count)
            records_.reserve(std::max(records_.size() + count, records_.capacity() * 2));
    }
    NewRows pushRows(Archetype& archetype, uint32_t most);
    Archetype& archetypeFor(const ComponentMask& mask);
    void takeOut(const Record& record);
    Record& move(Entity entity, Archetype& to, ComponentId id);
    void swapEntities(World& other);

    std::vector<Record> records_;
    uint32_t freeHead_ = kNone;
    uint32_t alive_ = 0;
    uint32_t frame_ = 1;
    uint32_t position_ = 0;
    uint64_t editCount_ = 0;
    std::deque<Archetype> archetypes_;  // stays in place: chunks and views point at them
    std::unordered_map<uint64_t, std::vector<uint32_t>> archetypeOfMask_;
    std::vector<Bundle> bundles_;
    std::array<std::atomic<QueryMatches*>, kMaxQueries> queries_{};
    std::vector<std::unique_ptr<QueryMatches>> ownedQueries_;
    std::mutex queryMutex_;
    ChunkMemory memory_;
    std::vector<std::shared_ptr<void>> resources_;
};

template <class... Ts>
Entity World::create(const Ts&... components) {
    const Bundle& bundle = bundleOf(bundleType<Ts...>());
    const Entity entity = takeHandle();
    const RowPlace place = pushRow(*bundle.archetype, memory_, entity, version());
    size_t i = 0;
    const auto put = [&]<class T>(const T& value) {
        std::byte* column = place.chunk->columns[bundle.columns[i++]];
        if constexpr (!std::is_empty_v<T>) std::memcpy(column + place.row * sizeof(T), &value, sizeof(T));
    };
    (put(components), ...);
    Record& record = records_[entity.index];
    record.chunk = place.chunk;
    record.row = place.row;
    ++alive_;
    ++editCount_;
    return entity;
}

template <class... Ts, class F>
void World::createMany(uint32_t count, F&& fill) {
    const Bundle bundle = bundleOf(bundleType<Ts...>());
    reserveHandles(count);
    while (count > 0) {
        const NewRows rows = pushRows(*bundle.archetype, count);
        size_t i = 0;
        const auto column = [&]<class T>(T*) {
            std::byte* begin = rows.chunk->columns[bundle.columns[i++]];
            if constexpr (std::is_empty_v<T>) return std::span<T>();  // a tag has nothing to write
            return std::span<T>(reinterpret_cast<T*>(begin) + rows.begin, rows.count);
        };
        std::apply(
            [&](auto... spans) {
                fill(std::span<const Entity>(rows.chunk->entities + rows.begin, rows.count), spans...);
            },
            std::tuple<std::span<Ts>...>{column(static_cast<Ts*>(nullptr))...});
        count -= rows.count;
    }
}

}  // namespace ag
