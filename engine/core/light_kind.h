// The kinds of light of KHR_lights_punctual.
#pragma once

#include <cstdint>

namespace ag {

enum class LightKind : uint32_t { kDirectional, kPoint, kSpot };

}  // namespace ag
