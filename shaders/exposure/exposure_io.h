// Automatic exposure: constants of the meter, its result and its settings.
#ifndef AG_EXPOSURE_IO_H
#define AG_EXPOSURE_IO_H

#include "common/portable.h"

AG_BEGIN

const uint kExposureBins = 256u;  // of luminance, by its logarithm
const float kExposureBinsAStop = 6.0f;
const float kLeastLuminanceStops = -24.0f;                  // the least half float; bins reach to 2^18.6
const float kMiddleGray = 0.18f;                            // what the metered mean is brought to
const float kDarkestShare = 0.2f, kBrightestShare = 0.05f;  // of the lit pixels, left out of the mean

struct Exposure {
    float stops;  // by which radiance is brightened, in the picture's units
};

struct MeterPush {
    float unitStops;     // log2 of the unit of radiance, W/(m² sr)
    float compensation;  // stops on top: what the user asks for, and the unit
    float least, most;   // stops
    float share;         // of the way to the target that a frame goes
    uint valid;          // a frame before has left its exposure
    uint stride;         // pixels from one metered to the next
};

AG_END
#endif
