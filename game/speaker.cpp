#include "game/speaker.h"

#include <utility>

#include "engine/core/log.h"

namespace ag::game {

void Speaker::open() {
    auto mixer = Mixer::open();
    if (mixer) {
        mixer_ = std::move(*mixer);
        const std::vector<Tone> rooms = roomTones();
        rooms_ = uint32_t(rooms.size());
        mixer_->load(gameTones(), rooms);
    } else if (!std::exchange(toldOf_, true)) {
        spdlog::info("no sound: {}", mixer.error().message);
    }
}

void Speaker::setVolume(float volume) {
    if (volume == volume_) return;
    if (volume > 0 && volume_ == 0) open();
    if (volume == 0) mixer_.reset();
    if (mixer_) mixer_->setVolume(volume * volume);  // even steps to the ear
    volume_ = volume;
}

void Speaker::play(std::span<const Sound> sounds) {
    if (!mixer_) return;
    for (const Sound& sound : sounds)
        mixer_->play(sound);
}

void Speaker::standIn(int32_t room, float seconds) {
    if (!mixer_) return;
    mixer_->surroundWith(uint32_t(room) < rooms_ ? std::optional(uint32_t(room)) : std::nullopt);
    mixer_->fade(seconds);
}

void Speaker::listenFrom(const CameraPose& eyes) {
    if (mixer_) mixer_->listenAt(eyes.position, eyes.forward);
}

}  // namespace ag::game
