// Rows in an order of which little changes at a time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace ag::render {

class KeptOrder {
  public:
    static constexpr uint32_t kNowhere = ~0u;

    uint32_t size() const { return uint32_t(rows_.size()); }
    uint32_t operator[](uint32_t place) const { return rows_[place]; }
    uint32_t placeOf(uint32_t row) const { return placeOf_[row]; }  // kNowhere: it is not in it
    // Where what now stands in each place stood before the last change; kNowhere: it had none.
    std::span<const uint32_t> before() const { return before_; }

    void clear() { *this = {}; }

    // Takes out the rows that `leaves` names and puts `arrived` in where their keys say; the others keep
    // their order. Rows are numbers below the size of `leaves`.
    template <class Key>
    void change(const std::vector<bool>& leaves, std::vector<uint32_t> arrived, Key&& key) {
        std::ranges::sort(arrived, {}, key);
        std::vector<uint32_t> rows;
        rows.reserve(rows_.size() + arrived.size());
        before_.clear();
        auto next = arrived.begin();
        const auto put = [&](uint32_t row, uint32_t from) {
            rows.push_back(row);
            before_.push_back(from);
        };
        for (uint32_t place = 0; place < rows_.size(); ++place) {
            const uint32_t row = rows_[place];
            if (leaves[row]) continue;
            while (next != arrived.end() && key(*next) < key(row))
                put(*next++, kNowhere);
            put(row, place);
        }
        while (next != arrived.end())
            put(*next++, kNowhere);
        rows_ = std::move(rows);
        placeOf_.assign(leaves.size(), kNowhere);
        for (uint32_t place = 0; place < rows_.size(); ++place)
            placeOf_[rows_[place]] = place;
    }

  private:
    std::vector<uint32_t> rows_, placeOf_, before_;
};

}  // namespace ag::render
