// What the camera sees, at fewer pixels, and points that stand for it.
#pragma once

#include "gi/inputs.h"

namespace ag::gi {

// io::CameraConstants of an image of so many pixels.
BufferHandle addCamera(GraphScope scope, std::string_view name, const RenderCamera& camera, glm::uvec2 size);

// Passes and resources; literals, because the graph keeps views of them.
struct DownsamplingNames {
    std::string_view depth, normal, camera, motion;
};
constexpr DownsamplingNames kDownsampling = {"gbuffer.downsample_depth", "gbuffer.downsample_normal",
                                             "gbuffer.downsample_camera", "gbuffer.downsample_motion"};
constexpr DownsamplingNames kLaterDownsampling = {
    "gbuffer.downsample_depth_later", "gbuffer.downsample_normal_later", "gbuffer.downsample_camera_later",
    "gbuffer.downsample_motion_later"};

// Every spacing-th pixel of every spacing-th row, as if the camera had no others: from the middle of each
// square of the image, what is left over at its right and lower border goes without. Depth, normal and
// motion only; itself with a spacing of 1.
Surfaces addDownsampled(GraphScope scope, const Surfaces& all, uint32_t spacing,
                        const DownsamplingNames& names = kDownsampling);

// The same of an image, rgba16f.
ImageHandle addDownsampledImage(GraphScope scope, std::string_view name, ImageHandle all, uint32_t spacing);

// io::kViewPointCount surface points that stand for the view: io::ViewPoint, also a texel buffer of vec4.
BufferHandle addViewPoints(GraphScope scope, const Surfaces& surfaces);

}  // namespace ag::gi
