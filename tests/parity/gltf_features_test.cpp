// A file of several glTF features, by the renderer and by the reference: they see the same.
#include <cmath>

#include "engine/scene/gltf_import.h"
#include "tests/parity/parity.h"
#include "tests/scene/gltf_files.h"

namespace ag::gi {
namespace {

using nlohmann::json;
using test::addAccessor;

constexpr int kFloat = 5126;

// A square of side 2 about the origin, facing +z; its indices.
json square(json& d) {
    const size_t positions = addAccessor(d, std::vector<float>{-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0},
                                         "VEC3", kFloat, 3),
                 indices = addAccessor(d, std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 1);
    return {{"attributes", {{"POSITION", positions}}}, {"indices", indices}, {"material", 0}};
}

// A floor with a colour at each corner, three small tiles by instancing, a morphed wall, an unlit sign; a
// sun.
json shelf(const char* camera) {
    json d = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", {0, 1, 2, 3, 4, 5}}}}}};
    for (const char* list : {"buffers", "bufferViews", "accessors"})
        d[list] = json::array();
    json floor = square(d), tile = square(d), wall = square(d), sign = square(d);
    floor["attributes"]["COLOR_0"] = addAccessor(
        d, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0.2f, 1, 0.01f, 0.01f, 0.01f}, "VEC3", kFloat, 3);
    floor["material"] = 1;
    wall["targets"] = {{{"POSITION", addAccessor(d, std::vector<float>{0, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0},
                                                 "VEC3", kFloat, 3)}}};
    sign["material"] = 2;
    d["meshes"] = {{{"primitives", {floor}}},
                   {{"primitives", {tile}}},
                   {{"primitives", {wall}}, {"weights", {0.7}}},
                   {{"primitives", {sign}}}};
    d["materials"] = {
        {{"doubleSided", true},
         {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {0.8, 0.7, 0.5, 1}}}}},
        {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
        {{"pbrMetallicRoughness", {{"baseColorFactor", {0.3, 0.6, 0.9, 1}}}},
         {"extensions", {{"KHR_materials_unlit", json::object()}}}}};
    const double half = std::sqrt(0.5);
    const json lying = {-half, 0, 0, half};
    d["nodes"] = {
        {{"mesh", 0}, {"rotation", lying}, {"scale", {3, 3, 3}}},
        {{"mesh", 1},
         {"rotation", lying},
         {"extensions",
          {{"EXT_mesh_gpu_instancing",
            {{"attributes",
              {{"TRANSLATION",
                addAccessor(d, std::vector<float>{-2, 0, 0.4f, 0, -1, 0.6f, 2, 0, 0.8f}, "VEC3", kFloat, 3)},
               {"SCALE", addAccessor(d, std::vector<float>{0.5f, 0.5f, 1, 0.6f, 0.4f, 1, 0.3f, 0.7f, 1},
                                     "VEC3", kFloat, 3)}}}}}}}},
        {{"mesh", 2}, {"translation", {0, 1, -2}}},
        {{"mesh", 3}, {"translation", {-1.8, 0.8, -1}}, {"scale", {0.5, 0.5, 1}}},
        {{"camera", 0}, {"translation", {0, 4, 7}}, {"rotation", {-0.2588, 0, 0, 0.9659}}},
        {{"rotation", {-0.6, 0.2, 0, 0.775}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}}};
    d["cameras"] = {{{"type", camera},
                     {"perspective", {{"yfov", 0.8}, {"znear", 0.1}}},
                     {"orthographic", {{"xmag", 5}, {"ymag", 2.8}, {"znear", 0.1}, {"zfar", 50}}}}};
    d["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 3}}};
    d["extensionsUsed"] = {"KHR_lights_punctual", "KHR_materials_unlit", "EXT_mesh_gpu_instancing"};
    return d;
}

class GltfParity : public testing::TestWithParam<const char*> {};

TEST_P(GltfParity, TheFileOfFeatures) {
    auto asset = importGltf(test::write("shelf.gltf", shelf(GetParam()).dump()));
    ASSERT_TRUE(asset) << asset.error().message;
    Parity p(std::move(*asset));
    const reference::Reference truth = p.trace({.paths = {.bounces = 1}, .samplesPerPixel = 256});
    const Image albedo = p.render(Layer::kAlbedo, {}, 1), depth = p.render(Layer::kDepth, {}, 1);
    int colours = 0, depths = 0;
    for (size_t i = 0; i < depth.pixels.size(); ++i) {
        const float far = truth.depth.pixels[i].x;
        depths += std::abs(depth.pixels[i].x - far) > 1e-3f * std::max(far, 1.0f);
        colours += glm::length(albedo.pixels[i] - truth.albedo.pixels[i]) > 0.02f;
    }
    EXPECT_LT(depths, 30) << "pixels that see another surface: only along silhouettes";
    EXPECT_LT(colours, 30);
    const ImageDifference direct = differ(truth.bounces[0], p.render(Layer::kDirect, {}, 2)),
                          bounce = differ(truth.bounces[1], p.render(Layer::kBounce1, {}, 60)),
                          seen = differ(truth.radiance, p.render(Layer::kRadiance, {}, 60));
    std::printf("%s: direct %.4f, bounce %.4f, radiance %.4f of the truth\n", GetParam(), direct.meanRatio,
                bounce.meanRatio, seen.meanRatio);
    EXPECT_NEAR(direct.meanRatio, 1, 0.02);
    EXPECT_NEAR(bounce.meanRatio, 1, 0.05);
    EXPECT_NEAR(seen.meanRatio, 1, 0.02);
}

INSTANTIATE_TEST_SUITE_P(Cameras, GltfParity, testing::Values("perspective", "orthographic"),
                         [](const auto& camera) { return std::string(camera.param); });

}  // namespace
}  // namespace ag::gi
