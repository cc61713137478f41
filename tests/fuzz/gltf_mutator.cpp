// For glTF: the JSON of a text or of a GLB is changed by values, the buffer of a GLB by bytes; the chunks'
// lengths stay right.
#include <array>
#include <cstring>

#include "tests/fuzz/mutators.h"

namespace {

using ag::fuzz::below, ag::fuzz::Random;

uint32_t wordAt(const std::string& bytes, size_t at) {
    uint32_t value = 0;
    if (at + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

void appendWord(std::string& bytes, uint32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void appendChunk(std::string& glb, uint32_t kind, std::string content, char filler) {
    content.resize((content.size() + 3) / 4 * 4, filler);
    appendWord(glb, uint32_t(content.size()));
    appendWord(glb, kind);
    glb += content;
}

std::string mutateBuffer(std::string buffer, Random& random) {
    if (buffer.empty() || below(2, random)) return buffer;
    const size_t most = buffer.size() + 64;
    const size_t had = buffer.size();
    buffer.resize(most);
    buffer.resize(LLVMFuzzerMutate(reinterpret_cast<uint8_t*>(buffer.data()), had, most));
    return buffer;
}

constexpr uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBinary = 0x004e4942;
constexpr size_t kHeader = 12, kChunkHeader = 8;

std::string mutateGlb(const std::string& glb, Random& random) {
    const size_t jsonSize = wordAt(glb, kHeader), bufferAt = kHeader + kChunkHeader + jsonSize;
    if (bufferAt > glb.size()) return {};
    const std::string json = ag::fuzz::mutateJson(glb.substr(kHeader + kChunkHeader, jsonSize), random);
    if (json.empty()) return {};
    std::string chunks;
    appendChunk(chunks, kJson, json, ' ');
    if (bufferAt + kChunkHeader <= glb.size())
        appendChunk(chunks, kBinary, mutateBuffer(glb.substr(bufferAt + kChunkHeader), random), '\0');
    std::string out;
    appendWord(out, kMagic);
    appendWord(out, 2);
    appendWord(out, uint32_t(kHeader + chunks.size()));
    return out + chunks;
}

}  // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t mostSize, unsigned seed) {
    Random random(seed);
    const std::string text = ag::fuzz::asText(bytes, size);
    const std::string mutated =
        wordAt(text, 0) == kMagic ? mutateGlb(text, random) : ag::fuzz::mutateJson(text, random);
    return ag::fuzz::intoBuffer(mutated, bytes, size, mostSize, random);
}
