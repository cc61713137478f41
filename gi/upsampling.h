// Irradiance of every n-th pixel brought to every pixel: bilinearly among those on the same surface (joint
// bilateral upsampling, Kopf et al. 2007); the few pixels without any look farther for what is most alike.
#pragma once

#include "gi/pixel_list.h"
#include "gi/surfaces.h"
#include "gi/val_shading.h"

namespace ag::gi {

// Passes and resources; literals, because the graph keeps views of them.
struct UpsamplingNames {
    std::string_view near, far, irradiance;
    PixelListNames lacking;
};
constexpr UpsamplingNames kUpsampling = {
    "upsampling.near",
    "upsampling.far",
    "upsampling.irradiance",
    {"upsampling.lacking", "upsampling.none_lacking", "upsampling.groups", "upsampling.no_groups"}};
constexpr UpsamplingNames kFirstBounceUpsampling = {
    "upsampling.near_first",
    "upsampling.far_first",
    "upsampling.irradiance_first",
    {"upsampling.lacking_first", "upsampling.none_lacking_first", "upsampling.groups_first",
     "upsampling.no_groups_first"}};
constexpr UpsamplingNames kLaterUpsampling = {"upsampling.near_later",
                                              "upsampling.far_later",
                                              "upsampling.irradiance_later",
                                              {"upsampling.lacking_later", "upsampling.none_lacking_later",
                                               "upsampling.groups_later", "upsampling.no_groups_later"}};

// What was gathered at the pixels of `downsampled` = addDownsampled(`all`); comes back as it is if those are
// all. Added to `base`, if there is one, whose direction stands for both.
Irradiance addUpsampling(GraphScope scope, const Surfaces& all, const Surfaces& downsampled,
                         const Irradiance& gathered, const UpsamplingNames& names = kUpsampling,
                         const Irradiance& base = {});

}  // namespace ag::gi
