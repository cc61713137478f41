// Materials, and their textures resampled to square classes of array layers.
#include <fmt/format.h>
#include <stb/stb_image_resize.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const char* name) {
    const auto found = extensions.find(name);
    return found == extensions.end() ? nullptr : &found->second;
}

double element(const tinygltf::Value& object, const char* key, size_t i, double fallback) {
    if (!object.IsObject() || !object.Has(key) || !object.Get(key).IsArray() ||
        object.Get(key).ArrayLen() <= i)
        return fallback;
    const tinygltf::Value& value = object.Get(key).Get(int(i));
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

// KHR_materials_specular and _ior: reflectance head on over that of an index of 1.5.
float specularOf(const tinygltf::ExtensionMap& extensions) {
    constexpr double kUsual = 0.04;
    constexpr float kMost = float(1 / kUsual);
    double specular = 1;
    if (const tinygltf::Value* e = extensionOf(extensions, "KHR_materials_specular")) {
        double colour = 0;
        for (size_t c = 0; c < 3; ++c)
            colour += element(*e, "specularColorFactor", c, 1) / 3;
        specular = numberOf(*e, "specularFactor", 1) * colour;
    }
    if (const tinygltf::Value* e = extensionOf(extensions, "KHR_materials_ior")) {
        const double ior = numberOf(*e, "ior", 1.5), root = (ior - 1) / (ior + 1);
        if (ior >= 1) specular *= root * root / kUsual;
    }
    return std::clamp(floatOf(specular), 0.0f, kMost);
}

float transmissionOf(const tinygltf::Material& m) {
    const tinygltf::Value* e = extensionOf(m.extensions, "KHR_materials_transmission");
    return e ? std::clamp(floatOf(*e, "transmissionFactor", 0), 0.0f, 1.0f) : 0.0f;
}

bool isGlass(const tinygltf::Material& m) {
    return transmissionOf(m) > 0.5f;
}

// Whether most of what an image shows at all covers in part, as a lens does and a leaf does not. `alpha`:
// what its own is multiplied by.
bool coversInPart(const tinygltf::Image& image, float alpha) {
    constexpr float kNothing = 0.03f, kAll = 0.9f;
    if (image.component % 2 == 1) return alpha < kAll;
    const size_t bytes = size_t(std::max(image.bits, 8) / 8), texel = bytes * size_t(image.component);
    size_t seen = 0, inPart = 0;
    for (size_t at = texel - 1; at < image.image.size(); at += texel) {  // the high byte of 16-bit texels
        const float covers = alpha * float(image.image[at]) / 255;
        seen += covers > kNothing, inPart += covers > kNothing && covers < kAll;
    }
    return 2 * inPart > seen;
}

// What blends by a texture is mostly leaves and decals, and is drawn where that covers more than half of it:
// so it blocks light and reflects it on. What covers in part is drawn over what is behind it, and light
// passes.
AlphaMode alphaModeOf(const tinygltf::Model& model, const tinygltf::Material& m, float alpha) {
    if (isGlass(m)) return AlphaMode::kBlend;
    if (m.alphaMode == "MASK") return AlphaMode::kMask;
    if (m.alphaMode != "BLEND") return AlphaMode::kOpaque;
    const int image = imageOf(model, m.pbrMetallicRoughness.baseColorTexture.index);
    if (image < 0) return alpha < 1 ? AlphaMode::kBlend : AlphaMode::kOpaque;
    return coversInPart(model.images[size_t(image)], alpha) ? AlphaMode::kBlend : AlphaMode::kMask;
}

// KHR_materials_unlit: the base colour is what is seen, whatever the light: it is emitted, and nothing
// reflected.
void makeUnlit(Material& m) {
    m.unlit = true;
    m.emissive = glm::vec3(m.baseColor);
    m.emissiveLayer = m.baseColorLayer;
    m.baseColor = glm::vec4(0, 0, 0, m.baseColor.w);
    m.metallic = m.specular = 0;
    m.roughness = 1;
}

bool isUnlit(const tinygltf::Material& m) {
    return m.extensions.contains("KHR_materials_unlit");
}

// KHR_texture_transform: scale, then rotate, then move.
glm::mat3x2 uvTransformOf(const tinygltf::ExtensionMap& extensions) {
    glm::mat3x2 m(1, 0, 0, 1, 0, 0);
    const tinygltf::Value* t = extensionOf(extensions, "KHR_texture_transform");
    if (!t) return m;
    const float angle = floatOf(*t, "rotation", 0);
    const glm::vec2 scale(floatOf(element(*t, "scale", 0, 1)), floatOf(element(*t, "scale", 1, 1)));
    m[0] = glm::vec2(std::cos(angle), -std::sin(angle)) * scale.x;
    m[1] = glm::vec2(std::sin(angle), std::cos(angle)) * scale.y;
    m[2] = {floatOf(element(*t, "offset", 0, 0)), floatOf(element(*t, "offset", 1, 0))};
    return m;
}

Material materialOf(const tinygltf::Model& model, const tinygltf::Material& m) {
    Material out;
    out.name = m.name;
    const auto& pbr = m.pbrMetallicRoughness;
    for (int c = 0; c < 4 && size_t(c) < pbr.baseColorFactor.size(); ++c)
        out.baseColor[c] = std::clamp(float(pbr.baseColorFactor[size_t(c)]), 0.0f, 1.0f);
    out.metallic = std::clamp(float(pbr.metallicFactor), 0.0f, 1.0f);
    out.roughness = std::clamp(float(pbr.roughnessFactor), 0.0f, 1.0f);
    float strength = 1;
    if (const tinygltf::Value* e = extensionOf(m.extensions, "KHR_materials_emissive_strength"))
        strength = std::max(floatOf(*e, "emissiveStrength", 1), 0.0f);
    for (int c = 0; c < 3 && size_t(c) < m.emissiveFactor.size(); ++c)
        out.emissive[c] = std::max(floatOf(m.emissiveFactor[size_t(c)]), 0.0f) * strength;
    out.specular = specularOf(m.extensions);
    out.normalScale = floatOf(m.normalTexture.scale);
    out.alphaMode = alphaModeOf(model, m, out.baseColor.w);
    if (out.alphaMode == AlphaMode::kBlend) out.transmission = transmissionOf(m);
    out.coversWholly = isGlass(m) && m.alphaMode == "OPAQUE";
    out.alphaCutoff = m.alphaMode == "BLEND" ? 0.5f : floatOf(m.alphaCutoff);
    out.doubleSided = m.doubleSided;
    out.uvTransform = uvTransformOf(pbr.baseColorTexture.extensions);
    return out;
}

TextureClass classFor(int side) {
    if (side <= 256) return TextureClass::k256;
    if (side <= 512) return TextureClass::k512;
    return side <= 1024 ? TextureClass::k1024 : TextureClass::k2048;
}

std::vector<uint8_t> toRgba(const tinygltf::Image& image) {
    const size_t texels = size_t(image.width) * size_t(image.height);
    const size_t bytes = size_t(std::max(image.bits, 8) / 8), components = size_t(image.component);
    std::vector<uint8_t> out(texels * 4, 255);
    for (size_t i = 0; i < texels; ++i) {
        for (size_t c = 0; c < components; ++c)  // the high byte of 16-bit texels
            out[i * 4 + c] = image.image[(i * components + c) * bytes + bytes - 1];
        if (components <= 2) {  // grey, perhaps with alpha
            if (components == 2) out[i * 4 + 3] = out[i * 4 + 1];
            out[i * 4 + 1] = out[i * 4 + 2] = out[i * 4];
        }
    }
    return out;
}

enum class TexelsOf { kColors, kNumbers, kNormals };  // kColors: sRGB

std::vector<uint8_t> resample(const tinygltf::Image& image, int side, TexelsOf what) {
    std::vector<uint8_t> source = toRgba(image);
    if (image.width == side && image.height == side) return source;
    std::vector<uint8_t> out(size_t(side) * size_t(side) * 4);
    stbir_resize_uint8_generic(source.data(), image.width, image.height, 0, out.data(), side, side, 0, 4, 3,
                               0, STBIR_EDGE_WRAP, STBIR_FILTER_DEFAULT,
                               what == TexelsOf::kColors ? STBIR_COLORSPACE_SRGB : STBIR_COLORSPACE_LINEAR,
                               nullptr);
    return out;
}

// JPEG shortens normals by some percent. The length of a mean normal tells how bumpy a surface is, so that
// short ones would pass for bumps.
void makeUnitLength(std::vector<uint8_t>& normals) {
    for (size_t i = 0; i < normals.size(); i += 4) {
        const glm::vec3 n = glm::vec3(normals[i], normals[i + 1], normals[i + 2]) / 127.5f - 1.0f;
        const float length = glm::length(n);
        const glm::vec3 codes = ((length > 0 ? n / length : glm::vec3(0, 0, 1)) + 1.0f) * 127.5f + 0.5f;
        for (int c = 0; c < 3; ++c)
            normals[i + size_t(c)] = uint8_t(codes[c]);
    }
}

// Layers already made, by image, class and what their texels are.
class LayerMaker {
  public:
    LayerMaker(const tinygltf::Model& model, SceneAsset& asset, uint64_t texels)
        : model_(model), asset_(asset), texelsLeft_(texels) {}

    int32_t layer(int texture, TextureClass textureClass, TexelsOf what) {
        const int source = imageOf(model_, texture);
        if (source < 0) return -1;
        const auto [entry, added] = made_.try_emplace({source, textureClass, what}, -1);
        if (!added) return entry->second;
        const uint64_t side = textureClassSize(textureClass);
        if (side * side > texelsLeft_) {
            full_ = true;
            return -1;
        }
        texelsLeft_ -= side * side;
        TextureLayers& layers = asset_.geometry.textures[size_t(textureClass)];
        auto& list = what == TexelsOf::kColors ? layers.srgb : layers.linear;
        list.push_back(resample(model_.images[size_t(source)], int(side), what));
        if (what == TexelsOf::kNormals) makeUnitLength(list.back());
        return entry->second = int32_t(list.size() - 1);
    }

    bool full() const { return full_; }  // there was more than the limit

  private:
    const tinygltf::Model& model_;
    SceneAsset& asset_;
    uint64_t texelsLeft_;
    bool full_ = false;
    std::map<std::tuple<int, TextureClass, TexelsOf>, int32_t> made_;
};

}  // namespace

