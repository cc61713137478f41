#include "tests/fuzz/mutators.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <nlohmann/json.hpp>

namespace ag::fuzz {
namespace {

using nlohmann::json;

constexpr const char* kNumbers[] = {"0",
                                    "-0",
                                    "1",
                                    "-1",
                                    "2",
                                    "3",
                                    "4",
                                    "5",
                                    "7",
                                    "16",
                                    "255",
                                    "256",
                                    "257",
                                    "65535",
                                    "65536",
                                    "2147483647",
                                    "2147483648",
                                    "-2147483648",
                                    "4294967295",
                                    "4294967296",
                                    "9007199254740993",
                                    "0.5",
                                    "1.5",
                                    "1e-40",
                                    "-1e-40",
                                    "1e20",
                                    "-1e20",
                                    "3.5e38",
                                    "1e308",
                                    "-1e308",
                                    "5120",
                                    "5121",
                                    "5123",
                                    "5125",
                                    "5126",
                                    "34962",
                                    "34963",
                                    "33071",
                                    "9728",
                                    "9987",
                                    "9223372036854775807"};

// Words that glTF gives a meaning.
constexpr const char* kWords[] = {"SCALAR",
                                  "VEC2",
                                  "VEC3",
                                  "VEC4",
                                  "MAT4",
                                  "OPAQUE",
                                  "MASK",
                                  "BLEND",
                                  "LINEAR",
                                  "STEP",
                                  "CUBICSPLINE",
                                  "translation",
                                  "rotation",
                                  "scale",
                                  "weights",
                                  "pointer",
                                  "POSITION",
                                  "NORMAL",
                                  "TANGENT",
                                  "TEXCOORD_0",
                                  "JOINTS_0",
                                  "WEIGHTS_0",
                                  "perspective",
                                  "orthographic",
                                  "point",
                                  "spot",
                                  "directional",
                                  "KHR_lights_punctual",
                                  "KHR_texture_transform",
                                  "KHR_materials_emissive_strength",
                                  "KHR_materials_specular",
                                  "image/png",
                                  "data:application/octet-stream;base64,AAAA",
                                  "data:image/png;base64,iVBORw0KGgo=",
                                  ""};

template <class T, size_t kCount>
const T& oneOf(const T (&values)[kCount], Random& random) {
    return values[below(uint32_t(kCount), random)];
}

void collect(json& value, std::vector<json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
        for (json& child : value)
            collect(child, all);
}

void changeContainer(json& value, const std::vector<json*>& all, Random& random) {
    const json other = *all[below(uint32_t(all.size()), random)];
    if (value.is_object()) {
        if (!value.empty() && below(2, random))
            value.erase(std::next(value.begin(), below(uint32_t(value.size()), random)));
        else
            value[oneOf(kWords, random)] = other;
        return;
    }
    const bool empty = value.empty();
    const uint32_t at = empty ? 0 : below(uint32_t(value.size()), random);
    switch (below(3, random)) {
        case 0:
            if (!empty) value.erase(at);
            break;
        case 1:
            value.push_back(empty ? other : json(value[at]));
            break;
        default:
            value.insert(value.begin() + at, other);
    }
}

void changeOne(json& root, Random& random) {
    std::vector<json*> all;
    collect(root, all);
    json& value = *all[below(uint32_t(all.size()), random)];
    if (below(8, random) == 0) {
        const json other = *all[below(uint32_t(all.size()), random)];
        value = other;
    } else if (value.is_structured()) {
        changeContainer(value, all, random);
    } else if (value.is_string()) {
        value = oneOf(kWords, random);
    } else if (value.is_number_integer() && below(2, random)) {
        value = value.get<uint64_t>() + below(5, random) - 2;  // unsigned: may go round
    } else {
        value = json::parse(oddNumber(random), nullptr, false);
    }
}

bool partOfWord(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' || c == '_';
}

struct Piece {
    size_t begin = 0, size = 0;
};

std::vector<Piece> wordsOf(const std::string& text) {
    std::vector<Piece> words;
    for (size_t i = 0; i < text.size(); ++i) {
        if (!partOfWord(text[i])) continue;
        if (i == 0 || !partOfWord(text[i - 1])) words.push_back({i, 0});
        ++words.back().size;
    }
    return words;
}

std::vector<Piece> linesOf(const std::string& text) {
    std::vector<Piece> lines;
    for (size_t begin = 0; begin < text.size();) {
        const size_t end = std::min(text.find('\n', begin), text.size() - 1) + 1;
        lines.push_back({begin, end - begin});
        begin = end;
    }
    return lines;
}

void changeWord(std::string& text, Random& random) {
    const auto words = wordsOf(text);
    if (words.empty()) return;
    const auto any = [&] { return words[below(uint32_t(words.size()), random)]; };
    const Piece other = any(), to = any();
    const std::string by = below(3, random) == 0 ? text.substr(other.begin, other.size) : oddNumber(random);
    text.replace(to.begin, to.size, by);
}

void changeLine(std::string& text, Random& random) {
    const auto lines = linesOf(text);
    if (lines.empty()) return;
    const auto any = [&] { return lines[below(uint32_t(lines.size()), random)]; };
    const Piece line = any(), to = any();
    const std::string copy = text.substr(line.begin, line.size);
    if (below(2, random))
        text.erase(line.begin, line.size);
    else
        text.insert(to.begin, copy);
}

}  // namespace

std::string oddNumber(Random& random) {
    return oneOf(kNumbers, random);
}

std::string mutateJson(const std::string& text, Random& random) {
    json root = json::parse(text, nullptr, false);
    if (root.is_discarded()) return {};
    for (uint32_t left = 1 + below(4, random); left > 0; --left)
        changeOne(root, random);
    return root.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string mutateWords(const std::string& text, Random& random) {
    std::string out = text;
    for (uint32_t left = 1 + below(4, random); left > 0; --left)
        below(3, random) ? changeWord(out, random) : changeLine(out, random);
    return out;
}

size_t intoBuffer(const std::string& mutated, uint8_t* bytes, size_t size, size_t mostSize, Random& random) {
    if (mutated.empty() || mutated.size() > mostSize || below(4, random) == 0)
        return LLVMFuzzerMutate(bytes, size, mostSize);
    std::memcpy(bytes, mutated.data(), mutated.size());
    return mutated.size();
}

}  // namespace ag::fuzz
