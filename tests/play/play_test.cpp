// The level played whole, with its light.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "game/contact_sheet.h"
#include "game/picture_check.h"
#include "game/save_game.h"
#include "tests/play/stage/bad_player.h"
#include "tests/play/stage/bot.h"
#include "tests/play/stage/reference_light.h"
#include "tests/support/device_environment.h"

namespace ag::game {
namespace {

constexpr uint32_t kTicksPerFrame = 12, kMoments = 20;

std::unique_ptr<Stage> makeStage() {
    return std::make_unique<Stage>(test::device(), shippedLevel(), kTicksPerFrame);
}

std::unique_ptr<Stage> play(std::span<const Input> inputs) {
    auto stage = makeStage();
    for (const Input& input : inputs)
        stage->tick(input);
    return stage;
}

std::unique_ptr<Stage> playWrong(const std::string& name) {
    const auto replay = loadReplay(AFTERGLOW_SOURCE_DIR "/tests/play/recordings/" + name + ".replay");
    EXPECT_TRUE(replay) << replay.error().message;
    return play(replay->ticks);
}

// Plays by script: what it waits for may come later than in the recording.
std::vector<Input> recordAnew() {
    const auto stage = makeStage();
    Bot bot(*stage, false);
    EXPECT_TRUE(playWalkthrough(bot));
    return bot.inputs();
}

constexpr size_t kShy = 15;
constexpr float kDarkness = 0.002f;  // W/m²
constexpr uint32_t kManyPaths = 1600;
constexpr uint32_t kBounces = 8;  // what more are there is less than a thousandth

// The shipped walkthrough, played once for all that is asked of it.
class Walkthrough : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        const auto replay = loadReplay(kRecording);
        ASSERT_TRUE(replay) << replay.error().message;
        inputs_ = replay->ticks;
        playInputs();
        if (stage_->game.progress().won) return;
        // A software device's arithmetic is its CPU's, and some flowers have just enough light.
        std::printf("the recording does not finish the level on this machine: it is played by script\n");
        inputs_ = recordAnew();
        playInputs();
    }
    static void TearDownTestSuite() {
        inputs_.clear();
        lit_.clear();
        stage_.reset();
    }
    static void row(const char* name, const render::RenderSettings& settings, std::span<const size_t> flowers,
                    uint32_t frames = 24);

    static void playInputs() {
        stage_ = makeStage();
        moments_.clear();
        const auto frames = uint32_t(inputs_.size()) / kTicksPerFrame;
        const ContactSheet sheet = ContactSheet::moments(kMoments, frames);
        stage_->watch = [&] {
            if (stage_->ticks % kTicksPerFrame == 0 &&
                sheet.wants(uint32_t(stage_->ticks / kTicksPerFrame) - 1))
                moments_.push_back(extremesOf(stage_->picture()));
        };
        lit_ = litFlowers(*stage_, inputs_);
        stage_->watch = [] {};
    }

    static constexpr const char* kRecording = AFTERGLOW_SOURCE_DIR "/game/level/walkthrough.replay";
    static inline std::vector<Input> inputs_;
    static inline std::unique_ptr<Stage> stage_;
    static inline std::vector<LitFlower> lit_;
    static inline std::vector<Extremes> moments_;
};

TEST_F(Walkthrough, OpensEveryFlowerAndEndsTheSameWayTwice) {
    const auto again = play(inputs_);
    for (Stage* stage : {stage_.get(), again.get()}) {
        const Progress& p = stage->game.progress();
        EXPECT_EQ(p.flowers, 19u);
        EXPECT_EQ(p.flowersOpen, 19u);
        EXPECT_EQ(p.roomsSolved, 8u);
        EXPECT_TRUE(p.won);
    }
    EXPECT_EQ(stage_->game.stateHash(), again->game.stateHash());
}

// Twenty moments, evenly over the walkthrough: none is mostly black or burnt out.
TEST_F(Walkthrough, IsNeitherBlackNorBurntOut) {
    ASSERT_EQ(moments_.size(), kMoments);
    for (size_t i = 0; i < moments_.size(); ++i) {
        EXPECT_LT(moments_[i].dark, kMostDark) << "moment " << i;
        EXPECT_LT(moments_[i].bright, kMostBright) << "moment " << i;
    }
}

