// Streaming 100,000 matrices: a share is written through handles, then what changed is copied.
#include <cstring>
#include <random>

#include "engine/ecs/view.h"
#include "tools/ecs_bench/frame_kernels.h"
#include "tools/ecs_bench/rows.h"

namespace ag::ecs_bench {
namespace {

constexpr uint32_t kCount = 100'000;

struct Streaming {
    World world;
    std::vector<Entity> chosen;
    std::vector<Matrix> gpu = std::vector<Matrix>(kCount);
    std::vector<uint32_t> firstSlot;  // of each chunk
    uint64_t written = 0, copied = 0;
    uint32_t lastRun = 0;

    explicit Streaming(uint32_t changed) {
        std::vector<Entity> all;
        for (uint32_t i = 0; i < kCount; ++i)
            all.push_back(world.create(Matrix{}));
        std::ranges::sample(all, std::back_inserter(chosen), changed, std::mt19937(3));
        std::ranges::shuffle(chosen, std::mt19937(4));
        uint32_t slot = 0;
        for (const auto& chunk : world.archetypes().front().chunks) {
            firstSlot.push_back(slot);
            slot += chunk->capacity;
        }
        gpu.resize(slot);
        frame();  // all are new
        written = copied = 0;
    }
    void frame() {
        world.advanceFrame();
        for (const Entity entity : chosen)
            world.write<Matrix>(entity)->worldFromLocal[3].x += 1;
        written += chosen.size();
        const SystemTime time{.version = world.version(), .lastRun = lastRun};
        View<Taken<const Matrix>>(world, time).chunks([&](const RowRun& run, std::span<const Matrix> rows) {
            std::memcpy(gpu.data() + firstSlot[run.chunk->ordinal] + run.first, rows.data(),
                        rows.size_bytes());
            copied += rows.size();
        });
        lastRun = time.version;
    }
};

Bench streaming(uint32_t changed) {
    return [=, s = std::shared_ptr<Streaming>()](benchmark::State& state) mutable {
        if (!s) s = std::make_shared<Streaming>(changed);
        constexpr int kFrames = 20;  // the clock is coarser than a frame
        timed(state, kFrames, [&] {
            for (int i = 0; i < kFrames; ++i)
                s->frame();
        });
        state.counters["copied_to_written"] = s->written ? double(s->copied) / double(s->written) : 1.0;
    };
}

}  // namespace

void addUploadRows(Rows& rows) {
    rows.alone("upload of 100k matrices, none changed", 2e3, streaming(0));
    rows.alone("upload, 0.1 % scattered changed", 5e3, streaming(kCount / 1000));
    rows.alone("upload, 1 % scattered changed", 25e3, streaming(kCount / 100));
}

}  // namespace ag::ecs_bench
