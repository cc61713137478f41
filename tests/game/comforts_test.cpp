// Photo mode, subtitles, times and the gamepad's buttons, without a device.
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <set>

#include "engine/core/safe_file.h"
#include "engine/renderer/probe_components.h"
#include "engine/scene/extract_system.h"
#include "game/menu.h"
#include "game/photo_mode.h"
#include "game/save_game.h"
#include "game/save_slot.h"
#include "game/subtitles.h"
#include "game/systems/show_sky.h"
#include "game/time_board.h"
#include "tests/game/level.h"
#include "tests/support/own_folder.h"

namespace ag::game {
namespace {

glm::dvec3 eyes(Game& game) {
    game.frame({64, 36});
    return game.world().resource<ActiveCamera>().pose.position;
}

TEST(PhotoMode, LeavesTheWorldAsItWas) {
    Game game(*readLevel(AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb"), 1);
    for (int i = 0; i < 30; ++i)
        game.tick({.forward = 1});
    const glm::dvec3 before = eyes(game);
    const auto sky = game.world().resource<LevelSky>().sky;
    const RenderScene& scene = game.scene();
    EXPECT_FALSE(scene.sky) << "the first room is closed";
    const uint64_t hash = game.stateHash();
    PhotoMode photo;
    photo.enter(game);
    EXPECT_LT(glm::distance(eyes(game), before), 1e-6) << "it begins at the player's eyes";
    EXPECT_TRUE(scene.sky) << "the camera may go where the sky is seen";
    photo.move(game, {.forward = 1, .look = {40, 0}, .buttons = kButtonJump}, 0.5f);
    EXPECT_GT(glm::distance(eyes(game), before), 0.5);
    const float hour = photo.hour(), angle = scene.camera.verticalFov;
    photo.press(game, GLFW_KEY_LEFT);
    photo.press(game, GLFW_KEY_UP);
    eyes(game);
    EXPECT_LT(photo.hour(), hour);
    EXPECT_NE(scene.sky, sky);
    EXPECT_LT(scene.camera.verticalFov, angle);
    photo.leave(game);
    EXPECT_LT(glm::distance(eyes(game), before), 1e-6);
    EXPECT_EQ(game.world().resource<LevelSky>().sky, sky);
    EXPECT_FALSE(scene.sky);
    EXPECT_EQ(game.stateHash(), hash);
}

// The level's own hour gives the level's own sky, the sun goes over the zenith, and it never sets.
TEST(PhotoMode, TheSunGoesOverTheSky) {
    Game game(*readLevel(AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb"), 1);
    game.tick({});
    eyes(game);
    PhotoMode photo;
    photo.enter(game);
    const auto sun = [&] { return game.world().resource<LevelSky>().sky->sunDirection; };
    const glm::vec3 level = daylightOf(game.level()).sunDirection;
    EXPECT_NEAR(photo.hour(), 17.03f, 0.02f) << "dusk: the sun stands 14.5 degrees high";
    photo.press(game, GLFW_KEY_RIGHT);
    EXPECT_FLOAT_EQ(photo.hour(), 17.25f);
    EXPECT_GT(sun().y, level.y) << "lower";
    EXPECT_GT(
        glm::dot(glm::normalize(glm::vec2(sun().x, sun().z)), glm::normalize(glm::vec2(level.x, level.z))),
        0.999f);
    for (int i = 0; i < 21; ++i)
        photo.press(game, GLFW_KEY_LEFT);
    EXPECT_FLOAT_EQ(photo.hour(), 12);
    EXPECT_NEAR(sun().y, -1, 1e-4f);
    for (int i = 0; i < 100; ++i)
        photo.press(game, GLFW_KEY_LEFT);
    EXPECT_LT(sun().y, -0.03f);
    EXPECT_LT(sun().x * level.x + sun().z * level.z, 0) << "from the other side";
}

TEST(PhotoMode, TellsWhatFlowersNearByRead) {
    Game game(level(), 1);
    game.tick({});
    eyes(game);
    PhotoMode photo;
    photo.enter(game);
    EXPECT_EQ(photo.lines(game, {}, "bounce1").size(), 1u) << "nothing was measured yet";
    EXPECT_NE(photo.lines(game, {}, "bounce1")[0].find("bounce1"), std::string::npos);
    // All flowers read the same: those of the first room are near.
    std::vector<io::ProbeRow> rows;
    size_t near = 0;
    View<const Flower>(game.world(), {}).each([&](Entity entity, const Flower& flower) {
        rows.push_back({.direct = glm::vec3(0.5f),
                        .idLow = uint32_t(entity.bits()),
                        .bounced = {0.25f, 0.125f, 1},
                        .idHigh = uint32_t(entity.bits() >> 32)});
        near += flower.room == 0;
    });
    gi::ProbeReadings readings;
    readings.set(std::as_bytes(std::span(rows)), 2);
    const std::vector<std::string> lines = photo.lines(game, readings, "");
    ASSERT_EQ(lines.size(), 1 + near);
    EXPECT_NE(lines[1].find(": 0.5000 0.2500 2.0000 W/m² bounced, 1.0000 direct; wants"), std::string::npos)
        << lines[1];
}

TEST(PhotoMode, NeverSavesOverAPhoto) {
    const std::string folder = test::ownFolder().string();
    EXPECT_EQ(nextPhoto(folder), folder + "/photo-001");
    ASSERT_TRUE(writeFileSafely(folder + "/photo-001.png", "a"));
    ASSERT_TRUE(writeFileSafely(folder + "/photo-002.exr", "b"));
    EXPECT_EQ(nextPhoto(folder), folder + "/photo-003");
}

TEST(Subtitles, SayWhatIsHeardAndWhere) {
    const CameraPose eyes{.position = {0, 1.6, 0}, .forward = {0, 0, -1}};
    Subtitles subtitles;
    const std::array sounds = {soundAt({3, 0, 0}, SoundId::kBloom), soundOf(SoundId::kClick),
                               soundAt({0, 0, 1}, SoundId::kStep)};
    subtitles.hear(sounds, eyes, 10);
    ASSERT_EQ(subtitles.lines(10).size(), 1u) << "steps and clicks are the player's own";
    EXPECT_EQ(subtitles.lines(10)[0], "a flower chimes, open, on the right");
    EXPECT_EQ(subtitles.lines(10 + Subtitles::kSeconds).size(), 0u);
    for (const auto& [place, side] :
         {std::pair(glm::dvec3(-3, 0, 1), "left"), {{1, 0, -3}, "ahead"}, {{1, 5, 3}, "behind"}}) {
        const Sound sound = soundAt(place, SoundId::kShut);
        subtitles.hear({&sound, 1}, eyes, 11);
        EXPECT_NE(subtitles.lines(11).back().find(side), std::string::npos) << side;
    }
    const Sound knock = soundAt({1, 0, -3}, SoundId::kKnock), melody = soundOf(SoundId::kFinished);
    subtitles.clear();
    for (int i = 0; i < 9; ++i)
        subtitles.hear({&knock, 1}, eyes, 20 + 0.1 * i);
    subtitles.hear({&melody, 1}, eyes, 21);
    EXPECT_EQ(subtitles.lines(21), (std::vector<std::string>{"something knocks, ahead", "a melody"}))
        << "what repeats is one line; what is everywhere has no side";
}

void solve(Game& game, int32_t index) {
    View<Flower>(game.world(), {game.world().version(), 0}).each([&](Flower& f) {
        if (f.room == index) f.bloomed = 1, f.openness = 1;
    });
    game.tick({});
}

TEST(Times, AreOfEachRoomAndGoOnWithTheSave) {
    const std::string path = test::ownFile("times.txt");
    Game game(level(), 1);
    TimeBoard board(path);
    ASSERT_TRUE(board.open(game));
    board.startOver(game);
    for (int i = 0; i < 90; ++i)
        game.tick({});
    EXPECT_EQ(board.follow(game), "");
    const std::string half = saveText(game);
    Game later(level(), 1);
    ASSERT_TRUE(restoreGame(later, half, "save"));
    TimeBoard again(path);
    ASSERT_TRUE(again.open(later));
    again.startOver(later);
    for (int i = 0; i < 30; ++i)
        later.tick({});
    solve(later, 0);
    EXPECT_EQ(again.follow(later), "Room 1 in 0:02.0");
    EXPECT_EQ(again.follow(later), "") << "told once";
    EXPECT_NEAR(again.best().room(0), 2, 0.05) << "what was spent before it was saved counts";
    solve(game, 0);
    ASSERT_TRUE(board.open(game));
    EXPECT_EQ(board.follow(game), "Room 1 in 0:01.5: before it was 0:02.0");
    EXPECT_EQ(board.roomNotes(), std::vector<std::string>{"at best 0:01.5"});
    // A room that was solved when the game went on is no news, and one from a chapter's start is.
    Game chapter(level(), 1);
    ASSERT_TRUE(startAtRoom(chapter, 1));
    board.startOver(chapter);
    for (int i = 0; i < 60; ++i)
        chapter.tick({});
    EXPECT_EQ(board.follow(chapter), "");
    solve(chapter, 1);
    EXPECT_EQ(board.follow(chapter), "Room 2 in 0:01.0");
    EXPECT_FALSE(chapter.world().resource<PlayTime>().known) << "the whole was not played";
    EXPECT_TRUE(*loadBestTimes(path)->rooms.begin() > 1);
}

TEST(Times, BrokenOrForeignOnesAreKeptAside) {
    const std::string path = test::ownFile("times.txt");
    const Game game(level(), 1);
    for (const char* text :
         {"level 0123456789abcdef\nroom 1 3\n", "room 1\n", "level xyz\n", "level zzzzzzzzzzzzzzzz\n",
          "room 0 3\n", "room 1.5 3\n", "room 1 -3\n", "whole nan\n", "whole 3 4\n", "best 3\n"}) {
        ASSERT_TRUE(writeFileSafely(path, text));
        TimeBoard board(path);
        const Status opened = board.open(game);
        ASSERT_FALSE(opened) << text;
        EXPECT_NE(opened.error().message.find("times.txt"), std::string::npos);
        EXPECT_EQ(*readFile(path + ".before"), text);
        EXPECT_TRUE(board.best().rooms.empty());
    }
    EXPECT_EQ(clockText(64.34), "1:04.3");
    EXPECT_EQ(clockText(59.96), "1:00.0");
}

// Killed at any moment of any save, what lies there is a whole one.
TEST(Save, OutlivesAKill) {
    const std::string folder = test::ownFolder().string(), path = folder + "/save.txt";
    Game game(level(), 1);
    game.tick({});
    ASSERT_TRUE(saveGame(game, path));
    std::set<std::string> texts;
    for (useconds_t i = 0; i < 40; ++i) {
        int saved[2];
        ASSERT_EQ(pipe(saved), 0);
        const pid_t child = fork();
        ASSERT_GE(child, 0);
        if (child == 0)
            for (SaveSlot slot(path);;) {
                game.tick({.forward = 1, .look = {float(i), 0}});
                slot.save(game);
                if (write(saved[1], "s", 1) != 1) _exit(1);
            }
        char first = 0;
        EXPECT_EQ(read(saved[0], &first, 1), 1) << "it saves";
        usleep(500 * (i % 20));
        kill(child, SIGKILL);
        close(saved[0]), close(saved[1]);
        waitpid(child, nullptr, 0);
        const auto text = readFile(path);
        ASSERT_TRUE(text);
        const Status good = checkSave(game, *text, path);
        ASSERT_TRUE(good) << good.error().message;
        texts.insert(*text);
    }
    EXPECT_GT(texts.size(), 10u) << "it was killed between saves that differ";
}

TEST(Keys, AGamepadsButtonsAreBoundAnew) {
    const auto keys = parseBindings("pad_lamp PadLeftTrigger\npad_use PadY\n", "keys.txt");
    ASSERT_TRUE(keys) << keys.error().message;
    EXPECT_EQ(keys->pad[size_t(Action::kLamp) - size_t(kFirstPadAction)], kPadTriggerCode);
    EXPECT_EQ(keys->pad[0], kPadCode + GLFW_GAMEPAD_BUTTON_A) << "what is not named stays";
    const std::string path = test::ownFile("pad_keys.txt");
    ASSERT_TRUE(saveBindings(*keys, path));
    EXPECT_EQ(*loadBindings(path), *keys);
    for (const char* text :
         {"pad_forward PadA\n", "pad_jump W\n", "jump PadA\n", "pad_jump PadStart\n", "pad_ PadA\n"})
        EXPECT_FALSE(parseBindings(text, "keys.txt")) << text;
}

TEST(Menu, AsksForAGamepadsButton) {
    Menu menu{.page = MenuPage::kGamepad};
    UserSettings settings;
    Bindings keys;
    const auto press = [&](int code) { return pressInMenu(menu, code, settings, keys); };
    EXPECT_EQ(menuLines(menu, settings, keys).size(), kPadActionCount + 1);
    EXPECT_EQ(menuLines(menu, settings, keys)[0], "jump: Pad A");
    press(GLFW_KEY_ENTER);
    EXPECT_TRUE(menu.waitsForPad());
    EXPECT_EQ(press(GLFW_KEY_W), MenuEvent::kNone);
    EXPECT_TRUE(menu.waitsForPad()) << "a key is no button";
    EXPECT_EQ(press(kPadCode + GLFW_GAMEPAD_BUTTON_X), MenuEvent::kKeysChanged);
    EXPECT_EQ(keys.pad[0], kPadCode + GLFW_GAMEPAD_BUTTON_X);
    EXPECT_EQ(keys.pad[size_t(Action::kUse) - size_t(kFirstPadAction)], kPadCode + GLFW_GAMEPAD_BUTTON_A)
        << "no button does two things";
    press(GLFW_KEY_ENTER);
    EXPECT_EQ(press(kPadCode + GLFW_GAMEPAD_BUTTON_START), MenuEvent::kNone) << "it opens the menu";
    EXPECT_FALSE(menu.message.empty());
    menu = {.page = MenuPage::kKeys};
    press(GLFW_KEY_ENTER);
    EXPECT_EQ(press(kPadCode + GLFW_GAMEPAD_BUTTON_X), MenuEvent::kNone) << "a button is no key";
}

}  // namespace
}  // namespace ag::game
