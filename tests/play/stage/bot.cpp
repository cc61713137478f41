#include "tests/play/stage/bot.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

#include "engine/scene/components.h"
#include "game/systems/walk_player.h"

namespace ag::game {
namespace {

constexpr double kPixelsPerRadian = 400, kMostPixels = 28;  // a tick
constexpr double kTurned = 0.02;                            // rad: looks where it should

glm::dvec2 flat(glm::dvec3 p) {
    return {p.x, p.z};
}

// Pixels in steps of 1/4, so that the recording stays short and exact.
float pixels(double angle) {
    return float(std::round(std::clamp(angle * kPixelsPerRadian, -kMostPixels, kMostPixels) * 4) / 4);
}

}  // namespace

bool Bot::fail(const std::string& what) {
    if (tells_) std::cerr << fmt::format("tick {}: {}\n", inputs_.size(), what);
    failed_ = true;
    if (tells_)
        View<const BodyState, const Body, const Name>(stage_.game.world(), {})
            .each([&](const BodyState& s, const Body& b, const Name& name) {
                if (b.kind != BodyKind::kDynamic) return;
                const glm::vec3 x = s.rotation * glm::vec3(1, 0, 0);
                std::cerr << fmt::format("  {} at {:.2f} {:.2f} {:.2f}, +x looks {:.2f} {:.2f} {:.2f}\n",
                                         name.text, s.position.x, s.position.y, s.position.z, x.x, x.y, x.z);
            });
    return false;
}

// The mouse movement towards what it looks at, or towards where it goes.
glm::vec2 Bot::turn() const {
    const Player& p = stage_.game.player();
    glm::dvec3 to = target_ - p.position;
    if (!looksAt_) {
        if (heading_ == glm::dvec2(0)) return {0, 0};
        to = {heading_.x, -0.05, heading_.y};
    }
    const double yaw = std::atan2(to.x, -to.z), pitch = std::atan2(to.y, std::hypot(to.x, to.z));
    const double dyaw = std::remainder(yaw - double(p.yaw), 6.283185307179586),
                 dpitch = pitch - double(p.pitch);
    return {pixels(dyaw), -pixels(dpitch)};
}

void Bot::tick(glm::dvec2 way) {
    const Player& p = stage_.game.player();
    const glm::dvec2 ahead(std::sin(double(p.yaw)), -std::cos(double(p.yaw))), right(-ahead.y, ahead.x);
    const auto rounded = [](double v) { return float(std::round(v * 64) / 64); };
    Input input{.forward = rounded(glm::dot(way, ahead)),
                .right = rounded(glm::dot(way, right)),
                .look = turn(),
                .buttons = held_};
    inputs_.push_back(input);
    std::vector<bool> bloomed;
    for (size_t i = 0; tells_ && i < stage_.flowers.size(); ++i)
        bloomed.push_back(stage_.flower(i).bloomed);
    stage_.tick(input);
    for (size_t i = 0; i < bloomed.size(); ++i)
        if (bloomed[i] && !stage_.flower(i).bloomed)
            std::cerr << fmt::format("tick {}: flower {} closed again\n", inputs_.size(), i);
}

bool Bot::walk(double x, double z, int mostTicks, double tolerance) {
    for (int i = 0; i < mostTicks; ++i) {
        const glm::dvec2 way = glm::dvec2(x, z) - flat(stage_.game.player().position);
        const double distance = glm::length(way);
        if (distance < tolerance) {
            heading_ = {};
            return true;
        }
        heading_ = way / distance;
        tick(heading_ * std::min(distance / 0.3, 1.0));
    }
    const glm::dvec3 at = stage_.game.player().position;
    return fail(fmt::format("wanted to walk to {:.2f} {:.2f}, stands at {:.2f} {:.2f}", x, z, at.x, at.z));
}

void Bot::look(double x, double y, double z) {
    target_ = {x, y, z};
    looksAt_ = true;
    for (int i = 0; i < 120 && (i == 0 || glm::length(turn()) > float(kTurned * kPixelsPerRadian)); ++i)
        tick({0, 0});
}

bool Bot::waitForFlower(size_t index, int mostTicks) {
    const int margin = 60;  // for other machines and longer frames
    render::ProbeLight best;
    for (int i = 0; i < mostTicks; ++i) {
        tick({0, 0});
        const Flower f = stage_.flower(index);
        const render::ProbeLight light = stage_.lightAt(index);
        if (light.bounced.x + light.bounced.y + light.bounced.z >=
            best.bounced.x + best.bounced.y + best.bounced.z)
            best = light;
        if (!f.bloomed) continue;
        wait(margin);
        if (tells_)
            std::cerr << fmt::format(
                "tick {}: flower {} open after {} ticks: bounced {:.3f} {:.3f} {:.3f} direct "
                "{:.3f}, wants {:.3f} of {:.2f} {:.2f} {:.2f}, match {:.3f}\n",
                inputs_.size(), index, i, light.bounced.x, light.bounced.y, light.bounced.z, light.direct.x,
                f.amount, f.wants.x, f.wants.y, f.wants.z, f.match);
        return true;
    }
    const Flower f = stage_.flower(index);
    return fail(fmt::format(
        "flower {} stays shut: openness {:.2f} mood {} bounced {:.3f} {:.3f} {:.3f} direct {:.3f} "
        "wants {:.3f}, match {:.3f}",
        index, f.openness, int(f.mood), best.bounced.x, best.bounced.y, best.bounced.z,
        stage_.lightAt(index).direct.x, f.amount, f.match));
}

bool Bot::waitForDoor(int room, int mostTicks) {
    for (int i = 0; i < mostTicks; ++i) {
        bool open = false;
        View<const Room>(stage_.game.world(), {}).each([&](const Room& r) {
            open = open || (r.index == room && r.solved && r.since > 1.7f);
        });
        if (open) {
            wait(60);  // it may open later elsewhere
            return true;
        }
        tick({0, 0});
    }
    return fail(fmt::format("the door of room {} stays shut", room));
}

void Bot::wait(int ticks) {
    for (int i = 0; i < ticks; ++i)
        tick({0, 0});
}

void Bot::press(uint32_t button) {
    const uint32_t before = held_;
    held_ |= button;
    wait(2);
    held_ = before;
    wait(2);
}

}  // namespace ag::game
