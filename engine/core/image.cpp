#include "engine/core/image.h"

#include <fmt/format.h>
#include <png.h>
#include <stb/stb_image.h>
#include <tinyexr.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>

#include "engine/core/number.h"
#include "engine/core/safe_file.h"
#include "engine/core/text.h"

namespace ag {
namespace {

std::string pfmBytes(const Image& image) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", image.width, image.height);
    for (int y = image.height - 1; y >= 0; --y)
        bytes.append(reinterpret_cast<const char*>(&image.at(0, y)), sizeof(glm::vec3) * size_t(image.width));
    return bytes;
}

// RGB in 32-bit floats, ZIP compression, attributes as strings.
Result<std::string> exrBytes(const Image& image) {
    std::vector<float> planes[3];
    for (size_t c = 0; c < 3; ++c)
        for (const glm::vec3& p : image.pixels)
            planes[c].push_back(p[2 - int(c)]);  // B, G, R: channels are in alphabetical order
    float* pointers[3] = {planes[0].data(), planes[1].data(), planes[2].data()};
    EXRImage pixels;
    InitEXRImage(&pixels);
    pixels.num_channels = 3;
    pixels.images = reinterpret_cast<unsigned char**>(pointers);
    pixels.width = image.width;
    pixels.height = image.height;

    EXRChannelInfo channels[3] = {};
    int types[3];
    for (size_t c = 0; c < 3; ++c) {
        channels[c].name[0] = "BGR"[c];
        types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    std::vector<EXRAttribute> attributes;
    for (const auto& [name, value] : image.attributes) {
        EXRAttribute a{};
        std::snprintf(a.name, sizeof(a.name), "%s", name.c_str());
        std::snprintf(a.type, sizeof(a.type), "string");
        a.value = reinterpret_cast<unsigned char*>(const_cast<char*>(value.data()));
        a.size = int(value.size());
        attributes.push_back(a);
    }
    EXRHeader header;
    InitEXRHeader(&header);
    header.num_channels = 3;
    header.channels = channels;
    header.pixel_types = types;
    header.requested_pixel_types = types;
    header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
    header.num_custom_attributes = int(attributes.size());
    header.custom_attributes = attributes.data();
    unsigned char* memory = nullptr;
    const char* message = nullptr;
    const size_t size = SaveEXRImageToMemory(&pixels, &header, &memory, &message);
    if (size == 0) {
        const std::string fault = firstLine(message ? message : "", "the encoder failed");
        if (message) FreeEXRErrorMessage(message);
        return Error{fault};
    }
    std::string bytes(reinterpret_cast<const char*>(memory), size);
    std::free(memory);
    return bytes;
}

Result<std::string> pngBytes(const Image& image) {
    std::vector<uint8_t> texels(image.pixels.size() * 3);
    for (size_t i = 0; i < image.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            texels[i * 3 + size_t(c)] = uint8_t(std::clamp(image.pixels[i][c], 0.0f, 1.0f) * 255.0f + 0.5f);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png_uint_32(image.width);
    png.height = png_uint_32(image.height);
    png.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);  // enough for any picture of this size
    std::string bytes(size, '\0');
    if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, texels.data(), 0, nullptr))
        return Error{png.message};
    bytes.resize(size);
    return bytes;
}

constexpr int kMostSide = 1 << 15;
constexpr double kMostTexels = 1 << 28;
constexpr int kMostChannels = 32;
constexpr uint64_t kMostImageBytes = uint64_t(1) << 32;  // of a file

bool reasonable(double width, double height) {
    return width > 0 && height > 0 && width <= kMostSide && height <= kMostSide &&
           width * height <= kMostTexels;
}

// The text up to the next white space, of a short header; empty: there is none.
std::string_view takeWord(std::string_view& text) {
    const size_t begin = std::min(text.find_first_not_of(" \t\n\r"), text.size());
    const size_t end = std::min(text.find_first_of(" \t\n\r", begin), text.size());
    const std::string_view word = text.substr(begin, end - begin);
    text.remove_prefix(end);
    return word;
}

