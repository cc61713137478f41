// Tones to the ear, by OpenAL Soft, of which nothing shows here. A sound with a place comes from there, as
// heard by whoever listens; the others are everywhere. One mixer at a time.
#pragma once

#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>

#include "engine/core/result.h"
#include "engine/sound/tone.h"

namespace ag {

struct Sound {          // one to be heard
    uint32_t tone = 0;  // of those that were loaded
    float gain = 1;     // 0 to 1
    float pitch = 1;    // times the tone's own
    bool placed = false;
    glm::dvec3 position{0};  // m, if it has a place
};

constexpr uint32_t kVoices = 24;  // at once; the quietest gives way to one that is louder

class Mixer {
  public:
    // What the machine plays sound on; the error names no device if there is none.
    static Result<std::unique_ptr<Mixer>> open();
    // Mixes only when asked, into memory.
    static Result<std::unique_ptr<Mixer>> openToMemory();
    ~Mixer();
    Mixer(const Mixer&) = delete;
    Mixer& operator=(const Mixer&) = delete;

    // Once; `loops` are those of surroundings.
    void load(std::span<const Tone> tones, std::span<const Tone> loops = {});
    void play(const Sound& sound);
    // What is heard all the time, from everywhere: fades over to it in `kFadeSeconds`, from whatever it was.
    // Nothing: to silence.
    void surroundWith(std::optional<uint32_t> loop);
    void fade(float seconds);  // so much time has passed
    static constexpr float kFadeSeconds = 2.5f;

    void listenAt(glm::dvec3 position, glm::vec3 forward);  // the head is upright
    void setVolume(float gain);                             // 0 to 1, of everything
    uint32_t voicesPlaying() const;

    // The next samples, left and right in turn, kToneRate a second; of a mixer to memory.
    void mix(std::span<float> stereo);

  private:
    struct Impl;
    explicit Mixer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace ag
