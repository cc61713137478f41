// The library's shaders, in its own memory. The table is made by tools/embed when the library is built.
#pragma once

#include <cstdint>
#include <span>

#include "engine/gpu/shader.h"

namespace ag::guest {

struct Binding {
    const char* name = nullptr;
    int kind = 0;
    uint32_t set = 0, binding = 0;
    bool reads = false, writes = false;
};

struct Constant {
    const char* name = nullptr;
    uint32_t id = 0;
    int kind = 0;
};

struct EmbeddedShader {
    const char* path;
    int stage;
    const uint32_t* words;
    size_t wordCount;
    const Binding* bindings;
    size_t bindingCount;
    const Constant* constants;
    size_t constantCount;
    uint32_t pushSizeBytes;
    uint32_t workgroupSize[3];
};

std::span<const EmbeddedShader> embeddedShaders();

// A gpu::ShaderSource of those.
Result<gpu::ShaderModule> embeddedShader(const std::string& path);

}  // namespace ag::guest
