#include "engine/scene/mip_chain.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/glm.hpp>

#include "engine/core/check.h"
#include "shaders/common/tonemap.h"

namespace ag {
namespace {

std::array<float, 256> valuesOf(TexelCodes codes) {
    std::array<float, 256> values{};
    for (size_t i = 0; i < values.size(); ++i) {
        const float share = float(i) / 255;
        values[i] = codes == TexelCodes::kSrgb ? io::linearFromSrgb1(share) : share;
    }
    return values;
}

// From values to the nearest of 256 codes.
class Encoder {
  public:
    explicit Encoder(const std::array<float, 256>& values) {
        for (size_t i = 0; i < 255; ++i)
            upTo_[i] = (values[i] + values[i + 1]) / 2;
        upTo_[255] = 2;
        uint8_t code = 0;
        for (size_t bin = 0; bin < kBins; ++bin) {
            while (upTo_[code] < float(bin) / kBins)
                ++code;
            first_[bin] = code;
        }
    }
    uint8_t operator()(float value) const {
        uint8_t code = first_[size_t(std::clamp(value, 0.0f, 1.0f) * (kBins - 1))];
        while (upTo_[code] < value)
            ++code;
        return code;
    }

  private:
    static constexpr size_t kBins = 1024;
    std::array<float, 256> upTo_{};
    std::array<uint8_t, kBins> first_{};  // the least code of each
};

struct Codec {
    explicit Codec(TexelCodes codes) : values(valuesOf(codes)), encode(values) {}
    std::array<float, 256> values;
    Encoder encode;
};

const Codec& codecOf(TexelCodes codes) {
    static const Codec linear(TexelCodes::kLinear), srgb(TexelCodes::kSrgb);
    return codes == TexelCodes::kSrgb ? srgb : linear;
}

// Every two by two of them. `at`: texel at a column and row of the finer level.
template <class F>
std::vector<glm::vec4> halved(uint32_t side, F&& at) {
    std::vector<glm::vec4> level(size_t(side / 2) * (side / 2));
    for (uint32_t y = 0; y < side / 2; ++y)
        for (uint32_t x = 0; x < side / 2; ++x) {
            const uint32_t left = 2 * x, top = 2 * y;
            level[size_t(y) * (side / 2) + x] =
                (at(left, top) + at(left + 1, top) + at(left, top + 1) + at(left + 1, top + 1)) / 4.0f;
        }
    return level;
}

}  // namespace

uint32_t mipCount(uint32_t side) {
    return uint32_t(std::bit_width(side));
}

std::vector<uint8_t> mipChain(std::span<const uint8_t> texels, uint32_t side, TexelCodes codes) {
    AG_CHECK(std::has_single_bit(side) && texels.size() == size_t(side) * side * 4);
    const Codec &color = codecOf(codes), &alpha = codecOf(TexelCodes::kLinear);
    std::vector<uint8_t> chain(texels.begin(), texels.end());
    chain.reserve(texels.size() / 3 * 4 + 4);
    const auto finest = [&](uint32_t x, uint32_t y) {
        const uint8_t* t = &texels[(size_t(y) * side + x) * 4];
        return glm::vec4(color.values[t[0]], color.values[t[1]], color.values[t[2]], alpha.values[t[3]]);
    };
    std::vector<glm::vec4> level;
    for (uint32_t from = side; from > 1; from /= 2) {
        const auto before = [&](uint32_t x, uint32_t y) { return level[size_t(y) * from + x]; };
        level = from == side ? halved(from, finest) : halved(from, before);
        for (const glm::vec4& t : level)
            chain.insert(chain.end(),
                         {color.encode(t.x), color.encode(t.y), color.encode(t.z), alpha.encode(t.w)});
    }
    return chain;
}

}  // namespace ag
