#include "engine/capture/levers.h"

namespace ag::capture {
namespace {

constexpr std::string_view kBounce = "the first bounce";

// docs/capture.md says how these were measured.
constexpr std::array kLevers = {
    Lever{.setting = "val_clustering.count",
          .limit = 16,
          .errorTimes = 1.26,
          .term = kBounce,
          .left =
              {{{"val_clustering", 0.81}, {"ism_atlas", 0.51}, {"val_shading", 0.53}, {"texel_rays", 0.92}}}},
    Lever{.setting = "ism_atlas.tile_size",
          .by = 2.0 / 3,
          .limit = 16,
          .errorTimes = 1.02,
          .term = kBounce,
          .left = {{{"ism_atlas", 0.47}, {"val_shading", 0.8}}}},
    Lever{.setting = "ism_atlas.points_per_map",
          .limit = 64,
          .errorTimes = 1.01,
          .term = kBounce,
          .left = {{{"ism_atlas.splat", 0.74}, {"ism_atlas.resolve", 0.8}}}},
    Lever{.setting = "gi.spacing",
          .by = 1,
          .adds = true,
          .limit = 4,
          .errorTimes = 1.69,
          .term = kBounce,
          .left = {{{"val_shading", 0.59}, {"texel_rays", 0.57}, {"upsampling", 0.95}}}},
    Lever{.setting = "val_shading.near_reach",
          .limit = 0.5,
          .errorTimes = 0.98,
          .term = kBounce,
          .left = {{{"val_shading", 0.81}}}},
    Lever{.setting = "val_shading.taps",
          .limit = 1,
          .errorTimes = 0.98,
          .term = kBounce,
          .left = {{{"val_shading", 0.9}}}},
    Lever{.setting = "rsm.resolution",
          .limit = 64,
          .errorTimes = 1.02,
          .term = kBounce,
          .left = {{{"rsm", 0.25},
                    {"importance", 0.54},
                    {"val_clustering", 0.31},
                    {"val_shading", 0.93},
                    {"texel_rays", 0.83}}}},
    Lever{.setting = "texel_rays.enabled",
          .by = 0,
          .errorTimes = 1.18,
          .term = kBounce,
          .left = {{{"texel_rays", 0}, {"gloss_rays", 0}}}},
    Lever{.setting = "val_shading.glossy",
          .by = 0,
          .errorTimes = 1.38,
          .term = "radiance",
          .left = {{{"val_gloss", 0}, {"gloss_rays", 0}}}},
    Lever{.setting = "shadow_maps.resolution",
          .limit = 64,
          .errorTimes = 1.38,
          .term = "direct light",
          .left = {{{"shadow_maps", 0.32}, {"direct_lighting", 0.8}}}},
    Lever{.setting = "sky.rounds",
          .by = 1.0 / 3,
          .limit = 1,
          .errorTimes = 1.02,
          .term = "the sky",
          .left = {{{"sky", 0.7}}}}};

}  // namespace

std::span<const Lever> levers() {
    return kLevers;
}

}  // namespace ag::capture
