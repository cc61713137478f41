// Flowers, saves, the menu, keys and quality, without a device.
#include <gtest/gtest.h>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "engine/core/safe_file.h"
#include "engine/physics/physics_system.h"
#include "engine/scene/components.h"
#include "game/dress_level.h"
#include "game/hud.h"
#include "game/menu.h"
#include "game/picture_check.h"
#include "game/save_game.h"
#include "game/systems/grow_flowers.h"
#include "game/systems/walk_player.h"
#include "tests/game/level.h"
#include "tests/support/own_folder.h"
#include "tools/scenegen/scenes.h"

namespace ag::game {
namespace {

render::ProbeLight lightOf(glm::vec3 direct, glm::vec3 bounced) {
    return {direct, bounced, 1};
}

TEST(Flowers, KnowTheirLight) {
    const Flower red{.wants = {1, 0.1f, 0.05f}, .amount = 0.1f};
    const auto moodIn = [](const Flower& flower, const render::ProbeLight& light) {
        return game::moodIn(flower, light, light.direct.x);
    };
    EXPECT_EQ(moodIn(red, lightOf({}, {})), FlowerMood::kDark);
    EXPECT_EQ(moodIn(red, lightOf({}, {0.3f, 0.03f, 0.02f})), FlowerMood::kGrowing);
    EXPECT_EQ(moodIn(red, lightOf({}, {0.1f, 0.01f, 0.01f})), FlowerMood::kThirsty);
    EXPECT_EQ(moodIn(red, lightOf({}, {0.3f, 0.3f, 0.25f})), FlowerMood::kWrong) << "white light";
    EXPECT_EQ(moodIn(red, lightOf({}, {0.02f, 0.05f, 0.4f})), FlowerMood::kWrong) << "blue light";
    EXPECT_EQ(moodIn(red, lightOf({0.5f, 0.5f, 0.4f}, {0.3f, 0.03f, 0.02f})), FlowerMood::kBlinded);
}

// What it shows grows with the light without a jump, and is whole exactly where it opens.
TEST(Flowers, ShowHowFarTheyAreFromOpening) {
    const Flower red{.wants = {1, 0.1f, 0.05f}, .amount = 0.1f}, shy{.amount = 0.1f, .shy = 1};
    float before = 0;
    for (float e = 0; e < 0.6f; e += 0.002f) {
        const render::ProbeLight light = lightOf({}, glm::vec3(1, 0.1f, 0.05f) * e);
        const float promise = promiseIn(red, light, 0);
        EXPECT_GE(promise, before);
        EXPECT_LT(promise - before, 0.02f) << "at " << e;
        EXPECT_EQ(promise == 1, moodIn(red, light, 0) == FlowerMood::kGrowing) << "at " << e;
        EXPECT_EQ(promiseIn(shy, light, 0) == 1, moodIn(shy, light, 0) == FlowerMood::kGrowing);
        before = promise;
    }
    before = 1;
    for (float white = 0; white < 1; white += 0.01f) {
        const render::ProbeLight light = lightOf({}, {1, 0.1f + 0.9f * white, 0.05f + 0.95f * white});
        const float promise = promiseIn(red, light, 0);
        EXPECT_LE(promise, before);
        EXPECT_LT(before - promise, 0.06f) << "at " << white;
        before = promise;
    }
    EXPECT_LT(promiseIn(red, lightOf({}, {1, 0.1f, 0.05f}), 0.2f), 0.6f) << "direct light takes away";
}

// Each substance is drawn with the mean that its materials' albedo is divided by, and has bumps.
TEST(Level, ItsMaterialsAreDrawnAndKeepTheirAlbedo) {
    const SceneAsset plain = level(), dressed = *readLevel(AFTERGLOW_SOURCE_DIR "/game/level/gallery.glb");
    const TextureLayers& layers = dressed.geometry.textures[size_t(TextureClass::k256)];
    ASSERT_EQ(layers.srgb.size(), layers.linear.size());
    EXPECT_GE(layers.srgb.size(), 9u);
    ASSERT_TRUE(dressed.sky);
    size_t drawn = 0;
    for (size_t i = 0; i < plain.geometry.materials.size(); ++i) {
        const Material &before = plain.geometry.materials[i], &after = dressed.geometry.materials[i];
        if (after.textureClass == TextureClass::kNone) continue;
        ++drawn;
        double sum = 0;
        const std::vector<uint8_t>& texels = layers.srgb[size_t(after.baseColorLayer)];
        for (size_t t = 0; t < texels.size(); t += 4)
            sum += std::pow((texels[t] / 255.0 + 0.055) / 1.055, 2.4);
        const double mean = sum / (double(texels.size()) / 4);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(double(after.baseColor[c]) * mean, double(before.baseColor[c]), 0.01) << after.name;
    }
    EXPECT_GE(drawn, 20u);
    EXPECT_EQ(triangleCount(dressed), triangleCount(plain));
}

TEST(Pictures, TellWhatIsDarkAndWhatIsBurntOut) {
    Image picture(10, 10);
    for (int i = 0; i < 100; ++i)
        picture.pixels[size_t(i)] = glm::vec3(i < 30 ? 0.05f : i < 90 ? 0.5f : 1.0f);
    const Extremes e = extremesOf(picture);
    EXPECT_FLOAT_EQ(e.dark, 0.3f);
    EXPECT_FLOAT_EQ(e.bright, 0.1f);
}

// The lamp's soft edge is not the beam; the beam is, however near another lamp's edge.
TEST(Flowers, BearTheSoftEdgeOfABeam) {
    const PunctualLight lamp{.intensity = glm::vec3(80),
                             .innerConeAngle = glm::radians(5.0f),
                             .outerConeAngle = glm::radians(25.0f),
                             .kind = LightKind::kSpot};
    const LocalTransform at;  // shines along -Z
    const auto direct = [&](float degrees) {
        const float cosine = std::cos(glm::radians(degrees)),
                    t = glm::clamp((cosine - std::cos(lamp.outerConeAngle)) /
                                       (std::cos(lamp.innerConeAngle) - std::cos(lamp.outerConeAngle)),
                                   0.0f, 1.0f);
        const glm::dvec3 point(2 * std::sin(double(glm::radians(degrees))), 0, -2 * double(cosine));
        return std::max(80 * t * t / 16 - softEdge(lamp, at, point), 0.0f);
    };
    EXPECT_EQ(direct(0), 5) << "all of the beam counts";
    EXPECT_GT(direct(12), 2);
    for (float degrees = 20; degrees < 30; degrees += 0.25f)
        EXPECT_LE(direct(degrees), kMostDirect) << degrees;
}

TEST(Level, IsWhatItsGeneratorMakes) {
    const SceneAsset shipped = level(), made = *scenegen::buildScene("gallery", 0);
    ASSERT_EQ(shipped.nodes.size(), made.nodes.size());
    EXPECT_EQ(triangleCount(shipped), triangleCount(made));
    EXPECT_LT(triangleCount(shipped), 60000u);
    for (size_t i = 0; i < made.nodes.size(); ++i) {
        EXPECT_EQ(shipped.nodes[i].name, made.nodes[i].name);
        EXPECT_EQ(shipped.nodes[i].extras.tag, made.nodes[i].extras.tag);
        EXPECT_EQ(shipped.nodes[i].extras.wants, made.nodes[i].extras.wants);
        EXPECT_LT(glm::length(shipped.nodes[i].local.translation - made.nodes[i].local.translation), 1e-6);
    }
    EXPECT_TRUE(shipped.warnings.empty()) << shipped.warnings[0];
}

TEST(Level, RestsUntilSomebodyComes) {
    Game game(level(), 1);
    for (int i = 0; i < 240; ++i)
        game.tick({});
    EXPECT_EQ(game.world().resource<Physics>().world->awakeCount(), 1u) << "the pendulum";
    EXPECT_EQ(game.progress().flowers, 19u);
    EXPECT_EQ(game.progress().rooms, 8u);
    EXPECT_EQ(game.progress().room, 0);
}

// A crate is picked up, carried and put down with the keys.
TEST(Level, CratesAreCarried) {
    Game game(level(), 1);
    game.tick({});
    game.world().resource<Player>().body.feet = {-1.9, 0, -0.75};
    game.tick({.look = {-628 - 62, 120}});  // to the stack at -x
    for (int i = 0; i < 20; ++i)
        game.tick({});
    game.tick({.buttons = kButtonUse});
    ASSERT_TRUE(game.player().carried);
    const Entity crate = game.player().carried;
    const glm::dvec3 before = game.world().get<BodyState>(crate)->position;
    for (int i = 0; i < 90; ++i)
        game.tick({.forward = -1});
    for (int i = 0; i < 30; ++i)
        game.tick({});
    const glm::dvec3 after = game.world().get<BodyState>(crate)->position;
    EXPECT_GT(glm::length(after - before), 1.0);
    EXPECT_LT(glm::length(after - game.player().position), 1.8);
    game.tick({.buttons = kButtonUse});
    EXPECT_FALSE(game.player().carried);
    for (int i = 0; i < 120; ++i)
        game.tick({});
    EXPECT_NEAR(game.world().get<BodyState>(crate)->position.y, 0.29, 0.05) << "lies on the floor";
}

TEST(Save, GoesOnWhereItWas) {
    Game game(level(), 1);
    for (int i = 0; i < 60; ++i)
        game.tick({.forward = 0.7f, .right = 0.2f, .look = {2, 0}});
    View<Room>(game.world(), {game.world().version(), 0}).each([](Room& room) {
        room.solved = room.index == 0;
    });
    game.tick({});
    const std::string text = saveText(game);
    Game other(level(), 1);
    ASSERT_TRUE(restoreGame(other, text, "save"));
    other.tick({});
    EXPECT_LT(glm::length(other.player().position - game.player().position), 0.05);
    EXPECT_EQ(other.player().yaw, game.player().yaw);
    EXPECT_EQ(other.progress().roomsSolved, 1u);
    EXPECT_EQ(other.progress().flowersOpen, 2u);
    Game later(level(), 1);
    ASSERT_TRUE(startAtRoom(later, 4));
    later.tick({});
    EXPECT_EQ(later.progress().room, 4);
    EXPECT_EQ(later.progress().roomsSolved, 4u);
    EXPECT_FALSE(startAtRoom(later, 99));
    EXPECT_FALSE(restoreGame(*std::make_unique<Game>(*scenegen::buildScene("hall", 0), 1), text, "save"));
}

TEST(Save, ABrokenOneIsRefusedAndKept) {
    Game game(level(), 1);
    game.tick({});
    const std::string good = saveText(game), path = test::ownFile("save.txt");
    const std::string cut = good.substr(0, good.size() / 2);
    std::string damaged = good;
    damaged.replace(damaged.find("body"), 8, "body nan");
    const std::string head = good.substr(0, good.find("player"));
    for (const std::string& text :
         {std::string(), std::string("hello"), cut, damaged, good.substr(0, good.size() - 4), good + "more\n",
          head + "player 1e30 0 0 0 0\nend\n", head + "player 0 0 0 nan 0\nend\n", head + "room -1 0\nend\n",
          head + "room 1000 0\nend\n", head + "room 0 inf\nend\n", head + "flower 4000000000 1\nend\n",
          head + "body 1 0 1e9 0 1 0 0 0\nend\n", head + "played -2\nend\n", head + "spent 0 nan\nend\n",
          head + "spent 1000 1\nend\n"}) {
        const uint64_t before = game.stateHash();
        const Status restored = restoreGame(game, text, path);
        ASSERT_FALSE(restored);
        EXPECT_NE(restored.error().message.find("save.txt"), std::string::npos);
        EXPECT_EQ(game.stateHash(), before) << "nothing of it counted";
        ASSERT_TRUE(writeFileSafely(path, text));
        ASSERT_TRUE(putBrokenSaveAside(game, path));
        EXPECT_FALSE(fileExists(path));
        EXPECT_EQ(*readFile(path + ".broken"), text);
    }
    ASSERT_TRUE(saveGame(game, path));
    ASSERT_TRUE(putBrokenSaveAside(game, path));
    EXPECT_TRUE(fileExists(path)) << "a good one stays";
    EXPECT_FALSE(saveGame(game, "/proc/none/save.txt"));
}

TEST(Keys, AreReadFromAFileAndBoundAnew) {
    const auto keys = parseBindings("# mine\nforward Up\nuse F\nlamp MouseRight\n", "keys.txt");
    ASSERT_TRUE(keys);
    EXPECT_EQ(keys->codes[size_t(Action::kForward)], GLFW_KEY_UP);
    EXPECT_EQ(keys->codes[size_t(Action::kBack)], GLFW_KEY_S) << "what is not named stays";
    const std::string path = test::ownFile("keys.txt");
    ASSERT_TRUE(saveBindings(*keys, path));
    EXPECT_EQ(*loadBindings(path), *keys);
    for (const char* text : {"fly W\n", "forward\n", "forward Nose\n", "forward W W\n"})
        EXPECT_FALSE(parseBindings(text, "keys.txt")) << text;
}

void goToLine(Menu& menu, const char* word, UserSettings& settings, Bindings& keys) {
    while (menuLines(menu, settings, keys)[size_t(menu.selected)].find(word) == std::string::npos)
        pressInMenu(menu, GLFW_KEY_DOWN, settings, keys);
}

TEST(Menu, IsWalkedWithKeys) {
    Menu menu;
    UserSettings settings;
    Bindings keys;
    const auto press = [&](int code) { return pressInMenu(menu, code, settings, keys); };
    EXPECT_EQ(menuLines(menu, settings, keys).size(), 5u) << "nothing to resume, nothing saved";
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kNewGame);
    EXPECT_EQ(press(GLFW_KEY_ESCAPE), MenuEvent::kNone) << "nothing to go back to yet";
    menu.hasSave = true;
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kContinue);
    menu.started = true;
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kResume);
    EXPECT_EQ(press(GLFW_KEY_ESCAPE), MenuEvent::kResume);
    press(GLFW_KEY_DOWN);
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kPhotoMode);
    press(GLFW_KEY_DOWN);
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kContinue) << "what was saved, instead of this game";
    press(GLFW_KEY_DOWN);
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kNewGame);
    press(GLFW_KEY_DOWN);
    press(GLFW_KEY_ENTER);
    EXPECT_EQ(menu.page, MenuPage::kSettings);
    EXPECT_EQ(press(GLFW_KEY_RIGHT), MenuEvent::kSettingsChanged);
    EXPECT_EQ(settings.quality, Quality::kLow) << "after automatic";
    press(GLFW_KEY_ESCAPE);
    press(GLFW_KEY_UP);
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kQuit);
    menu.page = MenuPage::kKeys;
    menu.selected = int(Action::kUse);
    press(GLFW_KEY_ENTER);
    EXPECT_EQ(press(GLFW_KEY_W), MenuEvent::kKeysChanged);
    EXPECT_EQ(keys.codes[size_t(Action::kUse)], GLFW_KEY_W);
    EXPECT_EQ(keys.codes[size_t(Action::kForward)], GLFW_KEY_E) << "no key does two things";
}

