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
constexpr DownsamplingNames kOtherDownsampling = {
    "gbuffer.downsample_depth_other", "gbuffer.downsample_normal_other", "gbuffer.downsample_camera_other",
    "gbuffer.downsample_motion_other"};
constexpr DownsamplingNames kLaterDownsampling = {
    "gbuffer.downsample_depth_later", "gbuffer.downsample_normal_later", "gbuffer.downsample_camera_later",
    "gbuffer.downsample_motion_later"};

// One pixel of each square of spacing x spacing; what is left over at the image's right and lower border goes
// without.
struct Downsampling {
    uint32_t spacing = 1;
    glm::uvec2 place{0};  // of the pixel in its square

    Downsampling(uint32_t n) : spacing(n), place(n / 2) {}  // its middle
    Downsampling(uint32_t n, glm::uvec2 at) : spacing(n), place(at) {}
    // Of the square's pixels one after another, its middle first.
    static Downsampling ofTurn(uint32_t n, uint32_t turn) {
        return {n, (n / 2 + glm::uvec2(turn % n, turn / n)) % n};
    }
};

// Those pixels, as if the camera had no others. Depth, normal and motion only; itself with a spacing of 1.
Surfaces addDownsampled(GraphScope scope, const Surfaces& all, const Downsampling& by,
                        const DownsamplingNames& names = kDownsampling);

// The same of an image, rgba16f.
ImageHandle addDownsampledImage(GraphScope scope, std::string_view name, ImageHandle all,
                                const Downsampling& by);

// io::kViewPointCount surface points that stand for the view: io::ViewPoint, also a texel buffer of vec4.
BufferHandle addViewPoints(GraphScope scope, const Surfaces& surfaces);

}  // namespace ag::gi