float mean(glm::vec3 e) {
    return (e.x + e.y + e.z) / 3;
}

// Where the walkthrough lights a flower, its probe has what the path tracer has there of the first bounce.
TEST_F(Walkthrough, FlowersMeasureWhatThePathTracerMeasures) {
    ASSERT_EQ(lit_.size(), 19u);
    render::Renderer renderer(test::device());
    renderer.load(stage_->game.level().geometry);
    // Every fourth one, which takes half a minute; all by hand with AFTERGLOW_FLOWERS set.
    const size_t step = std::getenv("AFTERGLOW_FLOWERS") ? 1 : 4;
    for (size_t i = 0; i < lit_.size(); i += step) {
        const gi::ProbeReading measured = measureLight(renderer, lit_[i], {}, 24),
                               truth = referenceLight(lit_[i], 1);
        const glm::vec3 a = measured.bounced, b = truth.bounced;
        std::printf(
            "flower %zu: %.4f %.4f %.4f, the path tracer %.4f %.4f %.4f: %+.1f %%; direct %.4f, %.4f\n", i,
            a.x, a.y, a.z, b.x, b.y, b.z, 100 * (mean(a) / mean(b) - 1), mean(measured.direct),
            mean(truth.direct));
        // The truth of so few paths is off by a per cent itself; what the shy one has is next to none.
        const float bound = i == kShy ? kDarkness : 0.04f * mean(b);
        EXPECT_NEAR(mean(a), mean(b), bound) << "flower " << i;
        if (i == kShy) continue;
        EXPECT_GT(glm::dot(glm::normalize(a), glm::normalize(b)), 0.995f) << "flower " << i;
        EXPECT_NEAR(mean(measured.direct), mean(truth.direct), 0.02f) << "flower " << i;
    }
}

// A line of errors in percent, each of a renderer that starts anew.
void Walkthrough::row(const char* name, const render::RenderSettings& settings,
                      std::span<const size_t> flowers, uint32_t frames) {
    std::printf("%-28s", name);
    for (const size_t i : flowers) {
        render::Renderer renderer(test::device());
        renderer.load(stage_->game.level().geometry);
        const uint32_t bounces = settings.bounce.laterBounces.enabled ? kBounces : 1;
        const float truth =
            mean(referenceLight(lit_[i], bounces, !settings.bounce.ismAtlas.enabled, kManyPaths).bounced);
        const float light = mean(measureLight(renderer, lit_[i], settings, frames).bounced);
        std::printf(" %+6.1f", 100 * (light / truth - 1));
        std::fflush(stdout);
    }
    std::printf(" %%\n");
}

// By hand: which term a flower's error is in. AFTERGLOW_FLOWERS="1 8" prints a table of these.
TEST_F(Walkthrough, TellsWhichTermOfAFlowersLightIsOff) {
    const char* asked = std::getenv("AFTERGLOW_FLOWERS");
    if (!asked) return;
    std::istringstream numbers(asked);
    std::vector<size_t> flowers;
    for (size_t i = 0; numbers >> i && i < lit_.size();)
        flowers.push_back(i);
    std::printf("%-28s", "share that shadows leave");
    for (const size_t i : flowers)
        std::printf(" %6.1f", 100 * mean(referenceLight(lit_[i], 1).bounced) /
                                  mean(referenceLight(lit_[i], 1, true).bounced));
    std::printf(" %%\n");
    render::RenderSettings open, taps, views, clusters, maps, low, medium;
    open.bounce.ismAtlas.enabled = false;
    taps.bounce.probes.taps = 16;
    views.bounce.ismAtlas.tileSize = 128;
    views.bounce.ismAtlas.pointsPerMap = 16384;
    clusters.bounce.valClustering.count = 512;
    maps.bounce.rsm.resolution = 512;
    applyQuality(Quality::kLow, low);
    applyQuality(Quality::kMedium, medium);
    row("medium, all bounces, settled", medium, flowers, 60);
    row("default", {}, flowers);
    row("without shadows, both", open, flowers);
    row("low, all bounces", low, flowers);
    row("twice as long", {}, flowers, 48);
    row("16 taps", taps, flowers);
    row("512 clusters", clusters, flowers);
    row("RSMs of 512", maps, flowers);
    row("views of 128, 16384 points", views, flowers);
}