void skipImage(tinygltf::Image& image) {
    image.mimeType = "image/ktx2";
    image.image.clear();
}

bool isSkippedImage(const tinygltf::Image& image) {
    return image.mimeType == "image/ktx2" && image.image.empty();
}

int imageOf(const tinygltf::Model& model, int texture) {
    if (texture < 0) return -1;
    const tinygltf::Texture& t = model.textures[size_t(texture)];
    const auto webp = t.extensions.find("EXT_texture_webp");
    const int other = webp == t.extensions.end() ? -1 : int(numberOf(webp->second, "source", -1));
    for (const int image : {t.source, other})
        if (image >= 0 && !model.images[size_t(image)].image.empty()) return image;
    return -1;
}

void importMaterials(const tinygltf::Model& model, SceneAsset& asset) {
    for (const tinygltf::Material& m : model.materials)
        asset.geometry.materials.push_back(materialOf(model, m));
    asset.geometry.materials.push_back({.name = "default"});  // for primitives without one
}

Fault importTextures(const tinygltf::Model& model, SceneAsset& asset, const ImportLimits& limits) {
    LayerMaker maker(model, asset, limits.layerTexels);
    constexpr size_t kMostLayers = 2048;
    for (size_t i = 0; i < model.materials.size(); ++i) {
        const tinygltf::Material& m = model.materials[i];
        const int base = m.pbrMetallicRoughness.baseColorTexture.index,
                  rough = m.pbrMetallicRoughness.metallicRoughnessTexture.index,
                  normal = m.normalTexture.index, emissive = m.emissiveTexture.index;
        int side = 0;
        for (int texture : {base, rough, normal, emissive}) {
            const int source = imageOf(model, texture);
            if (source < 0) continue;
            const tinygltf::Image& image = model.images[size_t(source)];
            side = std::max({side, image.width, image.height});
        }
        Material& out = asset.geometry.materials[i];
        if (side == 0) {
            if (isUnlit(m)) makeUnlit(out);
            continue;
        }
        out.textureClass = classFor(side);
        out.baseColorLayer = maker.layer(base, out.textureClass, TexelsOf::kColors);
        out.emissiveLayer = maker.layer(emissive, out.textureClass, TexelsOf::kColors);
        out.normalLayer = maker.layer(normal, out.textureClass, TexelsOf::kNormals);
        out.metallicRoughnessLayer = maker.layer(rough, out.textureClass, TexelsOf::kNumbers);
        if (isUnlit(m)) makeUnlit(out);
        if (maker.full()) return "its textures together are larger than the limit";
    }
    for (const TextureLayers& layers : asset.geometry.textures)
        if (layers.srgb.size() > kMostLayers || layers.linear.size() > kMostLayers)
            return "it has more textures of one size than fit an array";
    return std::nullopt;
}

}  // namespace ag::gltf
