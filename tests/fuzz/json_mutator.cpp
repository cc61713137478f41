// For inputs of JSON.
#include "tests/fuzz/mutators.h"

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t mostSize, unsigned seed) {
    ag::fuzz::Random random(seed);
    return ag::fuzz::intoBuffer(ag::fuzz::mutateJson(ag::fuzz::asText(bytes, size), random), bytes, size,
                                mostSize, random);
}
