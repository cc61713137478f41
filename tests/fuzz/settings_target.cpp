// What a player or a command line may set: settings, keys.
#include <sstream>

#include "engine/app/bindings.h"
#include "engine/core/settings.h"
#include "engine/renderer/render_settings.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    ag::render::RenderSettings gi;
    ag::Settings settings;
    ag::render::registerSettings(settings, gi);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        (void)settings.set(line);
        (void)ag::render::applyPreset(line, gi);
    }
    (void)settings.table();
    (void)ag::parseBindings(text, "keys");
    return 0;
}
