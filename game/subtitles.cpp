#include "game/subtitles.h"

#include <algorithm>
#include <cmath>

namespace ag::game {
namespace {

constexpr size_t kMostLines = 3;
constexpr double kAtHand = 0.8;  // m: nearer than that there is no side

const char* wordsFor(SoundId id) {
    switch (id) {
        case SoundId::kBloom:
            return "a flower chimes, open";
        case SoundId::kShut:
            return "a flower falls shut";
        case SoundId::kDoor:
            return "a door sinks";
        case SoundId::kLanterns:
            return "lanterns wake";
        case SoundId::kFinished:
            return "a melody";
        case SoundId::kKnock:
            return "something knocks";
        default:
            return nullptr;
    }
}

// By quarters about the way the eyes look.
const char* sideOf(glm::dvec3 place, const CameraPose& eyes) {
    const glm::dvec3 way = place - eyes.position;
    if (std::hypot(way.x, way.z) < kAtHand) return "";
    const glm::dvec2 ahead(eyes.forward.x, eyes.forward.z), to(way.x, way.z);
    const double along = glm::dot(ahead, to), aside = ahead.x * to.y - ahead.y * to.x;
    if (std::abs(along) >= std::abs(aside)) return along > 0 ? ", ahead" : ", behind";
    return aside > 0 ? ", on the right" : ", on the left";
}

}  // namespace

void Subtitles::hear(std::span<const Sound> sounds, const CameraPose& eyes, double seconds) {
    std::erase_if(heard_, [&](const Line& line) { return line.until <= seconds; });
    for (const Sound& sound : sounds) {
        const char* words = wordsFor(SoundId(sound.tone));
        if (!words) continue;
        const std::string text = std::string(words) + (sound.placed ? sideOf(sound.position, eyes) : "");
        std::erase_if(heard_, [&](const Line& line) { return line.text == text; });
        heard_.push_back({text, seconds + kSeconds});
    }
    if (heard_.size() > kMostLines) heard_.erase(heard_.begin(), heard_.end() - kMostLines);
}

std::vector<std::string> Subtitles::lines(double seconds) const {
    std::vector<std::string> lines;
    for (const Line& line : heard_)
        if (line.until > seconds) lines.push_back(line.text);
    return lines;
}

}  // namespace ag::game
