#include "engine/scene/gltf_import.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <filesystem>
#include <fstream>

#include "engine/scene/gltf_internal.h"
#include "engine/scene/split_primitives.h"

namespace ag {
namespace {

namespace fs = std::filesystem;

// What tinygltf's file callbacks know: the one folder they may read, and how much.
struct Folder {
    fs::path root;
    uint64_t limit;
};

// Whether the path stays in the folder once links and dots are resolved.
bool staysInside(const Folder& folder, const std::string& file) {
    std::error_code error;
    const fs::path target = fs::weakly_canonical(file, error);
    if (error) return false;
    const fs::path relative = target.lexically_relative(folder.root);
    return !relative.empty() && *relative.begin() != "..";
}

bool fileExists(const std::string& file, void* user) {
    std::error_code error;
    return staysInside(*static_cast<Folder*>(user), file) && fs::is_regular_file(file, error);
}

std::string expandPath(const std::string& file, void*) {
    return file;
}

bool readWhole(std::vector<unsigned char>* out, std::string* error, const std::string& file, void* user) {
    const Folder& folder = *static_cast<Folder*>(user);
    std::error_code code;
    const uint64_t size = fs::file_size(file, code);
    if (!staysInside(folder, file) || code || size > folder.limit) {
        if (error) *error += file + " lies outside the file's folder, is missing or is too large\n";
        return false;
    }
    std::ifstream in(file, std::ios::binary);
    out->resize(size);
    in.read(reinterpret_cast<char*>(out->data()), std::streamsize(size));
    return bool(in);
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// Refuses images by their header before decoding them.
bool decodeImage(tinygltf::Image* image, const int index, std::string* error, std::string*, int, int,
                 const unsigned char* bytes, int size, void* user) {
    const auto& limits = *static_cast<const ImportLimits*>(user);
    int width = 0, height = 0, components = 0;
    if (!stbi_info_from_memory(bytes, size, &width, &height, &components)) {
        if (error) *error += fmt::format("image {} cannot be decoded\n", index);
        return false;
    }
    const uint64_t side = uint64_t(std::max(width, height));
    if (side > limits.imageSide || uint64_t(width) * uint64_t(height) > limits.imageTexels) {
        if (error) *error += fmt::format("image {} is larger than the limit\n", index);
        return false;
    }
    unsigned char* texels = stbi_load_from_memory(bytes, size, &width, &height, &components, 4);
    if (!texels) {
        if (error) *error += fmt::format("image {} cannot be decoded\n", index);
        return false;
    }
    image->width = width;
    image->height = height;
    image->component = 4;
    image->bits = 8;
    image->pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    image->image.assign(texels, texels + size_t(width) * size_t(height) * 4);
    stbi_image_free(texels);
    return true;
}

std::string firstLine(const std::string& text) {
    const std::string line = text.substr(0, text.find('\n'));
    return line.empty() ? "it cannot be parsed" : line;
}

// A GLB announces itself in its first four bytes.
bool isBinary(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

Result<tinygltf::Model> parse(const std::string& path, const ImportLimits& limits) {
    std::error_code code;
    if (!fs::exists(path, code)) return Error{path + ": the file does not exist"};
    if (!fs::is_regular_file(path, code)) return Error{path + ": it is not a file"};
    Folder folder{fs::weakly_canonical(fs::absolute(path), code).parent_path(), limits.fileBytes};
    std::vector<unsigned char> bytes;
    if (fs::file_size(path, code) > limits.fileBytes)
        return Error{path + ": the file is larger than the limit"};
    if (!readWhole(&bytes, nullptr, path, &folder)) return Error{path + ": the file cannot be read"};
    if (bytes.empty()) return Error{path + ": the file is empty"};

    tinygltf::TinyGLTF loader;
    ImportLimits imageLimits = limits;
    loader.SetImageLoader(decodeImage, &imageLimits);
    loader.SetFsCallbacks({fileExists, expandPath, readWhole, writeNothing, &folder});
    tinygltf::Model model;
    std::string error, warning;
    const std::string base = folder.root.string();
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool parsed =
        isBinary(bytes) ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, base)
                        : loader.LoadASCIIFromString(&model, &error, &warning,
                                                     reinterpret_cast<const char*>(bytes.data()), size, base);
    if (!parsed) return Error{fmt::format("{}: {}", path, firstLine(error))};
    return model;
}

}  // namespace

Result<SceneAsset> importGltf(const std::string& path, const ImportLimits& limits) {
    auto parsed = parse(path, limits);
    if (!parsed) return parsed.error();
    const tinygltf::Model& model = *parsed;
    const auto fail = [&](const gltf::Fault& fault) { return Error{fmt::format("{}: {}", path, *fault)}; };
    if (const gltf::Fault f = gltf::validate(model, limits)) return fail(f);
    SceneAsset asset;
    asset.name = fs::path(path).stem().string();
    gltf::importMaterials(model, asset);
    if (const gltf::Fault f = gltf::importTextures(model, asset)) return fail(f);
    if (const gltf::Fault f = gltf::importMeshes(model, asset, limits)) return fail(f);
    splitLargePrimitives(asset);
    if (const gltf::Fault f = gltf::importNodes(model, asset, limits)) return fail(f);
    if (!model.animations.empty()) asset.warnings.push_back("its animations are not played");
    return asset;
}

}  // namespace ag
