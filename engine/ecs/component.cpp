#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>

#include "engine/ecs/entity.h"

namespace ag {
namespace {

struct Registry {
    std::mutex mutex;  // of writers; entries below `count` never change
    std::array<ComponentType, kMaxComponents> types;
    std::atomic<uint32_t> count{0};
};

Registry& registry() {
    static Registry instance;  // type identity is a fact of the process, not state
    return instance;
}

}  // namespace

ComponentId nextComponentId(const ComponentType& type) {
    Registry& r = registry();
    const std::lock_guard lock(r.mutex);
    const uint32_t id = r.count;
    AG_CHECK_LT(id, kMaxComponents);
    r.types[id] = type;
    r.count = id + 1;
    return id;
}

const ComponentType& componentType(ComponentId id) {
    return registry().types[id];
}

uint32_t componentTypeCount() {
    return registry().count;
}

ComponentId componentNamed(std::string_view name) {
    const Registry& r = registry();
    const auto end = r.types.begin() + r.count;
    const auto found =
        std::find_if(r.types.begin(), end, [&](const ComponentType& t) { return t.name == name; });
    return found == end ? kMaxComponents : ComponentId(found - r.types.begin());
}

}  // namespace ag
