#include "engine/scene/gltf_import.h"

#include <fmt/format.h>
#include <stb/stb_image.h>
#include <webp/decode.h>

#include <climits>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "engine/core/safe_file.h"
#include "engine/core/text.h"
#include "engine/scene/gltf_internal.h"
#include "engine/scene/split_primitives.h"

namespace ag {
namespace {

namespace fs = std::filesystem;

// What tinygltf's file callbacks know: the one folder they may read, how much is left to be read, what went
// wrong.
struct Folder {
    fs::path root;
    uint64_t bytesLeft;
    std::string fault;
};

// What tinygltf's image callback knows. The model is being read: its buffers and views are there.
struct ImageBudget {
    const tinygltf::Model& model;
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

// Whether a file is there is readWhole's to say, which knows why it is not.
bool assumeExists(const std::string&, void*) {
    return true;
}

std::string expandPath(const std::string& file, void*) {
    return file;
}

bool readWhole(std::vector<unsigned char>* out, std::string*, const std::string& file, void* user) {
    Folder& folder = *static_cast<Folder*>(user);
    const Result<std::string> bytes = staysInside(folder, file)
                                          ? readFile(file, folder.bytesLeft)
                                          : Error{file + ": it lies outside the scene's folder"};
    if (!bytes) {
        if (folder.fault.empty()) folder.fault = bytes.error().message;
        return false;
    }
    folder.bytesLeft -= bytes->size();
    out->assign(bytes->begin(), bytes->end());
    return true;
}

bool writeNothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
    return false;
}

// KTX 2.0: basis universal textures, which no package here reads.
bool isKtx(const unsigned char* bytes, int size) {
    constexpr unsigned char kMagic[] = {0xab, 'K', 'T', 'X', ' ', '2', '0'};
    return size >= int(sizeof kMagic) && std::memcmp(bytes, kMagic, sizeof kMagic) == 0;
}

bool isWebp(const unsigned char* bytes, int size) {
    return size >= 12 && std::memcmp(bytes, "RIFF", 4) == 0 && std::memcmp(bytes + 8, "WEBP", 4) == 0;
}

bool readImageSize(const unsigned char* bytes, int size, int& width, int& height) {
    int components = 0;
    return isWebp(bytes, size) ? WebPGetInfo(bytes, size_t(size), &width, &height) != 0
                               : stbi_info_from_memory(bytes, size, &width, &height, &components) != 0;
}

// RGBA8; empty: it cannot be decoded.
std::vector<unsigned char> decodeTexels(const unsigned char* bytes, int size, int width, int height) {
    std::vector<unsigned char> texels(size_t(width) * size_t(height) * 4);
    if (isWebp(bytes, size))
        return WebPDecodeRGBAInto(bytes, size_t(size), texels.data(), texels.size(), width * 4)
                   ? texels
                   : std::vector<unsigned char>();
    int components = 0;
    unsigned char* decoded = stbi_load_from_memory(bytes, size, &width, &height, &components, 4);
    if (!decoded) return {};
    std::copy_n(decoded, texels.size(), texels.begin());
    stbi_image_free(decoded);
    return texels;
}

// tinygltf hands out an image's bytes without a look at where its view ends.
bool liesInBuffer(const tinygltf::Model& model, int view) {
    if (view < 0) return true;
    const tinygltf::BufferView& v = model.bufferViews[size_t(view)];
    const size_t size = model.buffers[size_t(v.buffer)].data.size();
    return v.byteOffset <= size && v.byteLength <= size - v.byteOffset && v.byteLength <= INT_MAX;
}

// Refuses images by their header before decoding them; those of KTX files stay empty.
bool decodeImage(tinygltf::Image* image, const int index, std::string* error, std::string*, int, int,
                 const unsigned char* bytes, int size, void* user) {
    auto& budget = *static_cast<ImageBudget*>(user);
    if (!liesInBuffer(budget.model, image->bufferView)) {
        if (error) *error += fmt::format("image {}: its bytes lie outside their buffer\n", index);
        return false;
    }
    if (isKtx(bytes, size)) return gltf::skipImage(*image), true;
    int width = 0, height = 0;
    if (!readImageSize(bytes, size, width, height)) {
        if (error) *error += fmt::format("image {} cannot be decoded\n", index);
        return false;
    }
    const uint64_t side = uint64_t(std::max(width, height)), count = uint64_t(width) * uint64_t(height);
    if (side > budget.side || count > budget.texelsLeft) {
        if (error) *error += fmt::format("image {} is larger than the limit\n", index);
        return false;
    }
    budget.texelsLeft -= count;
    image->image = decodeTexels(bytes, size, width, height);
    if (image->image.empty()) {
        if (error) *error += fmt::format("image {} cannot be decoded\n", index);
        return false;
    }
    image->width = width;
    image->height = height;
    image->component = 4;
    image->bits = 8;
    image->pixel_type = TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE;
    return true;
}

constexpr size_t kGlbHeader = 12;               // magic, version, length
constexpr size_t kFirstChunk = kGlbHeader + 8;  // its length and type before it
constexpr uint32_t kGlbVersion = 2;

uint32_t wordAt(std::string_view bytes, size_t at) {
    uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

// A GLB announces itself in its first four bytes.
bool isBinary(std::string_view bytes) {
    return bytes.starts_with("glTF");
}

// The JSON of either kind of file; of a broken GLB what there is.
std::string_view jsonOf(std::string_view bytes) {
    if (!isBinary(bytes)) return bytes;
    if (bytes.size() < kFirstChunk) return {};
    return bytes.substr(kFirstChunk, wordAt(bytes, kGlbHeader));
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

// What is wrong with the bytes before anything is parsed.
gltf::Fault checkBytes(std::string_view bytes, const ImportLimits& limits) {
    if (bytes.empty()) return "the file is empty";
    if (bracketDepth(jsonOf(bytes)) > limits.jsonDepth)
        return fmt::format("its JSON is nested deeper than {}", limits.jsonDepth);
    if (!isBinary(bytes)) return std::nullopt;
    if (bytes.size() < kFirstChunk) return "the GLB ends within its header";
    if (wordAt(bytes, 4) != kGlbVersion)
        return fmt::format("it is a GLB of version {}, not 2", wordAt(bytes, 4));
    if (wordAt(bytes, 8) > bytes.size()) return "the GLB is shorter than its header says";
    return std::nullopt;
}

// The file with its JSON made readable.
std::string readable(const std::string& bytes) {
    const std::string_view json = jsonOf(bytes);
    std::string mended = gltf::readableJson(json, isBinary(bytes));
    if (mended == json) return bytes;
    if (!isBinary(bytes)) return mended;
    mended.resize((mended.size() + 3) / 4 * 4, ' ');
    std::string out = bytes.substr(0, kFirstChunk) + mended + bytes.substr(kFirstChunk + json.size());
    const auto chunk = uint32_t(mended.size()), whole = uint32_t(out.size());
    std::memcpy(out.data() + kGlbHeader, &chunk, sizeof chunk);
    std::memcpy(out.data() + 8, &whole, sizeof whole);
    return out;
}

// The library throws where a file's parts name others that are not there.
bool loadModel(tinygltf::TinyGLTF& loader, const std::string& bytes, const std::string& folder,
               tinygltf::Model& model, std::string& error) {
    std::string warning;
    const auto size = static_cast<unsigned int>(bytes.size());
    try {
        if (!isBinary(bytes))
            return loader.LoadASCIIFromString(&model, &error, &warning, bytes.data(), size, folder);
        const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
        return loader.LoadBinaryFromMemory(&model, &error, &warning, data, size, folder);
    } catch (const std::logic_error&) {
        error = "its parts do not fit together";
    } catch (const nlohmann::json::exception&) {
        error = "its JSON is not that of a glTF";
    }
    return false;
}

Result<tinygltf::Model> parse(const std::string& path, const ImportLimits& limits) {
    const auto bytes = readFile(path, limits.fileBytes);
    if (!bytes) return bytes.error();
    if (const gltf::Fault fault = checkBytes(*bytes, limits))
        return Error{fmt::format("{}: {}", path, *fault)};
    // A link to the file itself may lead elsewhere; what it names may not.
    std::error_code code;
    Folder folder{fs::canonical(path, code).parent_path(), limits.fileBytes - bytes->size(), ""};
    tinygltf::Model model;
    ImageBudget images{model, limits.imageSide, limits.imageTexels};
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(decodeImage, &images);
    loader.SetFsCallbacks({assumeExists, expandPath, readWhole, writeNothing, &folder});
    std::string error;
    const bool parsed = loadModel(loader, readable(*bytes), folder.root.string(), model, error);
    if (!folder.fault.empty()) return Error{fmt::format("{}: {}", path, folder.fault)};
    if (!parsed) return Error{fmt::format("{}: {}", path, firstLine(error, "it cannot be parsed"))};
    return model;
}

}  // namespace

Result<SceneAsset> importGltf(const std::string& path, const ImportLimits& limits) {
    auto parsed = parse(path, limits);
    if (!parsed) return parsed.error();
    tinygltf::Model& model = *parsed;
    const auto fail = [&](const gltf::Fault& fault) { return Error{fmt::format("{}: {}", path, *fault)}; };
    if (const gltf::Fault f = gltf::decompress(model, limits)) return fail(f);
    if (const gltf::Fault f = gltf::validate(model, limits)) return fail(f);
    SceneAsset asset;
    asset.name = fs::path(path).stem().string();
    asset.features = gltf::featuresOf(model);
    gltf::importMaterials(model, asset);
    if (const gltf::Fault f = gltf::importTextures(model, asset, limits)) return fail(f);
    gltf::importSky(model, asset);
    std::vector<int32_t> meshOfNode, newIndex;
    if (const gltf::Fault f = gltf::importMeshes(model, asset, meshOfNode)) return fail(f);
    splitLargePrimitives(asset);
    if (const gltf::Fault f = gltf::importNodes(model, meshOfNode, limits, asset, newIndex)) return fail(f);
    if (const gltf::Fault f = gltf::importSkins(model, newIndex, asset, limits)) return fail(f);
    if (const gltf::Fault f = gltf::importAnimations(model, newIndex, asset)) return fail(f);
    return asset;
}

}  // namespace ag
