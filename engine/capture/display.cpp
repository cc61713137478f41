#include "engine/capture/display.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/tonemap.h"
#include "engine/core/hash.h"

namespace ag::capture {
namespace {

constexpr int kLegendRow = 14;    // pixels below a false-colour picture
constexpr int kLeastWidth = 200;  // so that the legend has room

bool endsWith(const std::string& text, std::string_view end) {
    return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

// Dark blue, teal, green, yellow, red: lighter towards the middle, hue tells the sides apart.
glm::vec3 falseColor(float t) {
    constexpr std::array<glm::vec3, 5> kStops = {
        glm::vec3(0.10f, 0.07f, 0.42f), glm::vec3(0.05f, 0.52f, 0.72f), glm::vec3(0.30f, 0.78f, 0.42f),
        glm::vec3(0.98f, 0.85f, 0.25f), glm::vec3(0.80f, 0.12f, 0.08f)};
    const float x = std::clamp(t, 0.0f, 1.0f) * float(kStops.size() - 1);
    const size_t i = std::min(size_t(x), kStops.size() - 2);
    return glm::mix(kStops[i], kStops[i + 1], x - float(i));
}

// 3 x 5 pixels a letter, rows from the top, the left pixel in the highest of three bits.
uint32_t glyph(char letter) {
    constexpr std::string_view kLetters = "0123456789.-+em";
    constexpr std::array<uint32_t, 15> kBits = {
        0b111101101101111, 0b010110010010111, 0b111001111100111, 0b111001111001111, 0b101101111001001,
        0b111100111001111, 0b111100111101111, 0b111001001001001, 0b111101111101111, 0b111101111001111,
        0b000000000000010, 0b000000111000000, 0b000010111010000, 0b000111111100111, 0b000000111111101};
    const size_t at = kLetters.find(letter);
    return at == std::string_view::npos ? 0 : kBits[at];
}

void drawText(Image& image, int x, int y, const std::string& text) {
    constexpr int kScale = 2;
    for (size_t i = 0; i < text.size(); ++i)
        for (int bit = 0; bit < 15; ++bit) {
            if (!(glyph(text[i]) >> (14 - bit) & 1)) continue;
            for (int s = 0; s < kScale * kScale; ++s) {
                const int px = x + (int(i) * 4 + bit % 3) * kScale + s % kScale;
                const int py = y + (bit / 3) * kScale + s / kScale;
                if (px >= 0 && px < image.width && py < image.height) image.at(px, py) = glm::vec3(1);
            }
        }
}

Image enlarged(const Image& image) {
    const int factor = std::max(1, (kLeastWidth + image.width - 1) / std::max(image.width, 1));
    if (factor == 1) return image;
    Image out(image.width * factor, image.height * factor);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            out.at(x, y) = image.at(x / factor, y / factor);
    return out;
}

// Below the picture: the scale from the least to the greatest value.
Image withLegend(const Image& picture, float least, float greatest, const char* unit) {
    Image out(picture.width, picture.height + kLegendRow);
    std::ranges::copy(picture.pixels, out.pixels.begin());
    const std::string left = fmt::format("{:.3g}{}", least, unit),
                      right = fmt::format("{:.3g}{}", greatest, unit);
    const int from = int(left.size()) * 8 + 4, to = picture.width - int(right.size()) * 8 - 4;
    for (int y = picture.height + 2; y < out.height - 2; ++y)
        for (int x = from; x < to; ++x)
            out.at(x, y) = falseColor(float(x - from) / float(std::max(to - from - 1, 1)));
    drawText(out, 2, picture.height + 2, left);
    drawText(out, to + 4, picture.height + 2, right);
    return out;
}

// The 1st and 99th percentile of what is finite and not `empty` (a cleared background).
std::pair<float, float> rangeOf(std::span<const float> values, float empty) {
    std::vector<float> seen;
    const size_t step = std::max<size_t>(values.size() / 100000, 1);
    for (size_t i = 0; i < values.size(); i += step)
        if (std::isfinite(values[i]) && values[i] != empty) seen.push_back(values[i]);
    if (seen.empty()) return {0, 1};
    std::ranges::sort(seen);
    return {seen[size_t(0.01 * double(seen.size() - 1))], seen[size_t(0.99 * double(seen.size() - 1))]};
}

Image scalarDisplay(const Image& image, std::span<const float> values, float empty, const char* unit) {
    const auto [least, greatest] = rangeOf(values, empty);
    Image colors(image.width, image.height);
    for (size_t i = 0; i < values.size(); ++i)
        if (std::isfinite(values[i]) && values[i] != empty)
            colors.pixels[i] = falseColor(greatest > least ? (values[i] - least) / (greatest - least) : 0.5f);
    return withLegend(enlarged(colors), least, greatest, unit);
}

std::vector<float> firstChannel(const Image& image) {
    std::vector<float> values;
    for (const glm::vec3& p : image.pixels)
        values.push_back(p.x);
    return values;
}

// So bright that the 99th percentile is white.
Image lightDisplay(const Image& image) {
    std::vector<float> levels;
    for (const glm::vec3& p : image.pixels)
        levels.push_back(std::max(p.x, std::max(p.y, p.z)));
    const float white = std::max(rangeOf(levels, 0).second, 1e-12f);
    Image out(image.width, image.height);
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = glm::pow(glm::clamp(image.pixels[i] / white, 0.0f, 1.0f), glm::vec3(1 / 2.2f));
    return out;
}

template <class F>
Image mapped(const Image& image, F&& color) {
    Image out(image.width, image.height);
    for (size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = color(image.pixels[i]);
    return enlarged(out);
}

}  // namespace

Shown howShown(const Picture& picture) {
    const std::string& name = picture.name;
    if (name == "reference") return Shown::kRadiance;
    if (name == "gbuffer.depth" || name == "view.ism") return Shown::kDistance;
    if (picture.format == "d32f" || picture.format == "r32f") return Shown::kScalar;
    if (endsWith(name, ".normal") || endsWith(name, "surface")) return Shown::kDirection;
    if (endsWith(name, ".motion")) return Shown::kMotion;
    if (endsWith(name, ".albedo")) return Shown::kReflectance;
    const bool drawn = name == "view.clusters" || name == "view.vals" || name == "view.light_clusters" ||
                       name == "view.importance";
    return drawn || picture.format == "rgba8" ? Shown::kDisplay : Shown::kLight;
}

Image displayOf(const Picture& picture, const Look& look) {
    const Image& image = picture.pixels;
    switch (howShown(picture)) {
        case Shown::kDisplay:
            return mapped(image, [](glm::vec3 p) { return p; });
        case Shown::kRadiance:
            return mapped(image, [&](glm::vec3 p) {
                return io::applyTonemap(p, std::exp2(look.exposure), look.tonemap);
            });
        case Shown::kLight:
            return enlarged(lightDisplay(image));
        case Shown::kReflectance:
            return mapped(image,
                          [](glm::vec3 p) { return glm::pow(glm::max(p, 0.0f), glm::vec3(1 / 2.2f)); });
        case Shown::kDirection:
            return mapped(image, [](glm::vec3 p) { return p == glm::vec3(0) ? p : p * 0.5f + 0.5f; });
        case Shown::kMotion:
        case Shown::kScalar: {
            const bool motion = howShown(picture) == Shown::kMotion;
            std::vector<float> values = firstChannel(image);
            for (size_t i = 0; motion && i < values.size(); ++i)
                values[i] = glm::length(glm::vec2(image.pixels[i]));
            return scalarDisplay(image, values, motion ? -1.0f : 0.0f, "");
        }
        case Shown::kDistance: {
            std::vector<float> values = firstChannel(image);
            // Reversed depth: near over distance. A texel of a map of distances that sees nothing holds 1000.
            for (float& v : values)
                v = picture.name == "gbuffer.depth" ? (v > 0 ? look.cameraNear / v : 0) : (v >= 999 ? 0 : v);
            return scalarDisplay(image, values, 0, "m");
        }
    }
    return image;
}

Image shrunk(const Image& image, int most) {
    const int step = (std::max(image.width, image.height) + most - 1) / most;
    if (step <= 1) return image;
    Image out(image.width / step, image.height / step);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            out.at(x, y) = image.at(x * step, y * step);
    return out;
}

Statistics statisticsOf(const Image& image) {
    Statistics s{.hash = hashBytes(std::as_bytes(std::span(image.pixels)))};
    uint64_t count = 0;
    for (const glm::vec3& p : image.pixels)
        for (int c = 0; c < 3; ++c) {
            const double v = double(p[c]);
            if (!std::isfinite(v)) {
                ++s.notFinite;
                continue;
            }
            s.least = count ? std::min(s.least, v) : v;
            s.greatest = count ? std::max(s.greatest, v) : v;
            s.mean += v;
            ++count;
        }
    if (count) s.mean /= double(count);
    return s;
}

std::string picturesCsv(const std::vector<Picture>& pictures) {
    std::string out = "image,pass,format,width,height,least,mean,greatest,not_finite,hash\n";
    for (const Picture& p : pictures) {
        const Statistics s = statisticsOf(p.pixels);
        out += fmt::format("{},{},{},{},{},{:.6g},{:.6g},{:.6g},{},{:016x}\n", p.name, p.pass, p.format,
                           p.pixels.width, p.pixels.height, s.least, s.mean, s.greatest, s.notFinite, s.hash);
    }
    return out;
}

}  // namespace ag::capture
