// Saved games: the bytes as they are, and as the lines of a save of this very level.
#include <string>

#include "game/save_format.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    constexpr uint64_t kLevel = 7;
    (void)ag::game::parseSave(text, "save", kLevel);
    (void)ag::game::parseSave(ag::game::saveHead(kLevel) + text, "save", kLevel);
    return 0;
}
