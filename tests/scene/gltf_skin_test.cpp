// Skins and animations in glTF files: written and read again, and what is refused with which words.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/scene/deform.h"
#include "engine/scene/gltf_export.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/skinned_mesh.h"
#include "engine/scene/static_scene.h"
#include "tests/scene/bar.h"
#include "tests/scene/gltf_files.h"
#include "tools/scenegen/figures.h"

namespace ag {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// A GLB file taken apart.
struct Glb {
    json document;
    std::vector<char> bytes;

    explicit Glb(const SceneAsset& asset) {
        const std::string path = (test::ownFolder() / "whole.glb").string();
        EXPECT_TRUE(exportGlb(asset, path));
        std::ifstream in(path, std::ios::binary);
        const std::string all{std::istreambuf_iterator<char>(in), {}};
        uint32_t length = 0;
        std::memcpy(&length, all.data() + 12, 4);
        document = json::parse(all.substr(20, length));
        bytes.assign(all.begin() + 28 + length, all.end());
    }
    std::string write() const {
        std::string text = document.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<char> padded = bytes;
        padded.resize((padded.size() + 3) / 4 * 4);
        const std::string path = (test::ownFolder() / "case.glb").string();
        std::ofstream out(path, std::ios::binary);
        const auto word = [&](uint32_t w) { out.write(reinterpret_cast<const char*>(&w), 4); };
        word(0x46546C67), word(2), word(uint32_t(28 + text.size() + padded.size()));
        word(uint32_t(text.size())), word(0x4E4F534A), out << text;
        word(uint32_t(padded.size())), word(0x004E4942),
            out.write(padded.data(), std::ptrdiff_t(padded.size()));
        return path;
    }
    template <class T>
    void set(int accessor, size_t at, T value) {
        const json& a = document["accessors"][size_t(accessor)];
        const size_t offset = document["bufferViews"][a["bufferView"].get<size_t>()].value("byteOffset", 0);
        std::memcpy(bytes.data() + offset + at * sizeof(T), &value, sizeof value);
    }
    int attribute(const char* name) { return document["meshes"][0]["primitives"][0]["attributes"][name]; }
    json& sampler() { return document["animations"][0]["samplers"][0]; }
};

testing::AssertionResult refusedWith(const Glb& glb, const std::string& words) {
    const auto asset = importGltf(glb.write());
    const std::string fault = asset ? "" : asset.error().message;
    if (fault.find("case.glb: ") != std::string::npos && fault.find(words) != std::string::npos &&
        fault.find('\n') == std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "said: '" << fault << "' instead of something with '" << words << "'";
}

TEST(GltfSkin, WhatIsWrittenIsReadAgain) {
    const SceneAsset asset = scenegen::figures(3);
    const auto again = importGltf(Glb(asset).write());
    ASSERT_TRUE(again) << again.error().message;
    ASSERT_EQ(again->animations.size(), 1u);
    EXPECT_EQ(again->animations[0].channels.size(), asset.animations[0].channels.size());
    EXPECT_FLOAT_EQ(again->animations[0].duration, 3);
    const DeformedVertices a = deformSkinnedMeshes(staticScene(asset)),
                           b = deformSkinnedMeshes(staticScene(*again));
    ASSERT_EQ(a.positions.size(), b.positions.size());
    for (size_t i = 0; i < a.positions.size(); ++i) {
        ASSERT_LT(glm::length(a.positions[i] - b.positions[i]), 1e-5f) << i;
        ASSERT_LT(glm::length(a.attributes[i].normal - b.attributes[i].normal), 1e-4f) << i;
    }
    EXPECT_TRUE(again->warnings.empty());
}

TEST(GltfSkin, EveryInterpolationAndPathIsRead) {
    for (const auto& [name, how] : {std::pair("STEP", Interpolation::kStep),
                                    {"LINEAR", Interpolation::kLinear},
                                    {"CUBICSPLINE", Interpolation::kCubic}}) {
        SceneAsset asset = test::bar();
        const size_t values = how == Interpolation::kCubic ? 6 : 2;
        for (const ChannelPath path : {ChannelPath::kTranslation, ChannelPath::kScale})
            asset.animations[0].channels.push_back({.node = 1,
                                                    .path = path,
                                                    .times = {0, 2},
                                                    .values = std::vector(values, glm::vec4(1, 2, 3, 0))});
        for (SceneChannel& c : asset.animations[0].channels) {
            c.interpolation = how;
            c.values.resize(values, glm::vec4(0, 0, 0, 1));
        }
        const auto again = importGltf(Glb(asset).write());
        ASSERT_TRUE(again) << name << ": " << again.error().message;
        ASSERT_EQ(again->animations[0].channels.size(), 3u);
        EXPECT_FLOAT_EQ(again->animations[0].duration, 2);
        for (const SceneChannel& c : again->animations[0].channels) {
            EXPECT_EQ(c.interpolation, how);
            EXPECT_EQ(c.values.size(), values);
        }
        EXPECT_EQ(again->animations[0].channels[1].values[1], glm::vec4(1, 2, 3, 0));
    }
}

TEST(GltfSkin, OfEightJointsTheStrongestFourMoveAVertex) {
    SceneAsset asset = test::bar();
    Glb glb(asset);
    json& attributes = glb.document["meshes"][0]["primitives"][0]["attributes"];
    attributes["JOINTS_1"] = attributes["JOINTS_0"];
    attributes["WEIGHTS_1"] = attributes["WEIGHTS_0"];
    const int weights = glb.attribute("WEIGHTS_0");
    const float first[] = {0.3f, 0.1f, 0.1f, 0};  // twice over: 0.3, 0.3, 0.1, 0.1
    for (size_t i = 0; i < 4; ++i)
        glb.set(weights, i, first[i]);
    const auto read = importGltf(glb.write());
    ASSERT_TRUE(read) << read.error().message;
    const glm::vec4 w = read->geometry.skin[0].weights;
    EXPECT_FLOAT_EQ(w.x, 0.375f);
    EXPECT_FLOAT_EQ(w.y, 0.375f);
    EXPECT_FLOAT_EQ(w.z, 0.125f);
    EXPECT_FLOAT_EQ(w.w, 0.125f);
}

TEST(GltfSkin, RefusesBadSkins) {
    const Glb good(test::bar());
    ASSERT_TRUE(importGltf(good.write()));
    Glb g = good;
    g.set<uint16_t>(g.attribute("JOINTS_0"), 1, 7);
    g.set<float>(g.attribute("WEIGHTS_0"), 1, 0.5f);
    EXPECT_TRUE(refusedWith(g, "names joint 7, but skin 0 has only 2"));
    g = good;
    g.set<float>(g.attribute("WEIGHTS_0"), 5, -0.5f);
    EXPECT_TRUE(refusedWith(g, "a weight that is negative or not finite (vertex 1)"));
    g.set<float>(g.attribute("WEIGHTS_0"), 5, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(refusedWith(g, "a weight that is negative or not finite (vertex 1)"));
    g = good;
    for (size_t i = 0; i < 4; ++i)
        g.set<float>(g.attribute("WEIGHTS_0"), i, 0);
    EXPECT_TRUE(refusedWith(g, "vertices without weights"));
    g = good;
    g.document["meshes"][0]["primitives"][0]["attributes"].erase("WEIGHTS_0");
    EXPECT_TRUE(refusedWith(g, "JOINTS_0 or WEIGHTS_0 without the other"));
    g.document["meshes"][0]["primitives"][0]["attributes"].erase("JOINTS_0");
    EXPECT_TRUE(refusedWith(g, "vertices without weights"));
    g = good;
    g.document["accessors"][size_t(g.attribute("JOINTS_0"))]["componentType"] = 5126;
    EXPECT_FALSE(importGltf(g.write()));
    g = good;
    g.document["skins"][0]["joints"][1] = 99;
    EXPECT_TRUE(refusedWith(g, "skin 0 names joint 99, which does not exist"));
    g = good;
    const int inverseBind = g.document["skins"][0]["inverseBindMatrices"];
    g.set<float>(inverseBind, 3, std::numeric_limits<float>::infinity());
    EXPECT_TRUE(refusedWith(g, "an inverse bind matrix that is not finite"));
    g = good;
    g.document["skins"][0]["inverseBindMatrices"] = 0;
    EXPECT_TRUE(refusedWith(g, "skin 0 has bad inverse bind matrices"));
    g = good;
    g.document["nodes"].push_back({{"name", "elsewhere"}});
    g.document["skins"][0]["joints"][1] = g.document["nodes"].size() - 1;
    EXPECT_TRUE(refusedWith(g, "no joints in its scene"));
}

TEST(GltfSkin, RefusesBadAnimations) {
    const Glb good(test::bar());
    Glb g = good;
    const int times = g.sampler()["input"], values = g.sampler()["output"];
    g.set<float>(times, 1, 0);
    EXPECT_TRUE(refusedWith(g, "animation 0 channel 0 has times that do not rise (key 1)"));
    g.set<float>(times, 0, -1);
    EXPECT_TRUE(refusedWith(g, "a time that is negative"));
    g = good;
    g.set<float>(times, 1, std::numeric_limits<float>::quiet_NaN());
    EXPECT_TRUE(refusedWith(g, "a time that is negative, not finite"));
    g = good;
    g.set<float>(values, 2, std::numeric_limits<float>::infinity());
    EXPECT_TRUE(refusedWith(g, "a value that is not finite"));
    g = good;
    g.sampler()["output"] = 0;
    EXPECT_TRUE(refusedWith(g, "values that are no rotation"));
    g = good;
    g.sampler()["input"] = 50;
    EXPECT_TRUE(refusedWith(g, "names accessor 50, which does not exist"));
    g = good;
    g.sampler()["interpolation"] = "WAVY";
    EXPECT_TRUE(refusedWith(g, "unknown interpolation 'WAVY'"));
    g.sampler()["interpolation"] = "CUBICSPLINE";
    EXPECT_TRUE(refusedWith(g, "has 2 values for 2 times"));
    g = good;
    g.document["animations"][0]["channels"][0]["sampler"] = 4;
    EXPECT_TRUE(refusedWith(g, "names sampler 4, which does not exist"));
    g = good;
    g.document["animations"][0]["channels"][0]["target"]["node"] = 40;
    EXPECT_TRUE(refusedWith(g, "names node 40, which does not exist"));
    g = good;
    g.document["animations"][0]["channels"][0]["target"]["path"] = "colour";
    EXPECT_TRUE(refusedWith(g, "moves 'colour', which no node has"));
}

TEST(GltfSkin, HasLimits) {
    const std::string path = Glb(scenegen::figures(3)).write();
    for (const auto& [limits, words] :
         {std::pair(ImportLimits{.joints = 14}, "its skins together have more joints than the limit"),
          std::pair(ImportLimits{.keyValues = 100}, "its animations together have more keys than the limit"),
          std::pair(ImportLimits{.vertices = 900}, "have more vertices or joints than the limit")}) {
        const auto asset = importGltf(path, limits);
        ASSERT_FALSE(asset) << words;
        EXPECT_NE(asset.error().message.find(words), std::string::npos) << asset.error().message;
    }
}

TEST(GltfSkin, TheFoxRuns) {
    const fs::path file = fs::path(AFTERGLOW_SOURCE_DIR) / "../shared/scenes/fox/Fox.glb";
    if (!fs::exists(file)) GTEST_SKIP() << "the scenes are not part of the repository";
    const auto fox = importGltf(file.string());
    ASSERT_TRUE(fox) << fox.error().message;
    EXPECT_TRUE(fox->warnings.empty());
    ASSERT_EQ(fox->skins.size(), 1u);
    EXPECT_EQ(fox->skins[0].joints.size(), 24u);
    ASSERT_EQ(fox->animations.size(), 3u);
    SceneAsset asset = *fox;
    std::vector<glm::vec3> before;
    for (SceneNode& node : asset.nodes)
        node.extras.clip = 2;  // runs
    for (const float seconds : {0.0f, 0.3f}) {
        for (SceneNode& node : asset.nodes)
            node.extras.clipStart = seconds;
        const RenderScene scene = staticScene(asset);
        const DeformedVertices v = deformSkinnedMeshes(scene);
        ASSERT_EQ(v.positions.size(), 1728u);
        Bounds bounds;
        float moved = 0;
        for (size_t i = 0; i < v.positions.size(); ++i) {
            bounds.add(v.positions[i]);
            EXPECT_NEAR(glm::length(v.attributes[i].normal), 1, 1e-4f);
            if (!before.empty()) moved = std::max(moved, glm::length(v.positions[i] - before[i]));
        }
        const glm::vec3 size = bounds.max - bounds.min;
        EXPECT_GT(size.z, 100) << "as long as a fox, in centimetres";
        EXPECT_LT(size.z, 250);
        EXPECT_LT(size.x, 60);
        EXPECT_TRUE(before.empty() || moved > 5) << "its legs";
        before = v.positions;
    }
}

}  // namespace
}  // namespace ag
