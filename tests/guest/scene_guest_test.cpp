// Whole scenes through the C functions, beside our own renderer's light of the same scenes: the renderer
// draws the G-buffer, and the library knows no more of the scene than any host would tell it.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/gtc/packing.hpp>
#include <nlohmann/json.hpp>

#include "engine/core/image_difference.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/renderer.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/mip_chain.h"
#include "engine/scene/static_scene.h"
#include "tests/guest/guest_host.h"
#include "tools/scenegen/scenes.h"

namespace ag::test {
namespace {

struct HostVertex {
    glm::vec3 position, normal;
    glm::vec2 uv;
};

float linearOf(uint8_t srgb) {
    const float x = float(srgb) / 255;
    return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

template <class T>
void copy3(T (&to)[3], const glm::vec<3, T>& from) {
    for (int i = 0; i < 3; ++i)
        to[i] = from[i];
}

// A scene of ours as a host would hold it.
class HostScene {
  public:
    explicit HostScene(const RenderScene& scene) : scene_(scene), geometry_(*scene.geometry) {
        for (const Primitive& p : geometry_.primitives)
            appendPrimitive(p);
        vertexBuffer_ =
            gpu::loadBuffer(device(), {.name = "host.vertices", .vertexOrIndex = true}, vertices_);
        indexBuffer_ = gpu::loadBuffer(device(), {.name = "host.indices", .vertexOrIndex = true}, indices_);
    }

    void tell(AgiScene to) {
        uint32_t first = 0;
        for (const Material& m : geometry_.materials) {
            const AgiMaterial material = materialOf(m);
            ASSERT_EQ(agiAddMaterials(to, 1, &material, &first), AGI_OK) << agiLastError();
        }
        for (size_t p = 0; p < geometry_.primitives.size(); ++p) {
            const AgiMesh mesh = meshOf(p);
            ASSERT_EQ(agiAddMeshes(to, 1, &mesh, &first), AGI_OK) << agiLastError();
        }
        std::vector<AgiInstance> instances;
        for (const RenderInstance& i : scene_.instances) {
            const Material& m = geometry_.materials[geometry_.primitives[i.primitive].material];
            if (m.alphaMode == AlphaMode::kBlend) continue;  // neither blocks light nor reflects it
            AgiInstance instance{AGI_INIT(AgiInstance)};
            instance.id = instances.size();
            instance.mesh = i.primitive;
            instance.movable = i.movable;
            copy3(instance.position, glm::dvec3(i.worldFromLocal[3]) + scene_.originWorld);
            for (int k = 0; k < 9; ++k)
                instance.linear[k] = i.worldFromLocal[k / 3][k % 3];
            instances.push_back(instance);
        }
        ASSERT_EQ(agiSetInstances(to, uint32_t(instances.size()), instances.data()), AGI_OK)
            << agiLastError();
        std::vector<AgiLight> lights;
        for (const RenderLight& l : scene_.lights)
            if (l.bounces) lights.push_back(lightOf(l));
        ASSERT_EQ(agiSetLights(to, uint32_t(lights.size()), lights.data()), AGI_OK) << agiLastError();
        if (!scene_.sky) return;
        AgiSky sky{AGI_INIT(AgiSky)};
        sky.width = uint32_t(scene_.sky->radiance.width);
        sky.height = uint32_t(scene_.sky->radiance.height);
        sky.radiance = &scene_.sky->radiance.pixels[0].x;
        ASSERT_EQ(agiSetSky(to, &sky), AGI_OK) << agiLastError();
    }

  private:
    struct Range {
        uint32_t firstVertex = 0, vertexCount = 0, firstIndex = 0, indexCount = 0, material = 0;
    };

    // Vertices of its own, with the material's transform of texture coordinates in them.
    void appendPrimitive(const Primitive& p) {
        const auto indices = std::span(geometry_.indices).subspan(p.firstIndex, p.indexCount);
        const auto [least, most] = std::ranges::minmax(indices);
        ranges_.push_back({uint32_t(vertices_.size()), most - least + 1, uint32_t(indices_.size()),
                           p.indexCount, p.material});
        const glm::mat3x2& uv = geometry_.materials[p.material].uvTransform;
        for (uint32_t i = least; i <= most; ++i) {
            const size_t vertex = size_t(int64_t(i) + p.vertexOffset);
            const VertexAttributes& a = geometry_.attributes[vertex];
            vertices_.push_back({geometry_.positions[vertex], a.normal, uv * glm::vec3(a.uv, 1)});
        }
        for (const uint32_t i : indices)
            indices_.push_back(i - least);
    }

    float meanMetallic(const Material& m) const {
        if (m.metallicRoughnessLayer < 0) return m.metallic;
        const auto& texels =
            geometry_.textures[size_t(m.textureClass)].linear[size_t(m.metallicRoughnessLayer)];
        double sum = 0;
        for (size_t t = 2; t < texels.size(); t += 4)
            sum += texels[t];
        return m.metallic * float(sum / (255.0 * double(texels.size() / 4)));
    }

    AgiMaterial materialOf(const Material& m) {
        AgiMaterial out{AGI_INIT(AgiMaterial)};
        copy3(out.albedo, glm::vec3(m.baseColor) * (1 - meanMetallic(m)));
        out.doubleSided = m.doubleSided;
        copy3(out.emissive, m.emissive);
        if (m.baseColorLayer < 0) return out;
        const std::vector<uint8_t>& texels =
            geometry_.textures[size_t(m.textureClass)].srgb[size_t(m.baseColorLayer)];
        const uint32_t size = textureClassSize(m.textureClass);
        maps_.push_back(
            std::make_unique<gpu::Image>(device(), gpu::ImageDesc{.name = "host.albedo",
                                                                  .format = VK_FORMAT_R8G8B8A8_SRGB,
                                                                  .size = glm::uvec2(size),
                                                                  .mips = mipCount(size)}));
        const std::vector<uint8_t> mips = mipChain(texels, size, TexelCodes::kSrgb);
        gpu::uploadImage(device(), *maps_.back(), 0, std::as_bytes(std::span(mips)));
        out.albedoMap = maps_.back()->view();
        glm::dvec3 sum(0);
        size_t covered = 0;
        const bool cutOut = m.alphaMode == AlphaMode::kMask;
        for (size_t t = 0; t < texels.size(); t += 4) {
            if (cutOut && float(texels[t + 3]) / 255 < m.alphaCutoff) continue;
            sum += glm::dvec3(linearOf(texels[t]), linearOf(texels[t + 1]), linearOf(texels[t + 2]));
            ++covered;
        }
        copy3(out.albedoMapMean, glm::vec3(sum / double(std::max<size_t>(covered, 1))));
        out.alphaCutoff = cutOut ? m.alphaCutoff : 0;
        out.coverage = float(covered) / float(texels.size() / 4);
        return out;
    }

    AgiMesh meshOf(size_t primitive) const {
        const Range& r = ranges_[primitive];
        AgiMesh mesh{AGI_INIT(AgiMesh)};
        mesh.vertexBuffer = vertexBuffer_->handle();
        mesh.indexBuffer = indexBuffer_->handle();
        const VkDeviceSize from = r.firstVertex * sizeof(HostVertex);
        mesh.positionOffset = from + offsetof(HostVertex, position);
        mesh.normalOffset = from + offsetof(HostVertex, normal);
        mesh.uvOffset = from + offsetof(HostVertex, uv);
        mesh.positionStride = mesh.normalStride = mesh.uvStride = sizeof(HostVertex);
        mesh.indexOffset = r.firstIndex * sizeof(uint32_t);
        mesh.vertexCount = r.vertexCount;
        mesh.indexCount = r.indexCount;
        mesh.indexType = VK_INDEX_TYPE_UINT32;
        mesh.material = r.material;
        mesh.positions = &vertices_[r.firstVertex].position;
        mesh.normals = &vertices_[r.firstVertex].normal;
        mesh.uvs = &vertices_[r.firstVertex].uv;
        mesh.indices = &indices_[r.firstIndex];
        return mesh;
    }

    AgiLight lightOf(const RenderLight& l) const {
        AgiLight light{AGI_INIT(AgiLight)};
        light.id = l.id;
        light.kind = AgiLightKind(l.kind);
        copy3(light.position, glm::dvec3(l.position) + scene_.originWorld);
        copy3(light.direction, l.direction);
        copy3(light.intensity, l.intensity);
        light.range = l.range;
        light.innerAngle = l.innerConeAngle;
        light.outerAngle = l.outerConeAngle;
        light.budgetShare = l.budgetShare;
        light.mapSize = l.rsmResolution;
        return light;
    }

    const RenderScene& scene_;
    const GeometryArrays& geometry_;
    std::vector<Range> ranges_;
    std::vector<HostVertex> vertices_;
    std::vector<uint32_t> indices_;
    std::unique_ptr<gpu::Buffer> vertexBuffer_, indexBuffer_;
    std::vector<std::unique_ptr<gpu::Image>> maps_;
};

constexpr glm::uvec2 kSize{80, 45};
constexpr int kSceneFrames = 32, kSharedFrames = 16;  // rays are cast at rest, from the second on

// The library's light over the renderer's, as the camera sees both: all but what comes straight from suns and
// lamps.
ImageDifference compare(const RenderScene& scene, int frames) {
    render::Renderer renderer(device());
    renderer.load(*scene.geometry);
    render::RenderSettings settings;
    settings.bounce.laterBounces.enabled = true;
    settings.shadowMaps.rays = false;  // direct light is the same in both layers
    const auto layer = [&](render::Layer of, uint32_t count) {
        return render::renderLayer(renderer, scene, kSize, render::settingsOf(of, settings), of, count);
    };
    Image expected = layer(render::Layer::kIrradiance, uint32_t(frames));
    const Image direct = layer(render::Layer::kDirect, 2);
    for (size_t i = 0; i < expected.pixels.size(); ++i)
        expected.pixels[i] -= direct.pixels[i];
    const HostCamera camera(scene.camera, scene.originWorld, layer(render::Layer::kDepth, 1),
                            layer(render::Layer::kNormal, 1));
    HostScene host(scene);
    Guest guest;
    host.tell(guest.scene);
    guest.drawFrames(frames, guest.addView(camera, "medium"), camera);
    Image light = expected;
    light.pixels = camera.irradiance();
    return *compareImages(expected, light);
}

// A sun, movable things, a sky; and signs close to walls, which rays of another seed light otherwise: nearly
// all of that difference is on a few pixels, which the trimmed error leaves out.
TEST(SceneGuest, TheLibrarysLightIsTheRenderers) {
    for (const auto& [name, most] :
         {std::pair("corridor", 0.1), {"hall", 0.1}, {"courtyard", 0.06}, {"neon", 0.2}}) {
        const SceneAsset asset = *scenegen::buildScene(name, 0);
        RenderScene scene = staticScene(asset);
        setCamera(scene, cameraOf(asset, 0), kSize);
        const ImageDifference c = compare(scene, kSceneFrames);
        std::printf("%s: mean ratio %.4f, relative RMSE %.3f, trimmed %.3f\n", name, c.meanRatio,
                    c.relativeRmse, c.trimmedRelativeRmse);
        EXPECT_NEAR(c.meanRatio, 1, 0.05) << name;
        EXPECT_LT(c.trimmedRelativeRmse, most) << name;
    }
}

glm::vec3 vec3Of(const nlohmann::json& j) {
    return {j.at(0).get<float>(), j.at(1).get<float>(), j.at(2).get<float>()};
}

TEST(SceneGuest, AlsoInSharedScenes) {
    const std::array<std::string, 2> litByASun{"sponza/Sponza.gltf", "living_room/living_room.glb"};
    const std::filesystem::path shared = std::filesystem::path(AFTERGLOW_SOURCE_DIR) / "../shared/scenes";
    if (!exists(shared)) GTEST_SKIP() << "the scenes are not part of the repository";
    std::ifstream list(shared / "scenes.json");
    const nlohmann::json listed = nlohmann::json::parse(list);
    int compared = 0;
    for (const nlohmann::json& entry : listed.at("scenes")) {
        const std::string file = entry.at("file");
        if (std::ranges::find(litByASun, file) == litByASun.end()) continue;
        const auto asset = importGltf((shared / file).string());
        ASSERT_TRUE(asset) << asset.error().message;
        RenderScene scene = staticScene(*asset);
        scene.lights.push_back({.kind = LightKind::kDirectional,
                                .direction = glm::normalize(vec3Of(entry.at("sun_direction"))),
                                .intensity = glm::vec3(10),
                                .bounces = true,
                                .id = 1});
        const glm::vec3 from = vec3Of(entry.at("views").at(0).at("position"));
        const glm::vec3 to = vec3Of(entry.at("views").at(0).at("target"));
        setCamera(scene, {.position = from, .forward = glm::normalize(to - from)}, kSize);
        const ImageDifference c = compare(scene, kSharedFrames);
        std::printf("%s: mean ratio %.4f, relative RMSE %.3f\n", file.c_str(), c.meanRatio, c.relativeRmse);
        EXPECT_NEAR(c.meanRatio, 1, 0.1) << file;
        ++compared;
    }
    EXPECT_EQ(compared, std::ssize(litByASun));
}

}  // namespace
}  // namespace ag::test
