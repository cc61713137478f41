#include "engine/sound/tone.h"

#include <algorithm>
#include <cmath>

#include "engine/core/check.h"

namespace ag {
namespace {

constexpr double kTau = 6.283185307179586;
constexpr float kFade = 0.02f;       // s before the end
constexpr float kInaudible = 1e-4f;  // of a partial's strength: it is over
constexpr double kStep = 1.0 / kToneRate;

// Half a cosine from 0 to 1.
float eased(float t) {
    return 0.5f - 0.5f * std::cos(float(kTau / 2) * std::clamp(t, 0.0f, 1.0f));
}

// White noise through two low passes.
struct SoftNoise {
    uint32_t state = 1;
    float first = 0, second = 0;
    float next(double frequency) {
        state = state * 1664525u + 1013904223u;
        const float white = float(int32_t(state)) / 2147483648.0f;
        const float share = float(1 - std::exp(-kTau * frequency * kStep));
        first += share * (white - first);
        return second += share * (first - second);
    }
};

void addPartial(std::vector<float>& samples, const Partial& p) {
    const auto begin = size_t(p.delay * float(kToneRate));
    if (begin >= samples.size()) return;
    const double left = double(samples.size() - begin) * kStep;
    const double bend = p.glideTo > 0 ? std::pow(double(p.glideTo / p.frequency), kStep / left) : 1;
    const float fall = std::pow(0.001f, float(kStep) / p.decay);
    double frequency = double(p.frequency), phase = 0;
    float strength = p.gain;
    SoftNoise noise;
    for (size_t i = begin; i < samples.size() && strength > p.gain * kInaudible; ++i) {
        const float rise = float(double(i - begin) * kStep) / p.attack;
        const float wave = p.kind == PartialKind::kNoise ? noise.next(frequency) : float(std::sin(phase));
        samples[i] += wave * strength * (rise < 1 ? eased(rise) : 1);
        phase += kTau * frequency * kStep;
        frequency *= bend;
        if (rise >= 1) strength *= fall;
    }
}

void scaleToPeak(std::vector<float>& samples, float peak) {
    float most = 0;
    for (const float sample : samples)
        most = std::max(most, std::abs(sample));
    for (float& sample : samples)
        sample *= most > 0 ? peak / most : 0;
}

void addSteadySine(std::vector<float>& samples, const Partial& p) {
    const auto length = double(samples.size());
    const double periods = std::max(std::round(double(p.frequency) * length * kStep), 1.0);
    for (size_t i = 0; i < samples.size(); ++i)
        samples[i] += p.gain * float(std::sin(kTau * periods * double(i) / length));
}

// What follows the end is mixed into the beginning: both are noise, so that their powers add up to one.
void addSteadyNoise(std::vector<float>& samples, const Partial& p) {
    const size_t overlap = samples.size() / 4;
    SoftNoise noise;
    for (size_t i = 0; i < overlap; ++i)
        noise.next(double(p.frequency));  // it starts from silence
    std::vector<float> wave(samples.size() + overlap);
    for (float& sample : wave)
        sample = noise.next(double(p.frequency));
    for (size_t i = 0; i < overlap; ++i) {
        const float t = float(kTau / 4) * float(i) / float(overlap);
        wave[i] = std::sin(t) * wave[i] + std::cos(t) * wave[samples.size() + i];
    }
    for (size_t i = 0; i < samples.size(); ++i)
        samples[i] += p.gain * wave[i];
}

}  // namespace

std::vector<float> renderLoop(const Tone& tone) {
    AG_CHECK_MSG(tone.seconds > 2 * kFade && tone.peak <= 1, "a tone has a length and a bounded peak");
    std::vector<float> samples(size_t(tone.seconds * float(kToneRate)));
    for (const Partial& partial : tone.partials)
        partial.kind == PartialKind::kNoise ? addSteadyNoise(samples, partial)
                                            : addSteadySine(samples, partial);
    scaleToPeak(samples, tone.peak);
    return samples;
}

std::vector<float> renderTone(const Tone& tone) {
    AG_CHECK_MSG(tone.seconds > 2 * kFade && tone.peak <= 1, "a tone has a length and a bounded peak");
    std::vector<float> samples(size_t(tone.seconds * float(kToneRate)));
    for (const Partial& partial : tone.partials)
        addPartial(samples, partial);
    for (size_t i = 0; i < samples.size(); ++i) {
        const auto left = float(samples.size() - 1 - i) / float(kToneRate);
        if (left < kFade) samples[i] *= eased(left / kFade);
    }
    scaleToPeak(samples, tone.peak);
    return samples;
}

}  // namespace ag
