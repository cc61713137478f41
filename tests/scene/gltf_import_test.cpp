// What the importer must refuse, and with which words; what it must accept.
#include "engine/scene/gltf_import.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/scene/gltf_files.h"

namespace ag {
namespace {

using nlohmann::json;
using test::base64, test::faultOf, test::triangle, test::write;
namespace fs = std::filesystem;

testing::AssertionResult refusedWith(const json& document, const std::string& words) {
    const std::string fault = faultOf(document);
    if (fault.find("case.gltf: ") != std::string::npos && fault.find(words) != std::string::npos &&
        fault.find('\n') == std::string::npos)
        return testing::AssertionSuccess();
    return testing::AssertionFailure()
           << "said: '" << fault << "' instead of something with '" << words << "'";
}

TEST(GltfImport, ReadsATriangle) {
    const auto asset = importGltf(write("case.gltf", triangle().dump()));
    ASSERT_TRUE(asset) << asset.error().message;
    EXPECT_EQ(triangleCount(*asset), 1u);
    ASSERT_EQ(asset->nodes.size(), 1u);
    EXPECT_EQ(asset->nodes[0].name, "thing");
    ASSERT_EQ(asset->geometry.attributes.size(), 3u);
    EXPECT_FLOAT_EQ(asset->geometry.attributes[0].normal.z, 1) << "flat normals where none are given";
}

TEST(GltfImport, RefusesWhatIsNoGltf) {
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{"empty.gltf", ""},
                                            {"text.gltf", "hello"},
                                            {"html.glb", "<html>"},
                                            {"cut.glb", "glTF\x02"},
                                            {"half.gltf", triangle().dump().substr(0, 200)},
                                            {"array.gltf", "[1, 2]"}}) {
        const auto asset = importGltf(write(name, text));
        ASSERT_FALSE(asset) << name;
        EXPECT_NE(asset.error().message.find(name), std::string::npos) << asset.error().message;
    }
    EXPECT_NE(importGltf("/no/such/file.glb").error().message.find("does not exist"), std::string::npos);
    EXPECT_NE(importGltf(test::ownFolder().string()).error().message.find("not a file"), std::string::npos);
}

TEST(GltfImport, RefusesIndicesOutOfRange) {
    json d = triangle();
    d["accessors"][0]["count"] = 2;
    EXPECT_TRUE(refusedWith(d, "has index 2, but only 2 vertices"));
    d = triangle();
    d["meshes"][0]["primitives"][0]["indices"] = 9;
    EXPECT_TRUE(refusedWith(d, "indices accessor out of bounds"));
    d = triangle();
    d["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 5;
    EXPECT_TRUE(refusedWith(d, "accessor 5"));
    d = triangle();
    d["meshes"][0]["primitives"][0]["material"] = 3;
    EXPECT_TRUE(refusedWith(d, "material 3"));
    d = triangle();
    d["nodes"][0]["mesh"] = 7;
    EXPECT_TRUE(refusedWith(d, "mesh 7"));
    d = triangle();
    d["scenes"][0]["nodes"] = {4};
    EXPECT_TRUE(refusedWith(d, "node 4"));
    d = triangle();
    d["accessors"][0]["bufferView"] = 12;
    EXPECT_TRUE(refusedWith(d, "buffer view 12"));
}

TEST(GltfImport, RefusesAccessorsPastTheirData) {
    json d = triangle();
    d["accessors"][0]["count"] = 4;
    EXPECT_TRUE(refusedWith(d, "past the end"));
    d = triangle();
    d["accessors"][0]["count"] = 4000000000u;
    EXPECT_NE(faultOf(d), "");
    d = triangle();
    d["accessors"][0]["byteOffset"] = 1u << 31;
    EXPECT_NE(faultOf(d), "");
    d = triangle();
    d["bufferViews"][0]["byteLength"] = 1000;
    EXPECT_TRUE(refusedWith(d, "buffer view 0 reaches past"));
    d = triangle();
    d["bufferViews"][0]["byteStride"] = 4;
    EXPECT_NE(faultOf(d), "");
    d = triangle();
    d["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices", {{"bufferView", 1}, {"componentType", 5123}, {"byteOffset", 4}}},
        {"values", {{"bufferView", 0}}}};
    EXPECT_TRUE(refusedWith(d, "sparse"));
}

