// Ten steps over 50,000 objects: on one thread beside plain arrays, on two, and where little moves.
#include "tools/ecs_bench/frame.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

Bench ourFrame(uint32_t movingShare, uint32_t threads, Clock clock) {
    return [=, frame = std::shared_ptr<OurFrame>(),
            runner = std::shared_ptr<JobRunner>()](benchmark::State& state) mutable {
        if (!frame) {
            frame = std::make_shared<OurFrame>(movingShare);
            runner = std::make_shared<JobRunner>(threads);
            for (int i = 0; i < 20; ++i)
                frame->run(*runner);
        }
        timed(
            state, 1, [&] { frame->run(*runner); }, clock);
    };
}

}  // namespace

void addFrameRows(Rows& rows) {
    rows.compare("frame of ten systems, 50,000 objects", 1.05, ourFrame(1, 1, Clock::kThread),
                 [frame = std::shared_ptr<PlainFrame>()](benchmark::State& state) mutable {
                     if (!frame) frame = std::make_shared<PlainFrame>();
                     timed(state, 1, [&] { frame->run(); });
                 });
    rows.alone("frame, one thread, on the wall", 0, ourFrame(1, 1, Clock::kWall), 0.4);
    rows.against("frame, two threads to one", 0.56, ourFrame(1, 2, Clock::kWall),
                 "frame, one thread, on the wall/ours", 0.4);
    rows.against("frame, five of six still, to all moving", 0.55, ourFrame(6, 1, Clock::kThread),
                 "frame of ten systems, 50,000 objects/ours");
}

}  // namespace ag::ecs_bench
