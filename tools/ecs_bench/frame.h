// The frame of frame_kernels.h twice: as ten systems of our schedule, and as loops over plain arrays.
#pragma once

#include "engine/ecs/schedule.h"
#include "tools/ecs_bench/frame_kernels.h"
#include "tools/ecs_bench/plain_table.h"

namespace ag::ecs_bench {

class OurFrame {
  public:
    // `movingShare` 1: everything moves; 6: one in six does.
    explicit OurFrame(uint32_t movingShare);
    void run(JobRunner& runner) { schedule_.run(world_, runner); }
    World& world() { return world_; }
    uint64_t stateHash() { return world_.stateHash(); }
    uint64_t objectsHash();  // equal to PlainFrame's after as many frames
    uint64_t uploadedRows() const;

  private:
    World world_;
    Schedule schedule_;
};

class PlainFrame {
  public:
    PlainFrame();
    void run();
    uint64_t objectsHash() const;

  private:
    struct Kind {
        std::vector<Local> local;
        std::vector<Velocity> velocity;
        std::vector<Spin> spin;
        std::vector<uint32_t> above;  // row of the parent in its kind
        std::vector<Matrix> matrix;
        std::vector<Extent> extent;
        std::vector<WorldBox> box;
        std::vector<Visible> visible;
        uint32_t slot = 0;  // of row 0 in the upload
        size_t size() const { return local.size(); }
    };
    void fill(Kind& kind, uint32_t count, uint32_t seed, bool moves, bool spins);
    void addSpark(uint32_t seed);
    void removeSpark(uint32_t row);
    void respawnSparks();

    Kind things_, lamps_, harmed_, sparks_, rigs_, limbs_, tips_;
    std::array<Kind*, 7> kinds_ = {&things_, &lamps_, &harmed_, &sparks_, &rigs_, &limbs_, &tips_};
    std::vector<Glow> glow_;
    std::vector<Health> health_;
    std::vector<Harm> harm_;
    std::vector<Spark> spark_;
    HandleTable handles_;
    std::vector<Entity> sparkOwners_;
    std::vector<uint32_t> burnt_;
    std::vector<GatheredLight> lights_;
    std::vector<Matrix> gpu_;
    Planes planes_ = cameraPlanes();
};

}  // namespace ag::ecs_bench
