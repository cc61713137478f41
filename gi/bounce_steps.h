// Steps that the recipes of indirect light have in common: each takes what `f` holds and adds to it.
#pragma once

#include "gi/bounce_light.h"

namespace ag::gi {

// Another number whenever the sky's light on the points may have changed; 0: there is no sky.
uint64_t stepOfSky(const BounceLightInputs& in, const SkySettings& settings, const Settling& onPoints);
// What the levels of a sun's map are made for, where one shines.
SunFocus addSunFocus(GraphScope scope, const BounceLightInputs& in, const RsmSettings& s,
                     BufferHandle viewPoints, BounceLightHistory& h);
// RSMs, drawn by the host, with `f.emitters` as further ones; their texels.
void addRsms(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
             BounceLightHistory& h, BounceLight& f);
// The same, their texels clustered by what the view asks for, and an area light for each cluster.
void addAreaLights(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                   BounceLightHistory& h, BounceLight& f);
// Points on surfaces, and what each light of `f.vals` sees of them.
void addVisibility(GraphScope scope, const BounceLightInputs& in, const IsmAtlasSettings& s, BounceLight& f);
// Those of a term alone.
Vals valsOf(const BounceLight& f, Term term);
bool isFirstBounce(const BounceLight& f, const Vals& vals);
// Which pixels light is gathered at in this frame, and for how long yet if nothing changes.
GatherGrid gatherGridOf(GraphScope scope, const BounceLightInputs& in, const BounceLightSettings& s,
                        BounceLightHistory& h, const BounceLight& f);
// The irradiance gathered at `gathered` made steady and smooth, and brought to all pixels; at the pixels of
// `grid`, where there is one.
void addToPixels(GraphScope scope, const BounceLightInputs& in, const Surfaces& gathered,
                 const BounceLightSettings& s, BounceLightHistory& h, BounceLight& f,
                 const GatherGrid& grid = {});

}  // namespace ag::gi
