#include "engine/app/input_events.h"

#include <gtest/gtest.h>

#include "engine/app/bindings.h"

namespace ag {
namespace {

constexpr int kUndo = 90, kSave = 294;

// All that happened within one slow frame: a click that selects, a drag, then keys.
TEST(InputEvents, AClickAndADragWithinOneFrameAreSeenOneAfterTheOther) {
    InputEvents events;
    events.move({10, 5});
    events.button(0, true);
    events.button(0, false);
    events.button(0, true);
    events.move({20, 5});
    events.move({30, 5});
    events.button(0, false);
    events.key({kUndo, true});
    events.key({kSave});

    events.beginFrame();
    EXPECT_EQ(events.pointer().place, glm::vec2(10, 5));
    EXPECT_EQ(events.pointer().buttons, 1u);
    events.beginFrame();
    EXPECT_EQ(events.pointer().buttons, 0u);
    events.beginFrame();
    EXPECT_EQ(events.pointer().place, glm::vec2(10, 5));
    EXPECT_EQ(events.pointer().buttons, 1u);
    events.takeKeys();  // the button's own
    events.beginFrame();
    EXPECT_EQ(events.pointer().place, glm::vec2(30, 5)) << "movement while a button is held is of one frame";
    EXPECT_EQ(events.pointer().buttons, 0u);
    EXPECT_TRUE(events.takeKeys().empty()) << "keys were seen before the drag that they follow ended";
    events.beginFrame();
    const auto keys = events.takeKeys();
    ASSERT_EQ(keys.size(), 2u);
    EXPECT_EQ(keys[0].code, kUndo);
    EXPECT_TRUE(keys[0].control);
    EXPECT_EQ(keys[1].code, kSave);
    EXPECT_FALSE(keys[1].control);
}

TEST(InputEvents, AKeyAfterAMoveWaitsForTheNextFrame) {
    InputEvents events;
    events.key({kUndo});
    events.move({7, 8});
    events.key({kSave});
    events.beginFrame();
    const auto first = events.takeKeys();
    ASSERT_EQ(first.size(), 1u);
    EXPECT_EQ(first[0].code, kUndo);
    EXPECT_EQ(events.pointer().place, glm::vec2(7, 8));
    events.beginFrame();
    ASSERT_EQ(events.takeKeys().size(), 1u);
    events.beginFrame();
    EXPECT_TRUE(events.takeKeys().empty());
}

TEST(InputEvents, AButtonIsAKeyToo) {
    InputEvents events;
    events.move({1, 1});
    events.button(2, true);
    events.beginFrame();
    EXPECT_EQ(events.pointer().buttons, 4u);
    const auto keys = events.takeKeys();
    ASSERT_EQ(keys.size(), 1u);
    EXPECT_EQ(keys[0].code, kMouseCode + 2);
}

}  // namespace
}  // namespace ag
