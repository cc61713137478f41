// EXT_meshopt_compression and KHR_draco_mesh_compression: compressed bytes become plain buffers that the rest
// of the importer reads as any others.
#include <draco/compression/decode.h>
#include <draco/core/varint_decoding.h>
#include <draco/metadata/metadata_decoder.h>
#include <fmt/format.h>
#include <meshoptimizer.h>

#include <cstring>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

constexpr char kMeshopt[] = "EXT_meshopt_compression", kDraco[] = "KHR_draco_mesh_compression";

struct Bytes {
    const unsigned char* data = nullptr;
    size_t size = 0;
};

uint64_t wholeOf(const tinygltf::Value& object, const char* key) {
    const double number = numberOf(object, key, 0);
    return number >= 0 && number < 1e15 ? uint64_t(number) : 0;
}

std::string textOf(const tinygltf::Value& object, const char* key, const char* fallback) {
    return object.Has(key) && object.Get(key).IsString() ? object.Get(key).Get<std::string>() : fallback;
}

bool sliceOf(const tinygltf::Model& model, uint64_t buffer, uint64_t offset, uint64_t length, Bytes& out) {
    if (buffer >= model.buffers.size()) return false;
    const std::vector<unsigned char>& data = model.buffers[buffer].data;
    if (offset > data.size() || length > data.size() - offset) return false;
    out = {data.data() + offset, length};
    return true;
}

// A buffer of its own, seen by one view; returns the buffer's index.
int addBuffer(tinygltf::Model& model, std::vector<unsigned char> bytes) {
    model.buffers.emplace_back();
    model.buffers.back().data = std::move(bytes);
    return int(model.buffers.size() - 1);
}

int addView(tinygltf::Model& model, std::vector<unsigned char> bytes) {
    tinygltf::BufferView view;
    view.byteLength = bytes.size();
    view.buffer = addBuffer(model, std::move(bytes));
    model.bufferViews.push_back(view);
    return int(model.bufferViews.size() - 1);
}

struct MeshoptView {
    uint64_t count = 0, stride = 0;
    std::string mode, filter;
};

// The decoder asserts what a file may break.
bool shapeFits(const MeshoptView& v) {
    const bool attributes = v.mode == "ATTRIBUTES" && v.stride % 4 == 0 && v.stride > 0 && v.stride <= 256;
    const bool wholes = v.stride == 2 || v.stride == 4;
    if (attributes && v.filter == "OCTAHEDRAL") return v.stride == 4 || v.stride == 8;
    if (attributes && v.filter == "QUATERNION") return v.stride == 8;
    if (attributes) return v.filter == "NONE" || v.filter == "EXPONENTIAL";
    return wholes && v.filter == "NONE" &&
           ((v.mode == "TRIANGLES" && v.count % 3 == 0) || v.mode == "INDICES");
}

bool decodeMeshopt(const MeshoptView& v, Bytes from, unsigned char* out) {
    if (v.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out, v.count, v.stride, from.data, from.size) == 0;
    if (v.mode == "INDICES")
        return meshopt_decodeIndexSequence(out, v.count, v.stride, from.data, from.size) == 0;
    if (meshopt_decodeVertexBuffer(out, v.count, v.stride, from.data, from.size) != 0) return false;
    if (v.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out, v.count, v.stride);
    if (v.filter == "QUATERNION") meshopt_decodeFilterQuat(out, v.count, v.stride);
    if (v.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out, v.count, v.stride);
    return true;
}

Fault expandMeshoptViews(tinygltf::Model& model, uint64_t& bytesLeft) {
    for (size_t i = 0; i < model.bufferViews.size(); ++i) {
        const auto found = model.bufferViews[i].extensions.find(kMeshopt);
        if (found == model.bufferViews[i].extensions.end()) continue;
        const tinygltf::Value& e = found->second;
        const MeshoptView v{wholeOf(e, "count"), wholeOf(e, "byteStride"), textOf(e, "mode", ""),
                            textOf(e, "filter", "NONE")};
        Bytes from;
        if (!sliceOf(model, wholeOf(e, "buffer"), wholeOf(e, "byteOffset"), wholeOf(e, "byteLength"), from))
            return fmt::format("buffer view {}: its compressed bytes lie outside their buffer", i);
        if (!shapeFits(v))
            return fmt::format("buffer view {}: its compression has an impossible mode, filter or stride", i);
        if (v.count > bytesLeft / v.stride) return "what it compresses is larger than the limit";
        bytesLeft -= v.count * v.stride;
        std::vector<unsigned char> plain(v.count * v.stride);
        if (!decodeMeshopt(v, from, plain.data()))
            return fmt::format("buffer view {} cannot be decompressed", i);
        tinygltf::BufferView& view = model.bufferViews[i];
        view.byteOffset = 0;
        view.byteLength = plain.size();
        view.buffer = addBuffer(model, std::move(plain));
    }
    return std::nullopt;
}

