// Parameters of systems beside View: other entities' components, and resources.
#pragma once

#include "engine/ecs/terms.h"

namespace ag {

// Access to a component of any entity, the only way to other entities' rows.
template <class T>
class Lookup {
  public:
    Lookup(World& world, SystemTime time) : world_(&world), time_(time) {}
    static void access(Access& a) { detail::Term<T>::access(a); }
    // Null if it is dead or has none. For writing from one thread only.
    T* operator()(Entity entity) const {
        if constexpr (std::is_const_v<T>)
            return world_->get<std::remove_const_t<T>>(entity);
        else
            return static_cast<T*>(world_->writeAt(entity, componentId<T>(), time_.version));
    }

    // Whether the entity's chunk was written since the system last ran; false if it is dead or has none.
    bool changed(Entity entity) const {
        return world_->writtenSince(entity, componentId<std::remove_const_t<T>>(), time_.lastRun);
    }

  private:
    World* world_;
    SystemTime time_;
};

// One of the world's resources.
template <class T>
class Res {
  public:
    Res(World& world, SystemTime) : value_(&world.resource<std::remove_const_t<T>>()) {}
    static void access(Access& a) {
        const ResourceId id = resourceId<std::remove_const_t<T>>();
        AG_CHECK_LT(id, kMaxComponents);
        (std::is_const_v<T> ? a.resourceReads : a.resourceWrites).set(id);
    }
    T& operator*() const { return *value_; }
    T* operator->() const { return value_; }

  private:
    T* value_;
};

}  // namespace ag
