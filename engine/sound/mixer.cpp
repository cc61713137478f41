#include "engine/sound/mixer.h"

#include <AL/al.h>
#include <AL/alc.h>
#include <AL/alext.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/core/check.h"
#include "engine/sound/quiet_errors.h"

namespace ag {
namespace {

constexpr float kNear = 2;  // m, where a sound has its full strength; twice as far: half of it
constexpr float kFar = 40;  // m, from where on it gets no weaker

struct Voice {
    ALuint source = 0;
    float gain = 0;
    bool placed = false;
    glm::dvec3 position{0};
};

struct Surrounding {  // a loop that comes or goes
    ALuint source = 0;
    float gain = 0;  // now
    bool wanted = false;
};

bool isPlaying(const Voice& voice) {
    ALint state = AL_STOPPED;
    alGetSourcei(voice.source, AL_SOURCE_STATE, &state);
    return state == AL_PLAYING;
}

std::vector<ALshort> toShorts(const std::vector<float>& samples) {
    std::vector<ALshort> out(samples.size());
    std::ranges::transform(samples, out.begin(),
                           [](float s) { return ALshort(std::lround(std::clamp(s, -1.0f, 1.0f) * 32767)); });
    return out;
}

std::vector<ALuint> makeBuffers(std::span<const Tone> tones, std::vector<float> (*render)(const Tone&)) {
    std::vector<ALuint> buffers(tones.size());
    alGenBuffers(ALsizei(tones.size()), buffers.data());
    for (size_t i = 0; i < tones.size(); ++i) {
        const std::vector<ALshort> samples = toShorts(render(tones[i]));
        alBufferData(buffers[i], AL_FORMAT_MONO16, samples.data(), ALsizei(samples.size() * sizeof(ALshort)),
                     ALsizei(kToneRate));
    }
    return buffers;
}

template <class F>
F loopbackFunction(const char* name) {
    return reinterpret_cast<F>(alcGetProcAddress(nullptr, name));
}

}  // namespace

struct Mixer::Impl {
    ALCdevice* device = nullptr;
    ALCcontext* context = nullptr;
    std::array<Voice, kVoices> voices;
    std::vector<ALuint> buffers;
    std::vector<Surrounding> surroundings;  // by loop
    std::vector<ALuint> loops;
    glm::dvec3 ear{0};

