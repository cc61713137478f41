#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

bool usesExtension(const tinygltf::Model& model, std::string_view name) {
    return std::ranges::find(model.extensionsUsed, name) != model.extensionsUsed.end();
}

template <class T>
bool inside(int index, const std::vector<T>& list) {
    return index >= 0 && size_t(index) < list.size();
}

template <class T>
bool insideOrNone(int index, const std::vector<T>& list) {
    return index == -1 || inside(index, list);
}

// Where elements lie in a buffer view, bytes.
struct ElementRange {
    uint64_t offset = 0;
    uint64_t stride = 0;   // from one to the next
    uint64_t count = 0;    // of them
    uint64_t element = 0;  // size of one
};

// Bytes [offset, offset + stride (count - 1) + element) must lie in the view.
Fault checkRange(const tinygltf::Model& model, int view, const ElementRange& range, const std::string& what) {
    const auto& [offset, stride, count, element] = range;
    if (!inside(view, model.bufferViews))
        return fmt::format("{} names buffer view {}, which does not exist", what, view);
    if (count == 0) return std::nullopt;
    const uint64_t length = model.bufferViews[size_t(view)].byteLength;
    const bool fits = offset <= length && element <= length - offset &&
                      (stride == 0 || count - 1 <= (length - offset - element) / stride);
    if (!fits) return fmt::format("{} reaches past the end of buffer view {}", what, view);
    return std::nullopt;
}

Fault checkViews(const tinygltf::Model& model) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        const tinygltf::BufferView& v = model.bufferViews[i];
        if (!inside(v.buffer, model.buffers))
            return fmt::format("buffer view {} names buffer {}, which does not exist", i, v.buffer);
        const uint64_t size = model.buffers[size_t(v.buffer)].data.size();
        if (v.byteOffset > size || v.byteLength > size - v.byteOffset)
            return fmt::format("buffer view {} reaches past the end of buffer {}", i, v.buffer);
    }
    return std::nullopt;
}

