// The first bounce corrected by rays: walls that maps leak through are dark, and what moves is where it moved
// to.
#include <algorithm>

#include "engine/core/image_difference.h"
#include "shaders/texel_rays/texel_rays_io.h"
#include "tests/gi_gpu/bench.h"
#include "tools/reference/reference.h"
#include "tools/scenegen/builder.h"
#include "tools/scenegen/scenes.h"

namespace ag::gi {
namespace {

Image bounce1After(Bench& b, int frames) {
    for (int i = 0; i < frames; ++i)
        b.frame();
    return readImage(b.renderer, b.last.bounce.bounce1.image);
}

RenderSettings withRays(bool rays) {
    RenderSettings settings;
    settings.bounce.texelRays = {.enabled = rays};
    return settings;
}

TEST(TexelRays, WallsLitFromOutsideSendNothingInside) {
    std::array<double, 2> mean{};
    for (const bool rays : {false, true}) {
        Bench b(*scenegen::buildScene("shell", 0), {96, 54});
        b.settings = withRays(rays);
        mean[rays] = meanOf(bounce1After(b, 64));
    }
    const double truth = 0.00679;  // W/m², by path tracing: the lamp's
    std::printf("over the truth: %.4f, with rays %.4f\n", mean[0] / truth, mean[1] / truth);
    EXPECT_NEAR(mean[1] / truth, 1, 0.1);
    EXPECT_LT(mean[0] / truth, 6) << "domes send nothing inside, however wide the pixels";
}

void pushAside(Bench& b, float aside) {
    for (RenderInstance& instance : b.scene.instances) {
        instance.movable = true;
        instance.worldFromLocal[3].x += aside;
    }
    b.scene.allInstancesChanged = true;
    ++b.scene.instancesVersion;
}

TEST(TexelRays, WhatMovedStandsInTheWayWhereItIs) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    Bench moved(asset, {96, 54}), fresh(asset, {96, 54}), before(asset, {96, 54});
    for (Bench* b : {&moved, &fresh, &before})
        b->settings = withRays(true), useSmallMaps(b->settings);
    pushAside(moved, 0), pushAside(before, 0), pushAside(fresh, 0.5f);
    bounce1After(moved, 8);
    pushAside(moved, 0.5f);
    const Image truth = bounce1After(fresh, 64), image = bounce1After(moved, 64);
    const Image old = bounce1After(before, 64);
    const double mean = meanOf(truth);
    EXPECT_LT(shareOff(image, truth, 0.25 * mean), 0.03);
    EXPECT_GT(shareOff(old, truth, 0.25 * mean), 0.06);  // it makes a difference
}

TEST(TexelRays, WhatMovesStandsInTheWayWhereItIs) {
    const SceneAsset asset = *scenegen::buildScene("occluder", 0);
    Bench moving(asset, {96, 54}), still(asset, {96, 54});
    for (Bench* b : {&moving, &still})
        b->settings = withRays(true), useSmallMaps(b->settings);
    pushAside(moving, 0), pushAside(still, 0.5f);
    bounce1After(moving, 8);
    pushAside(moving, 0.5f);
    for (int i = 0; i < 48; ++i) {
        pushAside(moving, i % 2 ? 1e-4f : -1e-4f);
        moving.frame();
    }
    EXPECT_EQ(moving.outcome("texel_rays.cast"), PassOutcome::kRan);
    const Image image = readImage(moving.renderer, moving.last.bounce.bounce1.image),
                truth = bounce1After(still, 64);
    EXPECT_LT(shareOff(image, truth, 0.25 * meanOf(truth)), 0.04);  // 0.14 by where it stood before
}

// Where no ray is cast while something changes, surfaces keep what was found on them; lights that go out take
// it with them.
TEST(TexelRays, WhatWasFoundIsCarriedAlong) {
    Bench b(*scenegen::buildScene("shell", 0), {96, 54});
    b.settings = withRays(true);
    b.settings.bounce.texelRays.movingLength = 0;
    const double found = meanOf(bounce1After(b, 64));
    EXPECT_EQ(b.outcome("texel_rays.cast"), PassOutcome::kRan);
    Bench without(*scenegen::buildScene("shell", 0), {96, 54});
    without.settings = withRays(false);
    const double leaking = meanOf(bounce1After(without, 64));
    ASSERT_GT(leaking, 2 * found);

    const auto walk = [](Bench& of, int frames) {
        for (int i = 0; i < frames; ++i) {
            shiftCamera(of.scene, {0.002f, 0, 0});
            of.frame();
        }
        return meanOf(readImage(of.renderer, of.last.bounce.bounce1.image));
    };
    const double carried = walk(b, 8);
    EXPECT_EQ(b.outcome("texel_rays.cast"), PassOutcome::kDropped);
    std::printf("over what rays found: carried %.3f, without %.3f\n", carried / found, leaking / found);
    EXPECT_LT(carried, found + 0.3 * (leaking - found));

    walk(without, 8);
    for (Bench* of : {&b, &without}) {
        for (RenderLight& light : of->scene.lights)
            light.intensity *= 0.01f;
        ++of->scene.lightsVersion;
    }
    const double left = walk(b, 2), alone = walk(without, 2);
    std::printf("of lights that are nearly out: %.4f, without %.4f\n", left / found, alone / found);
    EXPECT_LT(left, alone + 0.05 * found);
}

// Area lights leak into the shell; rays that follow a camera that never stands still find that they do.
TEST(TexelRays, AreCastWhileTheCameraWalks) {
    const auto walked = [](uint32_t length) {
        Bench b(*scenegen::buildScene("shell", 0), {96, 54});
        b.settings = withRays(true);
        b.settings.bounce.texelRays.movingLength = length;
        for (int i = 0; i < 48; ++i) {
            shiftCamera(b.scene, {0.002f, 0, 0});
            b.frame();
        }
        EXPECT_EQ(b.outcome("texel_rays.cast"), length > 0 ? PassOutcome::kRan : PassOutcome::kDropped);
        return meanOf(readImage(b.renderer, b.last.bounce.bounce1.image));
    };
    Bench still(*scenegen::buildScene("shell", 0), {96, 54});
    still.settings = withRays(true);
    const double truth = meanOf(bounce1After(still, 256)), with = walked(48), without = walked(0);
    std::printf("light at the end of a walk over that at rest: with rays %.3f, without %.3f\n", with / truth,
                without / truth);
    EXPECT_GT(without, 2 * truth);
    EXPECT_LT(with, truth + 0.3 * (without - truth));
}

TEST(TexelRays, AStillFrameComesToRestAndSkippingChangesNoBit) {
    std::array<Image, 2> images;
    for (const bool skip : {true, false}) {
        Bench b(*scenegen::buildScene("ledges", 0), {96, 54});
        b.settings = withRays(true);
        useSmallMaps(b.settings);
        b.settings.bounce.texelRays.settleFrames = 16;
        b.options.skip = skip;
        images[skip] = bounce1After(b, int(framesToRest(b.settings.bounce)) + 8);
        if (skip) {
            EXPECT_EQ(b.passesRun(), 0);
        }
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
}

// At rest pixels that were left out are gathered, too, and keep that until something moves.
TEST(TexelRays, PixelsLeftOutGetLightOfTheirOwn) {
    Bench all(*scenegen::buildScene("ledges", 0), {96, 54}), some(all.asset, {96, 54}),
        each(all.asset, {96, 54});
    for (Bench* b : {&all, &some, &each}) {
        b->settings = withRays(true);
        useSmallMaps(b->settings);
        b->settings.bounce.texelRays.settleFrames = 64;
        b->settings.bounce.valClustering.settleFrames = 20;
    }
    some.settings.bounce.texelRays.allPixels = false;
    each.settings.bounce.spacing = 1;
    const int frames = int(framesToRest(all.settings.bounce)) + 8;
    const Image truth = bounce1After(each, frames);
    const auto found = compareImages(truth, bounce1After(all, frames)),
               without = compareImages(truth, bounce1After(some, frames));
    ASSERT_TRUE(found && without);
    std::printf("off every pixel's gather: relative RMSE %.4f, %.4f without turns\n", found->relativeRmse,
                without->relativeRmse);
    EXPECT_LT(found->relativeRmse, 0.8 * without->relativeRmse);

    shiftCamera(all.scene, {0.002f, 0, 0});
    all.frame();
    EXPECT_EQ(all.outcome("upsampling.near"), PassOutcome::kRan);
    EXPECT_EQ(all.outcome("upsampling.place"), PassOutcome::kDropped);
}

// Light that nobody asked for is not made; once somebody does, no pixel lacks it.
TEST(TexelRays, LightAskedForAtRestIsWhole) {
    Bench late(*scenegen::buildScene("ledges", 0), {96, 54}), early(late.asset, {96, 54});
    RenderSettings settings = withRays(true);
    settings.bounce.texelRays.settleFrames = 8;
    settings.bounce.valClustering.settleFrames = 6;
    const uint32_t rest = framesToRest(settings.bounce) + 8;
    const auto layer = [&](Bench& b, Layer of, uint32_t frames) {
        return renderLayer(b.renderer, b.scene, b.size, settings, of, frames);
    };
    const Image truth = layer(early, Layer::kBounce1, 2 * rest);
    layer(late, Layer::kDirect, rest);
    const auto atOnce = compareImages(truth, layer(late, Layer::kBounce1, 1));
    const auto atRest = compareImages(truth, layer(late, Layer::kBounce1, rest));
    ASSERT_TRUE(atOnce && atRest);
    std::printf("asked for late: relative RMSE %.4f at once, %.4f at rest\n", atOnce->relativeRmse,
                atRest->relativeRmse);
    EXPECT_LT(atOnce->relativeRmse, 0.4);  // where three of four pixels were black: more than 0.8
    EXPECT_LT(atRest->relativeRmse, 0.3);  // few rays, other clusters
}

// A sky alone: the first bounce has no lights, later ones do.
TEST(TexelRays, LaterBouncesAloneComeToRest) {
    Bench b(*scenegen::buildScene("cornell", 0), {64, 48});
    b.settings = withRays(true);
    b.settings.bounce.texelRays.settleFrames = 2;
    b.settings.bounce.valClustering.settleFrames = 2;
    b.settings.bounce.sky.settleFrames = 2;
    b.settings.bounce.laterBounces = {.enabled = true, .settleFrames = 2};
    b.scene.lights.clear();
    b.scene.sky = std::make_shared<const Sky>(constantSky(glm::vec3(1)));
    for (uint32_t i = 0; i < framesToRest(b.settings.bounce) + 8; ++i)
        b.frame();
    EXPECT_EQ(b.passesRun(), 0);
    EXPECT_GT(meanOf(readImage(b.renderer, b.last.bounce.irradiance.image)), 0);
}

// How likely each block draws each light, and what its rays to it found.
struct Draws {
    std::vector<float> likely;
    std::vector<io::RaysFound> found;
};
Draws drawsAfter(Bench& b, int frames) {
    BufferHandle likely, found;
    b.output = [&](GraphScope scope, const RenderFrame&) {
        likely = b.renderer.graph().findBuffer("texel_rays.likely");
        found = b.renderer.graph().findBuffer("texel_rays.found");
        for (const BufferHandle buffer : {likely, found})
            if (buffer) scope.output(buffer);
    };
    bounce1After(b, frames);
    return {b.read<float>(likely), b.read<io::RaysFound>(found)};
}

// A light's texels may face what its plane looks away from: no tile leaves it out.
TEST(TexelRays, AnyLightMayBeDrawnFromAnywhere) {
    Bench b(*scenegen::buildScene("nave", 0), {96, 54});
    b.settings = withRays(true);
    useSmallMaps(b.settings);
    const Draws draws = drawsAfter(b, 12);
    const uint32_t lights = b.settings.bounce.valClustering.count;
    ASSERT_EQ(draws.likely.size() % lights, 0u);
    std::vector<bool> lit(lights);
    for (size_t i = 0; i < draws.likely.size(); ++i)
        if (draws.likely[i] > 0) lit[i % lights] = true;
    EXPECT_GT(std::ranges::count(lit, true), lights / 2);
    for (size_t block = 0; block < draws.likely.size(); block += lights) {
        double sum = 0;
        for (uint32_t light = 0; light < lights; ++light) {
            sum += double(draws.likely[block + light]);
            EXPECT_EQ(draws.likely[block + light] > 0, lit[light]) << block / lights << ' ' << light;
        }
        EXPECT_NEAR(sum, 1, 1e-4);
    }
}

// Fewer and fewer draws go to lights that no ray of the block has seen.
TEST(TexelRays, DrawsLearnWhichLightsAreSeen) {
    std::array<double, 2> unseen{};
    for (const bool late : {false, true}) {
        Bench b(*scenegen::buildScene("nave", 0), {96, 54});
        b.settings = withRays(true);
        useSmallMaps(b.settings);
        const Draws draws = drawsAfter(b, late ? 128 : 4);
        double all = 0;
        for (size_t i = 0; i < draws.likely.size(); ++i) {
            all += double(draws.likely[i]);
            if (draws.found[i].squares == 0) unseen[late] += double(draws.likely[i]);
        }
        unseen[late] /= all;
    }
    std::printf("draws of lights that no ray saw: %.3f, then %.3f\n", unseen[0], unseen[1]);
    EXPECT_LT(unseen[1], 0.8 * unseen[0]);
}

Image tracedBounce1(const Bench& b) {
    const reference::RayScene rays(b.scene);
    JobRunner runner(2);
    return reference::makeReference(rays, b.size,
                                    {.paths = {.bounces = 1}, .samplesPerPixel = 512, .layer = "bounce1"},
                                    runner, [](double) {})
        .bounces[1];
}

// Of the first bounce at rest, relative RMSE.
double errorBeside(const Image& truth, Bench& b, bool rays, bool smallMaps) {
    b.settings = withRays(rays);
    if (smallMaps) useSmallMaps(b.settings);
    const auto found =
        compareImages(truth, renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kBounce1, 160));
    EXPECT_TRUE(found);
    return found ? found->relativeRmse : 1;
}

// A wall gets most of its light in a crease from the floor within millimetres, where a texel of the light's
// map may lie on either.
TEST(TexelRays, CreasesBesideLitSurfacesAreBright) {
    Bench b(*scenegen::buildScene("occluder", 0), {160, 90});
    const double error = errorBeside(tracedBounce1(b), b, true, true);
    std::printf("occluder: relative RMSE %.3f\n", error);
    EXPECT_LT(error, 0.19);  // 0.227 when texels of the wall stood for the floor
}

// A slit lets the sun onto a strip of the floor, a fifth as wide as a texel of its map, at the foot of a
// wall.
TEST(TexelRays, WhatIsNarrowerThanATexelLightsWhatIsNear) {
    scenegen::SceneBuilder room("slit");
    const uint32_t white = room.material("white", glm::vec3(0.7f)),
                   red = room.material("red", {0.7f, 0.2f, 0.1f});
    room.quad("floor", {-2, 0, 2}, {4, 0, 0}, {0, 0, -4}, red);
    room.quad("wall", {-2, 0, -1}, {4, 0, 0}, {0, 2, 0}, white);
    constexpr float kFrom = 0.01f, kWide = 0.008f;  // m, from the wall and across
    room.box("near lid", {0, 2.5f, -1 + kFrom - 1}, {4, 0.1f, 2}, white);
    room.box("far lid", {0, 2.5f, -1 + kFrom + kWide + 1}, {4, 0.1f, 2}, white);
    room.sun("sun", {0, -1, 0}, glm::vec3(100));
    room.camera("camera", {0, 0.4f, 0.2f}, {0, 0.1f, -1}, 40);
    Bench with(room.finish(), {96, 54}), without(with.asset, {96, 54});
    const Image truth = tracedBounce1(with);
    const double found = errorBeside(truth, with, true, true),
                 lights = errorBeside(truth, without, false, true);
    std::printf("a strip: relative RMSE %.3f with rays, %.3f without\n", found, lights);
    EXPECT_LT(found, 0.3 * lights);
}

// Draws through squares of orthographic, perspective and cube maps, whose reach is all of the room, and rays
// into the hemisphere find the whole of the light together, and none of it twice.
TEST(TexelRays, BothWaysAddUpForEveryKindOfMap) {
    for (const auto& [kind, name] : {std::pair{LightKind::kDirectional, "sun"},
                                     {LightKind::kSpot, "spot"},
                                     {LightKind::kPoint, "point"}}) {
        Bench b(*scenegen::buildScene("cornell", 0), {96, 54});
        RenderLight& lamp = b.scene.lights[0];
        lamp.kind = kind;
        if (kind == LightKind::kDirectional) lamp.direction = glm::normalize(glm::vec3(0.3f, -0.4f, -1));
        if (kind == LightKind::kPoint) lamp.position.y = 1.6f;
        const Image truth = tracedBounce1(b);
        b.settings = withRays(true);
        useSmallMaps(b.settings);
        b.settings.bounce.valClustering.count = 8;  // rays have all to say
        b.settings.bounce.texelRays.reach = 1;
        b.settings.bounce.texelRays.settleFrames = 64;
        const int rest = int(framesToRest(b.settings.bounce));
        const Image image = renderLayer(b.renderer, b.scene, b.size, b.settings, Layer::kBounce1, rest);
        const double ratio = meanOf(image) / meanOf(truth);
        std::printf("%s: mean over path tracing's %.4f\n", name, ratio);
        EXPECT_NEAR(ratio, 1, 0.01);  // 1.34 if squares are taken for half as large again
    }
}

// Sills light the wall above them: the lights' shape is wrong there, rays find it.
TEST(TexelRays, FindTheShapeOfNearLights) {
    Bench with(*scenegen::buildScene("ledges", 0), {96, 54}), without(with.asset, {96, 54});
    const Image truth = tracedBounce1(with);
    const double found = errorBeside(truth, with, true, false),
                 lights = errorBeside(truth, without, false, false);
    std::printf("ledges: relative RMSE %.3f with rays, %.3f without\n", found, lights);
    EXPECT_LT(found, 0.75 * lights);
}

}  // namespace
}  // namespace ag::gi
