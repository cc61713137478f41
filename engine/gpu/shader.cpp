#include "engine/gpu/shader.h"

#include <fstream>

namespace ag::gpu {

Result<ShaderModule> loadShader(const std::string& path) {
    const std::string file = std::string(AFTERGLOW_SHADER_DIR "/") + path + ".spv";
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    if (!in) return Error{"shader " + file + " is missing: build the target afterglow_shaders"};
    const auto bytes = size_t(in.tellg());
    if (bytes < 20 || bytes % 4 != 0) return Error{"shader " + file + " is not SPIR-V"};
    std::vector<uint32_t> spirv(bytes / 4);
    in.seekg(0);
    in.read(reinterpret_cast<char*>(spirv.data()), std::streamsize(bytes));
    if (!in) return Error{"shader " + file + " cannot be read"};
    return reflectShader(path, std::move(spirv));
}

}  // namespace ag::gpu
