#include "tests/support/allocation_counter.h"

#include <cstdlib>
#include <new>

namespace {
thread_local bool tCounting = false;
thread_local size_t tAllocations = 0;
}  // namespace

void* operator new(size_t bytes) {
    tAllocations += tCounting;
    if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
// The sanitizers bring a nothrow form of their own, which would not match our delete.
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    tAllocations += tCounting;
    return std::malloc(bytes);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, size_t) noexcept {
    std::free(memory);
}

namespace ag::test {

void startCounting() {
    tAllocations = 0;
    tCounting = true;
}

size_t stopCounting() {
    tCounting = false;
    return tAllocations;
}

}  // namespace ag::test
