#include "engine/core/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/check.h"

namespace ag {
namespace {

using Plane = std::vector<float>;
using Kernel = std::vector<float>;  // odd length, centred

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kColorExponent = 0.7f, kFeatureExponent = 0.5f;  // q_c, q_f
constexpr float kSplitColor = 0.4f, kSplitError = 0.95f;         // p_c, p_t
constexpr float kFeatureWidth = 0.082f;                          // degrees, peak to trough
const glm::vec3 kWhite(0.950428545f, 1.0f, 1.088900371f);        // D65
const glm::mat3 kXyzFromRgb(10135552.f / 24577794, 2613072.f / 12288897, 1425312.f / 73733382,  // columns
                            8788810.f / 24577794, 8788810.f / 12288897, 8788810.f / 73733382,
                            4435075.f / 24577794, 887015.f / 12288897, 70074185.f / 73733382);
const glm::mat3 kRgbFromXyz = glm::inverse(kXyzFromRgb);

// --- Colour ---

// A linearised CIELAB: achromatic, red-green, blue-yellow.
glm::vec3 opponentFromRgb(glm::vec3 rgb) {
    const glm::vec3 r = kXyzFromRgb * rgb / kWhite;
    return {116 * r.y - 16, 500 * (r.x - r.y), 200 * (r.y - r.z)};
}

glm::vec3 rgbFromOpponent(glm::vec3 c) {
    const float y = (c.x + 16) / 116;
    return kRgbFromXyz * (glm::vec3(y + c.y / 500, y, y - c.z / 200) * kWhite);
}

// CIELAB with chroma scaled by lightness: dark colours look less colourful (Hunt).
glm::vec3 huntLabFromRgb(glm::vec3 rgb) {
    const auto f = [](float t) {
        constexpr float d = 6.0f / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0f / 29;
    };
    const glm::vec3 r = kXyzFromRgb * rgb / kWhite;
    const glm::vec3 lab(116 * f(r.y) - 16, 500 * (f(r.x) - f(r.y)), 200 * (f(r.y) - f(r.z)));
    return {lab.x, 0.01f * lab.x * lab.y, 0.01f * lab.x * lab.z};
}

float hyab(glm::vec3 a, glm::vec3 b) {
    const glm::vec3 d = a - b;
    return std::abs(d.x) + std::sqrt(d.y * d.y + d.z * d.z);
}

// The largest difference an observer can meet: green against blue.
float largestColorError() {
    return std::pow(hyab(huntLabFromRgb({0, 1, 0}), huntLabFromRgb({0, 0, 1})), kColorExponent);
}

float redistribute(float error, float largest) {
    const float split = kSplitColor * largest;
    if (error < split) return error / split * kSplitError;
    return kSplitError + (error - split) / (largest - split) * (1 - kSplitError);
}

// --- Filters ---

Plane convolve(const Plane& in, int width, int height, const Kernel& horizontal, const Kernel& vertical) {
    Plane rows(in.size()), out(in.size());
    const int rx = int(horizontal.size() / 2), ry = int(vertical.size() / 2);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            float sum = 0;
            for (int i = -rx; i <= rx; ++i)
                sum += horizontal[size_t(i + rx)] *
                       in[size_t(y) * size_t(width) + size_t(std::clamp(x + i, 0, width - 1))];
            rows[size_t(y) * size_t(width) + size_t(x)] = sum;
        }
    for (int y = 0; y < height; ++y)
        for (int i = -ry; i <= ry; ++i) {
            const float weight = vertical[size_t(i + ry)];
            const float* row = &rows[size_t(std::clamp(y + i, 0, height - 1)) * size_t(width)];
            float* sum = &out[size_t(y) * size_t(width)];
            for (int x = 0; x < width; ++x)
                sum[x] += weight * row[x];
        }
    return out;
}

float sumOf(const Kernel& k) {
    float sum = 0;
    for (const float w : k)
        sum += w;
    return sum;
}

// Contrast sensitivity in space: a sum of Gaussians a sqrt(pi / b) exp(-pi² x² / b), x in degrees.
struct Sensitivity {
    struct Term {
        float a, b;
    };
    Term terms[2];
};
constexpr Sensitivity kAchromatic{{{1, 0.0047f}, {0, 1e-5f}}}, kRedGreen{{{1, 0.0053f}, {0, 1e-5f}}},
    kBlueYellow{{{34.1f, 0.04f}, {13.5f, 0.025f}}};
constexpr float kWidestTerm = 0.04f;

Plane filterBySensitivity(const Plane& in, int width, int height, const Sensitivity& s, float ppd) {
    const int radius = int(std::ceil(3 * std::sqrt(kWidestTerm / (2 * kPi * kPi)) * ppd));
    Plane out(in.size(), 0.0f);
    float mass = 0;
    for (const Sensitivity::Term& term : s.terms) {
        if (term.a == 0) continue;
        Kernel kernel(size_t(2 * radius + 1));
        for (int i = -radius; i <= radius; ++i) {
            const float x = float(i) / ppd;
            kernel[size_t(i + radius)] = std::exp(-kPi * kPi * x * x / term.b);
        }
        const float scale = term.a * std::sqrt(kPi / term.b);
        const Plane part = convolve(in, width, height, kernel, kernel);
        for (size_t i = 0; i < out.size(); ++i)
            out[i] += scale * part[i];
        mass += scale * sumOf(kernel) * sumOf(kernel);
    }
    for (float& v : out)
        v /= mass;
    return out;
}

// Derivatives of a Gaussian, first (edges) or second (points); positive and negative weights sum to 1 and -1.
struct FeatureKernels {
    Kernel smooth, edge, point;
};

FeatureKernels featureKernels(float ppd) {
    const float sigma = 0.5f * kFeatureWidth * ppd;
    const int radius = int(std::ceil(3 * sigma));
    FeatureKernels k;
    for (int i = -radius; i <= radius; ++i) {
        const float x = float(i), g = std::exp(-x * x / (2 * sigma * sigma));
        k.smooth.push_back(g);
        k.edge.push_back(-x * g);
        k.point.push_back((x * x / (sigma * sigma) - 1) * g);
    }
    const float total = sumOf(k.smooth);
    for (float& w : k.smooth)
        w /= total;
    for (Kernel* kernel : {&k.edge, &k.point}) {
        float up = 0, down = 0;
        for (const float w : *kernel)
            (w > 0 ? up : down) += std::abs(w);
        for (float& w : *kernel)
            w /= std::max(w > 0 ? up : down, 1e-20f);
    }
    return k;
}

// Length of the feature vector (along x, along y) at each pixel.
Plane featureStrength(const Plane& luma, int width, int height, const Kernel& feature, const Kernel& smooth) {
    Plane x = convolve(luma, width, height, feature, smooth);
    const Plane y = convolve(luma, width, height, smooth, feature);
    for (size_t i = 0; i < x.size(); ++i)
        x[i] = std::hypot(x[i], y[i]);
    return x;
}

struct Seen {  // a picture after the observer's filters
    std::vector<glm::vec3> lab;
    Plane edge, point;
};

Seen see(const Image& image, float ppd) {
    const int w = image.width, h = image.height;
    Plane channels[3], luma(image.pixels.size());
    for (Plane& c : channels)
        c.resize(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 o = opponentFromRgb(image.pixels[i]);
        for (int c = 0; c < 3; ++c)
            channels[c][i] = o[c];
        luma[i] = (o.x + 16) / 116;
    }
    const Sensitivity* sensitivities[3] = {&kAchromatic, &kRedGreen, &kBlueYellow};
    for (int c = 0; c < 3; ++c)
        channels[c] = filterBySensitivity(channels[c], w, h, *sensitivities[c], ppd);
    Seen seen;
    seen.lab.resize(image.pixels.size());
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const glm::vec3 rgb = rgbFromOpponent({channels[0][i], channels[1][i], channels[2][i]});
        seen.lab[i] = huntLabFromRgb(glm::clamp(rgb, glm::vec3(0), glm::vec3(1)));
    }
    const FeatureKernels k = featureKernels(ppd);
    seen.edge = featureStrength(luma, w, h, k.edge, k.smooth);
    seen.point = featureStrength(luma, w, h, k.point, k.smooth);
    return seen;
}

