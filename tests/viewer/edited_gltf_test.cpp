#include "tools/viewer/edited_gltf.h"

#include <gtest/gtest.h>

#include "engine/core/safe_file.h"
#include "engine/scene/gltf_import.h"
#include "tests/scene/gltf_files.h"

namespace ag::viewer {
namespace {

using nlohmann::json;
using test::folder, test::triangle;

std::vector<RenderLight> threeLights() {
    std::vector<RenderLight> lights(3);
    lights[0] = {.position = {1, 2, 3}, .intensity = {4, 2, 1}, .range = 7, .bounces = true};
    lights[1] = {.kind = LightKind::kSpot,
                 .position = {-1, 0, 0},
                 .direction = glm::normalize(glm::vec3(1, -1, 0.5f)),
                 .intensity = {0, 0, 5},
                 .innerConeAngle = 0.2f,
                 .outerConeAngle = 0.6f,
                 .castsShadow = false};
    lights[2] = {.kind = LightKind::kDirectional, .direction = {0, -1, 0}, .intensity = {9, 9, 9}};
    return lights;
}

CameraPose lookingDown() {
    return {
        .position = {100, 5, 0}, .forward = {0, -1, 0}, .up = {1, 0, 0}, .verticalFov = 0.7f, .near = 0.2f};
}

void expectLight(const RenderLight& is, const RenderLight& was, glm::vec3 origin) {
    EXPECT_EQ(is.kind, was.kind);
    if (was.kind != LightKind::kDirectional) {
        EXPECT_NEAR(glm::distance(is.position, was.position + origin), 0, 1e-4f);
    }
    if (was.kind != LightKind::kPoint) {
        EXPECT_NEAR(glm::distance(is.direction, was.direction), 0, 1e-5f);
    }
    EXPECT_NEAR(glm::distance(is.intensity, was.intensity), 0, 1e-4f);
    EXPECT_EQ(is.range, was.range);
    if (was.kind == LightKind::kSpot) {
        EXPECT_FLOAT_EQ(is.innerConeAngle, was.innerConeAngle);
        EXPECT_FLOAT_EQ(is.outerConeAngle, was.outerConeAngle);
    }
}

// A triangle with a light and a camera of its own.
json source() {
    json d = triangle();
    d["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1.0}, {"znear", 0.1}}}}};
    d["nodes"][0]["camera"] = 0;
    d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 77}}};
    d["extensionsUsed"] = {"KHR_lights_punctual"};
    d["extras"] = {{"kept", true}};
    return d;
}

std::string glbOf(std::string text) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::string out(20, 0);
    const uint32_t words[] = {2, uint32_t(20 + text.size()), uint32_t(text.size())};
    std::memcpy(out.data(), "glTF", 4);
    std::memcpy(out.data() + 4, words, sizeof words);
    std::memcpy(out.data() + 16, "JSON", 4);
    return out + text;
}

TEST(EditedGltf, HasTheLightsAndTheCameraAndAllElse) {
    const std::vector<RenderLight> lights = threeLights();
    const glm::dvec3 origin(100, 0, 0);
    for (const bool binary : {false, true}) {
        const std::string bytes = binary ? glbOf(source().dump()) : source().dump();
        const auto edited = withEdits(bytes, {lights, origin, lookingDown()});
        ASSERT_TRUE(edited);
        EXPECT_NE(edited->find("\"kept\":true"), std::string::npos);
        const std::string path = test::write(binary ? "edited.glb" : "edited.gltf", *edited);
        const auto asset = importGltf(path);
        ASSERT_TRUE(asset) << asset.error().message;
        EXPECT_EQ(triangleCount(*asset), 1u);
        const RenderScene scene = staticScene(*asset);
        ASSERT_EQ(scene.lights.size(), 3u) << "the file's own is gone";
        for (size_t i = 0; i < 3; ++i)
            expectLight(scene.lights[i], lights[i], glm::vec3(origin));
        const CameraPose pose = cameraOf(*asset, 0), was = lookingDown();
        EXPECT_NEAR(glm::distance(pose.position, was.position), 0, 1e-5);
        EXPECT_NEAR(glm::distance(pose.forward, was.forward), 0, 1e-5f);
        EXPECT_NEAR(glm::distance(pose.up, was.up), 0, 1e-5f);
        EXPECT_EQ(asset->cameras.size(), 2u) << "the file's own is the second";
        EXPECT_FLOAT_EQ(asset->cameras[1].verticalFov, 1);
    }
}

TEST(EditedGltf, SaysWhatALightDoesNotDo) {
    const std::vector<RenderLight> lights = threeLights();
    const auto edited = withEdits(source().dump(), {lights, {}, {}});
    const json d = json::parse(*edited);
    const auto extrasOf = [&](const char* name) {
        for (const json& node : d["nodes"])
            if (node.value("name", "") == name) return node.value("extras", json::object());
        return json();
    };
    EXPECT_EQ(extrasOf("light 0"), json::object());
    EXPECT_EQ(extrasOf("light 1"), (json{{"bounces", false}, {"castsShadow", false}}));
}

TEST(EditedGltf, RefusesWhatIsNone) {
    for (const std::string bytes : {"", "hello", "[1]", "glTF", "glTFxxxxxxxxxxxxxxxxxxxx", R"({"nodes": 3})",
                                    R"({"scene": 5, "scenes": []})", R"({"cameras": 4})"})
        EXPECT_FALSE(withEdits(bytes, {})) << bytes;
}

TEST(EditedGltf, BuiltInScenesBecomeFiles) {
    const std::string path = (folder() / "cornell_edited.glb").string();
    const std::vector<RenderLight> lights = threeLights();
    ASSERT_TRUE(saveEdited("cornell", 0, {lights, {}, lookingDown()}, path));
    const auto asset = importGltf(path);
    ASSERT_TRUE(asset);
    EXPECT_EQ(staticScene(*asset).lights.size(), 3u);
    EXPECT_EQ(editedPath("cornell"), "cornell_edited.glb");
    EXPECT_EQ(editedPath("a/b.gltf"), "a/b_edited.gltf");
}

}  // namespace
}  // namespace ag::viewer
