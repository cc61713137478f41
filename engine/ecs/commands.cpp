#include "engine/ecs/commands.h"

#include <algorithm>

namespace ag {

void ByteColumn::grow(size_t more) {
    capacity_ = std::max(capacity_ * 2, std::max<size_t>(size_ + more, 256));
    auto larger = std::make_unique_for_overwrite<std::byte[]>(capacity_);
    if (size_ > 0) std::memcpy(larger.get(), data_.get(), size_);
    data_ = std::move(larger);
}

Commands::Batch& Commands::findBatch(const BundleType& type) {
    const auto found = std::ranges::find(batches_, &type, &Batch::type);
    last_ = uint32_t(found - batches_.begin());
    if (found == batches_.end()) {
        batches_.push_back({.type = &type, .count = 0, .columns = {}});
        batches_.back().columns.resize(type.components.size());
    }
    if (batches_[last_].count == 0) used_.push_back(last_);
    return batches_[last_];
}

std::span<const std::unique_ptr<Commands>> Commands::parts(uint32_t count) {
    while (parts_.size() < partCount_ + count)
        parts_.push_back(std::make_unique<Commands>());
    partCount_ += count;
    return std::span(parts_).subspan(partCount_ - count, count);
}

// Entities come in any order: what the next ones need is fetched ahead.
void Commands::playEdits(World& world) {
    constexpr size_t kRecordAhead = 16, kRowAhead = 8;
    for (size_t i = 0; i < edits_.size(); ++i) {
        if (i + kRecordAhead < edits_.size()) world.prefetchRecord(edits_[i + kRecordAhead].entity);
        if (i + kRowAhead < edits_.size()) world.prefetchRow(edits_[i + kRowAhead].entity);
        const Edit& edit = edits_[i];
        switch (edit.kind) {
            case Kind::kDestroy:
                world.destroy(edit.entity);
                break;
            case Kind::kAdd:
                if (world.alive(edit.entity))
                    world.addFrom(edit.entity, {edit.component, values_.data() + edit.offset});
                break;
            case Kind::kRemove:
                world.removeComponent(edit.entity, edit.component);
                break;
        }
    }
    edits_.clear();
    values_.clear();
}

void Commands::play(World& world) {
    playEdits(world);
    for (const uint32_t index : used_) {
        Batch& batch = batches_[index];
        std::array<const std::byte*, kMostBundleTypes> columns{};
        for (size_t i = 0; i < batch.columns.size(); ++i)
            columns[i] = batch.columns[i].data();
        world.createRows(*batch.type, batch.count, columns.data());
        batch.count = 0;
        for (ByteColumn& column : batch.columns)
            column.clear();
    }
    used_.clear();
    for (uint32_t i = 0; i < partCount_; ++i)
        parts_[i]->play(world);
    partCount_ = 0;
}

}  // namespace ag