TEST(GltfImport, RefusesSparseValuesOfElementsThatAreNotThere) {
    json d = triangle();
    d["accessors"][0]["sparse"] = {
        {"count", 1},
        {"indices", {{"bufferView", 1}, {"componentType", 5123}, {"byteOffset", 4}}},
        {"values", {{"bufferView", 0}}}};
    EXPECT_EQ(faultOf(d), "") << "the last vertex takes the first's place";
    d["accessors"][0]["sparse"]["indices"] = {{"bufferView", 1},
                                              {"componentType", 5125}};  // two words as one
    EXPECT_TRUE(refusedWith(d, "accessor 0 has a sparse value for element 65536 of 3"));
}

// A GLB of the document, of any version.
std::string glb(const json& document, uint32_t version) {
    std::string text = document.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out = "glTF";
    const auto word = [&](uint32_t w) { out.append(reinterpret_cast<const char*>(&w), 4); };
    word(version), word(uint32_t(20 + text.size())), word(uint32_t(text.size()));
    return out + "JSON" + text;
}

TEST(GltfImport, RefusesGlbsOfOtherVersions) {
    const std::string good = glb(triangle(), 2);
    EXPECT_TRUE(importGltf(write("two.glb", good)));
    for (const uint32_t version : {0u, 1u, 3u}) {
        const auto asset = importGltf(write("other.glb", glb(triangle(), version)));
        ASSERT_FALSE(asset) << version;
        EXPECT_NE(asset.error().message.find(fmt::format("GLB of version {}, not 2", version)),
                  std::string::npos)
            << asset.error().message;
    }
    EXPECT_FALSE(importGltf(write("cut.glb", good.substr(0, good.size() - 1))));
}

TEST(GltfImport, RefusesBadNodeTrees) {
    json d = triangle();
    d["nodes"] = {{{"mesh", 0}, {"children", {1}}}, {{"children", {0}}}};
    EXPECT_TRUE(refusedWith(d, "cycle"));
    d["nodes"] = {{{"children", {1, 2}}}, {{"children", {3}}}, {{"children", {3}}}, {{"mesh", 0}}};
    EXPECT_TRUE(refusedWith(d, "two parents"));
    d = triangle();
    json chain = json::array();
    for (int i = 0; i < 3000; ++i)
        chain.push_back({{"children", {i + 1}}});
    chain.push_back({{"mesh", 0}});
    d["nodes"] = chain;
    EXPECT_TRUE(refusedWith(d, "deeper"));
    d = triangle();
    d["nodes"][0]["matrix"] = {1, 0, 0};
    EXPECT_NE(faultOf(d), "");
}

TEST(GltfImport, RefusesPositionsThatAreNotNumbers) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(refusedWith(triangle({0, 0, 0, nan, 0, 0, 0, 1, 0}), "not finite (vertex 1)"));
}

