#include "gi/blue_noise.h"

#include "engine/core/log.h"
#include "engine/core/safe_file.h"

namespace ag::gi {
namespace {

constexpr size_t kBytes = 64 * 64 * 4;

std::string load() {
    const std::string path = AFTERGLOW_SHADER_DIR "/blue_noise_64.bin";
    if (const auto bytes = readFile(path); bytes && bytes->size() == kBytes) return *bytes;
    spdlog::critical("{} is missing: build the target afterglow_blue_noise", path);
    std::abort();
}

}  // namespace

BufferHandle addBlueNoise(GraphScope scope) {
    static const std::string bytes = load();
    const BufferHandle buffer =
        scope.buffer("blue_noise.pixels", {.sizeBytes = kBytes, .texelFormat = VK_FORMAT_R16G16_UNORM});
    scope.upload("blue_noise.pixels", buffer, std::as_bytes(std::span(bytes)));
    return buffer;
}

}  // namespace ag::gi
