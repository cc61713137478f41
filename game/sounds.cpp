#include "game/sounds.h"

#include <array>

namespace ag::game {
namespace {

constexpr float kC4 = 261.63f, kE4 = 329.63f, kG4 = 392.00f, kC5 = 523.25f, kE5 = 659.26f, kG5 = 783.99f,
                kC6 = 1046.50f;  // Hz

// A struck bell: its own note and two above it that die sooner.
void addBell(Tone& tone, float frequency, float delay, float gain, float decay) {
    tone.partials.push_back({.frequency = frequency, .gain = gain, .delay = delay, .decay = decay});
    tone.partials.push_back(
        {.frequency = frequency * 2, .gain = 0.35f * gain, .delay = delay, .decay = decay * 0.6f});
    tone.partials.push_back(
        {.frequency = frequency * 3.01f, .gain = 0.12f * gain, .delay = delay, .decay = decay * 0.3f});
}

// Three notes up.
Tone bloom() {
    Tone tone{.seconds = 1.6f, .peak = 0.55f};
    addBell(tone, kC5, 0, 0.7f, 0.7f);
    addBell(tone, kG5, 0.11f, 0.8f, 0.9f);
    addBell(tone, kC6, 0.22f, 1, 1.3f);
    return tone;
}

// Dull, and down by a fifth and more.
Tone shut() {
    return {.seconds = 0.9f,
            .peak = 0.5f,
            .partials = {{.frequency = 330, .glideTo = 150, .attack = 0.04f, .decay = 1.0f},
                         {.frequency = 660, .glideTo = 290, .gain = 0.15f, .attack = 0.04f, .decay = 0.6f}}};
}

// Stone on stone under a low swell; as long as the door takes.
Tone door() {
    return {
        .seconds = 1.9f,
        .peak = 0.6f,
        .partials = {
            {.frequency = 65, .glideTo = 98, .attack = 0.7f, .decay = 3},
            {.frequency = 131, .glideTo = 196, .gain = 0.4f, .attack = 0.8f, .decay = 2.5f},
            {.frequency = 180, .gain = 1.5f, .attack = 0.5f, .decay = 2.5f, .kind = PartialKind::kNoise}}};
}

// A soft chord, its notes one after the other like the lights.
Tone lanterns() {
    Tone tone{.seconds = 2.8f, .peak = 0.4f};
    float delay = 0;
    for (const float note : {kC4, kE4, kG4, kC5, kE5}) {
        tone.partials.push_back({.frequency = note, .delay = delay, .attack = 0.25f, .decay = 3.5f});
        tone.partials.push_back(
            {.frequency = note * 2.003f, .gain = 0.15f, .delay = delay, .attack = 0.3f, .decay = 2.5f});
        delay += 0.18f;
    }
    return tone;
}

Tone finished() {
    Tone tone{.seconds = 3.2f, .peak = 0.6f};
    float delay = 0;
    for (const float note : {kC5, kE5, kG5, kC6, kG5, kC6}) {
        addBell(tone, note, delay, 0.8f, 1.6f);
        delay += 0.2f;
    }
    tone.partials.push_back({.frequency = kC4, .gain = 0.6f, .attack = 0.6f, .decay = 3});
    return tone;
}

// A thud: a falling low note and a breath of noise.
Tone thud(float seconds, float peak, float low, float noiseBelow, float noise) {
    return {.seconds = seconds,
            .peak = peak,
            .partials = {{.frequency = low * 1.6f, .glideTo = low, .attack = 0.003f, .decay = seconds * 0.9f},
                         {.frequency = noiseBelow,
                          .gain = noise,
                          .attack = 0.002f,
                          .decay = seconds * 0.5f,
                          .kind = PartialKind::kNoise}}};
}

Tone slide(float from, float to) {
    return {
        .seconds = 0.16f,
        .peak = 0.4f,
        .partials = {
            {.frequency = from, .glideTo = to, .attack = 0.02f, .decay = 0.2f},
            {.frequency = 900, .gain = 0.6f, .attack = 0.01f, .decay = 0.1f, .kind = PartialKind::kNoise}}};
}

Tone click() {
    return {.seconds = 0.06f,
            .peak = 0.35f,
            .partials = {{.frequency = kC6, .attack = 0.002f, .decay = 0.05f},
                         {.frequency = 2 * kC6, .gain = 0.3f, .attack = 0.001f, .decay = 0.03f}}};
}

Tone toneOf(SoundId id) {
    switch (id) {
        case SoundId::kBloom:
            return bloom();
        case SoundId::kShut:
            return shut();
        case SoundId::kDoor:
            return door();
        case SoundId::kLanterns:
            return lanterns();
        case SoundId::kFinished:
            return finished();
        case SoundId::kStep:
            return thud(0.12f, 0.35f, 90, 700, 2);
        case SoundId::kLanding:
            return thud(0.2f, 0.5f, 65, 500, 2.5f);
        case SoundId::kPickUp:
            return slide(190, 280);
        case SoundId::kPutDown:
            return slide(250, 160);
        case SoundId::kKnock:
            return thud(0.22f, 0.7f, 120, 1200, 3);
        case SoundId::kClick:
            return click();
    }
    return {};
}

}  // namespace

std::vector<Tone> gameTones() {
    std::vector<Tone> tones;
    for (uint32_t id = 0; id <= uint32_t(SoundId::kClick); ++id)
        tones.push_back(toneOf(SoundId(id)));
    return tones;
}

// A hush and, hardly heard, notes of the room's own; what is of stone sounds low, what is open high.
std::vector<Tone> roomTones() {
    struct Air {
        float hush;                  // Hz, above which it is damped
        std::array<float, 2> notes;  // Hz
        float share;                 // of the notes
    };
    static constexpr Air kRooms[] = {{220, {98.0f, 147.2f}, 0.10f},       // of the first light
                                     {320, {196.0f, 246.9f}, 0.09f},      // of colours
                                     {130, {65.4f, 98.2f}, 0.16f},        // of shadows
                                     {160, {73.4f, 146.0f}, 0.12f},       // of moving paint
                                     {260, {110.0f, 164.8f}, 0.10f},      // of mixing
                                     {420, {100.0f, 300.0f}, 0.14f},      // of signs: mains hum
                                     {110, {55.0f, 82.4f}, 0.12f},        // of the night
                                     {700, {174.6f, 261.6f}, 0.05f},      // greenhouse
                                     {1100, {2093.0f, 2105.0f}, 0.02f}};  // garden: wind, and a cricket
    std::vector<Tone> tones;
    for (const Air& air : kRooms)
        tones.push_back({.seconds = 6,
                         .peak = 0.16f,
                         .partials = {{.frequency = air.hush, .gain = 8, .kind = PartialKind::kNoise},
                                      {.frequency = air.notes[0], .gain = air.share},
                                      {.frequency = air.notes[1], .gain = air.share * 0.6f}}});
    return tones;
}

Sound soundOf(SoundId id, float gain, float pitch) {
    return {.tone = uint32_t(id), .gain = gain, .pitch = pitch};
}

Sound soundAt(glm::dvec3 position, SoundId id, float gain, float pitch) {
    return {.tone = uint32_t(id), .gain = gain, .pitch = pitch, .placed = true, .position = position};
}

}  // namespace ag::game
