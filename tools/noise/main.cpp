// Writes the noise that shaders read: OUT gets SIDE² pixels of two 16-bit numbers, evenly spread over their
// range, two independent patterns of blue noise.
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "tools/noise/void_and_cluster.h"

int main(int argc, char** argv) {
    const int side = argc == 3 ? std::atoi(argv[2]) : 0;
    if (side < 8 || side > 256) {
        std::fprintf(stderr, "usage: afterglow-noise OUT SIDE, SIDE 8 to 256 pixels\n");
        return 2;
    }
    const auto count = uint32_t(side * side);
    const auto a = ag::noise::voidAndCluster(uint32_t(side), 1),
               b = ag::noise::voidAndCluster(uint32_t(side), 2);
    std::ofstream out(argv[1], std::ios::binary);
    for (uint32_t i = 0; i < count; ++i)
        for (const uint32_t rank : {a[i], b[i]}) {
            const auto value = uint16_t(uint64_t(rank) * 65536 / count);
            out.put(char(value & 0xff)).put(char(value >> 8));
        }
    out.flush();
    if (!out) {
        std::fprintf(stderr, "%s cannot be written\n", argv[1]);
        return 1;
    }
    return 0;
}