TEST(Menu, StartsRoomsOneHasReached) {
    Menu menu;
    UserSettings settings{.roomsReached = 3};
    Bindings keys;
    const auto press = [&](int code) { return pressInMenu(menu, code, settings, keys); };
    press(GLFW_KEY_DOWN);
    ASSERT_EQ(menuLines(menu, settings, keys)[size_t(menu.selected)], "Rooms");
    press(GLFW_KEY_ENTER);
    EXPECT_EQ(menuLines(menu, settings, keys).size(), 4u) << "three rooms and the way back";
    press(GLFW_KEY_DOWN);
    EXPECT_EQ(press(GLFW_KEY_ENTER), MenuEvent::kStartRoom);
    EXPECT_EQ(menu.room, 1);
    EXPECT_EQ(menu.page, MenuPage::kMain);
}

TEST(Menu, ChangesTheResolutionFromAHalfToAll) {
    Menu menu{.page = MenuPage::kSettings};
    UserSettings settings;
    Bindings keys;
    goToLine(menu, "Resolution", settings, keys);
    for (const float wanted : {0.5f, 0.6f, 0.7f, 0.8f, 0.9f, 1.0f, 0.0f}) {
        pressInMenu(menu, GLFW_KEY_RIGHT, settings, keys);
        EXPECT_FLOAT_EQ(settings.resolution, wanted);
    }
    pressInMenu(menu, GLFW_KEY_LEFT, settings, keys);
    EXPECT_FLOAT_EQ(settings.resolution, 1);
}

