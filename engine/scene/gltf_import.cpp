#include "engine/scene/gltf_import.h"

#include <fmt/format.h>
#include <stb/stb_image.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "engine/scene/gltf_internal.h"
#include "engine/scene/split_primitives.h"

namespace ag {
namespace {

namespace fs = std::filesystem;

// What tinygltf's file callbacks know: the one folder they may read, and how much is left to be read.
struct Folder {
    fs::path root;
    uint64_t bytesLeft;
};

struct ImageBudget {
    uint32_t side;
    uint64_t texelsLeft;
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
    Folder& folder = *static_cast<Folder*>(user);
    std::error_code code;
    const bool there = staysInside(folder, file) && fs::is_regular_file(file, code);
    const uint64_t size = there ? fs::file_size(file, code) : 0;
    if (!there || code || size > folder.bytesLeft) {
        if (error) *error += file + " lies outside the file's folder, is missing or is too large\n";
        return false;
    }
    folder.bytesLeft -= size;
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
    auto& budget = *static_cast<ImageBudget*>(user);
    int width = 0, height = 0, components = 0;
    if (!stbi_info_from_memory(bytes, size, &width, &height, &components)) {
        if (error) *error += fmt::format("image {} cannot be decoded\n", index);
        return false;
    }
    const uint64_t side = uint64_t(std::max(width, height)), count = uint64_t(width) * uint64_t(height);
    if (side > budget.side || count > budget.texelsLeft) {
        if (error) *error += fmt::format("image {} is larger than the limit\n", index);
        return false;
    }
    budget.texelsLeft -= count;
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

// The JSON of either kind of file; of a broken GLB what there is.
std::string_view jsonOf(const std::vector<unsigned char>& bytes, bool binary) {
    const std::string_view all(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    constexpr size_t kHeader = 20;  // of the file and of its first chunk, whose length stands at 12
    if (!binary) return all;
    if (bytes.size() < kHeader) return {};
    uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    return all.substr(kHeader, length);
}

// How deep brackets stand in brackets: those who read them call themselves as often.
uint32_t bracketDepth(std::string_view json) {
    uint32_t depth = 0, deepest = 0;
    bool text = false;
    for (size_t i = 0; i < json.size(); ++i) {
        const char c = json[i];
        if (c == '"') text = !text;
        if (text && c == '\\') ++i;
        if (text) continue;
        if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
        if ((c == ']' || c == '}') && depth > 0) --depth;
    }
    return deepest;
}

// A GLB announces itself in its first four bytes.
bool isBinary(const std::vector<unsigned char>& bytes) {
    return bytes.size() >= 4 && bytes[0] == 'g' && bytes[1] == 'l' && bytes[2] == 'T' && bytes[3] == 'F';
}

Result<tinygltf::Model> parse(const std::string& path, const ImportLimits& limits) {
    std::error_code code;
    if (!fs::exists(path, code)) return Error{path + ": the file does not exist"};
    if (!fs::is_regular_file(path, code)) return Error{path + ": it is not a file"};
    // A link to the file itself may lead elsewhere; what it names may not.
    const fs::path whole = fs::canonical(path, code);
    Folder folder{whole.parent_path(), limits.fileBytes};
    std::vector<unsigned char> bytes;
    if (fs::file_size(path, code) > limits.fileBytes)
        return Error{path + ": the file is larger than the limit"};
    if (!readWhole(&bytes, nullptr, whole.string(), &folder))
        return Error{path + ": the file cannot be read"};
    if (bytes.empty()) return Error{path + ": the file is empty"};
    const bool binary = isBinary(bytes);
    if (bracketDepth(jsonOf(bytes, binary)) > limits.jsonDepth)
        return Error{fmt::format("{}: its JSON is nested deeper than {}", path, limits.jsonDepth)};

    tinygltf::TinyGLTF loader;
    ImageBudget images{limits.imageSide, limits.imageTexels};
    loader.SetImageLoader(decodeImage, &images);
    loader.SetFsCallbacks({fileExists, expandPath, readWhole, writeNothing, &folder});
    tinygltf::Model model;
    std::string error, warning;
    const std::string base = folder.root.string();
    const auto size = static_cast<unsigned int>(bytes.size());
    const bool parsed =
        binary ? loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(), size, base)
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
    if (const gltf::Fault f = gltf::importTextures(model, asset, limits)) return fail(f);
    if (const gltf::Fault f = gltf::importMeshes(model, asset)) return fail(f);
    splitLargePrimitives(asset);
    std::vector<int32_t> newIndex;
    if (const gltf::Fault f = gltf::importNodes(model, asset, newIndex)) return fail(f);
    if (const gltf::Fault f = gltf::importSkins(model, newIndex, asset, limits)) return fail(f);
    if (const gltf::Fault f = gltf::importAnimations(model, newIndex, asset)) return fail(f);
    return asset;
}

}  // namespace ag
