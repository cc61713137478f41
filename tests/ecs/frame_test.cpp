// The bench's frame of ten systems: the same bits on one thread, on two and over plain arrays.
#include "tools/ecs_bench/frame.h"

#include <gtest/gtest.h>

namespace ag::ecs_bench {
namespace {

struct Hashes {
    uint64_t state, objects;
    bool operator==(const Hashes&) const = default;
};

Hashes after(uint32_t movingShare, uint32_t threads, int frames) {
    OurFrame frame(movingShare);
    JobRunner runner(threads);
    for (int i = 0; i < frames; ++i)
        frame.run(runner);
    return {frame.stateHash(), frame.objectsHash()};
}

TEST(Frame, OneThreadTwoThreadsAndPlainArraysAgree) {
    const Hashes one = after(1, 1, 25);
    EXPECT_EQ(after(1, 2, 25), one);
    PlainFrame plain;
    for (int i = 0; i < 25; ++i)
        plain.run();
    EXPECT_EQ(plain.objectsHash(), one.objects);
    EXPECT_NE(after(1, 1, 26).objects, one.objects);
}

TEST(Frame, WhereLittleMovesLittleIsCopied) {
    EXPECT_EQ(after(6, 1, 25), after(6, 2, 25));
    OurFrame moving(1), still(6);
    JobRunner one(1);
    const auto copied = [&](OurFrame& frame) {
        for (int i = 0; i < 5; ++i)
            frame.run(one);
        const uint64_t before = frame.uploadedRows();
        frame.run(one);
        return frame.uploadedRows() - before;
    };
    EXPECT_EQ(copied(moving), kObjects);
    const uint64_t few = copied(still);
    EXPECT_GE(few, kObjects / 6);
    EXPECT_LE(few, kObjects / 4) << "one in six moves, all sparks, and rows beside them";
}

}  // namespace
}  // namespace ag::ecs_bench
