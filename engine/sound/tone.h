// Short sounds computed from a description, so that no files are needed: sines and soft noise that rise,
// glide and die away. Each starts and ends at exactly zero, so that nothing clicks.
#pragma once

#include <cstdint>
#include <vector>

namespace ag {

constexpr uint32_t kToneRate = 44100;  // samples/s

enum class PartialKind : uint32_t { kSine, kNoise };

struct Partial {
    float frequency = 440;  // Hz where it starts; of noise: what lies above is damped
    float glideTo = 0;      // Hz at the tone's end, evenly in pitch; 0: it stays
    float gain = 1;         // among the partials
    float delay = 0;        // s
    float attack = 0.005f;  // s to full strength
    float decay = 0.5f;     // s from there to a thousandth
    PartialKind kind = PartialKind::kSine;
};

struct Tone {
    float seconds = 1;
    float peak = 0.8f;  // of its loudest sample, at most 1
    std::vector<Partial> partials;
};

// One channel, -1 to 1. The same tone gives the same samples.
std::vector<float> renderTone(const Tone& tone);
// The same without an end: after its last sample comes its first. Partials sound as at full strength all the
// time; sines are tuned to whole periods, noise fades over into its own beginning.
std::vector<float> renderLoop(const Tone& tone);

}  // namespace ag
