// The structs both languages share lie the same in both: compiled shaders against offsetof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>

#include "engine/gpu/device_limits.h"
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
const std::set<std::string> kLoadedByWord = {
    "BvhMask",  "BvhPlace",      "BvhTriangle",   "Instance", "LightClusterRow",
    "Material", "PunctualLight", "SkinnedSample", "SkyTexel", "SurfaceSample"};

// Those of the repository, and as they are compiled for storage buffers.
std::vector<gpu::ShaderModule> allShaders() {
    namespace fs = std::filesystem;
    std::vector<gpu::ShaderModule> modules;
    for (const auto& entry : fs::recursive_directory_iterator(AFTERGLOW_SHADER_DIR)) {
        if (entry.path().extension() != ".spv") continue;
        const fs::path path = fs::relative(entry.path(), AFTERGLOW_SHADER_DIR).replace_extension();
        const fs::path source = *path.begin() == "storage" ? fs::relative(path, "storage") : path;
        if (!exists(fs::path(AFTERGLOW_SOURCE_DIR) / "shaders" / source)) continue;  // was once
        auto module = gpu::loadShader(path.string());
        EXPECT_TRUE(module) << module.error().message;
        if (module) modules.push_back(std::move(*module));
    }
    EXPECT_GT(modules.size(), 150u);
    return modules;
}

// What device_limits.cpp asks of a device is what the shaders need.
TEST(IoLayout, ShadersKeepWithinTheLeastLimits) {
    using enum gpu::BindingKind;
    for (const gpu::ShaderModule& module : allShaders()) {
        const auto expectWithin = [&](uint64_t needed, const char* limit) {
            EXPECT_LE(needed, gpu::findDeviceLimit(limit)->least) << module.path << ": " << limit;
        };
        const auto count = [&](gpu::BindingKind kind) {
            return uint64_t(std::ranges::count(module.bindings, kind, &gpu::ShaderBinding::kind));
        };
        expectWithin(module.pushSizeBytes, "maxPushConstantsSize");
        const bool ofRays = module.path.find("texel_rays/") != std::string::npos ||
                            module.path.find("gloss_rays/") != std::string::npos ||
                            module.path.ends_with("later_bounces/trace.comp") ||
                            module.path.ends_with("probes/trace_probes.comp");
        if (ofRays)
            EXPECT_LE(count(kStorageBuffer), gpu::kStorageBuffersOfRays) << module.path;
        else
            expectWithin(count(kStorageBuffer), "maxPerStageDescriptorStorageBuffers");
        expectWithin(count(kUniformBuffer), "maxPerStageDescriptorUniformBuffers");
        expectWithin(count(kSampledImage), "maxPerStageDescriptorSamplers");
        expectWithin(count(kSampledImage) + count(kUniformTexelBuffer), "maxPerStageDescriptorSampledImages");
        expectWithin(count(kStorageImage) + count(kStorageTexelBuffer), "maxPerStageDescriptorStorageImages");
        expectWithin(module.bindings.size(), "maxPerStageResources");
        const glm::uvec3 size = module.workgroupSize;
        expectWithin(size.x * size.y * size.z, "maxComputeWorkGroupInvocations");
        expectWithin(size.x, "maxComputeWorkGroupSize[0]");
        expectWithin(size.y, "maxComputeWorkGroupSize[1]");
        for (const gpu::ShaderBinding& b : module.bindings)
            expectWithin(b.set + 1, "maxBoundDescriptorSets");
    }
}

TEST(IoLayout, CompiledShadersAgreeWithTheHeaders) {
    std::map<std::string, int> seen;
    for (const gpu::ShaderModule& module : allShaders()) {
        const std::string& path = module.path;
        for (const gpu::ShaderStruct& s : module.structs) {
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
    EXPECT_GT(layouts().size(), 50u);
    for (const auto& [name, layout] : layouts())
        EXPECT_EQ(seen[name] == 0, kLoadedByWord.contains(name))
            << name << ": seen " << seen[name] << " times";
}

}  // namespace
}  // namespace ag
