// Parents, names and descriptions.
#include "engine/ecs/hierarchy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "engine/ecs/describe.h"
#include "engine/ecs/name.h"
#include "engine/ecs/view.h"
#include "tests/ecs/test_components.h"

namespace ag {
namespace {

uint32_t depth(const World& world, Entity e) {
    const HierarchyDepth* d = world.get<HierarchyDepth>(e);
    return d ? d->depth : 0;
}

TEST(Hierarchy, ReparentingTakesTheSubtreeAlong) {
    World world;
    world.setResource<HierarchyLevels>();
    ChildIndex children;
    std::vector<Entity> e;
    for (int i = 0; i < 6; ++i)
        e.push_back(world.create(Health{i}));
    setParent(world, children, e[1], e[0]);
    setParent(world, children, e[2], e[1]);
    setParent(world, children, e[3], e[1]);
    EXPECT_EQ(depth(world, e[3]), 2u);
    setParent(world, children, e[0], e[4]);
    EXPECT_EQ(depth(world, e[0]), 1u);
    EXPECT_EQ(depth(world, e[3]), 3u);
    EXPECT_EQ(world.resource<HierarchyLevels>().deepest, 3u);
    EXPECT_EQ(subtree(world, children, e[4]), (std::vector<Entity>{e[4], e[0], e[1], e[2], e[3]}));
    setParent(world, children, e[1], Entity{});
    EXPECT_FALSE(world.has<Parent>(e[1]));
    EXPECT_EQ(depth(world, e[2]), 1u);
    EXPECT_TRUE(children.of(world, e[0]).empty());
    EXPECT_EQ(destroySubtree(world, children, e[1]), 3u);
    EXPECT_FALSE(world.alive(e[2]) || world.alive(e[3]) || world.alive(e[1]));
    EXPECT_TRUE(world.alive(e[0]) && world.alive(e[4]) && world.alive(e[5]));
}

// Random edits against a plain list of parents.
TEST(Hierarchy, TheIndexFollowsRandomEdits) {
    World world;
    ChildIndex children;
    std::vector<std::pair<Entity, Entity>> model;  // who, and on whom
    std::mt19937 random(11);
    const auto parentOf = [&](Entity e) {
        return std::ranges::find(model, e, &std::pair<Entity, Entity>::first)->second;
    };
    const auto below = [&](Entity e, Entity above) {
        for (; e; e = parentOf(e))
            if (e == above) return true;
        return false;
    };
    for (int turn = 0; turn < 1500; ++turn) {
        const uint32_t what = random() % 8;
        if (model.size() < 5 || what < 3) {
            model.push_back({world.create(Health{turn}), Entity{}});
        } else if (what < 7) {
            auto& [child, parent] = model[random() % model.size()];
            const Entity to = random() % 9 ? model[random() % model.size()].first : Entity{};
            if (to && below(to, child)) continue;
            setParent(world, children, child, to);
            parent = to;
        } else {
            const Entity root = model[random() % model.size()].first;
            std::vector<Entity> gone;
            for (const auto& [e, p] : model)
                if (below(e, root)) gone.push_back(e);
            ASSERT_EQ(destroySubtree(world, children, root), gone.size());
            std::erase_if(model, [&](const auto& m) { return std::ranges::count(gone, m.first) > 0; });
        }
    }
    ASSERT_GT(model.size(), 50u);
    ASSERT_EQ(world.entityCount(), model.size());
    for (const auto& [e, parent] : model) {
        uint32_t levels = 0;
        for (Entity at = parent; at; at = parentOf(at))
            ++levels;
        EXPECT_EQ(depth(world, e), levels);
        const auto mine = children.of(world, e);
        const auto expected = std::ranges::count(model, e, &std::pair<Entity, Entity>::second);
        EXPECT_EQ(ptrdiff_t(mine.size()), expected);
        for (const Entity child : mine)
            EXPECT_EQ(parentOf(child), e);
    }
}

TEST(Hierarchy, AnotherOnTheSameIndexInheritsNoChildren) {
    World world;
    ChildIndex children;
    const Entity parent = world.create(Health{}), child = world.create(Health{});
    setParent(world, children, child, parent);
    world.destroy(parent);
    const Entity other = world.create(Health{});
    ASSERT_EQ(other.index, parent.index);
    EXPECT_TRUE(children.of(world, other).empty());
    EXPECT_TRUE(children.of(world, parent).empty());
}

TEST(HierarchyDeathTest, NothingHangsBelowItself) {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    World world;
    ChildIndex children;
    const Entity a = world.create(Health{}), b = world.create(Health{});
    setParent(world, children, b, a);
    EXPECT_DEATH(setParent(world, children, a, b), "below itself");
}

TEST(Names, AreFoundAndFollowChanges) {
    World world;
    NameIndex names;
    const Entity lamp = world.create(makeName("lamp")), door = world.create(Health{}, makeName("door"));
    const Entity other = world.create(makeName("lamp"), Health{});
    EXPECT_EQ(names.find(world, "lamp"), lamp);
    EXPECT_EQ(names.find(world, "door"), door);
    EXPECT_FALSE(names.find(world, "lam"));
    EXPECT_EQ(names.findAll(world, "lamp").size(), 2u);
    world.destroy(lamp);
    EXPECT_EQ(names.find(world, "lamp"), other);
    *world.write<Name>(other) = makeName("torch");
    EXPECT_FALSE(names.find(world, "lamp"));
    EXPECT_EQ(names.find(world, "torch"), other);
    View<Name>(world, {.version = world.version() + 5}).each([](Name& name) { name = makeName("same"); });
    EXPECT_EQ(names.findAll(world, "same").size(), 2u) << "systems rename, too";
}

TEST(Names, AreCutBetweenCharacters) {
    const std::string longName(62, 'a');
    EXPECT_EQ(std::string(makeName(longName + "b").text), longName + "b");
    EXPECT_EQ(std::string(makeName(longName + "\xc3\xa9").text), longName) << "é would be halved";
    World world;
    NameIndex names;
    const Entity e = world.create(makeName(longName + "\xc3\xa9 and more"));
    EXPECT_EQ(names.find(world, longName + "\xc3\xa9 and more"), e);
}

TEST(Describe, FieldsReadBackAsText) {
    describe<Health>({field("points", &Health::points)});
    describe<Parent>({field("entity", &Parent::entity)});
    describe<Name>({field("text", &Name::text)});
    describe<Position>({field("y", &Position::y, "m")});
    const Position p{1, 2.5f, 3};
    EXPECT_EQ(fieldText(fieldsOf(componentId<Position>())[0], &p), "2.5");
    EXPECT_EQ(fieldsOf(componentId<Position>())[0].unit, "m");
    const Health h{-7};
    EXPECT_EQ(fieldText(fieldsOf(componentId<Health>())[0], &h), "-7");
    const Parent q{{12, 3}}, none{};
    EXPECT_EQ(fieldText(fieldsOf(componentId<Parent>())[0], &q), "12.3");
    EXPECT_EQ(fieldText(fieldsOf(componentId<Parent>())[0], &none), "none");
    const Name n = makeName("hand lamp");
    EXPECT_EQ(fieldText(fieldsOf(componentId<Name>())[0], &n), "hand lamp");
    EXPECT_EQ(componentType(componentId<Position>()).name, "Position");
    EXPECT_EQ(shortTypeName("game::Position"), "Position");
}

TEST(Describe, ReportsCountRowsAndFill) {
    World world;
    for (int i = 0; i < 1000; ++i)
        world.create(Health{}, Position{});
    world.create(makeName("a lamp"));
    const WorldReport report = reportWorld(world);
    EXPECT_EQ(report.entities, 1001u);
    ASSERT_EQ(report.archetypes.size(), 2u);
    const ArchetypeReport& a = report.archetypes[0];
    EXPECT_NE(a.components.find("Health"), std::string::npos);
    EXPECT_EQ(a.rows, 1000u);
    EXPECT_EQ(a.chunks, 3u);
    EXPECT_EQ(a.capacity, 64u + 256 + 4096);
    EXPECT_DOUBLE_EQ(a.fill(), 1000.0 / 4416);
    EXPECT_GE(a.bytes, a.capacity * (sizeof(Entity) + sizeof(Health) + sizeof(Position)));
    std::vector<Entity> found;
    listEntities(world, "LAMP", found);
    EXPECT_EQ(found.size(), 1u);
    listEntities(world, "", found);
    EXPECT_EQ(found.size(), 1001u);
    listEntities(world, "door", found);
    EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace ag
