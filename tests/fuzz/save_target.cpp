// Saved games: the bytes as they are, and as the lines of a save of this very level.
#include <string>

#include "game/save_format.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    const ag::game::SaveLimits limits{.level = 7, .nodes = 100, .mostRoom = 3};
    (void)ag::game::parseSave(text, "save", limits);
    (void)ag::game::parseSave(ag::game::saveHead(limits.level) + text, "save", limits);
    return 0;
}
