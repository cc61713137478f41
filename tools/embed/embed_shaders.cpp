// Shaders into a library: their bytes by the assembler's .incbin, and a table of what reflection says of
// them, so that nothing is read or reflected at run time. What they are for devices of small texel buffers
// goes with them where it differs.
#include <fmt/format.h>

#include <iostream>

#include "engine/core/safe_file.h"
#include "engine/gpu/shader_files.h"

namespace {

using namespace ag::gpu;

std::string rowsOf(const ShaderModule& module, size_t index) {
    std::string out = fmt::format("const Binding bindings{}[] = {{", index);
    for (const ShaderBinding& b : module.bindings)
        out += fmt::format("{{\"{}\", {}, {}, {}, {}, {}}}, ", b.name, int(b.kind), b.set, b.binding,
                           int(b.reads), int(b.writes));
    out += fmt::format("{{}}}};\nconst Constant constants{}[] = {{", index);
    for (const SpecConstantInfo& c : module.specConstants)
        out += fmt::format("{{\"{}\", {}, {}}}, ", c.name, c.id, int(c.kind));
    return out + "{}};\n";
}

std::string entryOf(const ShaderModule& module, size_t index) {
    return fmt::format(
        "    {{\"{}\", {}, afterglow_shader{}, {}, bindings{}, {}, constants{}, {}, {}, {{{}, {}, {}}}}},\n",
        module.path, int(module.stage), index, module.spirv.size(), index, module.bindings.size(), index,
        module.specConstants.size(), module.pushSizeBytes, module.workgroupSize.x, module.workgroupSize.y,
        module.workgroupSize.z);
}

}  // namespace

int main(int count, char** arguments) {
    if (count < 5) {
        std::cerr << "afterglow-embed TABLE.cpp BYTES.S FOLDER SHADER...\n";
        return 2;
    }
    std::string rows, entries, externs, bytes = "    .section .rodata\n";
    size_t index = 0;
    const auto add = [&](const ShaderModule& module) {
        rows += rowsOf(module, index);
        entries += entryOf(module, index);
        externs += fmt::format("extern const uint32_t afterglow_shader{}[];\n", index);
        bytes += fmt::format(
            "    .balign 16\n    .globl afterglow_shader{0}\n    .hidden afterglow_shader{0}\n"
            "afterglow_shader{0}:\n    .incbin \"{1}/{2}.spv\"\n",
            index++, arguments[3], module.path);
    };
    for (int i = 4; i < count; ++i) {
        const auto module = loadShader(arguments[i]),
                   storage = loadShader(kStorageTexelShaders + arguments[i]);
        if (!module || !storage) {
            std::cerr << (module ? storage : module).error().message << '\n';
            return 2;
        }
        add(*module);
        if (storage->spirv != module->spirv) add(*storage);
    }
    bytes += "    .section .note.GNU-stack,\"\",%progbits\n";
    const std::string table =
        "// Made by tools/embed.\n#include \"gi/library/embedded_shaders.h\"\n\nextern \"C\" {\n" + externs +
        "}\n\nnamespace ag::guest {\nnamespace {\n\n" + rows + "\nconst EmbeddedShader kTable[] = {\n" +
        entries +
        "};\n\n}  // namespace\n\nstd::span<const EmbeddedShader> embeddedShaders() {\n"
        "    return kTable;\n}\n\n}  // namespace ag::guest\n";
    for (const auto& [path, text] : {std::pair(arguments[1], table), std::pair(arguments[2], bytes)})
        if (const ag::Status written = ag::writeFileSafely(path, text); !written) {
            std::cerr << written.error().message << '\n';
            return 2;
        }
    return 0;
}
