// Irradiance of every n-th pixel brought to every pixel: bilinearly among those on the same surface (joint
// bilateral upsampling, Kopf et al. 2007); the few pixels without any look farther for what is most alike,
// and those that are like nothing there are gathered by themselves.
#pragma once

#include "gi/pixel_list.h"
#include "gi/surfaces.h"
#include "gi/val_shading.h"
#include "shaders/upsampling/upsampling_io.h"

namespace ag::gi {

// Passes and resources; literals, because the graph keeps views of them.
struct UpsamplingNames {
    std::string_view near, far, irradiance;
    PixelListNames lacking, alone;
    std::string_view gather, place;
};
constexpr UpsamplingNames kUpsampling = {
    "upsampling.near",
    "upsampling.far",
    "upsampling.irradiance",
    {"upsampling.lacking", "upsampling.none_lacking", "upsampling.groups", "upsampling.no_groups"},
    {"upsampling.alone", "upsampling.none_alone", "upsampling.alone_groups", "upsampling.no_alone_groups"},
    "upsampling.gather",
    "upsampling.place"};
constexpr UpsamplingNames kFirstBounceUpsampling = {
    "upsampling.near_first",
    "upsampling.far_first",
    "upsampling.irradiance_first",
    {"upsampling.lacking_first", "upsampling.none_lacking_first", "upsampling.groups_first",
     "upsampling.no_groups_first"},
    {"upsampling.alone_first", "upsampling.none_alone_first", "upsampling.alone_groups_first",
     "upsampling.no_alone_groups_first"},
    "upsampling.gather_first",
    "upsampling.place_first"};
constexpr UpsamplingNames kLaterUpsampling = {
    "upsampling.near_later",
    "upsampling.far_later",
    "upsampling.irradiance_later",
    {"upsampling.lacking_later", "upsampling.none_lacking_later", "upsampling.groups_later",
     "upsampling.no_groups_later"},
    {"upsampling.alone_later", "upsampling.none_alone_later", "upsampling.alone_groups_later",
     "upsampling.no_alone_groups_later"},
    "",
    ""};

// Of passes that bring what was gathered at the pixels of `downsampled` to `all`.
io::UpsamplingPush upsamplingPush(const Surfaces& all, const Surfaces& downsampled);

// What was gathered at the pixels of `downsampled` = addDownsampled(`all`); comes back as it is if those are
// all. Added to `base`, if there is one, whose direction stands for both.
Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names = kUpsampling,
                         const Irradiance& base = {});
// Area lights that pixels like none of those gathered meet by themselves, and taps of their soft shadows.
struct LightsOfPixels {
    ShadowedVals lights;
    uint32_t taps = 1;
};
// The same with those that made `gathered`.
Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names, const LightsOfPixels& of);

// Whether the frame before left light at all pixels.
bool hasAllPixels(GraphScope scope, const UpsamplingNames& names);
// What was gathered at the pixels of `downsampled` to just those: the others stay as they are.
Irradiance addPlacing(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                      const Irradiance& gathered, const UpsamplingNames& names);

}  // namespace ag::gi