TEST(WrongRuns, TheDirectBeamOpensNothing) {
    const auto stage = playWrong("direct_beam");
    EXPECT_EQ(stage->flower(0).mood, FlowerMood::kBlinded);
    EXPECT_EQ(stage->flower(0).openness, 0);
    EXPECT_GT(stage->lightAt(0).direct.x, 1);
    EXPECT_EQ(stage->game.progress().flowersOpen, 0u);
}

TEST(WrongRuns, AnotherColourOpensNothing) {
    const auto stage = playWrong("wrong_colour");
    EXPECT_EQ(stage->flower(4).mood, FlowerMood::kWrong);
    EXPECT_FALSE(stage->flower(4).bloomed);
    // By path tracing 1.33 times.
    EXPECT_GT(stage->lightAt(4).bounced.z, 1.2f * stage->lightAt(4).bounced.y)
        << "blue light on the green flower";
    EXPECT_EQ(stage->game.progress().roomsSolved, 1u);
}

TEST(WrongRuns, AWallBetweenOpensNothing) {
    const auto stage = playWrong("wall_between");
    EXPECT_EQ(stage->flower(1).openness, 0);
    // 0.0225 comes round the screen, part of it by the backs of hung cloth; it wants 0.05.
    EXPECT_LT(stage->lightAt(1).bounced.x, 0.03f) << "the light is on the other side of the screen";
    EXPECT_EQ(stage->lightAt(1).direct, glm::vec3(0));
    EXPECT_EQ(stage->game.progress().flowersOpen, 0u);
}

// Somebody who aims badly, at the flowers and at what is beside them: in every room, from its entrance.
TEST(WrongRuns, BadAimNeitherGetsStuckNorOpensAFlowerByDirectLight) {
    constexpr int kRooms = 8, kTicks = 360;
    int direct = 0;
    for (int room = 0; room < kRooms; ++room) {
        Stage stage(test::device(), shippedLevel(), 20);
        ASSERT_TRUE(startAtRoom(stage.game, room));
        BadPlayer player(stage, uint32_t(room) + 1);
        player.play(kTicks);
        EXPECT_EQ(player.openedByDirectLight(), 0) << "room " << room;
        EXPECT_TRUE(player.canLeave()) << "room " << room;
        direct += player.ticksOfDirectLight();
    }
    EXPECT_GT(direct, 200) << "its beam did meet flowers";
}

#ifdef __SANITIZE_ADDRESS__  // keeps so much of what was freed
constexpr size_t kMostGrowth = 256 << 10;
#else
constexpr size_t kMostGrowth = 4 << 10;  // kilobytes
#endif

size_t residentKilobytes() {
    std::ifstream status("/proc/self/status");
    std::string word;
    while (status >> word)
        if (word == "VmRSS:") {
            size_t kilobytes = 0;
            status >> kilobytes;
            return kilobytes;
        }
    return 0;
}

// Ten thousand ticks of walking about, jumping, crouching and grasping.
TEST(Soak, TenThousandTicksNeedNoMoreMemory) {
    Stage stage(test::device(), shippedLevel(), 48);
    const auto input = [](int i) {
        return Input{.forward = i / 50 % 3 ? 1.0f : -1.0f,
                     .right = i / 70 % 2 ? 0.6f : 0,
                     .look = {float(i / 40 % 7) - 3, float(i % 11) - 5},
                     .buttons = uint32_t(i / 90 % 16)};
    };
    for (int i = 0; i < 3000; ++i)
        stage.tick(input(i));
    const size_t before = residentKilobytes();
    const uint64_t device = stage.renderer.deviceBytes();
    for (int i = 3000; i < 13000; ++i)
        stage.tick(input(i));
    EXPECT_LT(residentKilobytes(), before + kMostGrowth) << "kilobytes";
    EXPECT_EQ(stage.renderer.deviceBytes(), device);
    EXPECT_GT(stage.game.player().position.y, 0.5) << "still stands on the floor";
}

}  // namespace
}  // namespace ag::game
