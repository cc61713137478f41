#include "engine/gpu/shader_files.h"

#include <cstring>

#include "engine/core/safe_file.h"

namespace ag::gpu {

Result<ShaderModule> loadShader(const std::string& path) {
    const std::string file = std::string(AFTERGLOW_SHADER_DIR "/") + path + ".spv";
    const auto bytes = readFile(file);
    if (!bytes) return Error{"shader " + bytes.error().message + " (the target afterglow_shaders builds it)"};
    if (bytes->size() < 20 || bytes->size() % 4 != 0) return Error{"shader " + file + " is not SPIR-V"};
    std::vector<uint32_t> spirv(bytes->size() / 4);
    std::memcpy(spirv.data(), bytes->data(), bytes->size());
    return reflectShader(path, std::move(spirv));
}

}  // namespace ag::gpu