TEST(Menu, TurnsTheSoundOffExactly) {
    Menu menu{.page = MenuPage::kSettings};
    UserSettings settings;
    Bindings keys;
    goToLine(menu, "Sound", settings, keys);
    for (int i = 0; i < 8; ++i)
        EXPECT_EQ(pressInMenu(menu, GLFW_KEY_LEFT, settings, keys), MenuEvent::kSettingsChanged);
    EXPECT_EQ(settings.volume, 0);
    EXPECT_EQ(menuLines(menu, settings, keys)[size_t(menu.selected)], "Sound: off");
    for (int i = 0; i < 11; ++i)
        pressInMenu(menu, GLFW_KEY_RIGHT, settings, keys);
    EXPECT_EQ(settings.volume, 1);
    EXPECT_EQ(menuLines(menu, settings, keys)[size_t(menu.selected)], "Sound: 100 %");
}

TEST(Quality, PresetsLeaveTheEyeAlone) {
    render::RenderSettings gi;
    gi.composite.exposure = 2;
    for (const Quality q : {Quality::kLow, Quality::kMedium, Quality::kHigh, Quality::kUltra}) {
        gi.exposure.automatic = true;
        applyQuality(q, gi);
        EXPECT_TRUE(gi.exposure.automatic) << "the eye stays";
        EXPECT_EQ(gi.composite.exposure, 2);
        EXPECT_EQ(qualityFromName(qualityName(q)), q);
    }
}

