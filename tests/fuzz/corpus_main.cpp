// Runs a target over the files of a folder, without a fuzzer: what once was found stays mended, in every
// build.
// `--mutants N` adds N changed inputs, the same ones every time: the last line printed names that which ended
// the program.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

using Bytes = std::vector<uint8_t>;
using Random = std::minstd_rand;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);
// Of a mutator, where the target has one.
extern "C" __attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t* bytes, size_t size, size_t mostSize,
                                                                unsigned seed);

namespace {

constexpr size_t kMostBytes = 65536;  // of a mutant: as tools/fuzz.sh has it

size_t upTo(size_t end, Random& random) {
    return size_t(random()) % end;
}

void flipBit(uint8_t* at, size_t size, Random& random) {
    at[upTo(size, random)] ^= uint8_t(1u << upTo(8, random));
}

// Takes a run out, and says how many are left.
size_t cut(uint8_t* at, size_t size, Random& random) {
    const size_t begin = upTo(size, random), end = begin + 1 + upTo(size - begin, random);
    std::memmove(at + begin, at + end, size - end);
    return size - (end - begin);
}

// Copies a run over another place.
void overwrite(uint8_t* at, size_t size, Random& random) {
    const size_t from = upTo(size, random), to = upTo(size, random);
    std::memmove(at + to, at + from, upTo(size - std::max(from, to), random) + 1);
}

Random& mutating() {
    static Random random(1);
    return random;
}

}  // namespace

// libFuzzer's name: the mutators of forms fall back on it.
extern "C" size_t LLVMFuzzerMutate(uint8_t* bytes, size_t size, size_t mostSize) {
    if (size == 0) return 0;
    Random& random = mutating();
    for (size_t left = 1 + upTo(4, random); left > 0 && size > 0; --left)
        switch (upTo(4, random)) {
            case 0:
                size = cut(bytes, size, random);
                break;
            case 1:
                overwrite(bytes, size, random);
                break;
            default:
                flipBit(bytes, size, random);
        }
    return std::min(size, mostSize);
}

namespace {

std::vector<Bytes> readFolder(const char* folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<Bytes> inputs;
    for (const std::filesystem::path& file : files) {
        std::printf("input %zu: %s\n", inputs.size(), file.c_str());
        std::ifstream in(file, std::ios::binary);
        inputs.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>{});
    }
    return inputs;
}

void runOn(const Bytes& input) {
    std::fflush(stdout);
    LLVMFuzzerTestOneInput(input.data(), input.size());
}

void runMutants(const std::vector<Bytes>& inputs, size_t count) {
    for (size_t i = 0; i < count; ++i) {
        Bytes mutant = inputs[i % inputs.size()];
        if (mutant.size() > kMostBytes) continue;
        size_t size = mutant.size();
        mutant.resize(kMostBytes);
        size = LLVMFuzzerCustomMutator
                   ? LLVMFuzzerCustomMutator(mutant.data(), size, kMostBytes, unsigned(i + 1))
                   : LLVMFuzzerMutate(mutant.data(), size, kMostBytes);
        mutant.resize(size);
        std::printf("mutant %zu of input %zu\n", i, i % inputs.size());
        runOn(mutant);
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2 && !(argc == 4 && std::strcmp(argv[2], "--mutants") == 0)) return 2;
    const std::vector<Bytes> inputs = readFolder(argv[1]);
    if (inputs.empty()) return 1;  // a folder without files tests nothing
    for (size_t i = 0; i < inputs.size(); ++i) {
        std::printf("input %zu as it is\n", i);
        runOn(inputs[i]);
    }
    if (argc == 4) runMutants(inputs, std::strtoul(argv[3], nullptr, 10));
    return 0;
}