Fault checkSparse(const tinygltf::Model& model, const tinygltf::Accessor& a, uint64_t element,
                  const std::string& what) {
    const auto& sparse = a.sparse;
    if (sparse.count < 0 || uint64_t(sparse.count) > a.count)
        return what + " has more sparse values than elements";
    const int indexSize = tinygltf::GetComponentSizeInBytes(uint32_t(sparse.indices.componentType));
    if (indexSize <= 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        return what + " has a bad sparse index type or offset";
    const uint64_t count = uint64_t(sparse.count);
    if (Fault f = checkRange(model, sparse.indices.bufferView,
                             {.offset = uint64_t(sparse.indices.byteOffset),
                              .stride = uint64_t(indexSize),
                              .count = count,
                              .element = uint64_t(indexSize)},
                             what + " (sparse indices)"))
        return f;
    if (Fault f = checkRange(model, sparse.values.bufferView,
                             {.offset = uint64_t(sparse.values.byteOffset),
                              .stride = element,
                              .count = count,
                              .element = element},
                             what + " (sparse values)"))
        return f;
    const std::vector<uint32_t> rows = sparseRows(model, a);
    const auto beyond = std::ranges::find_if(rows, [&](uint32_t row) { return row >= a.count; });
    if (beyond != rows.end())
        return fmt::format("{} has a sparse value for element {} of {}", what, *beyond, a.count);
    return std::nullopt;
}

Fault checkAccessors(const tinygltf::Model& model, const ImportLimits& limits) {
    for (size_t i = 0; i < model.accessors.size(); ++i) {
        const tinygltf::Accessor& a = model.accessors[i];
        const std::string what = fmt::format("accessor {}", i);
        const int component = tinygltf::GetComponentSizeInBytes(uint32_t(a.componentType));
        const int components = tinygltf::GetNumComponentsInType(uint32_t(a.type));
        if (component <= 0 || components <= 0) return what + " has an unknown component or element type";
        if (a.count > limits.indices)
            return fmt::format("{} holds {} elements, more than the limit", what, a.count);
        const uint64_t element = uint64_t(component) * uint64_t(components);
        if (a.sparse.isSparse)
            if (Fault f = checkSparse(model, a, element, what)) return f;
        if (a.bufferView == -1 && a.count > limits.zeroElements)
            return fmt::format("{} holds {} elements without data, more than the limit", what, a.count);
        if (a.bufferView == -1) continue;  // zeroes, perhaps with sparse values
        if (!inside(a.bufferView, model.bufferViews))
            return fmt::format("{} names buffer view {}, which does not exist", what, a.bufferView);
        const uint64_t given = model.bufferViews[size_t(a.bufferView)].byteStride;
        if (given != 0 && given < element) return what + " has a stride smaller than its elements";
        if (Fault f = checkRange(model, a.bufferView,
                                 {.offset = a.byteOffset,
                                  .stride = given ? given : element,
                                  .count = a.count,
                                  .element = element},
                                 what))
            return f;
    }
    return std::nullopt;
}

// Morph targets add three numbers a vertex.
Fault checkTargets(const tinygltf::Model& model, const tinygltf::Primitive& p, uint64_t vertices,
                   const std::string& what) {
    for (const auto& target : p.targets)
        for (const auto& [name, index] : target) {
            if (!inside(index, model.accessors))
                return fmt::format("{} names accessor {} for a morph target, which does not exist", what,
                                   index);
            const tinygltf::Accessor& a = model.accessors[size_t(index)];
            if (a.count != vertices) return what + " has a morph target of another length than its positions";
        }
    return std::nullopt;
}

Fault checkPrimitive(const tinygltf::Model& model, const tinygltf::Primitive& p, bool quantized,
                     const std::string& what) {
    if (!insideOrNone(p.indices, model.accessors))
        return fmt::format("{} names accessor {}, which does not exist", what, p.indices);
    if (!insideOrNone(p.material, model.materials))
        return fmt::format("{} names material {}, which does not exist", what, p.material);
    uint64_t vertices = 0;
    bool first = true;
    for (const auto& [name, index] : p.attributes) {
        if (!inside(index, model.accessors))
            return fmt::format("{} names accessor {} for {}, which does not exist", what, index, name);
        const tinygltf::Accessor& a = model.accessors[size_t(index)];
        if (!first && a.count != vertices) return what + " has attributes of different lengths";
        vertices = a.count;
        first = false;
    }
    const auto position = p.attributes.find("POSITION");
    if (position == p.attributes.end()) return what + " has no positions";
    const tinygltf::Accessor& a = model.accessors[size_t(position->second)];
    if (a.type != TINYGLTF_TYPE_VEC3 || (a.componentType != TINYGLTF_COMPONENT_TYPE_FLOAT && !quantized))
        return what + " has positions that are not three floats";
    if (Fault f = checkTargets(model, p, a.count, what)) return f;
    if (p.indices < 0) return std::nullopt;
    const tinygltf::Accessor& i = model.accessors[size_t(p.indices)];
    const bool whole = i.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                       i.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                       i.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (i.type != TINYGLTF_TYPE_SCALAR || !whole)
        return what + " has indices that are not unsigned whole numbers";
    return std::nullopt;
}

// Summed up before anything is read: primitives may share an accessor, so that a small file asks for much.
Fault checkMeshes(const tinygltf::Model& model, const ImportLimits& limits) {
    uint64_t vertices = 0, indices = 0, moved = 0;  // by morph targets
    const bool quantized = usesExtension(model, "KHR_mesh_quantization");
    // Of each mesh: one, and one a node that bends its own.
    std::vector<uint64_t> copies(model.meshes.size(), 1);
    for (const tinygltf::Node& n : model.nodes)
        if (inside(n.mesh, model.meshes)) copies[size_t(n.mesh)] += hasOwnMorph(model, n);
    for (size_t m = 0; m < model.meshes.size(); ++m)
        for (size_t i = 0; i < model.meshes[m].primitives.size(); ++i) {
            const tinygltf::Primitive& p = model.meshes[m].primitives[i];
            if (Fault f = checkPrimitive(model, p, quantized, fmt::format("mesh {} primitive {}", m, i)))
                return f;
            const uint64_t own = model.accessors[size_t(p.attributes.at("POSITION"))].count;
            const uint64_t named = p.indices < 0 ? own : model.accessors[size_t(p.indices)].count;
            const bool shared =
                p.mode == TINYGLTF_MODE_TRIANGLE_STRIP || p.mode == TINYGLTF_MODE_TRIANGLE_FAN;
            const uint64_t listed = shared ? 3 * named : named;
            indices += copies[m] * listed;
            // Flat: one a corner. An empty one is work, too.
            const uint64_t drawn = p.attributes.contains("NORMAL") ? own : std::max(own, listed);
            vertices += copies[m] * std::max<uint64_t>(drawn, 1);
            if (vertices > limits.vertices || indices > limits.indices)
                return "it has more vertices or indices than the limit";
            moved += copies[m] * own * p.targets.size();
            if (moved > limits.vertices) return "its morph targets move more vertices than the limit";
        }
    return std::nullopt;
}

Fault checkTexture(const tinygltf::Model& model, int texture, size_t material) {
    if (texture == -1) return std::nullopt;
    if (!inside(texture, model.textures))
        return fmt::format("material {} names texture {}, which does not exist", material, texture);
    const tinygltf::Texture& t = model.textures[size_t(texture)];
    const auto named = [&](const char* extension) {
        const auto found = t.extensions.find(extension);
        return found == t.extensions.end() ? -1.0 : numberOf(found->second, "source", -1);
    };
    bool any = false;
    for (const double source : {double(t.source), named("EXT_texture_webp"), named("KHR_texture_basisu")}) {
        if (source == -1) continue;
        if (!(source >= 0 && source < double(model.images.size())))
            return fmt::format("texture {} names image {}, which does not exist", texture, source);
        any = true;
    }
    if (!any) return fmt::format("texture {} names no image", texture);
    return std::nullopt;
}

Fault checkMaterials(const tinygltf::Model& model) {
    for (size_t i = 0; i < model.materials.size(); ++i) {
        const tinygltf::Material& m = model.materials[i];
        for (int texture : {m.pbrMetallicRoughness.baseColorTexture.index,
                            m.pbrMetallicRoughness.metallicRoughnessTexture.index, m.normalTexture.index,
                            m.emissiveTexture.index})
            if (Fault f = checkTexture(model, texture, i)) return f;
    }
    return std::nullopt;
}

Fault checkNodes(const tinygltf::Model& model, const ImportLimits& limits) {
    if (model.nodes.size() > limits.nodes)
        return fmt::format("it has {} nodes, more than the limit", model.nodes.size());
    std::vector<int> parent(model.nodes.size(), -1);
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const tinygltf::Node& n = model.nodes[i];
        if (!insideOrNone(n.mesh, model.meshes))
            return fmt::format("node {} names mesh {}, which does not exist", i, n.mesh);
        if (!insideOrNone(n.camera, model.cameras))
            return fmt::format("node {} names camera {}, which does not exist", i, n.camera);
        if (!insideOrNone(n.skin, model.skins))
            return fmt::format("node {} names skin {}, which does not exist", i, n.skin);
        const bool shape = (n.matrix.empty() || n.matrix.size() == 16) &&
                           (n.translation.empty() || n.translation.size() == 3) &&
                           (n.rotation.empty() || n.rotation.size() == 4) &&
                           (n.scale.empty() || n.scale.size() == 3);
        if (!shape) return fmt::format("node {} has a transform of the wrong length", i);
        for (const auto* list : {&n.matrix, &n.translation, &n.rotation, &n.scale})
            if (!std::ranges::all_of(*list, [](double v) { return std::isfinite(v) && std::abs(v) < 1e12; }))
                return fmt::format("node {} has a transform that is not finite", i);
        for (int child : n.children) {
            if (!inside(child, model.nodes))
                return fmt::format("node {} names child {}, which does not exist", i, child);
            if (parent[size_t(child)] != -1) return fmt::format("node {} has two parents", child);
            parent[size_t(child)] = int(i);
        }
    }
    for (size_t i = 0; i < parent.size(); ++i) {
        uint32_t depth = 0;
        for (int at = parent[i]; at != -1; at = parent[size_t(at)])
            if (++depth > limits.nodeDepth)
                return fmt::format("node {} lies in a cycle or deeper than {}", i, limits.nodeDepth);
    }
    for (size_t s = 0; s < model.scenes.size(); ++s)
        for (int node : model.scenes[s].nodes)
            if (!inside(node, model.nodes))
                return fmt::format("scene {} names node {}, which does not exist", s, node);
    if (!insideOrNone(model.defaultScene, model.scenes))
        return fmt::format("the default scene {} does not exist", model.defaultScene);
    return std::nullopt;
}

