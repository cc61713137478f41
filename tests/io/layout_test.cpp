// The structs both languages share lie the same in both: compiled shaders against offsetof.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>

#include "engine/gpu/shader_files.h"
#define AG_INCLUDES
#include "shared_structs.inc"
#undef AG_INCLUDES

namespace ag {
namespace {

struct Member {
    const char* name;
    size_t offset;
};
struct Layout {
    size_t sizeBytes;
    std::vector<Member> members;
};

const std::map<std::string, Layout>& layouts() {
    static const std::map<std::string, Layout> all = {
#include "shared_structs.inc"
    };
    return all;
}

// What shaders read by the word, from texel buffers: the loader beside the struct knows where its members
// lie.
const std::set<std::string> kLoadedByWord = {"Instance",      "LightClusterRow", "Material",
                                             "PunctualLight", "SkinnedSample",   "SurfaceSample"};

TEST(IoLayout, CompiledShadersAgreeWithTheHeaders) {
    std::map<std::string, int> seen;
    int modules = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(AFTERGLOW_SHADER_DIR)) {
        if (entry.path().extension() != ".spv") continue;
        const std::string path =
            std::filesystem::relative(entry.path(), AFTERGLOW_SHADER_DIR).replace_extension().string();
        const auto module = gpu::loadShader(path);
        ASSERT_TRUE(module) << module.error().message;
        EXPECT_LE(module->pushSizeBytes, 128u) << path;
        ++modules;
        for (const gpu::ShaderStruct& s : module->structs) {
            const auto known = layouts().find(s.name);
            if (known == layouts().end()) continue;
            ++seen[s.name];
            ASSERT_EQ(s.members.size(), known->second.members.size()) << path << ' ' << s.name;
            for (size_t m = 0; m < s.members.size(); ++m) {
                EXPECT_EQ(s.members[m].name, known->second.members[m].name) << path << ' ' << s.name;
                EXPECT_EQ(s.members[m].offset, known->second.members[m].offset)
                    << path << ' ' << s.name << '.' << s.members[m].name;
            }
        }
    }
    EXPECT_GT(modules, 20);
    EXPECT_GT(layouts().size(), 50u);
    for (const auto& [name, layout] : layouts())
        EXPECT_EQ(seen[name] == 0, kLoadedByWord.contains(name))
            << name << ": seen " << seen[name] << " times";
}

}  // namespace
}  // namespace ag
