// Irradiance from virtual lights with the far ones shared out over blocks of n x n pixels (Wald et al. 2002;
// ACRSM section 3.2.3), and put together from the block's pixels that see the same surface (Laine et al.
// 2007). What no neighbour holds is gathered where it lacks. Difference: a filter by planes instead of a
// blur.
#pragma once

#include "engine/core/setting_fields.h"
#include "gi/val_shading.h"

namespace ag::gi {

struct InterleavedShadingSettings {
    uint32_t side = 3;  // n: each pixel meets one of n² parts of the far lights; 1: all of them

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"side", &InterleavedShadingSettings::side, 1, 4, "pixels",
                         "blocks of n x n pixels share the far lights, each pixel meets a part of them"}};
    }
    bool operator==(const InterleavedShadingSettings&) const = default;
};

struct InterleavedShadingNames {
    ValTileNames tiles;
    std::string_view far, near, fill, parts, irradiance, lacking, lackingCounts, noneLacking;
};
constexpr InterleavedShadingNames kFirstInterleaved = {
    {"interleaved_shading.classify", "interleaved_shading.lists", "interleaved_shading.counts"},
    "interleaved_shading.far",
    "interleaved_shading.near",
    "interleaved_shading.fill",
    "interleaved_shading.parts",
    "interleaved_shading.irradiance",
    "interleaved_shading.lacking",
    "interleaved_shading.lacking_counts",
    "interleaved_shading.none_lacking"};
constexpr InterleavedShadingNames kAllInterleaved = {
    {"interleaved_shading.classify_all", "interleaved_shading.lists_all", "interleaved_shading.counts_all"},
    "interleaved_shading.far_all",
    "interleaved_shading.near_all",
    "interleaved_shading.fill_all",
    "interleaved_shading.parts_all",
    "interleaved_shading.irradiance_all",
    "interleaved_shading.lacking_all",
    "interleaved_shading.lacking_counts_all",
    "interleaved_shading.none_lacking_all"};

Irradiance addInterleavedShading(GraphScope scope, const Surfaces& gbuffer, const ShadowedVals& lights,
                                 const ValShadingSettings& settings, uint32_t side,
                                 const InterleavedShadingNames& names = kFirstInterleaved);

}  // namespace ag::gi