    ~Impl() {
        if (context) {
            for (const Voice& voice : voices)
                alDeleteSources(1, &voice.source);
            for (const Surrounding& surrounding : surroundings)
                alDeleteSources(1, &surrounding.source);
            alDeleteBuffers(ALsizei(buffers.size()), buffers.data());
            alDeleteBuffers(ALsizei(loops.size()), loops.data());
            alcMakeContextCurrent(nullptr);
            alcDestroyContext(context);
        }
        if (device) alcCloseDevice(device);
    }
    // Places are relative to the ear: exact however far the world reaches.
    void place(const Voice& voice) const {
        const glm::vec3 p = voice.placed ? glm::vec3(voice.position - ear) : glm::vec3(0);
        alSource3f(voice.source, AL_POSITION, p.x, p.y, p.z);
    }
    Status start(const ALCint* attributes) {
        context = alcCreateContext(device, attributes);
        if (!context || !alcMakeContextCurrent(context)) return Error{"the sound device takes no context"};
        alDistanceModel(AL_INVERSE_DISTANCE_CLAMPED);
        for (Voice& voice : voices) {
            alGenSources(1, &voice.source);
            alSourcef(voice.source, AL_REFERENCE_DISTANCE, kNear);
            alSourcef(voice.source, AL_MAX_DISTANCE, kFar);
        }
        if (alGetError() != AL_NO_ERROR) return Error{"the sound device has too few voices"};
        return Ok{};
    }
    // A free voice, or the quietest if the new sound is louder; null if there is none.
    Voice* voiceFor(float gain) {
        for (Voice& voice : voices)
            if (!isPlaying(voice)) return &voice;
        Voice& quietest = *std::ranges::min_element(voices, {}, &Voice::gain);
        return quietest.gain < gain ? &quietest : nullptr;
    }
};

Mixer::Mixer(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Mixer::~Mixer() = default;

Result<std::unique_ptr<Mixer>> Mixer::open() {
    const QuietErrors quiet;
    auto impl = std::make_unique<Impl>();
    impl->device = alcOpenDevice(nullptr);
    if (!impl->device) return Error{"there is no sound device"};
    if (const Status started = impl->start(nullptr); !started) return started.error();
    return std::unique_ptr<Mixer>(new Mixer(std::move(impl)));
}

Result<std::unique_ptr<Mixer>> Mixer::openToMemory() {
    const auto openDevice = loopbackFunction<LPALCLOOPBACKOPENDEVICESOFT>("alcLoopbackOpenDeviceSOFT");
    auto impl = std::make_unique<Impl>();
    impl->device = openDevice ? openDevice(nullptr) : nullptr;
    if (!impl->device) return Error{"this OpenAL does not mix into memory"};
    const ALCint attributes[] = {ALC_FORMAT_CHANNELS_SOFT,
                                 ALC_STEREO_SOFT,
                                 ALC_FORMAT_TYPE_SOFT,
                                 ALC_FLOAT_SOFT,
                                 ALC_FREQUENCY,
                                 ALCint(kToneRate),
                                 ALC_HRTF_SOFT,
                                 ALC_FALSE,
                                 0};
    if (const Status started = impl->start(attributes); !started) return started.error();
    return std::unique_ptr<Mixer>(new Mixer(std::move(impl)));
}

void Mixer::load(std::span<const Tone> tones, std::span<const Tone> loops) {
    AG_CHECK_MSG(impl_->buffers.empty(), "tones are loaded once");
    impl_->buffers = makeBuffers(tones, renderTone);
    impl_->loops = makeBuffers(loops, renderLoop);
    impl_->surroundings.resize(loops.size());
    for (size_t i = 0; i < loops.size(); ++i) {
        ALuint& source = impl_->surroundings[i].source;
        alGenSources(1, &source);
        alSourcei(source, AL_BUFFER, ALint(impl_->loops[i]));
        alSourcei(source, AL_LOOPING, AL_TRUE);
        alSourcei(source, AL_SOURCE_RELATIVE, AL_TRUE);
    }
    // A device with few voices keeps them for sounds.
    if (alGetError() == AL_NO_ERROR) return;
    for (const Surrounding& surrounding : impl_->surroundings)
        alDeleteSources(1, &surrounding.source);
    impl_->surroundings.clear();
    alGetError();
}

void Mixer::surroundWith(std::optional<uint32_t> loop) {
    for (size_t i = 0; i < impl_->surroundings.size(); ++i)
        impl_->surroundings[i].wanted = loop == i;
}

void Mixer::fade(float seconds) {
    for (Surrounding& s : impl_->surroundings) {
        const float before = s.gain, step = seconds / kFadeSeconds;
        s.gain = std::clamp(s.gain + (s.wanted ? step : -step), 0.0f, 1.0f);
        if (s.gain == before) continue;
        alSourcef(s.source, AL_GAIN, s.gain);
        if (before == 0) alSourcePlay(s.source);
        if (s.gain == 0) alSourceStop(s.source);
    }
}

void Mixer::play(const Sound& sound) {
    AG_CHECK_LT(sound.tone, impl_->buffers.size());
    Voice* voice = impl_->voiceFor(sound.gain);
    if (!voice) return;
    voice->gain = sound.gain;
    voice->placed = sound.placed;
    voice->position = sound.position;
    alSourceStop(voice->source);
    alSourcei(voice->source, AL_BUFFER, ALint(impl_->buffers[sound.tone]));
    alSourcef(voice->source, AL_GAIN, sound.gain);
    alSourcef(voice->source, AL_PITCH, sound.pitch);
    alSourcei(voice->source, AL_SOURCE_RELATIVE, sound.placed ? AL_FALSE : AL_TRUE);
    impl_->place(*voice);
    alSourcePlay(voice->source);
}

void Mixer::listenAt(glm::dvec3 position, glm::vec3 forward) {
    impl_->ear = position;
    const ALfloat axes[] = {forward.x, forward.y, forward.z, 0, 1, 0};
    alListenerfv(AL_ORIENTATION, axes);
    for (const Voice& voice : impl_->voices)
        impl_->place(voice);
}

void Mixer::setVolume(float gain) {
    alListenerf(AL_GAIN, gain);
}

uint32_t Mixer::voicesPlaying() const {
    return uint32_t(std::ranges::count_if(impl_->voices, isPlaying));
}

void Mixer::mix(std::span<float> stereo) {
    static const auto render = loopbackFunction<LPALCRENDERSAMPLESSOFT>("alcRenderSamplesSOFT");
    render(impl_->device, stereo.data(), ALCsizei(stereo.size() / 2));
}

}  // namespace ag
