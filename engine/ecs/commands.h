// Structure changes asked for by systems, played back in order at the next flush.
#pragma once

#include "engine/ecs/world.h"

namespace ag {

class Commands {
  public:
    template <class... Ts>
    void create(const Ts&... components) {
        push({Kind::kCreate, Entity{}, uint32_t(sizeof...(Ts))});
        (pushValue(components), ...);
    }
    void destroy(Entity entity) { push({Kind::kDestroy, entity, 0}); }
    template <class T>
    void add(Entity entity, const T& value) {
        push({Kind::kAdd, entity, 1});
        pushValue(value);
    }
    template <class T>
    void remove(Entity entity) {
        push({Kind::kRemove, entity, componentId<T>()});
    }
    bool empty() const { return ops_.empty(); }
    // Entities that died meanwhile are passed over. Keeps its memory.
    void play(World& world);

  private:
    enum class Kind : uint32_t { kCreate, kDestroy, kAdd, kRemove };
    struct Op {
        Kind kind;
        Entity entity;
        uint32_t count;  // of values; kRemove: the component
    };
    struct Value {
        ComponentId id;
        uint32_t offset;  // in bytes_
    };
    void push(Op op) { ops_.push_back(op); }
    template <class T>
    void pushValue(const T& value) {
        values_.push_back({componentId<T>(), uint32_t(bytes_.size())});
        const auto* from = reinterpret_cast<const std::byte*>(&value);
        bytes_.insert(bytes_.end(), from, from + sizeof value);
    }

    std::vector<Op> ops_;
    std::vector<Value> values_;
    std::vector<std::byte> bytes_;
    std::vector<ComponentValue> scratch_;
};

}  // namespace ag
