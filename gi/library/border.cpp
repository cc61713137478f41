#include "gi/library/border.h"

#include <cmath>
#include <new>

namespace ag::guest {
namespace {

thread_local std::string tLastError;

AgiResult resultOf(FailureKind kind) {
    switch (kind) {
        case FailureKind::kDeviceLost:
            return AGI_ERROR_DEVICE_LOST;
        case FailureKind::kDeviceMemory:
            return AGI_ERROR_DEVICE_MEMORY;
        case FailureKind::kHostMemory:
            return AGI_ERROR_HOST_MEMORY;
        case FailureKind::kUnsupported:
            return AGI_ERROR_UNSUPPORTED;
        default:
            return AGI_ERROR_INTERNAL;
    }
}

AgiResult note(AgiResult result, const char* sentence) {
    try {
        tLastError = sentence;
    } catch (...) {
        tLastError.clear();
    }
    return result;
}

template <class T>
bool allFinite(const T* numbers, size_t count) {
    return std::all_of(numbers, numbers + count, [](T x) { return std::isfinite(x); });
}

}  // namespace

void refuseUnless(bool fine, const char* sentence) {
    if (!fine) throw BadArgument(sentence);
}

bool isFinite(const float* numbers, size_t count) {
    return allFinite(numbers, count);
}
bool isFinite(const double* numbers, size_t count) {
    return allFinite(numbers, count);
}

void throwFailures() {
    onFailure([](FailureKind kind, const std::string& sentence) { throw Failure(kind, sentence); });
}

AgiResult resultOfException() {
    try {
        throw;
    } catch (const BadArgument& e) {
        return note(AGI_ERROR_ARGUMENT, e.what());
    } catch (const Failure& e) {
        return note(resultOf(e.kind), e.what());
    } catch (const std::bad_alloc&) {
        return note(AGI_ERROR_HOST_MEMORY, "out of host memory");
    } catch (const std::exception& e) {
        return note(AGI_ERROR_INTERNAL, e.what());
    } catch (...) {
        return note(AGI_ERROR_INTERNAL, "an unknown exception");
    }
}

const char* lastError() {
    return tLastError.c_str();
}

}  // namespace ag::guest
