// The light of the sky: radiance from every direction in which nothing stands, as an equirectangular picture.
#pragma once

#include "engine/core/equirectangular.h"
#include "engine/core/image.h"

namespace ag {

struct Sky {
    // W/(m² sr), as engine/core/equirectangular.h has it. One texel: the same from everywhere.
    Image radiance;
    // Of a clear sky (analyticSky); turbidity 0: it is of another kind.
    glm::vec3 sunDirection{0, -1, 0};
    float turbidity = 0;
};

// Bilinear.
glm::vec3 skyRadiance(const Sky& sky, glm::vec3 direction);

Sky constantSky(glm::vec3 radiance);
// A clear sky (Preetham, Shirley and Smits 1999, A Practical Analytic Model for Daylight) without the sun's
// disc, 1 W being 683 lm. `sunDirection`: the way the sun's light travels, unit, downwards; `turbidity`: from
// 2, clear, to 10, hazy. Below the horizon lies ground of albedo 0.2 that the sky lights.
Sky analyticSky(glm::vec3 sunDirection, float turbidity);

constexpr float kLeastTurbidity = 2, kMostTurbidity = 10;
constexpr float kMostSkyRadiance = 1e6f;

// nullptr if a picture can be a sky, else what is wrong with it.
const char* whyNoSky(const Image& picture);

}  // namespace ag
