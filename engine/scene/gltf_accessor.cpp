#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

template <class T>
T loadAs(const unsigned char* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// One component as a double; integers scaled to [0, 1] or [-1, 1] when normalised.
double component(const unsigned char* at, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: {
            const double v = loadAs<int8_t>(at);
            return normalized ? std::max(v / 127.0, -1.0) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: {
            const double v = loadAs<uint8_t>(at);
            return normalized ? v / 255.0 : v;
        }
        case TINYGLTF_COMPONENT_TYPE_SHORT: {
            const double v = loadAs<int16_t>(at);
            return normalized ? std::max(v / 32767.0, -1.0) : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: {
            const double v = loadAs<uint16_t>(at);
            return normalized ? v / 65535.0 : v;
        }
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return loadAs<uint32_t>(at);
        case TINYGLTF_COMPONENT_TYPE_FLOAT:
            return double(loadAs<float>(at));
        default:
            return 0;
    }
}

template <class T>
T convert(double value) {
    if constexpr (std::is_same_v<T, float>)
        return float(value);
    else  // of a file's floats or negative numbers, where whole ones belong
        return T(value >= 0 && value <= double(std::numeric_limits<T>::max()) ? value : 0);
}

const unsigned char* viewData(const tinygltf::Model& model, int view, size_t offset) {
    const tinygltf::BufferView& v = model.bufferViews[size_t(view)];
    return model.buffers[size_t(v.buffer)].data.data() + v.byteOffset + offset;
}

template <class T>
void readElements(const tinygltf::Accessor& a, const unsigned char* at, size_t stride, int components,
                  T* out) {
    const int given = tinygltf::GetNumComponentsInType(uint32_t(a.type));
    const int size = tinygltf::GetComponentSizeInBytes(uint32_t(a.componentType));
    for (size_t i = 0; i < a.count; ++i)
        for (int c = 0; c < std::min(components, given); ++c)
            out[i * size_t(components) + size_t(c)] =
                convert<T>(component(at + i * stride + size_t(c * size), a.componentType, a.normalized));
}

template <class T>
std::vector<T> readAll(const tinygltf::Model& model, int index, int components) {
    const tinygltf::Accessor& a = model.accessors[size_t(index)];
    std::vector<T> out(a.count * size_t(components), T(0));
    const int given = tinygltf::GetNumComponentsInType(uint32_t(a.type));
    const size_t element = size_t(given * tinygltf::GetComponentSizeInBytes(uint32_t(a.componentType)));
    if (a.bufferView >= 0) {
        const size_t stride = model.bufferViews[size_t(a.bufferView)].byteStride;
        readElements(a, viewData(model, a.bufferView, a.byteOffset), stride ? stride : element, components,
                     out.data());
    }
    if (!a.sparse.isSparse) return out;
    const std::vector<uint32_t> rows = sparseRows(model, a);
    const unsigned char* values =
        viewData(model, a.sparse.values.bufferView, size_t(a.sparse.values.byteOffset));
    tinygltf::Accessor one = a;
    one.count = 1;
    for (size_t i = 0; i < rows.size(); ++i)
        readElements(one, values + i * element, element, components, &out[rows[i] * size_t(components)]);
    return out;
}

}  // namespace

std::vector<uint32_t> sparseRows(const tinygltf::Model& model, const tinygltf::Accessor& a) {
    const int type = a.sparse.indices.componentType;
    const size_t size = size_t(tinygltf::GetComponentSizeInBytes(uint32_t(type)));
    const unsigned char* indices =
        viewData(model, a.sparse.indices.bufferView, size_t(a.sparse.indices.byteOffset));
    std::vector<uint32_t> rows(size_t(a.sparse.count), 0);
    for (size_t i = 0; i < rows.size(); ++i)
        rows[i] = convert<uint32_t>(component(indices + i * size, type, false));
    return rows;
}

std::vector<float> readFloats(const tinygltf::Model& model, int accessor, int components) {
    return readAll<float>(model, accessor, components);
}

std::vector<uint32_t> readUints(const tinygltf::Model& model, int accessor, int components) {
    return readAll<uint32_t>(model, accessor, components);
}

double numberOf(const tinygltf::Value& object, const char* key, double fallback) {
    if (!object.IsObject() || !object.Has(key)) return fallback;
    const tinygltf::Value& value = object.Get(key);
    return value.IsNumber() ? value.GetNumberAsDouble() : fallback;
}

float floatOf(double number) {
    constexpr double kMost = 1e12;
    return float(std::clamp(number, -kMost, kMost));
}

float floatOf(const tinygltf::Value& object, const char* key, double fallback) {
    return floatOf(numberOf(object, key, fallback));
}

}  // namespace ag::gltf