TEST(UserFiles, AreReadAndRefused) {
    const std::string path = test::ownFile("settings.txt");
    UserSettings settings{.quality = Quality::kHigh, .sensitivity = 1.5f, .volume = 0.3f, .hints = false};
    ASSERT_TRUE(saveUserSettings(settings, path));
    const auto back = loadUserSettings(path);
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->quality, Quality::kHigh);
    EXPECT_EQ(back->sensitivity, 1.5f);
    EXPECT_EQ(back->volume, 0.3f);
    EXPECT_FALSE(back->hints);
    for (const char* text :
         {"quality best\n", "sensitivity 99\n", "hints maybe\n", "colour red\n", "hints\n"}) {
        ASSERT_TRUE(writeFileSafely(path, text));
        EXPECT_FALSE(loadUserSettings(path)) << text;
    }
}

// Each colour of the level has a shape of its own.
TEST(Hud, ShapesTellTheColoursApart) {
    const SceneAsset asset = level();
    std::map<std::string, Shape> shapes;
    for (const SceneNode& node : asset.nodes)
        if (node.extras.tag == "flower")
            shapes[node.name.substr(node.name.rfind(' ') + 1)] = shapeOf(node.extras.wants);
    EXPECT_EQ(shapes.size(), 7u);
    EXPECT_EQ(shapes["white"], Shape::kCircle);
    EXPECT_EQ(shapes["red"], Shape::kTriangle);
    EXPECT_EQ(shapes["green"], Shape::kSquare);
    EXPECT_EQ(shapes["blue"], Shape::kDiamond);
    EXPECT_EQ(shapes["yellow"], Shape::kStar);
    EXPECT_EQ(shapes["magenta"], Shape::kCross);
    EXPECT_EQ(shapes["cyan"], Shape::kHexagon);
    Game game(asset, 1);
    game.tick({});
    const HudState hud = readHud(game.world(), game.hints(), true);
    EXPECT_EQ(hud.flowers.size(), 2u);
    EXPECT_NE(hud.goal.find("0 of 2"), std::string::npos);
    EXPECT_TRUE(hud.hint.empty()) << "nobody needs one yet";
    EXPECT_TRUE(hud.flowers[0].meant != hud.flowers[1].meant) << "one of them is pointed at";
    for (int i = 0; i < int(kHintSeconds * 60) + 60; ++i)
        game.tick({});
    EXPECT_FALSE(readHud(game.world(), game.hints(), true).hint.empty());
    EXPECT_TRUE(readHud(game.world(), game.hints(), false).hint.empty()) << "turned off";
}