Result<Image> loadPfm(const std::string& path) {
    const auto bytes = readFile(path, kMostImageBytes);
    if (!bytes) return bytes.error();
    std::string_view text = *bytes;
    const std::string_view magic = takeWord(text);
    const double width = parseNumber(takeWord(text)).value_or(0),
                 height = parseNumber(takeWord(text)).value_or(0),
                 scale = parseNumber(takeWord(text)).value_or(0);
    const bool whole = width == std::floor(width) && height == std::floor(height);
    if (magic != "PF" || !whole || !reasonable(width, height) || !(scale < 0))
        return Error{path + " is not a little-endian colour PFM image"};
    // Before anything is made: a header may promise what the file does not hold.
    const size_t size = size_t(width) * size_t(height) * sizeof(glm::vec3);
    if (text.size() < size + 1) return Error{path + " is shorter than its header says"};
    text.remove_prefix(1);  // the one white space that ends the header
    Image image{int(width), int(height)};
    for (int y = image.height - 1; y >= 0; --y)
        text.copy(reinterpret_cast<char*>(&image.at(0, y)), sizeof(glm::vec3) * size_t(width),
                  sizeof(glm::vec3) * size_t(width) * size_t(image.height - 1 - y));
    return image;
}

// What the decoder allocates, given back whatever happens.
struct ExrFile {
    EXRHeader header;
    EXRImage pixels;
    const char* message = nullptr;
    ExrFile() {
        InitEXRHeader(&header);
        InitEXRImage(&pixels);
    }
    ~ExrFile() {
        FreeEXRImage(&pixels);
        FreeEXRHeader(&header);
        if (message) FreeEXRErrorMessage(message);
    }
    ExrFile(const ExrFile&) = delete;
    ExrFile& operator=(const ExrFile&) = delete;
};

// Whether each attribute "type" of a file's header says scan lines; a file may have none. The decoder ends
// the program at one it does not know, so that one has to look first. Attributes are name, type (both ended
// by a zero), size, bytes.
bool hasOnlyScanLines(std::string_view text) {
    size_t at = 8;  // after the magic number and the version
    const auto word = [&] {
        const size_t end = std::min(text.find('\0', std::min(at, text.size())), text.size());
        const std::string_view found = text.substr(std::min(at, end), end - std::min(at, end));
        at = end + 1;
        return found;
    };
    for (std::string_view name = word(); !name.empty(); name = word()) {
        word();
        if (at + 4 > text.size()) return true;
        uint32_t size = 0;
        std::memcpy(&size, text.data() + at, 4);
        at += 4;
        if (size > text.size() - at) return true;
        const std::string_view value = text.substr(at, size);
        if (name == "type" && value.substr(0, value.find('\0')) != "scanlineimage") return false;
        at += size;
    }
    return true;
}

// Why an image is not even tried: the decoder believes what the header says.
const char* whyRefused(const EXRHeader& header) {
    const EXRBox2i& w = header.data_window;
    if (!reasonable(double(w.max_x) - w.min_x + 1, double(w.max_y) - w.min_y + 1))
        return "its size is larger than the limit or none";
    if (header.num_channels < 1 || header.num_channels > kMostChannels)
        return "it has too many channels or none";
    if (header.chunk_count < 0 || header.chunk_count > w.max_y - w.min_y + 1)
        return "it says to have more chunks than lines";
    return nullptr;
}

void takeAttributes(const EXRHeader& header, Image& image) {
    for (int i = 0; i < header.num_custom_attributes; ++i) {
        const EXRAttribute& a = header.custom_attributes[i];
        if (std::string_view(a.type) == "string")
            image.attributes[a.name] = std::string(reinterpret_cast<const char*>(a.value), size_t(a.size));
    }
}

// The channel of that name; of a grey image its only one. -1: there is none.
int channelNamed(const EXRHeader& header, std::string_view name) {
    if (header.num_channels == 1) return 0;
    for (int c = 0; c < header.num_channels; ++c)
        if (name == header.channels[c].name) return c;
    return -1;
}