Fault checkLights(const tinygltf::Model& model) {
    for (size_t i = 0; i < model.nodes.size(); ++i) {
        const auto found = model.nodes[i].extensions.find("KHR_lights_punctual");
        if (found == model.nodes[i].extensions.end()) continue;
        const double light = numberOf(found->second, "light", -1);
        if (!(light >= 0 && light < double(model.lights.size())))
            return fmt::format("node {} names light {}, which does not exist", i, light);
    }
    for (size_t i = 0; i < model.lights.size(); ++i) {
        const tinygltf::Light& l = model.lights[i];
        const bool numbers =
            std::isfinite(l.intensity) && l.intensity >= 0 && std::isfinite(l.range) && l.range >= 0 &&
            (l.color.empty() || l.color.size() == 3) &&
            std::ranges::all_of(l.color, [](double c) { return std::isfinite(c) && c >= 0; });
        if (!numbers)
            return fmt::format("light {} has a negative or non-finite intensity, colour or range", i);
        if (l.type != "directional" && l.type != "point" && l.type != "spot")
            return fmt::format("light {} is of unknown type '{}'", i, l.type);
        if (l.type == "spot" &&
            !(l.spot.innerConeAngle >= 0 && l.spot.innerConeAngle <= l.spot.outerConeAngle &&
              l.spot.outerConeAngle <= 1.5707964))
            return fmt::format("light {} has impossible cone angles", i);
    }
    return std::nullopt;
}

