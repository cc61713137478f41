// The border: what a host passes is looked at before anything is done, and nothing of ours crosses but a code
// and a sentence.
#pragma once

#include <algorithm>
#include <cstring>
#include <string>

#include "engine/core/failure.h"
#include "gi/include/afterglow/afterglow_gi.h"

namespace ag::guest {

// An argument that cannot be.
class BadArgument : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

void refuseUnless(bool fine, const char* sentence);
bool isFinite(const float* numbers, size_t count);
bool isFinite(const double* numbers, size_t count);

// As the library knows the struct: what the host does not know of is zero.
template <class T>
T whole(const T* given, const char* name) {
    refuseUnless(given != nullptr, name);
    refuseUnless(given->structSize >= 2 * sizeof(size_t), "structSize is not set: begin with AGI_INIT");
    T out{};
    std::memcpy(static_cast<void*>(&out), given, std::min(given->structSize, sizeof out));
    return out;
}

// Of an array whose items are as large as the host knows them.
template <class T>
T wholeOf(const T* items, uint32_t index, const char* name) {
    refuseUnless(items != nullptr, name);
    const auto* bytes = reinterpret_cast<const std::byte*>(items);
    return whole(reinterpret_cast<const T*>(bytes + index * items->structSize), name);
}

// Into a struct of the host's, as much of it as the host knows.
template <class T>
void give(const T& filled, T* to, const char* name) {
    refuseUnless(to != nullptr, name);
    const size_t known = std::min(to->structSize, sizeof filled), head = offsetof(T, next) + sizeof to->next;
    refuseUnless(known >= head, "structSize is not set: begin with AGI_INIT");
    std::memcpy(reinterpret_cast<std::byte*>(to) + head, reinterpret_cast<const std::byte*>(&filled) + head,
                known - head);
}

// Failures of ours, as exceptions, from now on.
void throwFailures();
AgiResult resultOfException();  // of the one being handled; notes its sentence

template <class Body>
AgiResult across(Body&& body) noexcept {
    try {
        body();
        return AGI_OK;
    } catch (...) {
        return resultOfException();
    }
}

const char* lastError();

}  // namespace ag::guest