// Empty if all went well.
std::string decodeExr(const std::string& text, ExrFile& exr) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
    EXRVersion version;
    if (ParseEXRVersionFromMemory(&version, bytes, text.size()) != TINYEXR_SUCCESS)
        return "its first bytes are others";
    const bool lines = !version.multipart && !version.non_image && !version.tiled;
    if (!lines || !hasOnlyScanLines(text)) return "it is not one part of scan lines";
    const auto said = [&](const char* otherwise) {
        return firstLine(exr.message ? exr.message : "", otherwise);
    };
    if (ParseEXRHeaderFromMemory(&exr.header, &version, bytes, text.size(), &exr.message) != TINYEXR_SUCCESS)
        return said("its header is broken");
    if (const char* why = whyRefused(exr.header)) return why;
    for (int c = 0; c < exr.header.num_channels; ++c) {
        if (exr.header.pixel_types[c] == TINYEXR_PIXELTYPE_UINT) return "it holds whole numbers";
        exr.header.requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
    }
    exr.pixels.num_channels = exr.header.num_channels;  // else the decoder forgets broken channels' memory
    if (LoadEXRImageFromMemory(&exr.pixels, &exr.header, bytes, text.size(), &exr.message) !=
        TINYEXR_SUCCESS) {
        InitEXRImage(&exr.pixels);  // the decoder gave it back already
        return said("its pixels are broken");
    }
    return exr.pixels.images ? "" : "it has no pixels";
}

Result<Image> loadExr(const std::string& path) {
    const auto text = readFile(path, kMostImageBytes);
    if (!text) return text.error();
    ExrFile exr;
    const auto refuse = [&](const std::string& why) {
        return Error{fmt::format("{} is not a readable EXR image: {}", path, why)};
    };
    if (const std::string fault = decodeExr(*text, exr); !fault.empty()) return refuse(fault);
    Image image(exr.pixels.width, exr.pixels.height);
    for (int c = 0; c < 3; ++c) {
        const int channel = channelNamed(exr.header, std::string_view("RGB").substr(size_t(c), 1));
        if (channel < 0) return refuse("it lacks one of the channels R, G and B");
        const auto* values = reinterpret_cast<const float*>(exr.pixels.images[channel]);
        for (size_t i = 0; i < image.pixels.size(); ++i)
            image.pixels[i][c] = values[i];
    }
    takeAttributes(exr.header, image);
    return image;
}

// Radiance's run-length encoded picture (Ward 1991).
Result<Image> loadHdr(const std::string& path) {
    const auto bytes = readFile(path, kMostImageBytes);
    if (!bytes) return bytes.error();
    const auto refuse = [&](const char* why) {
        return Error{fmt::format("{} is not a readable HDR image: {}", path, why)};
    };
    if (bytes->size() > size_t(std::numeric_limits<int>::max())) return refuse("it is too large");
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes->data());
    const int length = int(bytes->size());
    int width = 0, height = 0, channels = 0;
    if (!stbi_is_hdr_from_memory(data, length)) return refuse("its first bytes are others");
    if (!stbi_info_from_memory(data, length, &width, &height, &channels) || !reasonable(width, height))
        return refuse("its size is larger than the limit or none");
    float* const texels = stbi_loadf_from_memory(data, length, &width, &height, &channels, 3);
    if (!texels) return refuse("its pixels are broken");
    Image image(width, height);
    std::memcpy(image.pixels.data(), texels, image.pixels.size() * sizeof(glm::vec3));
    stbi_image_free(texels);
    return image;
}

std::string extensionOf(const std::string& path) {
    return std::filesystem::path(path).extension().string();
}

Result<std::string> encode(const Image& image, const std::string& extension) {
    if (extension == ".exr") return exrBytes(image);
    if (extension == ".pfm") return pfmBytes(image);
    if (extension == ".png") return pngBytes(image);
    return Error{"the name must end in .exr, .pfm or .png"};
}

}  // namespace

Status saveImage(const Image& image, const std::string& path) {
    if (image.pixels.empty()) return Error{"cannot write " + path + ": the image is empty"};
    const auto bytes = encode(image, extensionOf(path));
    if (!bytes) return Error{fmt::format("cannot write {}: {}", path, bytes.error().message)};
    return writeFileSafely(path, *bytes);
}

Result<Image> loadImage(const std::string& path) {
    const std::string extension = extensionOf(path);
    if (extension == ".exr") return loadExr(path);
    if (extension == ".pfm") return loadPfm(path);
    if (extension == ".hdr") return loadHdr(path);
    return Error{path + " is neither .exr, .hdr nor .pfm"};
}

}  // namespace ag
