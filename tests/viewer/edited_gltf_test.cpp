#include "tools/viewer/edited_gltf.h"

#include <gtest/gtest.h>

#include "engine/core/safe_file.h"
#include "engine/scene/gltf_import.h"
#include "tests/scene/gltf_files.h"

namespace ag::viewer {
namespace {

using nlohmann::json;
using test::triangle;

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

// Nodes under a turned and scaled parent and with a matrix; a material each, one of them unlit, and none.
json movable() {
    json d = source();
    d["nodes"] = {
        {{"name", "parent"}, {"scale", {2, 2, 2}}, {"children", {1}}},
        {{"name", "child"}, {"mesh", 0}},
        {{"name", "by matrix"}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1}}, {"mesh", 0}}};
    d["scenes"] = {{{"nodes", {0, 2}}}};
    d["materials"] = {{{"name", "plain"}},
                      {{"name", "unlit"}, {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    return d;
}

TEST(EditedGltf, MovesThingsWhereTheyStand) {
    const auto before = importGltf(test::write("movable.gltf", movable().dump()));
    ASSERT_TRUE(before) << before.error().message;
    const auto nodeNamed = [&](std::string_view name) {
        return uint32_t(std::ranges::find(before->nodes, name, &SceneNode::name) - before->nodes.begin());
    };
    const AssetEdits edits{.moves = {{nodeNamed("child"), {1, 0, 0}}, {nodeNamed("by matrix"), {0, 0, -2}}}};
    const auto edited = withEdits(movable().dump(), {.moves = movesInFile(*before, edits)});
    ASSERT_TRUE(edited) << edited.error().message;
    const auto after = importGltf(test::write("moved.gltf", *edited));
    ASSERT_TRUE(after) << after.error().message;
    SceneAsset expected = *before;
    ASSERT_TRUE(applyEdits(edits, expected));
    const RenderScene a = staticScene(expected), b = staticScene(*after);
    ASSERT_EQ(a.instances.size(), b.instances.size());
    for (size_t i = 0; i < a.instances.size(); ++i)
        EXPECT_EQ(a.instances[i].worldFromLocal, b.instances[i].worldFromLocal) << i;
    EXPECT_EQ(staticScene(*before).instances[0].worldFromLocal[3] + glm::vec3(1, 0, 0),
              b.instances[0].worldFromLocal[3]);
}

TEST(EditedGltf, ChangesHowMaterialsLook) {
    const std::vector<MaterialLook> looks = {
        {.material = 0,
         .baseColor = {0.5f, 0.25f, 1, 0.75f},
         .metallic = 0.5f,
         .roughness = 0.25f,
         .emissive = {0, 4, 2}},
        {.material = 1, .baseColor = {1, 0, 0, 1}, .metallic = 0, .emissive = {0.5f, 0, 0}},
        {.material = 2,
         .baseColor = {0, 1, 0, 1},
         .metallic = 0}};  // what primitives without one are drawn with
    const auto edited = withEdits(movable().dump(), {.looks = looks});
    ASSERT_TRUE(edited) << edited.error().message;
    const auto after = importGltf(test::write("looks.gltf", *edited));
    ASSERT_TRUE(after) << after.error().message;
    for (const MaterialLook& look : looks)
        EXPECT_EQ(lookOf(after->geometry, look.material), look) << look.material;
    EXPECT_EQ(after->geometry.primitives[0].material, 2u);
}

TEST(EditedGltf, RefusesWhatIsNone) {
    for (const std::string bytes : {"", "hello", "[1]", "glTF", "glTFxxxxxxxxxxxxxxxxxxxx", R"({"nodes": 3})",
                                    R"({"scene": 5, "scenes": []})", R"({"cameras": 4})"})
        EXPECT_FALSE(withEdits(bytes, {})) << bytes;
}

TEST(EditedGltf, BuiltInScenesBecomeFiles) {
    const std::string path = test::ownFile("cornell_edited.glb");
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
