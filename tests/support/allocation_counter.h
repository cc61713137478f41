// Counts what operator new hands out on this thread, for tests that nothing is allocated; and makes it fail.
#pragma once

#include <cstddef>

namespace ag::test {

void startCounting();
size_t stopCounting();

// The allocation after `count` more of this thread throws std::bad_alloc; then none does.
void failAllocationAfter(size_t count);
// While it lives none of this thread counts or fails: code that is not ours is called.
class UncountedAllocations {
  public:
    UncountedAllocations();
    ~UncountedAllocations();
    UncountedAllocations(const UncountedAllocations&) = delete;
    UncountedAllocations& operator=(const UncountedAllocations&) = delete;

  private:
    bool counting_;
    size_t untilFailure_;
};

// Calls `work` and returns how often it allocated.
template <class F>
size_t countAllocations(F&& work) {
    startCounting();
    work();
    return stopCounting();
}

}  // namespace ag::test
