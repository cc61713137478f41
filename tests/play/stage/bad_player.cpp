#include "tests/play/stage/bad_player.h"

#include <algorithm>
#include <cmath>

#include "game/systems/grow_flowers.h"

namespace ag::game {
namespace {

constexpr double kWorstAim = 0.1745;  // rad: 10°
constexpr float kSurelyDirect = 1;    // W/m², beyond any beam's soft edge
constexpr double kGot = 0.4;          // m: it got away
constexpr int kAimTicks = 24, kWalkTicks = 40;

}  // namespace

BadPlayer::BadPlayer(Stage& stage, uint32_t seed) : stage_(stage), bot_(stage), random_(seed) {
    bot_.wait(1);
    room_ = stage.game.progress().room;
    for (size_t i = 0; i < stage.flowers.size(); ++i)
        before_.push_back(stage.flower(i));
    stage.watch = [this] { check(); };
}

BadPlayer::~BadPlayer() {
    stage_.watch = [] {};
}

double BadPlayer::random(double least, double most) {
    return least + (most - least) * double(random_() >> 8) * 0x1p-24;
}

void BadPlayer::check() {
    for (size_t i = 0; i < stage_.flowers.size(); ++i) {
        const Flower now = stage_.flower(i);
        const glm::vec3 direct = stage_.lightAt(i).direct;
        if (std::max({direct.x, direct.y, direct.z}) > kSurelyDirect && now.room == room_) {
            ++direct_;
            wrong_ += now.openness > before_[i].openness || (now.bloomed && !before_[i].bloomed);
        }
        before_[i] = now;
    }
}

// Off by up to 10° to the side and up.
void BadPlayer::aimNear(glm::dvec3 place) {
    const glm::dvec3 eyes = stage_.game.player().position, to = place - eyes;
    const double flat = std::hypot(to.x, to.z), yaw = std::atan2(to.x, -to.z) + random(-kWorstAim, kWorstAim),
                 pitch = std::clamp(std::atan2(to.y, flat) + random(-kWorstAim, kWorstAim), -1.2, 1.2);
    const glm::dvec3 aim =
        eyes + glm::dvec3(std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch));
    bot_.look(aim.x, aim.y, aim.z);
}

void BadPlayer::play(int ticks) {
    std::vector<size_t> here;
    for (size_t i = 0; i < stage_.flowers.size(); ++i)
        if (stage_.flower(i).room == room_) here.push_back(i);
    const uint64_t end = stage_.ticks + uint64_t(ticks);
    while (stage_.ticks < end) {
        const glm::dvec3 flower = stage_.flowerAt(here[random_() % here.size()]);
        const double side = random(0, 6.283), far = random(0.8, 3);
        bot_.lookAhead();
        bot_.walk(flower.x + far * std::cos(side), flower.z + far * std::sin(side), kWalkTicks);
        aimNear(flower);
        bot_.wait(kAimTicks);
        aimNear(flower + glm::dvec3(random(-1.5, 1.5), random(-0.7, 1), random(-1.5, 1.5)));
        bot_.press(kButtonUse);
        bot_.wait(kAimTicks);
    }
}

bool BadPlayer::canLeave() {
    bot_.hold(0);
    if (stage_.game.player().carried) bot_.press(kButtonUse);
    const glm::dvec3 start = stage_.game.player().position;
    bot_.lookAhead();
    for (const auto& [x, z] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
        bot_.walk(start.x + x, start.z + z, 60);
        const glm::dvec3 at = stage_.game.player().position;
        if (std::hypot(at.x - start.x, at.z - start.z) > kGot) return stage_.game.player().body.feet.y > -0.1;
    }
    return false;
}

}  // namespace ag::game
