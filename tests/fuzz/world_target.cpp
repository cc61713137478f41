// Saved worlds. The checksum is made right, so that what lies behind it is reached.
#include <cstring>

#include "engine/core/hash.h"
#include "engine/ecs/snapshot.h"

namespace {

struct Position {
    double x = 0, y = 0;
};
struct Marked {};
struct Count {
    uint32_t n = 0;
};

// The types exist once they are asked for.
void knowTypes() {
    static ag::World known;
    static const ag::Entity kOne = known.create(Position{}, Marked{}, Count{});
    (void)kOne;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    knowTypes();
    std::vector<std::byte> saved(size);
    if (size > 0) std::memcpy(saved.data(), bytes, size);
    ag::World world;
    (void)ag::restoreWorld(world, saved);
    const uint64_t hash = ag::hashBytes(saved);
    const auto* tail = reinterpret_cast<const std::byte*>(&hash);
    saved.insert(saved.end(), tail, tail + sizeof hash);
    if (ag::restoreWorld(world, saved)) {
        world.create(Position{}, Count{});
        (void)ag::saveWorld(world);
    }
    return 0;
}