// --- Exposures ---

// The tone curve's coefficients as HDR-FLIP takes them (ACES fit with its pre-exposure of 0.6 undone).
constexpr float kTop2 = 0.6f * 0.6f * 2.51f, kTop1 = 0.6f * 0.03f;
constexpr float kBottom2 = 0.6f * 0.6f * 2.43f, kBottom1 = 0.6f * 0.59f, kBottom0 = 0.14f;
constexpr float kNearWhite = 0.85f;

float tone(float x) {
    x = std::min(x, 1e6f);
    return std::clamp((kTop2 * x + kTop1) * x / ((kBottom2 * x + kBottom1) * x + kBottom0), 0.0f, 1.0f);
}

Image exposed(const Image& image, float stops) {
    Image out(image.width, image.height);
    const float scale = std::exp2(stops);
    for (size_t i = 0; i < out.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c)
            out.pixels[i][c] = tone(std::max(image.pixels[i][c], 0.0f) * scale);
    return out;
}

}  // namespace

std::vector<float> flipLdr(const Image& truth, const Image& test, float pixelsPerDegree) {
    AG_CHECK(truth.width == test.width && truth.height == test.height);
    const Seen a = see(truth, pixelsPerDegree), b = see(test, pixelsPerDegree);
    const float largest = largestColorError();
    std::vector<float> error(truth.pixels.size());
    for (size_t i = 0; i < error.size(); ++i) {
        const float color = redistribute(std::pow(hyab(a.lab[i], b.lab[i]), kColorExponent), largest);
        const float feature = std::max(std::abs(a.edge[i] - b.edge[i]), std::abs(a.point[i] - b.point[i]));
        const float featureError =
            std::clamp(std::pow(feature / std::numbers::sqrt2_v<float>, kFeatureExponent), 0.0f, 1.0f);
        error[i] = std::pow(color, 1 - featureError);
    }
    return error;
}

