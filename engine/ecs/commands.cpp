#include "engine/ecs/commands.h"

namespace ag {

void Commands::play(World& world) {
    size_t value = 0;
    for (const Op& op : ops_) {
        switch (op.kind) {
            case Kind::kCreate:
                scratch_.clear();
                for (uint32_t i = 0; i < op.count; ++i, ++value)
                    scratch_.push_back({values_[value].id, bytes_.data() + values_[value].offset});
                world.createFrom(scratch_);
                break;
            case Kind::kDestroy:
                world.destroy(op.entity);
                break;
            case Kind::kAdd:
                if (world.alive(op.entity))
                    world.addFrom(op.entity, {values_[value].id, bytes_.data() + values_[value].offset});
                ++value;
                break;
            case Kind::kRemove:
                world.removeComponent(op.entity, op.count);
                break;
        }
    }
    ops_.clear();
    values_.clear();
    bytes_.clear();
}

}  // namespace ag
