// Failures that nothing nearby can go on from: how they travel. A program ends with the sentence (program.h),
// a library hands it to its host as a code.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace ag {

enum class FailureKind : uint32_t {
    kMistake,
    kUnsupported,
    kDevice,
    kDeviceLost,
    kDeviceMemory,
    kHostMemory
};

class Failure : public std::runtime_error {
  public:
    Failure(FailureKind failure, const std::string& sentence) : std::runtime_error(sentence), kind(failure) {}
    const FailureKind kind;
};

// Of the process; it must not return. None: mistakes of ours are printed and abort, anything else is thrown
// as a Failure.
using FailureHandler = void (*)(FailureKind kind, const std::string& sentence);
void onFailure(FailureHandler handler);

[[noreturn]] void fail(FailureKind kind, const std::string& sentence);

// Prints and aborts: what a mistake is worth where nobody else can act on it.
[[noreturn]] void abortWith(const std::string& sentence);

}  // namespace ag
