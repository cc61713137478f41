// The mips of a texture, exact to half a code. Blits may round down at each level (llvmpipe), which tilts
// normals of coarse levels by a degree.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace ag {

enum class TexelCodes { kLinear, kSrgb };  // of colours; alpha is always linear

uint32_t mipCount(uint32_t side);  // of a square texture, down to one texel

// All levels, the finest first, tightly packed. `texels`: 8-bit RGBA of a square whose side is a power of
// two. Colours are averaged as light.
std::vector<uint8_t> mipChain(std::span<const uint8_t> texels, uint32_t side, TexelCodes codes);

}  // namespace ag
