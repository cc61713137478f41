// Entities, their components and the world's resources.
//
// Every column of every chunk carries a version: frame x 256 + position of the writing system. Because it
// holds the position and not the time, it is the same on one thread and on many, and a writer late in a frame
// is seen by an early reader of the next. Structure changes (create, destroy, add, remove) happen here
// directly, or from systems through Commands at a flush.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <unordered_map>
#include <utility>

#include "engine/ecs/storage.h"

namespace ag {

constexpr uint32_t kVersionsPerFrame = 256;
constexpr uint32_t kFlushPosition = 255;  // in a frame: where structure changes, after all systems

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

// Component values to create an entity with or add to one.
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
    Entity create(const Ts&... components) {
        const ComponentValue values[] = {ComponentValue{componentId<Ts>(), &components}..., ComponentValue{}};
        return createFrom({values, sizeof...(Ts)});
    }
    Entity createFrom(std::span<const ComponentValue> values);
    void destroy(Entity entity);  // nothing if it is not alive
    bool alive(Entity entity) const {
        return entity.index < records_.size() && records_[entity.index].generation == entity.generation &&
               records_[entity.index].archetype != kNone;
    }

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
        return alive(entity) && archetypes_[records_[entity.index].archetype].column(componentId<T>()) >= 0;
    }
    template <class T>
    const T* get(Entity entity) const {  // null if it is dead or has none
        return static_cast<const T*>(find(entity, componentId<T>()));
    }
    // For writing: stamps the column and, if tracked, the row with the version now.
    template <class T>
    T* write(Entity entity) {
        return static_cast<T*>(writeAt(entity, componentId<T>(), version()));
    }
    void* writeAt(Entity entity, ComponentId id, uint32_t version);

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
    T& resource() const {
        const ResourceId id = resourceId<T>();
        AG_CHECK_MSG(id < resources_.size() && resources_[id], "the resource was never set");
        return *static_cast<T*>(resources_[id].get());
    }

    uint32_t entityCount() const { return alive_; }
    std::deque<Archetype>& archetypes() { return archetypes_; }
    const std::deque<Archetype>& archetypes() const { return archetypes_; }
    uint32_t frame() const { return frame_; }
    void advanceFrame() { ++frame_; }
    uint32_t version() const { return frame_ * kVersionsPerFrame + kFlushPosition; }

    // Over all rows in storage order: equal for equal worlds however many threads made them.
    uint64_t stateHash() const;

  private:
    static constexpr uint32_t kNone = ~0u;
    struct Record {
        uint32_t generation = 0;
        uint32_t archetype = kNone;
        RowPlace place;
    };
    uint32_t archetypeFor(const ComponentMask& mask);
    const void* find(Entity entity, ComponentId id) const;
    void setValue(const Record& record, ComponentValue value);
    void takeOut(const Record& record);
    void move(Entity entity, uint32_t to);

    std::vector<Record> records_;
    std::vector<uint32_t> freeIndices_;
    std::deque<Archetype> archetypes_;  // stays in place: views hold references
    std::unordered_map<uint64_t, std::vector<uint32_t>> archetypeOfMask_;
    ChunkMemory memory_;
    std::vector<std::shared_ptr<void>> resources_;
    uint32_t alive_ = 0;
    uint32_t frame_ = 1;
};

}  // namespace ag
