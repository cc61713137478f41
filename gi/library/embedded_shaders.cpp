#include "gi/library/embedded_shaders.h"

#include <algorithm>

namespace ag::guest {

Result<gpu::ShaderModule> embeddedShader(const std::string& path) {
    const auto all = embeddedShaders();
    const auto found = std::ranges::find_if(all, [&](const EmbeddedShader& s) { return path == s.path; });
    if (found == all.end() && path.starts_with(gpu::kStorageTexelShaders))
        return embeddedShader(path.substr(gpu::kStorageTexelShaders.size()));  // it reads no texel buffers
    if (found == all.end()) return Error{"the library was built without the shader " + path};
    gpu::ShaderModule module{
        .path = path,
        .stage = VkShaderStageFlagBits(found->stage),
        .spirv = {found->words, found->words + found->wordCount},
        .pushSizeBytes = found->pushSizeBytes,
        .workgroupSize = {found->workgroupSize[0], found->workgroupSize[1], found->workgroupSize[2]}};
    for (const Binding& b : std::span(found->bindings, found->bindingCount))
        module.bindings.push_back({b.name, gpu::BindingKind(b.kind), b.set, b.binding, b.reads, b.writes});
    for (const Constant& c : std::span(found->constants, found->constantCount))
        module.specConstants.push_back({c.name, c.id, gpu::ScalarKind(c.kind)});
    return module;
}

}  // namespace ag::guest
