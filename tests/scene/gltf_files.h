// Small glTF files made by hand, written into a folder of the running case's own.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/own_folder.h"

namespace ag::test {

namespace fs = std::filesystem;
using nlohmann::json;

inline std::string base64(const std::vector<unsigned char>& bytes) {
    static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t word = uint32_t(bytes[i]) << 16;
        if (i + 1 < bytes.size()) word |= uint32_t(bytes[i + 1]) << 8;
        if (i + 2 < bytes.size()) word |= bytes[i + 2];
        for (int d = 0; d < 4; ++d)
            out += i + size_t(d) <= bytes.size() ? kDigits[word >> (18 - 6 * d) & 63] : '=';
    }
    return out;
}

// Bytes as a buffer of a document.
inline json bufferOf(const std::vector<unsigned char>& bytes) {
    return {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
}

template <class T>
std::vector<unsigned char> bytesOf(const std::vector<T>& values) {
    std::vector<unsigned char> bytes(values.size() * sizeof(T));
    std::memcpy(bytes.data(), values.data(), bytes.size());
    return bytes;
}

// Adds values in a buffer and a view of their own; the accessor's index.
template <class T>
size_t addAccessor(json& document, const std::vector<T>& values, const char* type, int componentType,
                   size_t components, bool normalized = false) {
    document["buffers"].push_back(bufferOf(bytesOf(values)));
    document["bufferViews"].push_back(
        {{"buffer", document["buffers"].size() - 1}, {"byteLength", values.size() * sizeof(T)}});
    document["accessors"].push_back({{"bufferView", document["bufferViews"].size() - 1},
                                     {"componentType", componentType},
                                     {"normalized", normalized},
                                     {"count", values.size() / components},
                                     {"type", type}});
    return document["accessors"].size() - 1;
}

// A triangle: three positions and three 16-bit indices in one embedded buffer.
inline json triangle(std::array<float, 9> positions = {0, 0, 0, 1, 0, 0, 0, 1, 0}) {
    std::vector<unsigned char> bytes(42);
    std::memcpy(bytes.data(), positions.data(), 36);
    const uint16_t indices[] = {0, 1, 2};
    std::memcpy(bytes.data() + 36, indices, 6);
    return {{"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0}}}}},
            {"nodes", {{{"mesh", 0}, {"name", "thing"}}}},
            {"meshes", {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}}}}}}},
            {"accessors",
             {{{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
              {{"bufferView", 1}, {"componentType", 5123}, {"count", 3}, {"type", "SCALAR"}}}},
            {"bufferViews",
             {{{"buffer", 0}, {"byteLength", 36}}, {{"buffer", 0}, {"byteOffset", 36}, {"byteLength", 6}}}},
            {"buffers",
             {{{"byteLength", 42}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}}}};
}

inline std::string write(const std::string& name, const std::string& text) {
    const fs::path path = test::ownFolder() / name;
    std::ofstream(path, std::ios::binary) << text;
    return path.string();
}

// The sentence a document is refused with; empty if it loads.
inline std::string faultOf(const nlohmann::json& document, const ImportLimits& limits = {}) {
    const auto asset = importGltf(write("case.gltf", document.dump()), limits);
    return asset ? "" : asset.error().message;
}

}  // namespace ag::test
