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
    // their order. Rows are numbers below the size of `leaves`. `arrived` comes back sorted.
    template <class Key>
    void change(const std::vector<bool>& leaves, std::vector<uint32_t>& arrived, Key&& key) {
        std::ranges::sort(arrived, {}, key);
        next_.clear();
        before_.clear();
        auto comes = arrived.begin();
        const auto put = [&](uint32_t row, uint32_t from) {
            next_.push_back(row);
            before_.push_back(from);
        };
        for (uint32_t place = 0; place < rows_.size(); ++place) {
            const uint32_t row = rows_[place];
            if (leaves[row]) continue;
            while (comes != arrived.end() && key(*comes) < key(row))
                put(*comes++, kNowhere);
            put(row, place);
        }
        while (comes != arrived.end())
            put(*comes++, kNowhere);
        std::swap(rows_, next_);
        next_.reserve(rows_.size());
        placeOf_.assign(leaves.size(), kNowhere);
        for (uint32_t place = 0; place < rows_.size(); ++place)
            placeOf_[rows_[place]] = place;
    }

  private:
    std::vector<uint32_t> rows_, placeOf_, before_;
    std::vector<uint32_t> next_;  // scratch
};

}  // namespace ag::render
