// The limit: a vector a component and a checked handle table, columns known at compile time.
#pragma once

#include <algorithm>
#include <tuple>
#include <vector>

#include "engine/ecs/entity.h"

namespace ag::ecs_bench {

class HandleTable {
  public:
    struct Record {
        uint32_t row = 0;
        uint32_t generation = 0;
        uint32_t table = ~0u;  // none: free
    };
    Entity take(uint32_t row, uint32_t table) {
        Entity entity;
        if (free_.empty()) {
            entity = {uint32_t(records_.size()), 0};
            records_.push_back({row, 0, table});
        } else {
            entity = {free_.back(), records_[free_.back()].generation};
            free_.pop_back();
            records_[entity.index] = {row, entity.generation, table};
        }
        return entity;
    }
    void release(Entity entity) {
        ++records_[entity.index].generation;
        records_[entity.index].table = ~0u;
        free_.push_back(entity.index);
    }
    Record* find(Entity entity) {
        if (entity.index >= records_.size()) return nullptr;
        Record& record = records_[entity.index];
        return record.generation == entity.generation && record.table != ~0u ? &record : nullptr;
    }

  private:
    std::vector<Record> records_;
    std::vector<uint32_t> free_;
};

template <class... Ts>
class PlainTable {
  public:
    explicit PlainTable(HandleTable& handles, uint32_t id = 0) : handles_(handles), id_(id) {}

    Entity create(const Ts&... values) {
        const Entity entity = handles_.take(uint32_t(owners_.size()), id_);
        append(entity, values...);
        return entity;
    }
    uint32_t append(Entity entity, const Ts&... values) {
        owners_.push_back(entity);
        (column<Ts>().push_back(values), ...);
        return uint32_t(owners_.size() - 1);
    }
    template <class F>
    void createMany(uint32_t count, F&& fill) {  // fill(index, T&...)
        owners_.resize(count);
        (column<Ts>().resize(count), ...);
        for (uint32_t i = 0; i < count; ++i)
            owners_[i] = handles_.take(i, id_);
        uint32_t i = 0;
        each([&](Ts&... values) { fill(i++, values...); });
    }
    void destroy(Entity entity) {
        const HandleTable::Record* record = handles_.find(entity);
        if (!record) return;
        takeOut(record->row);
        handles_.release(entity);
    }
    void takeOut(uint32_t row) {
        const Entity moved = owners_.back();
        owners_[row] = moved;
        ((column<Ts>()[row] = column<Ts>().back(), column<Ts>().pop_back()), ...);
        owners_.pop_back();
        if (row < owners_.size()) handles_.find(moved)->row = row;
    }
    void clear() {
        for (const Entity entity : owners_)
            handles_.release(entity);
        owners_.clear();
        (column<Ts>().clear(), ...);
    }
    template <class F>
    void each(F&& f) {
        const size_t rows = owners_.size();
        [&](Ts*... columns) {
            for (size_t i = 0; i < rows; ++i)
                f(columns[i]...);
        }(column<Ts>().data()...);
    }
    template <class T>
    std::vector<T>& column() {
        return std::get<std::vector<T>>(columns_);
    }
    std::vector<Entity>& owners() { return owners_; }
    HandleTable& handles() { return handles_; }

  private:
    HandleTable& handles_;
    uint32_t id_;
    std::vector<Entity> owners_;
    std::tuple<std::vector<Ts>...> columns_;
};

}  // namespace ag::ecs_bench
