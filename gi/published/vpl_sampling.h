// Virtual point lights as instant radiosity has them (Keller 1997; Dachsbacher & Stamminger 2006): RSM
// texels chosen by importance, the same ones while nothing moves. The classic beside our area lights.
#pragma once

#include "gi/importance.h"
#include "gi/val_fit.h"

namespace ag::gi {

// `count` lights over all maps, as lights without size.
Vals addVplSampling(GraphScope scope, const RsmSet& rsm, const Importance& importance, uint32_t count);

}  // namespace ag::gi
