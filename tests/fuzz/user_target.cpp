// A player's settings; what can be read can be written and read again.
#include "game/user_files.h"
#include "tests/fuzz/as_file.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string& path = ag::fuzz::asFile(bytes, size, ".user");
    const auto settings = ag::game::loadUserSettings(path);
    if (!settings) return 0;
    if (!ag::game::saveUserSettings(*settings, path) || !ag::game::loadUserSettings(path)) std::abort();
    return 0;
}
