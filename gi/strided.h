// Items in a host's memory, at equal distances.
#pragma once

#include <cstddef>
#include <cstring>

namespace ag::gi {

template <class T>
struct Strided {
    const std::byte* data = nullptr;  // null: there are none
    size_t strideBytes = sizeof(T);

    static Strided of(const T* items) { return {reinterpret_cast<const std::byte*>(items), sizeof(T)}; }
    T operator[](size_t i) const {
        T item;
        std::memcpy(&item, data + i * strideBytes, sizeof item);
        return item;
    }
    explicit operator bool() const { return data != nullptr; }
};

}  // namespace ag::gi
