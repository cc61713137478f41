#include "engine/scene/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ag {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

// Perez's five coefficients; F(θ, γ) is relative to the zenith up to a factor.
struct Perez {
    float a, b, c, d, e;
    float at(float cosTheta, float gamma) const {
        const float cosGamma = std::cos(gamma);
        return (1 + a * std::exp(b / std::max(cosTheta, 1e-3f))) *
               (1 + c * std::exp(d * gamma) + e * cosGamma * cosGamma);
    }
};

// Of luminance and of the chromaticities x and y, with their values at the zenith (kcd/m² for the first).
struct ClearSky {
    Perez luminance, x, y;
    float zenithLuminance, zenithX, zenithY;
};

float cubic(const float (&m)[4], float t) {
    return ((m[0] * t + m[1]) * t + m[2]) * t + m[3];
}

// Appendix A.2 of the paper. `t`: turbidity; `theta`: the sun's angle from the zenith.
ClearSky clearSky(float t, float theta) {
    ClearSky s{.luminance = {0.1787f * t - 1.4630f, -0.3554f * t + 0.4275f, -0.0227f * t + 5.3251f,
                             0.1206f * t - 2.5771f, -0.0670f * t + 0.3703f},
               .x = {-0.0193f * t - 0.2592f, -0.0665f * t + 0.0008f, -0.0004f * t + 0.2125f,
                     -0.0641f * t - 0.8989f, -0.0033f * t + 0.0452f},
               .y = {-0.0167f * t - 0.2608f, -0.0950f * t + 0.0092f, -0.0079f * t + 0.2102f,
                     -0.0441f * t - 1.6537f, -0.0109f * t + 0.0529f},
               .zenithLuminance = 0,
               .zenithX = 0,
               .zenithY = 0};
    constexpr float kX[3][4] = {{0.00166f, -0.00375f, 0.00209f, 0},
                                {-0.02903f, 0.06377f, -0.03202f, 0.00394f},
                                {0.11693f, -0.21196f, 0.06052f, 0.25886f}};
    constexpr float kY[3][4] = {{0.00275f, -0.00610f, 0.00317f, 0},
                                {-0.04214f, 0.08970f, -0.04153f, 0.00516f},
                                {0.15346f, -0.26756f, 0.06670f, 0.26688f}};
    const float chi = (4.0f / 9.0f - t / 120) * (kPi - 2 * theta);
    s.zenithLuminance = std::max((4.0453f * t - 4.9710f) * std::tan(chi) - 0.2155f * t + 2.4192f, 0.0f);
    s.zenithX = (cubic(kX[0], theta) * t + cubic(kX[1], theta)) * t + cubic(kX[2], theta);
    s.zenithY = (cubic(kY[0], theta) * t + cubic(kY[1], theta)) * t + cubic(kY[2], theta);
    return s;
}

// CIE xyY to linear sRGB; none negative.
glm::vec3 rgbOf(float x, float y, float luminance) {
    const float scale = luminance / std::max(y, 1e-4f);
    const glm::vec3 xyz(x * scale, luminance, (1 - x - y) * scale);
    const glm::vec3 rgb(3.2406f * xyz.x - 1.5372f * xyz.y - 0.4986f * xyz.z,
                        -0.9689f * xyz.x + 1.8758f * xyz.y + 0.0415f * xyz.z,
                        0.0557f * xyz.x - 0.2040f * xyz.y + 1.0570f * xyz.z);
    return glm::max(rgb, glm::vec3(0));
}

constexpr glm::ivec2 kAnalyticSize{256, 128};
constexpr float kGroundAlbedo = 0.2f;
constexpr float kRadianceOfKilocandela = 1000.0f / 683.0f;  // W/(m² sr) of 1 kcd/m²

// On a horizontal plane, from the rows above the horizon.
glm::vec3 skyIrradiance(const Image& picture) {
    const glm::ivec2 size(picture.width, picture.height);
    glm::vec3 sum(0);
    for (int y = 0; y < size.y / 2; ++y) {
        const float cosine = std::cos((float(y) + 0.5f) / float(size.y) * kPi);
        for (int x = 0; x < size.x; ++x)
            sum += picture.at(x, y) * (cosine * skyTexelAngle(size, y));
    }
    return sum;
}

}  // namespace

glm::vec3 skyRadiance(const Sky& sky, glm::vec3 direction) {
    return lookUpDirection({sky.radiance.width, sky.radiance.height}, sky.radiance.pixels, direction);
}

Sky constantSky(glm::vec3 radiance) {
    Sky sky{.radiance = Image(1, 1)};
    sky.radiance.pixels[0] = radiance;
    return sky;
}

Sky analyticSky(glm::vec3 sunDirection, float turbidity) {
    const glm::vec3 toSun = -sunDirection;
    const float sunTheta = std::min(std::acos(std::clamp(toSun.y, -1.0f, 1.0f)), 0.5f * kPi);
    const ClearSky s = clearSky(turbidity, sunTheta);
    const auto relative = [&](const Perez& p, float cosTheta, float gamma) {
        return p.at(cosTheta, gamma) / p.at(1, sunTheta);
    };
    Sky sky{.radiance = Image(kAnalyticSize.x, kAnalyticSize.y),
            .sunDirection = sunDirection,
            .turbidity = turbidity};
    for (int y = 0; y < kAnalyticSize.y / 2; ++y)
        for (int x = 0; x < kAnalyticSize.x; ++x) {
            const glm::vec3 d = skyDirection((glm::vec2(x, y) + 0.5f) / glm::vec2(kAnalyticSize));
            const float gamma = std::acos(std::clamp(glm::dot(d, toSun), -1.0f, 1.0f));
            sky.radiance.at(x, y) =
                kRadianceOfKilocandela * rgbOf(s.zenithX * relative(s.x, d.y, gamma),
                                               s.zenithY * relative(s.y, d.y, gamma),
                                               s.zenithLuminance * relative(s.luminance, d.y, gamma));
        }
    const glm::vec3 ground = skyIrradiance(sky.radiance) * (kGroundAlbedo / kPi);
    std::fill(sky.radiance.pixels.begin() + ptrdiff_t(sky.radiance.pixels.size() / 2),
              sky.radiance.pixels.end(), ground);
    return sky;
}

const char* whyNoSky(const Image& picture) {
    const bool single = picture.width == 1 && picture.height == 1;
    if (!single && picture.width != 2 * picture.height) return "is not twice as wide as high";
    for (const glm::vec3& p : picture.pixels)
        for (int c = 0; c < 3; ++c)
            if (!(p[c] >= 0) || !(p[c] <= kMostSkyRadiance)) return "holds what is no radiance from 0 to 1e6";
    return nullptr;
}

}  // namespace ag
