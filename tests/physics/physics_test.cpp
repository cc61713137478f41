// Bodies, joints and somebody on foot, against what can be worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/physics/character.h"
#include "engine/physics/physics_system.h"

namespace ag {
namespace {

constexpr float kTick = 1.0f / 60;

Body box(BodyKind kind, glm::vec3 size, float mass = 10) {
    return {.kind = kind, .halfSize = size * 0.5f, .mass = mass};
}

// A floor 40 m wide whose top is y = 0.
void addFloor(PhysicsWorld& w) {
    w.add(box(BodyKind::kStatic, {40, 1, 40}), {0, -0.5, 0}, glm::quat(1, 0, 0, 0));
}

const glm::quat kUpright(1, 0, 0, 0);

struct Walk {
    PhysicsWorld world;
    Character who;
    CharacterSettings settings;

    explicit Walk(glm::dvec3 feet = glm::dvec3(0)) {
        addFloor(world);
        who.feet = feet;
        who.walker = world.addWalker({settings.radius, settings.height}, feet);
    }
    void go(glm::vec2 way, int ticks, bool jump = false, bool crouch = false) {
        for (int i = 0; i < ticks; ++i) {
            moveCharacter(world, who, {way, jump && i == 0, crouch}, settings, kTick);
            world.step(kTick);
        }
    }
};

TEST(Physics, FallsAndRestsWhereTheFloorIs) {
    PhysicsWorld w;
    addFloor(w);
    const BodyId crate = w.add(box(BodyKind::kDynamic, glm::vec3(0.6f)), {0, 3, 0}, kUpright);
    for (int i = 0; i < 30; ++i)
        w.step(kTick);
    EXPECT_NEAR(w.pose(crate).position.y, 3 - 0.5 * 9.81 * 0.25, 0.08) << "half a second of free fall";
    for (int i = 0; i < 270; ++i)
        w.step(kTick);
    EXPECT_NEAR(w.pose(crate).position.y, 0.3, 0.01);
    EXPECT_FALSE(w.pose(crate).awake);
}

TEST(Physics, LiesOnAMeshOfTriangles) {
    PhysicsWorld w({1000, 0, 0});
    const glm::dvec3 corners[] = {{990, 0, -10}, {990, 0, 10}, {1010, 2, 10}, {1010, 2, -10}};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    w.addMesh(corners, indices);
    const BodyId crate = w.add(box(BodyKind::kDynamic, glm::vec3(0.6f)), {1000, 3, 0}, kUpright);
    for (int i = 0; i < 240; ++i)
        w.step(kTick);
    const glm::dvec3 at = w.pose(crate).position;  // on a slope of 1 in 10
    EXPECT_NEAR(at.y, 0.1 * (at.x - 990) + 0.3, 0.03);
    EXPECT_NEAR(at.x, 1000, 1.5);
}

TEST(Physics, HundredsOfBodiesComeToRest) {
    PhysicsWorld w;
    addFloor(w);
    for (int i = 0; i < 300; ++i)
        w.add(box(BodyKind::kDynamic, glm::vec3(0.5f)),
              {0.8 * (i % 15) - 6, 0.26 + 0.55 * (i / 150), 0.8 * (i / 15 % 10) - 4}, kUpright);
    for (int i = 0; i < 400 && w.awakeCount() > 0; ++i)
        w.step(kTick);
    EXPECT_EQ(w.awakeCount(), 0u);
}

TEST(Physics, AHingeStaysOnItsAxisAndWithinItsLimits) {
    PhysicsWorld w;
    Body panel = box(BodyKind::kDynamic, {1, 2, 0.06f}, 20);
    panel.center = {0.5f, 1, 0};
    const BodyId id = w.add(panel, {2, 0.05, 1}, kUpright);
    w.addHinge(id, {.pivot = {0, 0, 0}, .axis = {0, 1, 0}, .least = -1.2f, .most = 0.4f});
    for (const float side : {1.0f, -1.0f}) {
        for (int i = 0; i < 240; ++i) {
            if (i < 60)
                w.push(id, w.pose(id).rotation * glm::vec3(0, 0, side * 1.2f),
                       w.pose(id).position + glm::dvec3(w.pose(id).rotation * glm::vec3(1, 1, 0)));
            w.step(kTick);
            ASSERT_LT(glm::length(w.pose(id).position - glm::dvec3(2, 0.05, 1)), 0.03)
                << "but for the blow at a stop";
            ASSERT_GT((w.pose(id).rotation * glm::vec3(0, 1, 0)).y, 0.999f);
            const glm::vec3 along = w.pose(id).rotation * glm::vec3(1, 0, 0);
            const float angle = std::atan2(-along.z, along.x);
            ASSERT_GT(angle, -1.35f);
            ASSERT_LT(angle, 0.55f);
        }
        const glm::vec3 along = w.pose(id).rotation * glm::vec3(1, 0, 0);
        EXPECT_NEAR(std::atan2(-along.z, along.x), side > 0 ? -1.2f : 0.4f, 0.25f)
            << "at the stop, or a little back from it";
    }
}

TEST(Physics, APendulumKeepsItsPeriodAndItsSwing) {
    World world;
    setUpPhysics(world, {0, 0, 0});
    Body bob = box(BodyKind::kDynamic, glm::vec3(0.2f), 5);
    bob.center = {0, -2, 0};
    bob.linearDamping = bob.angularDamping = 0;
    const float start = 0.2f;
    LocalTransform at{.translation = {0, 4, 0}, .rotation = glm::angleAxis(start, glm::vec3(1, 0, 0))};
    const Entity e = world.create(at, WorldTransform{}, bob, Hinge{.axis = {1, 0, 0}, .least = 1, .most = -1},
                                  Pendulum{start});
    Schedule s;
    s.add("makeBodies", makeBodies);
    s.add("keepPendulums", keepPendulums);
    s.add("stepPhysics", stepPhysics);
    s.add("placeBodies", placeBodies);
    JobRunner runner(1);
    int crossings = 0, first = 0, last = 0;
    float widest = 0, before = start;
    for (int i = 0; i < 1800; ++i) {
        s.run(world, runner);
        const glm::vec3 down = world.get<BodyState>(e)->rotation * glm::vec3(0, -1, 0);
        const float angle = std::asin(down.z);
        if (i > 900) widest = std::max(widest, std::abs(angle));
        if ((angle > 0) != (before > 0)) {
            if (crossings++ == 0) first = i;
            last = i;
        }
        before = angle;
    }
    const double period = 2.0 * (last - first) * double(kTick) / (crossings - 1);
    const double exact = 2 * 3.14159265 * std::sqrt(2.0067 / 9.81);  // with the bob's own inertia
    EXPECT_NEAR(period, exact, 0.03 * exact);
    EXPECT_NEAR(widest, start, 0.03f);
}

TEST(Character, StandsOnTheFloorAndIsStoppedByWalls) {
    Walk w({0, 1, 0});
    w.world.add(box(BodyKind::kStatic, {0.1f, 3, 10}), {2, 1.5, 0}, kUpright);
    w.go({0, 0}, 60);
    EXPECT_NEAR(w.who.feet.y, 0, 0.03);
    EXPECT_TRUE(w.who.grounded);
    w.go({1, 0}, 120);
    EXPECT_LT(w.who.feet.x, 1.95 - 0.3 + 0.001);
    EXPECT_GT(w.who.feet.x, 1.95 - 0.3 - 0.05);
    w.go({1, 0.6f}, 60);
    EXPECT_GT(w.who.feet.z, 0.8) << "slides along the wall";
    EXPECT_LT(w.who.feet.x, 1.951 - 0.3);
}

// Doorposts catch no shoulder; a wall that goes on, and a crate, stop one as before.
TEST(Character, StepsAsideWhereAShoulderIsCaught) {
    for (const double side : {1.0, -1.0})
        for (const double overlap : {-0.1, 0.0, 0.1}) {
            Walk w;
            w.world.add(box(BodyKind::kStatic, {0.4f, 3, 4}), {2, 1.5, side * (2 - overlap)}, kUpright);
            w.go({1, 0}, 150);
            EXPECT_GT(w.who.feet.x, 2.5) << "a post " << overlap << " m before the middle";
            EXPECT_LT(std::abs(w.who.feet.z), 0.5);
        }
    Walk wall;
    wall.world.add(box(BodyKind::kStatic, {0.4f, 3, 4}), {2, 1.5, 1.5}, kUpright);
    wall.go({1, 0}, 150);
    EXPECT_LT(wall.who.feet.x, 1.8) << "its end is half a metre off";
    EXPECT_NEAR(wall.who.feet.z, 0, 0.01);
}

TEST(Character, JumpsAsHighAsTheSettingSays) {
    Walk w;
    w.go({0, 0}, 30);
    const double ground = w.who.feet.y;
    double highest = 0;
    int ticks = 0;
    w.go({0, 0}, 1, true);
    for (; !w.who.grounded && ticks < 200; ++ticks) {
        w.go({0, 0}, 1);
        highest = std::max(highest, w.who.feet.y - ground);
    }
    EXPECT_NEAR(highest, double(w.settings.jumpHeight), 0.02);
    EXPECT_NEAR(ticks * double(kTick), 2 * std::sqrt(2 * double(w.settings.jumpHeight) / 9.81), 0.06);
}

TEST(Character, ClimbsStepsButNotWalls) {
    Walk w;
    w.world.add(box(BodyKind::kStatic, {2, 0.25f, 4}), {2.5, 0.125, 0}, kUpright);
    w.world.add(box(BodyKind::kStatic, {2, 1.2f, 4}), {4.5, 0.6, 0}, kUpright);
    w.go({1, 0}, 120);
    EXPECT_NEAR(w.who.feet.y, 0.25, 0.04);
    EXPECT_LT(w.who.feet.x, 3.5 - 0.29);
    w.go({-1, 0}, 120);
    EXPECT_NEAR(w.who.feet.y, 0, 0.04) << "and down again";
}

TEST(Character, CrouchesUnderWhatHangsLow) {
    Walk w;
    w.world.add(box(BodyKind::kStatic, {2, 1, 4}), {2.5, 1.7, 0}, kUpright);
    w.go({1, 0}, 120);
    EXPECT_LT(w.who.feet.x, 1.25);
    w.go({1, 0}, 60, false, true);
    EXPECT_GT(w.who.feet.x, 1.8);
    w.go({0, 0}, 30);
    EXPECT_TRUE(w.who.crouched) << "there is no room to stand";
    w.go({1, 0}, 180);
    w.go({0, 0}, 30);
    EXPECT_FALSE(w.who.crouched);
}

TEST(Character, PushesACrate) {
    Walk w;
    const BodyId crate = w.world.add(box(BodyKind::kDynamic, glm::vec3(0.7f), 20), {1.5, 0.36, 0}, kUpright);
    w.go({1, 0}, 120);
    EXPECT_GT(w.world.pose(crate).position.x, 2.2);
    EXPECT_LT(w.who.feet.x + 0.3, w.world.pose(crate).position.x - 0.3) << "does not pass into it";
    EXPECT_NEAR(w.world.pose(crate).position.y, 0.35, 0.05);
}

TEST(Character, DoesNotPassWallsHoweverItRuns) {
    Walk w({0, 0.5, 0});
    for (const auto& [x, z] : {std::pair(2.0, 0.0), {-2.0, 0.0}, {0.0, 2.0}, {0.0, -2.0}})
        w.world.add(box(BodyKind::kStatic, x == 0 ? glm::vec3(4.2f, 3, 0.2f) : glm::vec3(0.2f, 3, 4.2f)),
                    {x, 1.5, z}, kUpright);
    for (int i = 0; i < 4000; ++i) {
        const float a = float(i / 7) * 2.399f;
        w.go({std::cos(a), std::sin(a)}, 1, i % 50 == 0, i % 90 > 70);
        ASSERT_LT(std::max(std::abs(w.who.feet.x), std::abs(w.who.feet.z)), 1.62) << "tick " << i;
        ASSERT_GT(w.who.feet.y, -0.05);
    }
}

// A world of crates that fall over each other while somebody runs into them.
std::vector<double> scramble(glm::dvec3 origin) {
    PhysicsWorld world(origin);
    world.add(box(BodyKind::kStatic, {40, 1, 40}), origin + glm::dvec3(0, -0.5, 0), kUpright);
    std::vector<BodyId> crates;
    for (int i = 0; i < 40; ++i)
        crates.push_back(
            world.add(box(BodyKind::kDynamic, glm::vec3(0.4f), 5),
                      origin + glm::dvec3(0.3 * (i % 5) + 1, 0.5 + 0.45 * (i / 5), 0.1 * (i % 3)), kUpright));
    Character who{.feet = origin};
    const CharacterSettings settings;
    who.walker = world.addWalker({settings.radius, settings.height}, who.feet);
    for (int i = 0; i < 240; ++i) {
        moveCharacter(world, who, {{1, 0.2f}, i % 60 == 30, false}, settings, kTick);
        world.step(kTick);
    }
    std::vector<double> out{who.feet.x - origin.x, who.feet.y - origin.y, who.feet.z - origin.z};
    for (const BodyId crate : crates) {
        const glm::dvec3 p = world.pose(crate).position - origin;
        out.insert(out.end(), {p.x, p.y, p.z});
    }
    return out;
}

TEST(Physics, TheSameInputsGiveTheSameBits) {
    const std::vector<double> once = scramble(glm::dvec3(0));
    EXPECT_EQ(scramble(glm::dvec3(0)), once);
    EXPECT_EQ(scramble(glm::dvec3(1048576, 0, -524288)).size(), once.size());
}

TEST(Physics, BodiesFollowTheirEntities) {
    World world;
    setUpPhysics(world, {1e6, 0, 0});
    world.create(LocalTransform{.translation = {1e6, -0.5, 0}}, WorldTransform{},
                 box(BodyKind::kStatic, {10, 1, 10}));
    const Entity crate = world.create(LocalTransform{.translation = {1e6, 2, 0}}, WorldTransform{},
                                      box(BodyKind::kDynamic, glm::vec3(1)));
    Schedule s;
    s.add("makeBodies", makeBodies);
    s.add("stepPhysics", stepPhysics);
    s.add("placeBodies", placeBodies);
    JobRunner runner(1);
    for (int i = 0; i < 240; ++i)
        s.run(world, runner);
    EXPECT_NEAR(world.get<LocalTransform>(crate)->translation.y, 0.5, 0.02);
    EXPECT_NEAR(world.get<LocalTransform>(crate)->translation.x, 1e6, 1e-3) << "as precise far out";
    EXPECT_EQ(world.get<BodyState>(crate)->awake, 0u);
    world.destroy(crate);
    s.run(world, runner);
    EXPECT_EQ(world.resource<Physics>().world->bodyCount(), 1u);
}

TEST(Physics, IsDrawnBetweenItsTicks) {
    World world;
    setUpPhysics(world, {0, 0, 0});
    const Entity e = world.create(LocalTransform{.translation = {0, 50, 0}}, WorldTransform{},
                                  box(BodyKind::kDynamic, glm::vec3(1)));
    Schedule tick, draw;
    tick.add("makeBodies", makeBodies);
    tick.add("stepPhysics", stepPhysics);
    draw.add("placeBodies", placeBodies);
    JobRunner runner(1);
    for (int i = 0; i < 20; ++i)
        tick.run(world, runner);
    const BodyState& state = *world.get<BodyState>(e);
    world.resource<Physics>().share = 0.25f;
    draw.run(world, runner);
    EXPECT_NEAR(world.get<LocalTransform>(e)->translation.y,
                state.previousPosition.y + 0.25 * (state.position.y - state.previousPosition.y), 1e-9);
    EXPECT_LT(state.position.y, state.previousPosition.y);
}

}  // namespace
}  // namespace ag
