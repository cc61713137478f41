#include "tests/support/allocation_counter.h"

#include <cstdlib>
#include <new>

namespace {
thread_local bool tCounting = false;
thread_local size_t tAllocations = 0;
constexpr size_t kNever = ~size_t(0);
thread_local size_t tUntilFailure = kNever;

bool mayAllocate() {
    tAllocations += tCounting;
    return tUntilFailure == kNever || tUntilFailure-- > 0;
}

}  // namespace

void* operator new(size_t bytes) {
    if (mayAllocate())
        if (void* memory = std::malloc(bytes)) return memory;
    throw std::bad_alloc();
}
// The sanitizers bring a nothrow form of their own, which would not match our delete.
void* operator new(size_t bytes, const std::nothrow_t&) noexcept {
    return mayAllocate() ? std::malloc(bytes) : nullptr;
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

void failAllocationAfter(size_t count) {
    tUntilFailure = count;
}

UncountedAllocations::UncountedAllocations() : counting_(tCounting), untilFailure_(tUntilFailure) {
    tCounting = false;
    tUntilFailure = kNever;
}

UncountedAllocations::~UncountedAllocations() {
    tCounting = counting_;
    tUntilFailure = untilFailure_;
}

}  // namespace ag::test
