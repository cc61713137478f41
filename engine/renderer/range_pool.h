// Ranges of one growing array for lists of changing length: powers of two, so that what one list gives back
// fits another.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace ag::render {

class RangePool {
  public:
    struct Range {
        uint32_t first = 0, capacity = 0;
        bool operator==(const Range&) const = default;
    };
    // Room for `count` elements: the same range as long as it holds them and at least a quarter is used.
    void fit(Range& range, uint32_t count);
    void release(Range& range);              // now, however small it is
    uint32_t size() const { return size_; }  // of the array
    void clear() { *this = {}; }

  private:
    static constexpr uint32_t kLeastLog = 4;
    std::array<std::vector<uint32_t>, 32> free_;  // firsts, by the capacity's logarithm
    uint32_t size_ = 0;
};

}  // namespace ag::render
