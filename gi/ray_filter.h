// What rays found at pixels, a frame after another: means over frames, their filter over the screen, and how
// they come to all pixels when these have their turns (see GatherGrid).
#pragma once

#include <array>
#include <string_view>

#include "gi/surfaces.h"
#include "gi/upsampling.h"

namespace ag::gi {

constexpr uint32_t kMostFilterRounds = 4;
constexpr float kOfNeighbours = 8;  // frames that their means count for where a pixel's turn begins

// Passes and resources; literals, because the graph keeps views of them.
struct RayFilterNames {
    std::string_view even, odd;
    std::array<std::string_view, kMostFilterRounds> passes;
};
struct RayMeanNames {
    std::string_view pass, mean, square, surface, rest, cameras;
    RayFilterNames filter;
};

struct RayFilter {
    uint32_t rounds;  // each twice as wide
    float tolerance;  // standard deviations by which the light of taps may differ
};

struct UncertainLight {
    ImageHandle light;    // rgba32f; alpha: variance, mean of the channels
    ImageHandle surface;  // rgba16f: normal; m along the axis, 0: sky
    BufferHandle cameras;
};
enum class FilterAlpha { kVariance, kDeviation };

// Alpha: the noise left, as `alpha` says; with no rounds always its variance.
ImageHandle addRayFilter(GraphScope scope, glm::uvec2 size, const UncertainLight& of, const RayFilter& filter,
                         const RayFilterNames& names, FilterAlpha alpha);

// The camera of the frame before.
struct FollowedCamera {
    RenderCamera camera;
    bool known;  // there was such a frame, about the same origin
};
// `history`: that camera, if it is `known`; then this frame's.
FollowedCamera followCamera(const RenderCamera& now, RenderCamera& history, bool known);

struct RayMeans {
    ImageHandle sent;  // what this frame's rays found
    FollowedCamera before;
    float mostLength;  // frames that a mean stands for
    bool moving;       // something may have changed what rays find: blocks that see it forget
    uint32_t step;
    RayFilter filter;
};

// At the pixels of `surfaces`: averaged over frames on the same surface, filtered by how uncertain the means
// are. Alpha: standard deviation of the noise left; with no rounds variance.
ImageHandle addRayMeans(GraphScope scope, const Surfaces& surfaces, const RayMeans& in,
                        const RayMeanNames& names);

struct JoinNames {
    std::string_view pass, result;
};

// `placed`: at `all`, pixels of several turns, each with noise of its own, whose standard deviation is the
// image's alpha. The noise between them is smoothed, as far as light of pixels about differs by `tolerance`
// deviations.
ImageHandle addJoinedTurns(GraphScope scope, const Surfaces& all, ImageHandle placed, float tolerance,
                           const JoinNames& names);

struct TurnNames {
    const UpsamplingNames& upsampling;
    JoinNames join;
};

// Means of the pixels of one turn, to all: upsampled in the first turn, then to just those pixels.
ImageHandle addTurn(GraphScope scope, const Surfaces& all, const Surfaces& gathered, ImageHandle means,
                    uint32_t turn, const RayFilter& filter, const TurnNames& names);

}  // namespace ag::gi
