// Lights that make no sense: a warning that names them, once, and no black frame.
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "engine/core/log.h"
#include "engine/ecs/schedule.h"
#include "engine/scene/extract_system.h"
#include "engine/scene/light_check.h"
#include "engine/scene/transform_system.h"

namespace ag {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity(),
                kNan = std::numeric_limits<float>::quiet_NaN();

TEST(LightCheck, MendsWhatIsWrongAndNothingElse) {
    RenderLight good{.kind = LightKind::kSpot, .intensity = glm::vec3(3), .range = 5};
    const RenderLight before = good;
    EXPECT_EQ(mendLight(good), nullptr);
    EXPECT_EQ(good, before);
    RenderLight dark{.intensity = glm::vec3(0)};
    EXPECT_EQ(mendLight(dark), nullptr) << "a lamp may be off";
    RenderLight endless{.intensity = glm::vec3(2), .range = kInfinity};
    EXPECT_NE(mendLight(endless), nullptr);
    EXPECT_EQ(endless.range, 0);
    EXPECT_EQ(endless.intensity, glm::vec3(2));
    const auto broken = [](auto change) {
        RenderLight light{.kind = LightKind::kSpot, .intensity = glm::vec3(1), .castsShadow = true};
        change(light);
        return mendLight(light) != nullptr && light.intensity == glm::vec3(0) && !light.castsShadow &&
               std::isfinite(light.position.x + light.range + light.direction.y);
    };
    EXPECT_TRUE(broken([](RenderLight& l) { l.intensity.y = kNan; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.intensity.y = kInfinity; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.intensity.z = -1; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.range = -2; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.range = kNan; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.position.x = kNan; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.direction = glm::vec3(kNan); }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.outerConeAngle = 2; }));
    EXPECT_TRUE(broken([](RenderLight& l) { l.innerConeAngle = kNan; }));
}

TEST(LightCheck, ExtractionNamesTheEntityOnce) {
    const auto old = spdlog::default_logger();
    std::ostringstream text;
    spdlog::set_default_logger(
        std::make_shared<spdlog::logger>("test", std::make_shared<spdlog::sinks::ostream_sink_st>(text)));
    World world;
    const GeometryArrays geometry;
    world.setResource<ActiveCamera>();
    world.setResource<ExtractState>();
    world.setResource<RenderScene>().geometry = &geometry;
    world.create(WorldTransform{}, Name{"lamp over the stairs"}, PunctualLight{.intensity = glm::vec3(kNan)});
    world.create(WorldTransform{}, Name{"good lamp"}, PunctualLight{.intensity = glm::vec3(4)});
    Schedule schedule;
    schedule.add("extractScene", extractScene);
    JobRunner runner(1);
    for (int i = 0; i < 3; ++i)
        schedule.run(world, runner);
    spdlog::set_default_logger(old);
    const std::string log = text.str();
    const size_t first = log.find("lamp over the stairs");
    EXPECT_NE(first, std::string::npos) << log;
    EXPECT_EQ(log.find("lamp over the stairs", first + 1), std::string::npos) << log;
    EXPECT_EQ(log.find("good lamp"), std::string::npos) << log;
    const std::vector<RenderLight>& lights = world.resource<RenderScene>().lights;
    ASSERT_EQ(lights.size(), 2u);
    EXPECT_EQ(lights[0].intensity + lights[1].intensity, glm::vec3(4));
}

}  // namespace
}  // namespace ag
