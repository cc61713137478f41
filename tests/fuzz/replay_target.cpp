// Recorded inputs.
#include "engine/app/input.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    (void)ag::loadReplay(ag::fuzz::asFile(bytes, size, ".replay"));
    return 0;
}