TEST(GltfImport, RefusesFilesOutsideItsFolderAndMissingOnes) {
    write("../outside.bin", std::string(42, 'x'));
    json d = triangle();
    d["buffers"][0]["uri"] = "../outside.bin";
    EXPECT_TRUE(refusedWith(d, "outside.bin: it lies outside the scene's folder"));
    d["buffers"][0]["uri"] = "missing.bin";
    EXPECT_TRUE(refusedWith(d, "missing.bin: the file does not exist"));
    d = triangle();
    d["images"] = {{{"uri", "missing.png"}}};
    d["textures"] = {{{"source", 0}}};
    d["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    EXPECT_TRUE(refusedWith(d, "missing.png: the file does not exist"));
    d["images"] = {{{"uri", "../outside.bin"}}};
    EXPECT_TRUE(refusedWith(d, "outside.bin: it lies outside the scene's folder"));
    d["images"] = {{{"uri", "data:image/png;base64,AAAA"}}};
    EXPECT_NE(faultOf(d), "");
}

TEST(GltfImport, RefusesWhatItCannotHonour) {
    json d = triangle();
    d["extensionsRequired"] = {"ACME_fog"};
    EXPECT_TRUE(refusedWith(d, "ACME_fog"));
    d = triangle();
    d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", -3}}};
    d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    EXPECT_TRUE(refusedWith(d, "light 0"));
    d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 2;
    EXPECT_TRUE(refusedWith(d, "light 2"));
}

TEST(GltfImport, LightsTakeTheirDefaults) {
    json d = triangle();
    d["extensionsUsed"] = {"KHR_lights_punctual"};
    d["extensions"]["KHR_lights_punctual"]["lights"] = {
        {{"type", "spot"}, {"intensity", 5}, {"spot", json::object()}}};
    d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    const auto asset = importGltf(write("case.gltf", d.dump()));
    ASSERT_TRUE(asset) << asset.error().message;
    ASSERT_EQ(asset->lights.size(), 1u);
    EXPECT_EQ(asset->lights[0].intensity, glm::vec3(5)) << "an absent colour is white";
    EXPECT_NEAR(asset->lights[0].outerConeAngle, 0.785398f, 1e-5f);
    EXPECT_EQ(asset->lights[0].range, 0);
}

TEST(GltfImport, LeavesOutWhatHasNoArea) {
    const auto asset = importGltf(write("case.gltf", triangle({0, 0, 0, 1, 0, 0, 2, 0, 0}).dump()));
    ASSERT_TRUE(asset) << asset.error().message;
    EXPECT_EQ(triangleCount(*asset), 0u);
    EXPECT_FALSE(asset->warnings.empty());
}

// A small file that asks for much is refused by what it says, before anything of it is made.
TEST(GltfImport, RefusesWhatGrowsBeyondTheLimits) {
    const auto refuses = [](const json& file, const ImportLimits& limits, const std::string& words) {
        const auto asset = importGltf(write("large.gltf", file.dump()), limits);
        ASSERT_FALSE(asset) << words;
        EXPECT_NE(asset.error().message.find(words), std::string::npos) << asset.error().message;
    };
    json shared = triangle();
    const json primitive = shared["meshes"][0]["primitives"][0];
    for (int i = 0; i < 400; ++i)
        shared["meshes"][0]["primitives"].push_back(primitive);
    refuses(shared, {.vertices = 1000}, "more vertices or indices than the limit");
    json zeroes = triangle();
    zeroes["accessors"][0].erase("bufferView");
    zeroes["accessors"][0]["count"] = 2'000'000;
    refuses(zeroes, {}, "without data, more than the limit");
    json far = triangle();
    far["nodes"][0]["scale"] = {1e9, 1, 1};
    far["nodes"].push_back({{"children", {0}}, {"scale", {1e9, 1, 1}}});
    far["scenes"][0]["nodes"] = {int(far["nodes"].size()) - 1};
    refuses(far, {}, "farther off or is larger");
    json deep = triangle();
    json* at = &deep["extras"];
    for (int i = 0; i < 200; ++i)
        at = &(*at)["x"];
    *at = 1;
    refuses(deep, {}, "nested deeper than 128");
    refuses(triangle(), {.fileBytes = 10}, "larger than the limit");
}

TEST(GltfImport, SurvivesRandomDamage) {
    const std::string good = triangle().dump();
    std::mt19937 random(5);
    int loaded = 0;
    for (int i = 0; i < 1500; ++i) {
        std::string bad = good;
        for (uint32_t edits = 1 + random() % 4; edits > 0; --edits)
            bad[random() % bad.size()] = char(random() % 256);
        loaded += bool(importGltf(write("damaged.gltf", bad)));
    }
    EXPECT_LT(loaded, 1500) << "some damage must be noticed";
}

TEST(GltfImport, LoadsTheSharedScenes) {
    const fs::path shared = fs::path(AFTERGLOW_SOURCE_DIR) / "../shared/scenes";
    if (!fs::exists(shared)) GTEST_SKIP() << "the scenes are not part of the repository";
    for (const auto& [file, triangles] :
         std::map<std::string, uint64_t>{{"sponza/Sponza.gltf", 262267},
                                         {"sibenik/sibenik.gltf", 75273},
                                         {"zdm2/zdm2.gltf", 70691},
                                         {"living_room/living_room.glb", 1543},
                                         {"flight_helmet/FlightHelmet.gltf", 94722},
                                         {"fox/Fox.glb", 576}}) {
        const auto asset = importGltf((shared / file).string());
        ASSERT_TRUE(asset) << asset.error().message;
        EXPECT_NEAR(double(triangleCount(*asset)), double(triangles), double(triangles) * 0.02) << file;
    }
}

}  // namespace
}  // namespace ag
