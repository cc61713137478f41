// Materials and their textures on the device, and what passes want to know of all of them.
#include <algorithm>
#include <array>
#include <span>

#include "engine/core/hash.h"
#include "engine/gpu/transfer.h"
#include "engine/renderer/scene_gpu.h"
#include "engine/scene/mip_chain.h"

namespace ag::render {
namespace {

io::Material materialRow(const Material& m, RenderUnits units) {
    return {.baseColor = m.baseColor,
            .emissive = m.emissive / units.light,
            .alphaCutoff = m.alphaMode == AlphaMode::kMask ? m.alphaCutoff
                           : m.coversWholly                ? -1.0f
                                                           : 0.0f,
            .metallic = m.metallic,
            .roughness = m.roughness,
            .specular = m.specular,
            .normalScale = m.normalScale,
            .layers = {m.baseColorLayer, m.emissiveLayer, m.normalLayer, m.metallicRoughnessLayer},
            .uvRow0 = {m.uvTransform[0][0], m.uvTransform[1][0], m.uvTransform[2][0],
                       m.doubleSided ? 1.0f : 0.0f},
            .uvRow1 = {m.uvTransform[0][1], m.uvTransform[1][1], m.uvTransform[2][1], m.transmission}};
}

bool isGlossy(const Material& m) {
    return m.metallic > 0 || m.specular > 0;
}

uint8_t leastGreen(std::span<const uint8_t> texels) {
    uint8_t least = 255;
    for (size_t green = 1; green < texels.size(); green += 4)
        least = std::min(least, texels[green]);
    return least;
}

// A class without textures still needs something bound: one black texel.
std::unique_ptr<gpu::Image> loadLayers(gpu::Device& device, const char* name, VkFormat format, uint32_t size,
                                       const std::vector<std::vector<uint8_t>>& layers) {
    const uint32_t side = layers.empty() ? 1 : size;
    auto image = std::make_unique<gpu::Image>(
        device, gpu::ImageDesc{.name = name,
                               .format = format,
                               .size = {side, side},
                               .layers = std::max<uint32_t>(uint32_t(layers.size()), 1),
                               .mips = mipCount(side),
                               .array = true});
    const std::array<std::byte, 4> black{};
    if (layers.empty()) gpu::uploadImage(device, *image, 0, black);
    const TexelCodes codes = format == VK_FORMAT_R8G8B8A8_SRGB ? TexelCodes::kSrgb : TexelCodes::kLinear;
    for (uint32_t layer = 0; layer < layers.size(); ++layer) {
        const std::vector<uint8_t> mips = mipChain(layers[layer], side, codes);
        gpu::uploadImage(device, *image, layer, std::as_bytes(std::span(mips)));
    }
    return image;
}

}  // namespace

// Points on surfaces keep their albedo and emission, so they are chosen anew; trees when all is at rest.
void SceneGpu::changeMaterials(const GeometryArrays& geometry, RenderUnits units) {
    loadMaterials(geometry, units);
    points_.forget();
    geometryVersion_ = geometry.version;
}

void SceneGpu::useUnits(const GeometryArrays& geometry, RenderUnits units) {
    loadMaterials(geometry, units);
    lightUnit_ = units.light;
    instancesVersion_ = notedVersion_ = 0;
    points_.forget();
    trees_.forget();
}

void SceneGpu::loadMaterials(const GeometryArrays& geometry, RenderUnits units) {
    std::vector<io::Material> rows;
    strongestEmission_ = 0;
    hasGlossy_ = hasNormalMaps_ = false;
    leastRoughness_ = 1;
    for (const Material& m : geometry.materials) {
        rows.push_back(materialRow(m, units));
        strongestEmission_ = std::max({strongestEmission_, m.emissive.x, m.emissive.y, m.emissive.z});
        hasGlossy_ = hasGlossy_ || isGlossy(m);
        if (isGlossy(m)) leastRoughness_ = std::min(leastRoughness_, leastRoughnessOf(m));
        hasNormalMaps_ = hasNormalMaps_ || m.normalLayer >= 0;
    }
    materials_ = gpu::loadBuffer(device_, {.name = "scene.materials", .texelFormat = gpu::kVec4Texels}, rows);
    materialsVersion_ = combineHash(geometry.version, hashValue(units.light));
}

// Textures stay while factors of materials change.
void SceneGpu::noteTextures(const GeometryArrays& geometry) {
    for (uint32_t c = 0; c < kTextureClassCount; ++c)
        leastGreen_[c].assign(geometry.textures[c].linear.size(), std::nullopt);
    for (const Material& m : geometry.materials) {
        if (m.metallicRoughnessLayer < 0) continue;
        const size_t c = size_t(m.textureClass), layer = size_t(m.metallicRoughnessLayer);
        if (!leastGreen_[c][layer]) leastGreen_[c][layer] = leastGreen(geometry.textures[c].linear[layer]);
    }
}

// Of all texels where that is a texture's.
float SceneGpu::leastRoughnessOf(const Material& m) const {
    if (m.metallicRoughnessLayer < 0) return m.roughness;
    const auto& green = leastGreen_[size_t(m.textureClass)][size_t(m.metallicRoughnessLayer)];
    return m.roughness * float(green.value_or(0)) / 255;
}

void SceneGpu::loadTextures(const GeometryArrays& geometry) {
    for (uint32_t c = 1; c < kTextureClassCount; ++c) {
        const uint32_t size = textureClassSize(TextureClass(c));
        srgb_[c - 1] =
            loadLayers(device_, "scene.srgb", VK_FORMAT_R8G8B8A8_SRGB, size, geometry.textures[c].srgb);
        linear_[c - 1] =
            loadLayers(device_, "scene.linear", VK_FORMAT_R8G8B8A8_UNORM, size, geometry.textures[c].linear);
    }
}

}  // namespace ag::render
