// Shaders from the build's folder, reflected through SPIRV-Cross.
#pragma once

#include "engine/gpu/shader.h"

namespace ag::gpu {

// Reads `<AFTERGLOW_SHADER_DIR>/<path>.spv` and reflects it.
Result<ShaderModule> loadShader(const std::string& path);
Result<ShaderModule> reflectShader(std::string path, std::vector<uint32_t> spirv);

}  // namespace ag::gpu
