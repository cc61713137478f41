// Where in and about its pixel a sample lies, so that the mean of the samples is the filtered pixel: chances
// follow the filter (Ernst, Stamminger and Greiner 2006, Filter Importance Sampling), and no sample has a
// weight.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <string_view>

namespace ag::reference {

enum class PixelFilter : uint32_t {
    kCenter,          // the pixel's centre alone, as a rasteriser sees it: for comparing term by term
    kBox,             // the pixel's square
    kBlackmanHarris,  // three pixels wide, smooth
};

std::string_view filterName(PixelFilter filter);
std::optional<PixelFilter> filterFromName(std::string_view name);

// Offset from the centre in pixels, of an even point in the unit square.
glm::vec2 filterOffset(PixelFilter filter, glm::vec2 uv);

}  // namespace ag::reference
