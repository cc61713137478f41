// The filter of light that rays found at pixels, once all of them have had their turn (see GatherGrid).
#pragma once

#include <string_view>

#include "gi/surfaces.h"

namespace ag::gi {

struct JoinNames {  // literals, because the graph keeps views of them
    std::string_view pass, result;
};

// `placed`: at `all`, pixels of several turns, each with noise of its own, whose standard deviation is the
// image's alpha. The noise between them is smoothed, as far as light of pixels about differs by `tolerance`
// deviations.
ImageHandle addJoinedTurns(GraphScope scope, const Surfaces& all, ImageHandle placed, float tolerance,
                           const JoinNames& names);

}  // namespace ag::gi
