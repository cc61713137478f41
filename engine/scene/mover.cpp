#include "engine/scene/mover.h"

#include <cmath>
#include <numbers>

namespace ag {
namespace {

constexpr double kTurnsPerRadian = 0.5 / std::numbers::pi;

// Adding and taking away leaves the nearest whole number, without a call.
double nearestWhole(double x) {
    constexpr double kBig = 0x1.8p52;
    return (x + kBig) - kBig;
}

inline float sine(double turns) {
    float x = float(turns - nearestWhole(turns));  // -1/2 to 1/2
    const float fold = std::copysign(0.5f, x) - x;
    x = std::fabs(x) > 0.25f ? fold : x;
    const float s = x * x;  // Taylor's series of sin(2 pi x) up to x^13
    return x * (6.2831853f +
                s * (-41.341702f +
                     s * (81.605249f +
                          s * (-76.705860f + s * (42.058694f + s * (-15.094643f + s * 3.8199526f))))));
}

inline void placeAt(const Mover& mover, double seconds, LocalTransform& local) {
    const double phase = mover.period > 0 ? double(sine(seconds / double(mover.period))) : 0;
    local.translation = mover.origin + glm::dvec3(mover.extent) * phase;
    const double halfTurns =
        (double(mover.startYaw) + double(mover.spinSpeed) * seconds) * (0.5 * kTurnsPerRadian);
    local.rotation = glm::quat(sine(halfTurns + 0.25), 0, sine(halfTurns), 0);
}

}  // namespace

float sineOfTurns(double turns) {
    return sine(turns);
}

void place(const Mover& mover, double seconds, LocalTransform& local) {
    placeAt(mover, seconds, local);
}

void moveAlong(View<LocalTransform, const Mover> movers, double seconds, JobRunner& runner) {
    movers.parallel(runner,
                    [=](LocalTransform& local, const Mover& mover) { placeAt(mover, seconds, local); });
}

}  // namespace ag