TEST(Hud, TellsWhyAFlowerCloses) {
    Game game(level(), 1);
    game.tick({});
    const auto read = [&](FlowerMood mood, float openness, float direct) {
        View<Flower, render::ProbeLight>(game.world(), {}).each([&](Flower& f, render::ProbeLight& light) {
            f.mood = mood;
            f.openness = openness;
            light.direct = glm::vec3(direct);
            return true;
        });
        return readHud(game.world(), game.hints(), true).flowers.at(0);
    };
    EXPECT_TRUE(read(FlowerMood::kThirsty, 0.5f, 0).closing);
    EXPECT_FALSE(read(FlowerMood::kThirsty, 0, 0).closing) << "it is shut";
    EXPECT_FALSE(read(FlowerMood::kGrowing, 0.5f, 0).closing);
    EXPECT_FALSE(read(FlowerMood::kOpen, 1, 0).closing);
    EXPECT_STREQ(moodText(read(FlowerMood::kBlinded, 0, 5)), "direct light!");
    EXPECT_STREQ(moodText(read(FlowerMood::kBlinded, 0, 0.2f)), "a beam's edge!");
    EXPECT_TRUE(readHud(game.world(), game.hints(), true).legend) << "no room is solved yet";
}

// Near and far: its beam goes through what the middle of the view is on.
TEST(Lamp, LightsWhatTheMiddleOfTheViewIsOn) {
    Game game(level(), 1);
    const PhysicsWorld& physics = *game.world().resource<Physics>().world;
    double nearest = 100, farthest = 0;
    for (int turn = 0; turn < 12; ++turn) {
        for (int i = 0; i < 80; ++i)
            game.tick({.forward = turn == 6 && i < 30 ? 1.0f : 0, .look = {i < 10 ? 33.0f : 0, 0}});
        const Player& player = game.player();
        const glm::dvec3 ahead(viewDirection(player.yaw, player.pitch));
        const auto hit = physics.ray(player.position, player.position + ahead * 8.0);
        if (!hit) continue;
        const double distance = glm::length(hit->position - player.position);
        nearest = std::min(nearest, distance), farthest = std::max(farthest, distance);
        View<const HandLamp, const LocalTransform>(game.world(), {})
            .each([&](const HandLamp&, const LocalTransform& at) {
                const glm::dvec3 to = hit->position - at.translation,
                                 beam = glm::dvec3(at.rotation * glm::vec3(0, 0, -1));
                EXPECT_LT(glm::length(to - beam * glm::dot(to, beam)), 0.01)
                    << "at " << distance << " m, turn " << turn;
            });
    }
    EXPECT_LT(nearest, 2);
    EXPECT_GT(farthest, 4);
}

}  // namespace
}  // namespace ag::game
