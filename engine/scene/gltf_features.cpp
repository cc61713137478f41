// What a file asks for, feature by feature, and what becomes of it: the report of `afterglow info`.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

using tinygltf::Material, tinygltf::Model, tinygltf::Primitive;

constexpr FeatureSupport kUsed = FeatureSupport::kUsed, kApproximated = FeatureSupport::kApproximated,
                         kNotSupported = FeatureSupport::kNotSupported;

struct Extension {
    std::string_view name;
    FeatureSupport support;
    std::string_view note;
};

constexpr std::array kExtensions = {
    Extension{"EXT_mesh_gpu_instancing", kUsed, ""},
    Extension{"EXT_meshopt_compression", kUsed, ""},
    Extension{"EXT_texture_webp", kUsed, ""},
    Extension{"KHR_draco_mesh_compression", kUsed, ""},
    Extension{"KHR_lights_punctual", kUsed, ""},
    Extension{"KHR_materials_emissive_strength", kUsed, ""},
    Extension{"KHR_mesh_quantization", kUsed, ""},
    Extension{"KHR_node_visibility", kUsed, ""},
    Extension{"KHR_texture_transform", kUsed, ""},
    Extension{"EXT_lights_image_based", kApproximated,
              "the finest of its specular images are the sky; its irradiance follows from them; --sky takes "
              "its place"},
    Extension{"KHR_materials_ior", kApproximated,
              "right where light comes head-on; below 1.5 grazing light is reflected less than it should be"},
    Extension{"KHR_materials_specular", kApproximated,
              "its colour by the mean of the factor's channels; its textures are not read"},
    Extension{
        "KHR_materials_transmission", kApproximated,
        "above one half the surface is a thin sheet of clear glass that blocks no light, below it is opaque"},
    Extension{"KHR_materials_unlit", kApproximated,
              "the colour is emitted as radiance, so that it also lights what is around it"},
    Extension{"KHR_materials_variants", kApproximated, "the variant that the file names first is shown"},
    Extension{"KHR_texture_basisu", kApproximated,
              "a texture's PNG or JPEG is shown; a texture that has none is left out"},
    Extension{"KHR_animation_pointer", kNotSupported, "what it animates rests"},
    Extension{"KHR_materials_anisotropy", kNotSupported, "highlights are round"},
    Extension{"KHR_materials_clearcoat", kNotSupported, "the coat's highlight is missing"},
    Extension{"KHR_materials_diffuse_transmission", kNotSupported, "no light comes through the surface"},
    Extension{"KHR_materials_dispersion", kNotSupported, "colours are not split"},
    Extension{"KHR_materials_iridescence", kNotSupported, "colours do not change with the angle"},
    Extension{"KHR_materials_pbrSpecularGlossiness", kNotSupported,
              "the metallic-roughness values beside it are used"},
    Extension{"KHR_materials_sheen", kNotSupported, "the velvet rim is missing"},
    Extension{"KHR_materials_volume", kNotSupported, "light passes without being absorbed"},
    Extension{"KHR_xmp_json_ld", kNotSupported, "the picture does not depend on it"},
};

template <class F>
uint64_t countPrimitives(const Model& model, F&& holds) {
    uint64_t count = 0;
    for (const tinygltf::Mesh& mesh : model.meshes)
        count += uint64_t(std::ranges::count_if(mesh.primitives, holds));
    return count;
}

template <class F>
uint64_t countMaterials(const Model& model, F&& holds) {
    return uint64_t(std::ranges::count_if(model.materials, holds));
}

template <class F>
void forEachTexture(const Material& m, F&& use) {
    use(m.pbrMetallicRoughness.baseColorTexture);
    use(m.pbrMetallicRoughness.metallicRoughnessTexture);
    use(m.normalTexture);
    use(m.emissiveTexture);
}

// How many parts of the file ask for each extension; the file itself counts where no part does.
std::map<std::string, uint64_t> extensionUses(const Model& model) {
    std::map<std::string, uint64_t> uses;
    const auto count = [&](const auto& part) {
        for (const auto& [name, value] : part.extensions)
            ++uses[name];
    };
    const auto countAll = [&](const auto& parts) { std::ranges::for_each(parts, count); };
    countAll(model.materials), countAll(model.nodes), countAll(model.meshes);
    countAll(model.textures), countAll(model.bufferViews), countAll(model.scenes);
    for (const tinygltf::Mesh& mesh : model.meshes)
        countAll(mesh.primitives);
    for (const Material& m : model.materials)
        forEachTexture(m, count);
    for (const auto& [name, value] : model.extensions)
        uses.try_emplace(name, 1);
    return uses;
}

bool hasAttribute(const Primitive& p, const char* name) {
    return p.attributes.contains(name);
}