template <class T>
bool storeAttribute(const draco::PointAttribute& from, uint32_t points, int components,
                    std::vector<unsigned char>& out) {
    const size_t element = sizeof(T) * size_t(components);
    out.resize(points * element);
    T values[16];
    for (uint32_t p = 0; p < points; ++p) {
        if (!from.ConvertValue<T>(from.mapped_index(draco::PointIndex(p)), int8_t(components), values))
            return false;
        std::memcpy(out.data() + p * element, values, element);
    }
    return true;
}

// In the type that the accessor promises.
bool storeAttribute(const draco::PointAttribute& from, uint32_t points, const tinygltf::Accessor& accessor,
                    std::vector<unsigned char>& out) {
    const int components = tinygltf::GetNumComponentsInType(uint32_t(accessor.type));
    if (components < 1 || components > 4) return false;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return storeAttribute<int8_t>(from, points, components, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return storeAttribute<uint8_t>(from, points, components, out);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return storeAttribute<int16_t>(from, points, components, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return storeAttribute<uint16_t>(from, points, components, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return storeAttribute<uint32_t>(from, points, components, out);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return storeAttribute<float>(from, points, components, out);
        default:
            return false;
    }
}

void pointAt(tinygltf::Model& model, tinygltf::Accessor& accessor, std::vector<unsigned char> bytes) {
    accessor.bufferView = addView(model, std::move(bytes));
    accessor.byteOffset = 0;
    accessor.sparse.isSparse = false;
}

std::vector<unsigned char> indicesOf(const draco::Mesh& mesh) {
    std::vector<uint32_t> indices;
    for (uint32_t f = 0; f < mesh.num_faces(); ++f)
        for (const draco::PointIndex& point : mesh.face(draco::FaceIndex(f)))
            indices.push_back(point.value());
    std::vector<unsigned char> bytes(indices.size() * sizeof(uint32_t));
    if (!bytes.empty()) std::memcpy(bytes.data(), indices.data(), bytes.size());
    return bytes;
}

struct MeshSize {
    uint64_t vertices = 0, indices = 0;
};

draco::DecoderBuffer bufferOf(Bytes from) {
    draco::DecoderBuffer buffer;
    buffer.Init(reinterpret_cast<const char*>(from.data), from.size);
    return buffer;
}

// What the compressed bytes say they hold, before anything is made of it (Draco bitstream 2.2, which the
// extension asks for). False: they are no such mesh.
bool readDracoSize(Bytes from, MeshSize& size) {
    constexpr unsigned char kBegin[] = {'D', 'R', 'A', 'C', 'O', 2, 2, draco::TRIANGULAR_MESH};
    constexpr size_t kMethodAt = sizeof kBegin, kFlagsAt = kMethodAt + 1, kHeader = kFlagsAt + 2;
    if (from.size < kHeader || std::memcmp(from.data, kBegin, sizeof kBegin) != 0) return false;
    draco::DecoderBuffer buffer = bufferOf(from);
    buffer.Advance(int64_t(kHeader));
    draco::GeometryMetadata ignored;
    const uint32_t flags = from.data[kFlagsAt] | uint32_t(from.data[kFlagsAt + 1]) << 8;
    if (flags & METADATA_FLAG_MASK && !draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &ignored))
        return false;
    const bool sequential = from.data[kMethodAt] == draco::MESH_SEQUENTIAL_ENCODING;
    if (!sequential) buffer.Advance(1);  // how edgebreaker's corners are visited
    uint32_t first = 0, second = 0;
    if (!draco::DecodeVarint(&first, &buffer) || !draco::DecodeVarint(&second, &buffer)) return false;
    const uint32_t faces = sequential ? first : second, vertices = sequential ? second : first;
    size = {vertices, uint64_t(faces) * 3};
    return true;
}

std::unique_ptr<draco::Mesh> decodeDraco(Bytes from) {
    draco::DecoderBuffer buffer = bufferOf(from);
    draco::Decoder decoder;
    auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
    return mesh.ok() ? std::move(mesh).value() : nullptr;
}

// The primitive's accessors, which have no data of their own, get what its mesh holds.
Fault fillAccessors(tinygltf::Model& model, const tinygltf::Primitive& p, const draco::Mesh& mesh,
                    const tinygltf::Value& attributes, const std::string& what) {
    const auto accessorAt = [&](int index) {
        return index >= 0 && size_t(index) < model.accessors.size() ? &model.accessors[size_t(index)]
                                                                    : nullptr;
    };
    for (const std::string& name : attributes.Keys()) {
        const auto found = p.attributes.find(name);
        tinygltf::Accessor* accessor = found == p.attributes.end() ? nullptr : accessorAt(found->second);
        const draco::PointAttribute* from =
            mesh.GetAttributeByUniqueId(uint32_t(wholeOf(attributes, name.c_str())));
        std::vector<unsigned char> bytes;
        if (!accessor || !from || accessor->count != mesh.num_points() ||
            !storeAttribute(*from, mesh.num_points(), *accessor, bytes))
            return fmt::format("{}: its compressed {} is not what its accessor says", what, name);
        pointAt(model, *accessor, std::move(bytes));
    }
    tinygltf::Accessor* indices = accessorAt(p.indices);
    if (!indices || indices->count != uint64_t(mesh.num_faces()) * 3)
        return what + ": its compressed triangles are not what its accessor says";
    indices->componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    pointAt(model, *indices, indicesOf(mesh));
    return std::nullopt;
}

Fault expandDraco(tinygltf::Model& model, tinygltf::Primitive& p, const tinygltf::Value& e,
                  const std::string& what, MeshSize& left) {
    const uint64_t view = e.Has("bufferView") ? wholeOf(e, "bufferView") : model.bufferViews.size();
    Bytes from;
    if (view >= model.bufferViews.size() ||
        !sliceOf(model, uint64_t(model.bufferViews[view].buffer), model.bufferViews[view].byteOffset,
                 model.bufferViews[view].byteLength, from))
        return what + ": its compressed bytes lie outside their buffer";
    MeshSize size;
    if (!readDracoSize(from, size)) return what + " cannot be decompressed";
    if (size.vertices > left.vertices || size.indices > left.indices)
        return "what it compresses is larger than the limit";
    left = {left.vertices - size.vertices, left.indices - size.indices};
    const std::unique_ptr<draco::Mesh> mesh = decodeDraco(from);
    if (!mesh) return what + " cannot be decompressed";
    if (!e.Has("attributes") || !e.Get("attributes").IsObject())
        return what + ": its compression names no attributes";
    return fillAccessors(model, p, *mesh, e.Get("attributes"), what);
}

Fault expandDracoMeshes(tinygltf::Model& model, const ImportLimits& limits) {
    MeshSize left{limits.vertices, limits.indices};
    for (size_t m = 0; m < model.meshes.size(); ++m)
        for (size_t i = 0; i < model.meshes[m].primitives.size(); ++i) {
            tinygltf::Primitive& p = model.meshes[m].primitives[i];
            const auto found = p.extensions.find(kDraco);
            if (found == p.extensions.end()) continue;
            const std::string what = fmt::format("mesh {} primitive {}", m, i);
            if (Fault f = expandDraco(model, p, found->second, what, left)) return f;
        }
    return std::nullopt;
}

}  // namespace

Fault decompress(tinygltf::Model& model, const ImportLimits& limits) {
    uint64_t bytesLeft = limits.fileBytes;
    if (Fault f = expandMeshoptViews(model, bytesLeft)) return f;
    return expandDracoMeshes(model, limits);
}

}  // namespace ag::gltf