FlipExposures flipExposures(const Image& truth) {
    std::vector<float> luminance(truth.pixels.size());
    for (size_t i = 0; i < luminance.size(); ++i)
        luminance[i] = (kXyzFromRgb * glm::max(truth.pixels[i], glm::vec3(0))).y;
    const float brightest = *std::ranges::max_element(luminance);
    if (!(brightest > 0)) return {};
    const auto middle = luminance.begin() + std::ptrdiff_t(luminance.size() / 2);
    std::nth_element(luminance.begin(), middle, luminance.end());
    const float median = std::max(*middle, brightest * 0x1p-16f);
    // Where the curve reaches near white: the larger root of top - t bottom = 0.
    const float a = kTop2 - kNearWhite * kBottom2, b = kTop1 - kNearWhite * kBottom1,
                c = -kNearWhite * kBottom0;
    const float x = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    FlipExposures e{.first = std::log2(x / brightest), .last = std::log2(x / median)};
    e.count = std::max(2, int(std::ceil(e.last - e.first)));
    return e;
}

std::vector<float> flipHdr(const Image& truth, const Image& test, float pixelsPerDegree) {
    const FlipExposures exposures = flipExposures(truth);
    std::vector<float> worst(truth.pixels.size(), 0.0f);
    for (int i = 0; i < exposures.count; ++i) {
        const auto error =
            flipLdr(exposed(truth, exposures.at(i)), exposed(test, exposures.at(i)), pixelsPerDegree);
        for (size_t p = 0; p < worst.size(); ++p)
            worst[p] = std::max(worst[p], error[p]);
    }
    return worst;
}

double meanFlip(const Image& truth, const Image& test) {
    double sum = 0;
    for (const float e : flipHdr(truth, test))
        sum += double(e);
    return sum / double(std::max<size_t>(truth.pixels.size(), 1));
}

}  // namespace ag
