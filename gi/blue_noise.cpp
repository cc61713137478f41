#include "gi/blue_noise.h"

#include <fstream>
#include <iterator>

#include "engine/core/log.h"

namespace ag::gi {
namespace {

constexpr size_t kBytes = 64 * 64 * 4;

std::vector<char> load() {
    const std::string path = AFTERGLOW_SHADER_DIR "/blue_noise_64.bin";
    std::ifstream in(path, std::ios::binary);
    std::vector<char> bytes{std::istreambuf_iterator<char>(in), {}};
    if (bytes.size() == kBytes) return bytes;
    spdlog::critical("{} is missing: build the target afterglow_blue_noise", path);
    std::abort();
}

}  // namespace

BufferHandle addBlueNoise(FrameGraph& graph) {
    static const std::vector<char> bytes = load();
    const BufferHandle buffer =
        graph.buffer("blue_noise.pixels", {.sizeBytes = kBytes, .texelFormat = VK_FORMAT_R16G16_UNORM});
    graph.upload("blue_noise.pixels", buffer, std::as_bytes(std::span(bytes)));
    return buffer;
}

}  // namespace ag::gi
