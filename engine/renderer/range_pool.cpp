#include "engine/renderer/range_pool.h"

#include <algorithm>
#include <bit>

namespace ag::render {

void RangePool::fit(Range& range, uint32_t count) {
    if (count <= range.capacity && (range.capacity <= 1u << kLeastLog || count > range.capacity / 4)) return;
    release(range);
    if (count == 0) return;
    const uint32_t log = std::max(kLeastLog, uint32_t(std::bit_width(count - 1)));
    range.capacity = 1u << log;
    std::vector<uint32_t>& given = free_[log];
    if (given.empty()) {
        range.first = size_;
        size_ += range.capacity;
    } else {
        range.first = given.back();
        given.pop_back();
    }
}

void RangePool::release(Range& range) {
    if (range.capacity > 0) free_[uint32_t(std::countr_zero(range.capacity))].push_back(range.first);
    range = {};
}

}  // namespace ag::render