bool isStrip(const Primitive& p) {
    return p.mode == TINYGLTF_MODE_TRIANGLE_STRIP || p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

bool isPointOrLine(const Primitive& p) {
    return p.mode >= TINYGLTF_MODE_POINTS && p.mode <= TINYGLTF_MODE_LINE_STRIP;
}

// Whether a texture is scaled, turned or moved otherwise than that of the base colour, which all follow.
bool movesTexturesApart(const Material& m) {
    constexpr char kTransform[] = "KHR_texture_transform";
    const tinygltf::TextureInfo& base = m.pbrMetallicRoughness.baseColorTexture;
    const auto of = [&](const auto& texture) {
        const auto found = texture.extensions.find(kTransform);
        return found == texture.extensions.end() ? tinygltf::Value() : found->second;
    };
    bool apart = false;
    forEachTexture(
        m, [&](const auto& texture) { apart = apart || (texture.index >= 0 && !(of(texture) == of(base))); });
    return apart;
}

uint64_t countChannels(const Model& model, const std::string& path) {
    uint64_t count = 0;
    for (const tinygltf::Animation& a : model.animations)
        count += uint64_t(std::ranges::count(a.channels, path, &tinygltf::AnimationChannel::target_path));
    return count;
}

uint64_t countCameras(const Model& model, const std::string& type) {
    return uint64_t(std::ranges::count(model.cameras, type, &tinygltf::Camera::type));
}

uint64_t countSamplers(const Model& model, bool (*holds)(const tinygltf::Sampler&)) {
    return uint64_t(std::ranges::count_if(model.samplers, holds));
}

bool wrapsOtherwise(const tinygltf::Sampler& s) {
    return s.wrapS != TINYGLTF_TEXTURE_WRAP_REPEAT || s.wrapT != TINYGLTF_TEXTURE_WRAP_REPEAT;
}

bool picksNearest(const tinygltf::Sampler& s) {
    return s.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
}

// What needs no extension.
std::vector<SceneFeature> coreFeatures(const Model& model) {
    const auto primitives = [&](auto&& holds) { return countPrimitives(model, holds); };
    const auto materials = [&](auto&& holds) { return countMaterials(model, holds); };
    const uint64_t scenes = model.scenes.size();
    return {
        {"strips and fans", primitives(isStrip)},
        {"points and lines", primitives(isPointOrLine), kNotSupported, "they are not drawn"},
        {"sparse accessors",
         uint64_t(std::ranges::count_if(model.accessors, [](const auto& a) { return a.sparse.isSparse; }))},
        {"vertex colours", primitives([](const Primitive& p) { return hasAttribute(p, "COLOR_0"); }),
         kApproximated, "without their alpha; what is emitted has the material's colour alone"},
        {"second texture coordinates", materials([](const Material& m) { return uvSetsOf(m).first > 0; })},
        {"textures of one material on different coordinates",
         materials([](const Material& m) { return uvSetsOf(m).second; }), kApproximated,
         "all follow its base colour"},
        {"textures of one material transformed differently", materials(movesTexturesApart), kApproximated,
         "all follow its base colour"},
        {"morph targets", primitives([](const Primitive& p) { return !p.targets.empty(); })},
        {"animated morph targets", countChannels(model, "weights"), kNotSupported,
         "they stay at the weights that the file begins with"},
        {"skins", model.skins.size()},
        {"more than four joints a vertex",
         primitives([](const Primitive& p) { return hasAttribute(p, "JOINTS_1"); }), kApproximated,
         "the strongest four are used"},
        {"animations", model.animations.size()},
        {"alpha masks", materials([](const Material& m) { return m.alphaMode == "MASK"; })},
        {"alpha blending", materials([](const Material& m) { return m.alphaMode == "BLEND"; }), kApproximated,
         "what a texture cuts out is drawn where it covers more than half; the rest over what is behind, "
         "and light passes"},
        {"occlusion textures", materials([](const Material& m) { return m.occlusionTexture.index >= 0; }),
         kNotSupported, "occlusion is found from the geometry"},
        {"samplers that clamp or mirror", countSamplers(model, wrapsOtherwise), kApproximated,
         "textures repeat"},
        {"samplers that pick the nearest texel", countSamplers(model, picksNearest), kApproximated,
         "texels are interpolated"},
        {"perspective cameras", countCameras(model, "perspective")},
        {"orthographic cameras", countCameras(model, "orthographic"), kApproximated,
         "seen in perspective from 500 heights of the picture away"},
        {"scenes beside the default", scenes > 1 ? scenes - 1 : 0, kNotSupported, "they are not shown"},
    };
}

const Extension* find(std::string_view name) {
    const auto found = std::ranges::find(kExtensions, name, &Extension::name);
    return found == kExtensions.end() ? nullptr : &*found;
}

}  // namespace

bool canRequire(std::string_view extension) {
    return find(extension) != nullptr;
}

std::vector<SceneFeature> featuresOf(const Model& model) {
    std::vector<SceneFeature> features = coreFeatures(model);
    std::erase_if(features, [](const SceneFeature& f) { return f.uses == 0; });
    const std::map<std::string, uint64_t> uses = extensionUses(model);
    for (const std::string& name : std::set(model.extensionsUsed.begin(), model.extensionsUsed.end())) {
        const Extension* known = find(name);
        const auto found = uses.find(name);
        features.push_back({name, found == uses.end() ? 0 : found->second,
                            known ? known->support : kNotSupported,
                            known ? std::string(known->note) : "what it describes is left out"});
    }
    return features;
}

}  // namespace ag::gltf
