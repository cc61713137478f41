// Counts what operator new hands out on this thread, for tests that nothing is allocated.
#pragma once

#include <cstddef>

namespace ag::test {

void startCounting();
size_t stopCounting();

// Calls `work` and returns how often it allocated.
template <class F>
size_t countAllocations(F&& work) {
    startCounting();
    work();
    return stopCounting();
}

}  // namespace ag::test
