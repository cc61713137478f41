// Readers take files: a fuzzer's bytes become one, of this process alone.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace ag::fuzz {

// The file's path; the next call writes over it.
inline const std::string& asFile(const uint8_t* bytes, size_t size, const char* extension) {
    static std::string path;
    if (!path.empty()) std::remove(path.c_str());
    path = "/tmp/afterglow_fuzz_" + std::to_string(getpid()) + extension;
    std::FILE* file = std::fopen(path.c_str(), "wb");
    if (!file || std::fwrite(bytes, 1, size, file) != size || std::fclose(file) != 0) std::abort();
    static const int kRemoved = std::atexit([] { std::remove(path.c_str()); });
    (void)kRemoved;
    return path;
}

}  // namespace ag::fuzz
