// Faults of the outside world as values: a T, or one sentence that says what is wrong with what.
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "engine/core/check.h"

namespace ag {

struct Error {
    std::string message;  // one sentence naming the file or device and the fault
};

template <class T>
class [[nodiscard]] Result {
  public:
    Result(T value) : state_(std::move(value)) {}
    Result(Error error) : state_(std::move(error)) {}

    explicit operator bool() const { return std::holds_alternative<T>(state_); }
    T& value() {
        AG_CHECK_MSG(*this, error().message);
        return std::get<T>(state_);
    }
    const T& value() const {
        AG_CHECK_MSG(*this, error().message);
        return std::get<T>(state_);
    }
    T& operator*() { return value(); }
    const T& operator*() const { return value(); }
    T* operator->() { return &value(); }
    const T* operator->() const { return &value(); }
    const Error& error() const { return std::get<Error>(state_); }

  private:
    std::variant<T, Error> state_;
};

struct Ok {};
using Status = Result<Ok>;

}  // namespace ag
