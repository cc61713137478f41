// Mutations that keep an input's form, so that a fuzzer reaches what lies behind the parser: one value of a
// JSON text, one word or line of a text. A quarter of the time libFuzzer's own mutations of bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

// libFuzzer's; only fuzzers have it.
extern "C" size_t LLVMFuzzerMutate(uint8_t* bytes, size_t size, size_t mostSize);

namespace ag::fuzz {

using Random = std::minstd_rand;

inline uint32_t below(uint32_t end, Random& random) {
    return uint32_t(random() % end);
}

// Numbers at which readers break.
std::string oddNumber(Random& random);

// A JSON text with one to four of its values changed; empty if it is none.
std::string mutateJson(const std::string& text, Random& random);

// A text with one to four of its words or lines changed.
std::string mutateWords(const std::string& text, Random& random);

// Puts the mutation into libFuzzer's buffer, or a mutation of bytes where it is empty or does not fit.
size_t intoBuffer(const std::string& mutated, uint8_t* bytes, size_t size, size_t mostSize, Random& random);

inline std::string asText(const uint8_t* bytes, size_t size) {
    return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace ag::fuzz
