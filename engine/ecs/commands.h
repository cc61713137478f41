// Structure changes asked for by systems, played back at the next flush: first what happens to entities there
// are, in the order asked for; then the new ones, together by their components, so that they are made in
// bulk.
#pragma once

#include "engine/ecs/world.h"

namespace ag {

// Values of one component, one after the other; keeps its memory.
class ByteColumn {
  public:
    template <class T>
    void push(const T& value) {
        if (size_ + sizeof(T) > capacity_) grow(sizeof(T));
        std::memcpy(data_.get() + size_, &value, sizeof(T));
        size_ += sizeof(T);
    }
    const std::byte* data() const { return data_.get(); }
    size_t size() const { return size_; }
    void clear() { size_ = 0; }

  private:
    void grow(size_t more);
    std::unique_ptr<std::byte[]> data_;
    size_t size_ = 0, capacity_ = 0;
};

class Commands {
  public:
    template <class... Ts>
    void create(const Ts&... components) {
        Batch& batch = batchOf(bundleType<Ts...>());
        size_t i = 0;
        const auto put = [&]<class T>(const T& value) {
            if constexpr (!std::is_empty_v<T>) batch.columns[i].push(value);
            ++i;
        };
        (put(components), ...);
        ++batch.count;
    }
    void destroy(Entity entity) { edits_.push_back({Kind::kDestroy, 0, entity, 0}); }
    template <class T>
    void add(Entity entity, const T& value) {
        edits_.push_back({Kind::kAdd, componentId<T>(), entity, uint32_t(values_.size())});
        values_.push(value);
    }
    template <class T>
    void remove(Entity entity) {
        edits_.push_back({Kind::kRemove, componentId<T>(), entity, 0});
    }
    bool empty() const { return edits_.empty() && used_.empty() && partCount_ == 0; }
    // Entities that died meanwhile are passed over. Keeps its memory.
    void play(World& world);
    // Buffers for a loop on several threads, played after this one in their order.
    std::span<const std::unique_ptr<Commands>> parts(uint32_t count);

  private:
    enum class Kind : uint16_t { kDestroy, kAdd, kRemove };
    struct Edit {
        Kind kind;
        ComponentId component;
        Entity entity;
        uint32_t offset;  // in values_
    };
    struct Batch {
        const BundleType* type = nullptr;
        uint32_t count = 0;
        std::vector<ByteColumn> columns;
    };
    Batch& batchOf(const BundleType& type) {
        if (last_ < batches_.size() && batches_[last_].type == &type && batches_[last_].count > 0)
            return batches_[last_];
        return findBatch(type);
    }
    Batch& findBatch(const BundleType& type);
    void playEdits(World& world);

    std::vector<Edit> edits_;
    ByteColumn values_;
    std::vector<Batch> batches_;
    std::vector<uint32_t> used_;  // batches of this time, in the order of their first entity
    uint32_t last_ = 0;
    std::vector<std::unique_ptr<Commands>> parts_;
    uint32_t partCount_ = 0;
};

}  // namespace ag