Fault checkImages(const tinygltf::Model& model, const ImportLimits& limits) {
    uint64_t texels = 0;
    for (size_t i = 0; i < model.images.size(); ++i) {
        const tinygltf::Image& image = model.images[i];
        if (isSkippedImage(image)) continue;
        const std::string name =
            image.uri.empty() ? fmt::format("image {}", i) : fmt::format("image {} ({})", i, image.uri);
        if (image.width <= 0 || image.height <= 0 || image.image.empty())
            return name + " is missing or cannot be decoded";
        if (uint32_t(image.width) > limits.imageSide || uint32_t(image.height) > limits.imageSide)
            return name + " is larger than the limit";
        texels += uint64_t(image.width) * uint64_t(image.height);
        if (texels > limits.imageTexels) return "its images together are larger than the limit";
        if (image.component < 1 || image.component > 4 ||
            image.image.size() < uint64_t(image.width) * uint64_t(image.height) * uint64_t(image.component) *
                                     uint64_t(std::max(image.bits, 8) / 8))
            return name + " has fewer texels than its size says";
    }
    return std::nullopt;
}

}  // namespace

Fault validate(const tinygltf::Model& model, const ImportLimits& limits) {
    if (model.asset.version.rfind("2", 0) != 0)
        return fmt::format("its version is '{}', not 2.x", model.asset.version);
    for (const std::string& name : model.extensionsRequired)
        if (!canRequire(name))
            return fmt::format("it requires the extension {}, which is not supported", name);
    if (Fault f = checkViews(model)) return f;
    if (Fault f = checkAccessors(model, limits)) return f;
    if (Fault f = checkMeshes(model, limits)) return f;
    if (Fault f = checkMaterials(model)) return f;
    if (Fault f = checkNodes(model, limits)) return f;
    if (Fault f = checkSkins(model, limits)) return f;
    if (Fault f = checkAnimations(model, limits)) return f;
    if (Fault f = checkLights(model)) return f;
    return checkImages(model, limits);
}

}  // namespace ag::gltf
