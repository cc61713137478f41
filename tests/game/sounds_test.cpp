// What the game sounds like, and what is heard of the world: a recorder in the mixer's place.
#include "game/sounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/renderer/probe_components.h"
#include "game/game.h"
#include "game/systems/grow_flowers.h"
#include "game/systems/make_sounds.h"
#include "tests/game/level.h"

namespace ag::game {
namespace {

// The game with ears: keeps what the mixer would have been given.
struct Listener {
    Game game{level(), 1};
    std::vector<Sound> heard;

    explicit Listener(int settle = 120) {
        for (int i = 0; i < settle; ++i)
            tick();
        heard.clear();
    }
    void tick(const Input& input = {}) {
        game.tick(input);
        for (const Sound& sound : game.sounds())
            heard.push_back(sound);
    }
    void ticks(int count, const Input& input = {}) {
        for (int i = 0; i < count; ++i)
            tick(input);
    }
    int count(SoundId id) const { return int(std::ranges::count(heard, uint32_t(id), &Sound::tone)); }
    Sound first(SoundId id) const { return *std::ranges::find(heard, uint32_t(id), &Sound::tone); }
    SystemTime now() { return {game.world().version(), 0}; }
};

// The light that a room's flowers want, for a tick.
void light(Listener& l, int32_t room) {
    View<const Flower, render::ProbeLight>(l.game.world(), l.now())
        .each([&](const Flower& f, render::ProbeLight& p) {
            if (f.room == room) p = {{}, f.wants * (4 * f.amount), 1};
        });
}

int flowersOf(Listener& l, int32_t room) {
    int count = 0;
    View<const Flower>(l.game.world(), {}).each([&](const Flower& f) { count += f.room == room; });
    return count;
}

TEST(Sounds, AreShortAndClean) {
    const std::vector<Tone> tones = gameTones();
    ASSERT_EQ(tones.size(), size_t(SoundId::kClick) + 1);
    for (size_t i = 0; i < tones.size(); ++i) {
        const std::vector<float> samples = renderTone(tones[i]);
        EXPECT_LE(samples.size(), size_t(3.5 * kToneRate)) << i;
        float most = 0;
        for (const float s : samples)
            most = std::max(most, std::abs(s));
        EXPECT_LE(most, 1) << i;
        EXPECT_GE(most, 0.2f) << i;
        EXPECT_EQ(samples.front(), 0) << i;
        EXPECT_EQ(samples.back(), 0) << i;
    }
}

TEST(Sounds, ChimesOfARoomDiffer) {
    EXPECT_LT(bloomPitch({1, 0.1f, 0.05f}, 0), bloomPitch({0.1f, 0.2f, 1}, 0)) << "red below blue";
    EXPECT_LT(bloomPitch({1, 1, 1}, 0), bloomPitch({1, 1, 1}, 1)) << "the second above the first";
    for (int place = 0; place < 30; ++place) {
        EXPECT_GE(bloomPitch({1, 0, 0}, place), 0.5f);
        EXPECT_LE(bloomPitch({0, 0, 1}, place), 16);
    }
}

TEST(Sounds, NothingChangesAndNothingIsHeard) {
    Listener l;
    l.ticks(10000);
    EXPECT_TRUE(l.heard.empty()) << "first: " << l.heard[0].tone;
    EXPECT_LE(l.game.sounds().size(), 32u);
}

TEST(Sounds, AFlowerOpensWithOneChimeAtItsPlace) {
    Listener l;
    glm::dvec3 place(0);
    Entity flower;
    View<const Flower, const LocalTransform>(l.game.world(), {})
        .each([&](Entity e, const Flower& f, const LocalTransform& at) {
            if (f.room == 1 && f.wants.z > 2 * f.wants.x) flower = e, place = at.translation;
        });
    l.game.world().resource<Player>().body.feet = {0, 0, -14};  // flowers open where somebody is
    l.ticks(60);
    l.heard.clear();
    for (int i = 0; i < 400; ++i) {
        const Flower f = *l.game.world().get<Flower>(flower);
        *l.game.world().write<render::ProbeLight>(flower) = {{}, f.wants * (4 * f.amount), 1};
        l.tick();
    }
    EXPECT_EQ(l.heard.size(), 1u);
    ASSERT_EQ(l.count(SoundId::kBloom), 1);
    EXPECT_TRUE(l.first(SoundId::kBloom).placed);
    EXPECT_LT(glm::length(l.first(SoundId::kBloom).position - place), 1);
    EXPECT_FLOAT_EQ(l.first(SoundId::kBloom).pitch, bloomPitch(l.game.world().get<Flower>(flower)->wants, 1));
    // The beam closes it, and is heard doing so once.
    l.heard.clear();
    for (int i = 0; i < 200; ++i) {
        *l.game.world().write<render::ProbeLight>(flower) = {glm::vec3(1), {}, 1};
        l.tick();
    }
    EXPECT_EQ(l.heard.size(), 1u);
    EXPECT_EQ(l.count(SoundId::kShut), 1);
}

TEST(Sounds, ASolvedRoomWakesItsLanternsAndOpensItsDoor) {
    Listener l;
    for (int i = 0; i < 400; ++i) {
        light(l, 0);
        l.tick();
    }
    EXPECT_EQ(l.count(SoundId::kBloom), flowersOf(l, 0));
    EXPECT_EQ(l.count(SoundId::kLanterns), 1);
    EXPECT_EQ(l.count(SoundId::kDoor), 1);
    EXPECT_NEAR(l.first(SoundId::kDoor).position.z, -8.15, 0.5);
    EXPECT_EQ(l.count(SoundId::kFinished), 0);
}

TEST(Sounds, FeetAreHeardByTheWayTheyWalk) {
    Listener l;
    l.game.world().resource<Player>().body.feet = {0, 0, -1.2};
    l.tick();
    const double from = l.game.player().position.z;
    l.ticks(90, {.forward = 1});
    const double way = std::abs(l.game.player().position.z - from);
    EXPECT_NEAR(l.count(SoundId::kStep), way / kStride, 1.1) << way << " m";
    l.ticks(30);  // comes to a stand
    l.heard.clear();
    l.ticks(60);
    EXPECT_EQ(l.heard.size(), 0u) << "stands, tone " << l.heard[0].tone;
    l.tick({.buttons = kButtonJump});
    l.ticks(90);
    EXPECT_EQ(l.count(SoundId::kLanding), 1);
    EXPECT_EQ(l.heard.size(), 1u) << "tones " << l.heard[0].tone << ", " << l.heard.back().tone;
}

TEST(Sounds, CratesAreHeardInHandsAndOnTheFloor) {
    Listener l;
    l.game.world().resource<Player>().body.feet = {-1.9, 0, -0.75};
    l.tick({.look = {-628 - 62, 120}});  // to the stack at -x
    l.ticks(20);
    l.heard.clear();
    l.tick({.buttons = kButtonUse});
    EXPECT_EQ(l.count(SoundId::kPickUp), 1);
    l.ticks(60, {.forward = -1});
    l.ticks(60);
    l.heard.clear();
    l.tick({.buttons = kButtonUse});
    l.ticks(120);
    EXPECT_EQ(l.count(SoundId::kPutDown), 1);
    EXPECT_GE(l.count(SoundId::kKnock), 1) << "it falls on the floor";
    EXPECT_LE(l.count(SoundId::kKnock), 4);
}

// All dynamic bodies are thrown about each tick: the loudest is heard, a few times a second.
TEST(Sounds, ContactsAreLimited) {
    Listener l;
    PhysicsWorld& physics = *l.game.world().resource<Physics>().world;
    for (int i = 0; i < 300; ++i) {
        View<const Body, const BodyState>(l.game.world(), {}).each([&](const Body& b, const BodyState& s) {
            if (b.kind == BodyKind::kDynamic) physics.push(s.body, {0, i % 2 ? 60 : -60, 0}, s.position);
        });
        l.tick();
    }
    EXPECT_GT(l.count(SoundId::kKnock), 10);
    EXPECT_LE(l.count(SoundId::kKnock), int(300 / 60.0 / kKnockGap) + 1);
    for (const Sound& sound : l.heard) {
        EXPECT_LE(sound.gain, 1);
        EXPECT_GT(sound.gain, 0);
    }
}

TEST(Sounds, ThousandsOfTicksOfPlayNeedNoMoreRoom) {
    Listener l(0);
    size_t most = 0;
    for (int i = 0; i < 10000; ++i) {
        l.game.tick({.forward = i / 50 % 3 ? 1.0f : -1.0f,
                     .right = i / 70 % 2 ? 0.6f : 0,
                     .look = {float(i / 40 % 7) - 3, float(i % 11) - 5},
                     .buttons = uint32_t(i / 90 % 16)});
        most = std::max(most, l.game.sounds().size());
    }
    EXPECT_LE(most, 8u);
    EXPECT_EQ(l.game.world().resource<Sounds>().now.capacity(), 32u);
}

}  // namespace
}  // namespace ag::game
