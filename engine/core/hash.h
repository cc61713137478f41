// 64-bit content hashes: versions of resources and keys of passes (not for untrusted input).
#pragma once

#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace ag {

constexpr uint64_t mixHash(uint64_t x) {
    x ^= x >> 32;
    x *= 0xd6e8feb86659fd93ull;
    x ^= x >> 32;
    x *= 0xd6e8feb86659fd93ull;
    x ^= x >> 32;
    return x;
}

constexpr uint64_t combineHash(uint64_t seed, uint64_t value) {
    return mixHash(seed * 0x9e3779b97f4a7c15ull + value + 1);
}

inline uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed = 0) {
    uint64_t hash = combineHash(seed, bytes.size());
    size_t i = 0;
    for (; i + 8 <= bytes.size(); i += 8) {
        uint64_t word;
        std::memcpy(&word, bytes.data() + i, 8);
        hash = combineHash(hash, word);
    }
    uint64_t tail = 0;
    if (i < bytes.size()) std::memcpy(&tail, bytes.data() + i, bytes.size() - i);
    return combineHash(hash, tail);
}

inline uint64_t hashText(std::string_view text, uint64_t seed = 0) {
    return hashBytes(std::as_bytes(std::span(text.data(), text.size())), seed);
}

// Only for types without padding: their bytes are their value.
template <class T>
uint64_t hashValue(const T& value, uint64_t seed = 0) {
    static_assert(std::is_trivially_copyable_v<T>);
    return hashBytes(std::as_bytes(std::span(&value, 1)), seed);
}

}  // namespace ag
