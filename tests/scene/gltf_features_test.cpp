// What files may use beyond plain meshes: each feature gives the same scene as the file written without it,
// and is in the report.
#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <gtest/gtest.h>
#include <meshoptimizer.h>
#include <webp/encode.h>

#include <algorithm>
#include <numbers>
#include <random>

#include "engine/core/projection.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/static_scene.h"
#include "tests/scene/gltf_files.h"

namespace ag {
namespace {

using nlohmann::json;
using test::addAccessor, test::bufferOf, test::bytesOf, test::faultOf, test::triangle, test::write;

constexpr int kByte = 5120, kShort = 5122, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

SceneAsset import(const json& document, const char* name = "case.gltf") {
    auto asset = importGltf(write(name, document.dump()));
    EXPECT_TRUE(asset) << (asset ? "" : asset.error().message);
    return asset ? std::move(*asset) : SceneAsset{};
}

const SceneFeature* featureOf(const SceneAsset& asset, const std::string& name) {
    const auto found = std::ranges::find(asset.features, name, &SceneFeature::name);
    return found == asset.features.end() ? nullptr : &*found;
}

testing::AssertionResult reports(const SceneAsset& asset, const std::string& name, FeatureSupport support,
                                 uint64_t uses = 1) {
    const SceneFeature* f = featureOf(asset, name);
    if (!f) return testing::AssertionFailure() << name << " is not in the report";
    if (f->support != support || f->uses != uses)
        return testing::AssertionFailure() << name << " is used " << f->uses << " times: " << f->note;
    if ((f->support == FeatureSupport::kUsed) != f->note.empty())
        return testing::AssertionFailure() << name << " needs a note, or needs none: '" << f->note << "'";
    return testing::AssertionSuccess();
}

json& primitive(json& d) {
    return d["meshes"][0]["primitives"][0];
}

json withMaterial(const json& material) {
    json d = triangle();
    d["materials"] = {material};
    primitive(d)["material"] = 0;
    return d;
}

// A square of 4x4 texels: the left half red and clear, the right half green and opaque.
std::vector<unsigned char> twoHalves() {
    std::vector<unsigned char> texels;
    for (int i = 0; i < 16; ++i)
        for (const int c : i % 4 < 2 ? std::array{255, 0, 0, 51} : std::array{0, 255, 0, 255})
            texels.push_back(static_cast<unsigned char>(c));
    return texels;
}

json webpOf(const std::vector<unsigned char>& texels) {  // 4x4
    uint8_t* encoded = nullptr;
    const size_t size = WebPEncodeLosslessRGBA(texels.data(), 4, 4, 16, &encoded);
    const std::vector<unsigned char> bytes(encoded, encoded + size);
    WebPFree(encoded);
    return {{"uri", "data:image/webp;base64," + test::base64(bytes)}};
}

json webpImage() {
    return webpOf(twoHalves());
}

json ktxImage() {
    const std::vector<unsigned char> bytes = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                              '0',  0xbb, '\r', '\n', 0x1a, '\n'};
    return {{"uri", "data:image/ktx2;base64," + test::base64(bytes)}};
}

// Faces of a plain colour, 255 over `share` each; that towards -Z is twoHalves().
json surroundings(unsigned char share) {
    json d = triangle();
    json faces = json::array();
    for (int face = 0; face < 5; ++face) {
        std::vector<unsigned char> texels;
        for (int i = 0; i < 16; ++i)
            for (const int c : {face == 0 ? 255 : 0, face == 2 ? 255 : 0, face == 4 ? 255 : 0, int(share)})
                texels.push_back(static_cast<unsigned char>(c));
        d["images"].push_back(webpOf(texels));
        faces.push_back(face);
    }
    d["images"].push_back(webpImage());
    faces.push_back(5);
    d["extensionsUsed"] = {"EXT_lights_image_based", "EXT_texture_webp"};
    d["extensions"]["EXT_lights_image_based"]["lights"] = {
        {{"specularImageSize", 4}, {"specularImages", {faces}}, {"intensity", 2}}};
    d["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 0;
    return d;
}

TEST(GltfFeatures, ImageBasedLightIsTheSky) {
    json d = surroundings(51);
    const SceneAsset asset = import(d);
    ASSERT_TRUE(asset.sky);
    const auto seen = [](const SceneAsset& a, glm::vec3 d) { return skyRadiance(*a.sky, glm::normalize(d)); };
    EXPECT_LT(glm::distance(seen(asset, {1, 0, 0}), glm::vec3(10, 0, 0)), 0.01f) << "twice 1 over a fifth";
    EXPECT_LT(glm::distance(seen(asset, {0, 1, 0}), glm::vec3(0, 10, 0)), 0.01f);
    EXPECT_LT(glm::distance(seen(asset, {0, 0, 1}), glm::vec3(0, 0, 10)), 0.01f);
    EXPECT_LT(glm::distance(seen(asset, {-0.6f, 0.2f, -1}), glm::vec3(10, 0, 0)), 0.3f)
        << "left, but for what is interpolated";
    EXPECT_LT(glm::distance(seen(asset, {0.6f, 0.2f, -1}), glm::vec3(0, 2, 0)), 0.3f) << "right";
    EXPECT_EQ(whyNoSky(asset.sky->radiance), nullptr);
    EXPECT_TRUE(reports(asset, "EXT_lights_image_based", FeatureSupport::kApproximated));

    // A quarter turn about the axis upwards: what was at +X is at -Z.
    d["extensions"]["EXT_lights_image_based"]["lights"][0]["rotation"] = {0, std::numbers::sqrt2 / 2, 0,
                                                                          std::numbers::sqrt2 / 2};
    EXPECT_LT(glm::distance(seen(import(d), {0, 0, -1}), glm::vec3(10, 0, 0)), 0.01f);
}

TEST(GltfFeatures, ImageBasedLightWithoutItsImagesIsLeftOut) {
    for (const json& broken : {json(7), json({0, 1, 2}), json({0, 1, 2, 3, 4, 99}), json("text")}) {
        json d = surroundings(255);
        d["extensions"]["EXT_lights_image_based"]["lights"][0]["specularImages"] = {broken};
        const SceneAsset asset = import(d);
        EXPECT_FALSE(asset.sky);
        EXPECT_EQ(asset.warnings.size(), 1u);
    }
    json d = surroundings(255);
    d["scenes"][0]["extensions"]["EXT_lights_image_based"]["light"] = 3;
    EXPECT_FALSE(import(d).sky);
}

TEST(GltfFeatures, ReportSaysWhatIsLost) {
    json d = withMaterial({{"extensions", {{"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}}}}});
    d["extensionsUsed"] = {"KHR_materials_clearcoat", "ACME_fog", "KHR_lights_punctual", "ACME_fog"};
    d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    d["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    primitive(d)["mode"] = 5;  // strip
    const SceneAsset asset = import(d);
    EXPECT_TRUE(reports(asset, "KHR_materials_clearcoat", FeatureSupport::kNotSupported));
    EXPECT_TRUE(reports(asset, "ACME_fog", FeatureSupport::kNotSupported, 0));
    EXPECT_TRUE(reports(asset, "strips and fans", FeatureSupport::kUsed));
    EXPECT_TRUE(reports(asset, "KHR_lights_punctual", FeatureSupport::kUsed)) << "one light";
    EXPECT_EQ(asset.features.size(), 4u) << "nothing that the file does not use";
}

TEST(GltfFeatures, UnlitIsEmittedAndReflectsNothing) {
    json d = withMaterial({{"pbrMetallicRoughness", {{"baseColorFactor", {0.2, 0.4, 0.8, 1}}}},
                           {"extensions", {{"KHR_materials_unlit", json::object()}}}});
    d["extensionsUsed"] = {"KHR_materials_unlit"};
    const SceneAsset asset = import(d);
    const Material& m = asset.geometry.materials[0];
    EXPECT_EQ(m.emissive, glm::vec3(0.2f, 0.4f, 0.8f));
    EXPECT_EQ(m.baseColor, glm::vec4(0, 0, 0, 1));
    EXPECT_EQ(m.metallic, 0);
    EXPECT_EQ(m.specular, 0);
    EXPECT_TRUE(reports(asset, "KHR_materials_unlit", FeatureSupport::kApproximated));
}

TEST(GltfFeatures, IndexOfRefractionSetsWhatIsReflectedHeadOn) {
    const auto specularOf = [](const json& extensions) {
        return import(withMaterial({{"extensions", extensions}})).geometry.materials[0].specular;
    };
    EXPECT_FLOAT_EQ(specularOf({{"KHR_materials_ior", {{"ior", 1.5}}}}), 1);
    EXPECT_FLOAT_EQ(specularOf({{"KHR_materials_ior", {{"ior", 2}}}}) * 0.04f, 1 / 9.0f);
    EXPECT_FLOAT_EQ(specularOf({{"KHR_materials_ior", {{"ior", 1}}}}), 0);
    EXPECT_FLOAT_EQ(specularOf({{"KHR_materials_specular",
                                 {{"specularFactor", 0.5}, {"specularColorFactor", {1, 0.5, 0}}}}}),
                    0.25f);
}

TEST(GltfFeatures, GlassAndBlendedSurfaces) {
    const auto modeOf = [](const json& material) {
        return import(withMaterial(material)).geometry.materials[0].alphaMode;
    };
    const auto blended = [](double alpha) {
        return json{{"alphaMode", "BLEND"},
                    {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, alpha}}}}};
    };
    EXPECT_EQ(modeOf(blended(0.3)), AlphaMode::kBlend);
    EXPECT_EQ(modeOf(blended(1)), AlphaMode::kOpaque) << "exporters blend what is opaque";
    const auto glass = [](double factor) {
        return json{{"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", factor}}}}}};
    };
    EXPECT_EQ(modeOf(glass(0.9)), AlphaMode::kBlend);
    EXPECT_EQ(modeOf(glass(0.2)), AlphaMode::kOpaque);
    const Material pane = import(withMaterial(glass(0.9))).geometry.materials[0];
    EXPECT_FLOAT_EQ(pane.transmission, 0.9f);
    EXPECT_FLOAT_EQ(import(withMaterial(blended(0.3))).geometry.materials[0].baseColor.w, 0.3f);
    json opaqueGlass = glass(0.9);
    opaqueGlass["pbrMetallicRoughness"] = {{"baseColorFactor", {1, 1, 1, 0.2}}};
    EXPECT_TRUE(import(withMaterial(opaqueGlass)).geometry.materials[0].coversWholly)
        << "alpha counts where the mode says so";
    opaqueGlass["alphaMode"] = "BLEND";
    EXPECT_FALSE(import(withMaterial(opaqueGlass)).geometry.materials[0].coversWholly);

    json leaf = withMaterial({{"alphaMode", "BLEND"},
                              {"alphaCutoff", 0.9},
                              {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    leaf["images"] = {webpImage()};
    leaf["textures"] = {{{"source", 0}}};
    const SceneAsset asset = import(leaf);
    EXPECT_EQ(asset.geometry.materials[0].alphaMode, AlphaMode::kMask);
    EXPECT_FLOAT_EQ(asset.geometry.materials[0].alphaCutoff, 0.5f) << "the cut-off is that of masks alone";
    EXPECT_TRUE(reports(asset, "alpha blending", FeatureSupport::kApproximated));
    leaf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.6};
    EXPECT_EQ(import(leaf).geometry.materials[0].alphaMode, AlphaMode::kBlend) << "covers in part everywhere";
}

// As compression leaves them: 0.8 and 1.2 long.
TEST(GltfFeatures, NormalMapsAreNormalised) {
    std::vector<unsigned char> texels;
    for (int i = 0; i < 16; ++i)
        for (const int c : i % 4 < 2 ? std::array{128, 128, 229, 255} : std::array{219, 128, 219, 255})
            texels.push_back(static_cast<unsigned char>(c));
    json d = withMaterial({{"normalTexture", {{"index", 0}}},
                           {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", 0}}}}}});
    d["images"] = {webpOf(texels)};
    d["extensionsUsed"] = {"EXT_texture_webp"};
    d["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
    const SceneAsset asset = import(d);
    const Material& m = asset.geometry.materials[0];
    const auto& layers = asset.geometry.textures[size_t(m.textureClass)].linear;
    const std::vector<uint8_t>& normals = layers[size_t(m.normalLayer)];
    for (size_t i = 0; i < normals.size(); i += 4) {
        const glm::vec3 n = glm::vec3(normals[i], normals[i + 1], normals[i + 2]) / 127.5f - 1.0f;
        ASSERT_NEAR(glm::length(n), 1, 0.008);
    }
    ASSERT_NE(m.metallicRoughnessLayer, m.normalLayer) << "numbers stay as they are";
    EXPECT_NEAR(layers[size_t(m.metallicRoughnessLayer)][(128 * 256 + 64) * 4 + 2], 229, 4);
}

TEST(GltfFeatures, TexturesOfOtherFormats) {
    json d = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    d["images"] = {ktxImage(), webpImage()};
    d["extensionsUsed"] = {"EXT_texture_webp", "KHR_texture_basisu"};
    d["textures"] = {{{"extensions", {{"EXT_texture_webp", {{"source", 1}}}}}}};
    const SceneAsset webp = import(d);
    const Material& m = webp.geometry.materials[0];
    ASSERT_EQ(m.baseColorLayer, 0);
    const std::vector<uint8_t>& layer = webp.geometry.textures[size_t(m.textureClass)].srgb[0];
    constexpr size_t kRow = 128 * 256 * 4;
    EXPECT_NEAR(layer[kRow + 4 * 64], 255, 4) << "the left half is red";
    EXPECT_NEAR(layer[kRow + 4 * 192 + 1], 255, 4) << "the right half is green";
    EXPECT_TRUE(reports(webp, "EXT_texture_webp", FeatureSupport::kUsed));

    d["textures"] = {{{"source", 1}, {"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    EXPECT_EQ(import(d).geometry.materials[0].baseColorLayer, 0) << "the fallback is shown";
    d["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    d["extensionsRequired"] = {"KHR_texture_basisu"};
    const SceneAsset plain = import(d);
    EXPECT_EQ(plain.geometry.materials[0].baseColorLayer, -1);
    EXPECT_TRUE(reports(plain, "KHR_texture_basisu", FeatureSupport::kApproximated));
    d["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 7}}}}}}};
    EXPECT_NE(faultOf(d).find("texture 0 names image 7"), std::string::npos);
    d["textures"] = {json::object()};
    EXPECT_NE(faultOf(d).find("texture 0 names no image"), std::string::npos);
}

TEST(GltfFeatures, SecondTextureCoordinates) {
    json d = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}},
                           {"emissiveTexture", {{"index", 0}, {"texCoord", 0}}}});
    d["images"] = {webpImage()};
    d["textures"] = {{{"source", 0}}};
    primitive(d)["attributes"]["TEXCOORD_0"] =
        addAccessor(d, std::vector<float>{0, 0, 0, 0, 0, 0}, "VEC2", kFloat, 2);
    primitive(d)["attributes"]["TEXCOORD_1"] =
        addAccessor(d, std::vector<uint16_t>{0, 0, 65535, 0, 0, 65535}, "VEC2", kUnsignedShort, 2, true);
    const SceneAsset asset = import(d);
    EXPECT_EQ(asset.geometry.attributes[1].uv, glm::vec2(1, 0));
    EXPECT_EQ(asset.geometry.attributes[2].uv, glm::vec2(0, 1));
    EXPECT_TRUE(reports(asset, "second texture coordinates", FeatureSupport::kUsed));
    EXPECT_TRUE(
        reports(asset, "textures of one material on different coordinates", FeatureSupport::kApproximated));

    json& texture = d["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
    texture = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 1}}}}}};
    d["extensionsUsed"] = {"KHR_texture_transform"};
    EXPECT_EQ(import(d).geometry.attributes[1].uv, glm::vec2(1, 0)) << "the transform's set is what counts";
}

TEST(GltfFeatures, ImagesLieInTheirBuffers) {
    json d = withMaterial({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    d["textures"] = {{{"source", 0}}};
    d["images"] = {{{"bufferView", 2}, {"mimeType", "image/png"}}};
    for (const json& view : {json{{"buffer", 0}, {"byteOffset", 1e12}, {"byteLength", 4096}},
                             json{{"buffer", 0}, {"byteOffset", 40}, {"byteLength", 4096}}}) {
        d["bufferViews"][2] = view;
        EXPECT_NE(faultOf(d).find("image 0: its bytes lie outside their buffer"), std::string::npos);
    }
}

TEST(GltfFeatures, QuantizedMeshes) {
    json d = triangle();
    primitive(d)["attributes"]["POSITION"] =
        addAccessor(d, std::vector<int16_t>{0, 0, 0, 100, 0, 0, 0, -200, 0}, "VEC3", kShort, 3);
    primitive(d)["attributes"]["NORMAL"] =
        addAccessor(d, std::vector<int8_t>{0, 0, -127, 0, 0, -127, 0, 0, -128}, "VEC3", kByte, 3, true);
    EXPECT_NE(faultOf(d).find("not three floats"), std::string::npos) << "only where the file says so";
    d["extensionsUsed"] = {"KHR_mesh_quantization"};
    const SceneAsset asset = import(d);
    EXPECT_EQ(asset.geometry.positions[2], glm::vec3(0, -200, 0));
    EXPECT_EQ(asset.geometry.attributes[2].normal, glm::vec3(0, 0, -1));
}

TEST(GltfFeatures, MorphTargetsAtTheWeightsOfMeshAndNode) {
    json d = triangle();
    const size_t up = addAccessor(d, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", kFloat, 3),
                 aside = addAccessor(d, std::vector<float>{2, 0, 0, 2, 0, 0, 2, 0, 0}, "VEC3", kFloat, 3);
    primitive(d)["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}}};
    d["meshes"][0]["weights"] = {0.5, 0};
    d["nodes"] = {{{"mesh", 0}}, {{"mesh", 0}, {"weights", {0, 1.5}}}, {{"mesh", 0}, {"weights", {0.5, 0}}}};
    d["scenes"][0]["nodes"] = {0, 1, 2};
    const SceneAsset asset = import(d);
    const auto cornerOf = [&](size_t node) {
        const SceneMesh& mesh = asset.meshes[size_t(asset.nodes[node].mesh)];
        return asset.geometry.positions[size_t(asset.geometry.primitives[mesh.firstPrimitive].vertexOffset)];
    };
    EXPECT_EQ(cornerOf(0), glm::vec3(0, 0, 0.5f));
    EXPECT_EQ(cornerOf(1), glm::vec3(3, 0, 0));
    EXPECT_EQ(asset.nodes[2].mesh, asset.nodes[0].mesh) << "equal weights share the mesh";
    EXPECT_TRUE(reports(asset, "morph targets", FeatureSupport::kUsed));

    primitive(d)["targets"] = {{{"POSITION", 77}}};
    EXPECT_NE(faultOf(d).find("morph target"), std::string::npos);
    primitive(d)["targets"] = {
        {{"POSITION", addAccessor(d, std::vector<float>{0, 0, 1}, "VEC3", kFloat, 3)}}};
    EXPECT_NE(faultOf(d).find("another length"), std::string::npos);
}

// What a few bytes ask for again and again is summed up before it is made.
TEST(GltfFeatures, MorphTargetsAreCounted) {
    json d = triangle();
    const size_t up = addAccessor(d, std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", kFloat, 3);
    primitive(d)["targets"] = json::array();
    for (int i = 0; i < 40; ++i)
        primitive(d)["targets"].push_back({{"POSITION", up}});
    EXPECT_EQ(faultOf(d, {.vertices = 120}), "");
    EXPECT_NE(faultOf(d, {.vertices = 119}).find("morph targets move more"), std::string::npos);

    d = triangle();
    d["accessors"].push_back({{"componentType", kFloat}, {"count", 0}, {"type", "VEC3"}});
    primitive(d) = {{"attributes", {{"POSITION", 2}}}, {"targets", {{{"POSITION", 2}}}}};
    d["nodes"] = json::array();
    for (int i = 0; i < 6; ++i)
        d["nodes"].push_back({{"mesh", 0}, {"weights", {i + 1}}});
    d["scenes"][0]["nodes"] = {0, 1, 2, 3, 4, 5};
    EXPECT_NE(faultOf(d, {.vertices = 6}).find("more vertices"), std::string::npos) << "each copy is work";
    EXPECT_EQ(import(d).warnings.size(), 1u) << "said once, not of each copy";
}

json instanced() {
    json d = triangle();
    d["extensionsUsed"] = {"EXT_mesh_gpu_instancing"};
    const float half = std::numbers::sqrt2_v<float> / 2;
    d["nodes"][0]["translation"] = {10, 0, 0};
    d["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = {
        {"TRANSLATION", addAccessor(d, std::vector<float>{0, 0, 0, 0, 5, 0}, "VEC3", kFloat, 3)},
        {"ROTATION", addAccessor(d, std::vector<float>{0, 0, 0, 1, 0, 0, half, half}, "VEC4", kFloat, 4)},
        {"SCALE", addAccessor(d, std::vector<float>{1, 1, 1, 2, 2, 2}, "VEC3", kFloat, 3)}};
    return d;
}

TEST(GltfFeatures, InstancesAreNodes) {
    json d = instanced();
    const SceneAsset asset = import(d);
    EXPECT_EQ(triangleCount(asset), 2u) << "the node itself draws nothing more";
    const RenderScene scene = staticScene(asset, glm::dvec3(0));
    ASSERT_EQ(scene.instances.size(), 2u);
    const glm::vec3 corner = scene.instances[1].worldFromLocal * glm::vec4(1, 0, 0, 1);
    EXPECT_NEAR(glm::distance(corner, glm::vec3(10, 7, 0)), 0, 1e-5f) << "scaled, turned about z, moved";
    EXPECT_TRUE(reports(asset, "EXT_mesh_gpu_instancing", FeatureSupport::kUsed));

    auto& attributes = d["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
    attributes["SCALE"] = 99;
    EXPECT_NE(faultOf(d).find("do not fit together"), std::string::npos);
    attributes["SCALE"] = addAccessor(d, std::vector<float>{1, 1, 1}, "VEC3", kFloat, 3);
    EXPECT_NE(faultOf(d).find("do not fit together"), std::string::npos);
    attributes.erase("SCALE");
    attributes["TRANSLATION"] =
        addAccessor(d, std::vector<float>{0, 0, 0, INFINITY, 0, 0}, "VEC3", kFloat, 3);
    EXPECT_NE(faultOf(d).find("not finite"), std::string::npos);
    const auto few = importGltf(write("few.gltf", instanced().dump()), {.nodes = 2});
    ASSERT_FALSE(few);
    EXPECT_NE(few.error().message.find("more nodes than the limit"), std::string::npos);
}

TEST(GltfFeatures, HiddenNodesHideWhatIsBelowThem) {
    json d = triangle();
    d["nodes"] = {
        {{"mesh", 0}, {"children", {1}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
        {{"mesh", 0}},
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}}};
    d["scenes"][0]["nodes"] = {0, 2};
    d["extensionsUsed"] = {"KHR_node_visibility"};
    EXPECT_EQ(triangleCount(import(d)), 1u);
}

TEST(GltfFeatures, OrthographicCamerasShowDepthsAtOneSize) {
    json d = triangle();
    d["cameras"] = {{{"type", "orthographic"},
                     {"orthographic", {{"xmag", 2}, {"ymag", 1.5}, {"znear", 0.1}, {"zfar", 100}}}}};
    d["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 4}}});
    d["scenes"][0]["nodes"] = {0, 1};
    const SceneAsset asset = import(d);
    RenderScene scene = staticScene(asset, glm::dvec3(0));
    setCamera(scene, cameraOf(asset, 0), {400, 300});
    const auto heightAt = [&](float z) {
        const glm::vec4 h = scene.camera.clipFromWorld * glm::vec4(0, 1.5f, z, 1);
        return h.y / h.w;
    };
    EXPECT_NEAR(std::abs(heightAt(4)), 1, 1e-3f) << "the picture is 3 m high";
    EXPECT_NEAR(heightAt(-5) / heightAt(4), 1, 0.01f);
    const glm::vec4 before = scene.camera.clipFromWorld * glm::vec4(0, 0, 3.95f, 1),
                    behind = scene.camera.clipFromWorld * glm::vec4(0, 0, 3.85f, 1);
    EXPECT_GT(before.z, before.w) << "cut off by the near plane";
    EXPECT_LT(behind.z, behind.w);
    EXPECT_TRUE(reports(asset, "orthographic cameras", FeatureSupport::kApproximated));
    d["cameras"][0]["orthographic"]["ymag"] = 1e-46;  // none, as a float
    const SceneAsset flat = import(d);
    setCamera(scene, cameraOf(flat, 0), {400, 300});
    EXPECT_TRUE(std::isfinite(scene.camera.clipFromWorld[0][0]));
    EXPECT_GT(cameraOf(flat, 0).near, 0);
}

// A fan of triangles about a point; 3 floats a vertex.
std::vector<float> fanPositions(uint32_t triangles) {
    std::vector<float> positions = {0, 0, 1};
    for (uint32_t i = 0; i <= triangles; ++i) {
        const float angle = 1.5f * float(i) / float(triangles);
        positions.insert(positions.end(), {std::cos(angle), std::sin(angle), 0});
    }
    return positions;
}

std::vector<uint32_t> fanIndices(uint32_t triangles) {
    std::vector<uint32_t> indices;
    for (uint32_t i = 0; i < triangles; ++i)
        indices.insert(indices.end(), {0, i + 1, i + 2});
    return indices;
}

// The fan, its positions and indices compressed by meshoptimizer, with one buffer for all that is compressed
// and one without bytes for what it was.
json meshoptFan(uint32_t triangles) {
    const std::vector<float> positions = fanPositions(triangles);
    const std::vector<uint32_t> indices = fanIndices(triangles);
    const size_t vertices = positions.size() / 3;
    std::vector<unsigned char> attributes(meshopt_encodeVertexBufferBound(vertices, 12)),
        faces(meshopt_encodeIndexBufferBound(indices.size(), vertices));
    attributes.resize(
        meshopt_encodeVertexBuffer(attributes.data(), attributes.size(), positions.data(), vertices, 12));
    faces.resize(meshopt_encodeIndexBuffer(faces.data(), faces.size(), indices.data(), indices.size()));
    const size_t first = attributes.size();
    std::vector<unsigned char> both = attributes;
    both.insert(both.end(), faces.begin(), faces.end());

    json d = triangle();
    d["extensionsUsed"] = d["extensionsRequired"] = {"EXT_meshopt_compression"};
    const size_t plain = positions.size() * 4 + indices.size() * 4;
    d["buffers"] = {
        bufferOf(both),
        {{"byteLength", plain}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
    d["bufferViews"] = {{{"buffer", 1},
                         {"byteLength", positions.size() * 4},
                         {"byteStride", 12},
                         {"extensions",
                          {{"EXT_meshopt_compression",
                            {{"buffer", 0},
                             {"byteLength", first},
                             {"byteStride", 12},
                             {"count", vertices},
                             {"mode", "ATTRIBUTES"}}}}}},
                        {{"buffer", 1},
                         {"byteOffset", positions.size() * 4},
                         {"byteLength", indices.size() * 4},
                         {"extensions",
                          {{"EXT_meshopt_compression",
                            {{"buffer", 0},
                             {"byteOffset", first},
                             {"byteLength", both.size() - first},
                             {"byteStride", 4},
                             {"count", indices.size()},
                             {"mode", "TRIANGLES"}}}}}}};
    d["accessors"] = {
        {{"bufferView", 0}, {"componentType", kFloat}, {"count", vertices}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", kUnsignedInt}, {"count", indices.size()}, {"type", "SCALAR"}}};
    return d;
}

double areaOf(const SceneAsset& asset) {
    double area = 0;
    const GeometryArrays& g = asset.geometry;
    for (size_t i = 0; i + 2 < g.indices.size(); i += 3) {
        const glm::vec3 a = g.positions[g.indices[i]], b = g.positions[g.indices[i + 1]],
                        c = g.positions[g.indices[i + 2]];
        area += 0.5 * double(glm::length(glm::cross(b - a, c - a)));
    }
    return area;
}

double fanArea(uint32_t triangles) {
    json d = triangle();
    primitive(d)["attributes"]["POSITION"] = addAccessor(d, fanPositions(triangles), "VEC3", kFloat, 3);
    primitive(d)["indices"] = addAccessor(d, fanIndices(triangles), "SCALAR", kUnsignedInt, 1);
    return areaOf(import(d, "plain.gltf"));
}

TEST(GltfFeatures, MeshoptCompression) {
    const json d = meshoptFan(200);
    const SceneAsset asset = import(d);
    EXPECT_EQ(triangleCount(asset), 200u);
    EXPECT_DOUBLE_EQ(areaOf(asset), fanArea(200)) << "it loses nothing";
    EXPECT_TRUE(reports(asset, "EXT_meshopt_compression", FeatureSupport::kUsed, 2));
    json bad = d;
    bad["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["byteStride"] = 13;
    EXPECT_NE(faultOf(bad).find("impossible mode, filter or stride"), std::string::npos);
    bad = d;
    bad["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["byteLength"] = 3;
    EXPECT_NE(faultOf(bad).find("cannot be decompressed"), std::string::npos);
    bad = d;
    bad["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["byteOffset"] = 1e9;
    EXPECT_NE(faultOf(bad).find("outside their buffer"), std::string::npos);
    bad = d;
    bad["bufferViews"][0]["extensions"]["EXT_meshopt_compression"]["count"] = 1e12;
    EXPECT_NE(faultOf(bad).find("larger than the limit"), std::string::npos);
}

std::vector<unsigned char> dracoFan(uint32_t triangles, bool sequential) {
    const std::vector<float> p = fanPositions(triangles);
    const std::vector<uint32_t> indices = fanIndices(triangles);
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(int(triangles));
    const int position = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
    for (uint32_t t = 0; t < triangles; ++t)
        builder.SetAttributeValuesForFace(position, draco::FaceIndex(t), &p[3 * indices[3 * t]],
                                          &p[3 * indices[3 * t + 1]], &p[3 * indices[3 * t + 2]]);
    const std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    draco::Encoder encoder;
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 14);
    if (sequential) encoder.SetEncodingMethod(draco::MESH_SEQUENTIAL_ENCODING);
    draco::EncoderBuffer buffer;
    EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
    return {buffer.data(), buffer.data() + buffer.size()};
}

json dracoDocument(uint32_t triangles, bool sequential = false) {
    json d = triangle();
    const std::vector<unsigned char> bytes = dracoFan(triangles, sequential);
    d["extensionsUsed"] = d["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    d["buffers"] = {bufferOf(bytes)};
    d["bufferViews"] = {{{"buffer", 0}, {"byteLength", bytes.size()}}};
    d["accessors"] = {{{"componentType", kFloat}, {"count", triangles + 2}, {"type", "VEC3"}},
                      {{"componentType", kUnsignedShort}, {"count", 3 * triangles}, {"type", "SCALAR"}}};
    primitive(d)["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", 0},
                                                                {"attributes", {{"POSITION", 0}}}};
    return d;
}

TEST(GltfFeatures, DracoCompression) {
    const json d = dracoDocument(150);
    const SceneAsset asset = import(d);
    EXPECT_EQ(triangleCount(asset), 150u);
    EXPECT_NEAR(areaOf(asset), fanArea(150), 1e-3);
    EXPECT_TRUE(reports(asset, "KHR_draco_mesh_compression", FeatureSupport::kUsed));
    json bad = d;
    bad["accessors"][0]["count"] = 20;
    EXPECT_NE(faultOf(bad).find("compressed POSITION"), std::string::npos);
    bad = d;
    bad["accessors"][1]["count"] = 30;
    EXPECT_NE(faultOf(bad).find("compressed triangles"), std::string::npos);
    bad = d;
    bad["bufferViews"][0]["byteLength"] = 9;
    EXPECT_NE(faultOf(bad).find("cannot be decompressed"), std::string::npos);
    bad = d;
    primitive(bad)["extensions"]["KHR_draco_mesh_compression"]["bufferView"] = 5;
    EXPECT_NE(faultOf(bad), "");
}

// Before anything is decompressed, and all primitives together.
TEST(GltfFeatures, DracoMeshesAreCountedFirst) {
    for (const bool sequential : {false, true}) {
        json d = dracoDocument(150, sequential);
        EXPECT_EQ(faultOf(d, {.vertices = 450}), "");  // flat: one a corner
        EXPECT_NE(faultOf(d, {.vertices = 151}).find("compresses is larger"), std::string::npos);
        EXPECT_NE(faultOf(d, {.indices = 449}).find("compresses is larger"), std::string::npos);
        d["meshes"][0]["primitives"].push_back(primitive(d));
        EXPECT_EQ(faultOf(d, {.vertices = 900}), "");
        EXPECT_NE(faultOf(d, {.vertices = 303}).find("compresses is larger"), std::string::npos);
    }
}

// Compressed bytes that are damaged anywhere: a scene or a sentence, and no memory that the file does not
// account for.
TEST(GltfFeatures, SurvivesDamagedCompression) {
    std::minstd_rand random(7);
    for (const json& good : {meshoptFan(40), dracoDocument(40)}) {
        const std::string uri = good["buffers"][0]["uri"];
        const size_t first = uri.find(',') + 1;
        int loaded = 0;
        for (int i = 0; i < 1500; ++i) {
            std::string damaged = uri;
            for (uint32_t k = 0; k < 1 + random() % 3; ++k)
                damaged[first + random() % (uri.size() - first - 2)] = char('A' + random() % 26);
            json d = good;
            d["buffers"][0]["uri"] = damaged;
            loaded += faultOf(d).empty();
        }
        EXPECT_GT(loaded, 0);
        EXPECT_LT(loaded, 1500);
    }
}

}  // namespace
}  // namespace ag
