#include <cstring>

#include "tools/ecs_bench/frame.h"

namespace ag::ecs_bench {
namespace {

struct Limb {};
struct Tip {};
struct Above {
    Entity entity;
};

struct LightList {
    std::vector<GatheredLight> lights;
};

// Each chunk has a range of slots as long as it can be, for ever: upload is a copy a run of changed rows.
struct GpuRows {
    std::vector<std::vector<uint32_t>> firstSlot;  // by archetype and chunk
    std::vector<Matrix> rows;
    std::atomic<uint64_t> copied{0};

    uint32_t slotOf(const Chunk& chunk) {
        const uint32_t archetype = chunk.archetype->index;
        if (firstSlot.size() <= archetype) firstSlot.resize(archetype + 1);
        while (firstSlot[archetype].size() <= chunk.ordinal) {
            firstSlot[archetype].push_back(uint32_t(rows.size()));
            rows.resize(rows.size() + chunk.archetype->chunks[firstSlot[archetype].size() - 1]->capacity);
        }
        return firstSlot[archetype][chunk.ordinal];
    }
};

void move(View<Local, Velocity> moving, JobRunner& runner) {
    moving.parallel(runner, [](Local& local, Velocity& v) { moveThing(local, v); });
}
void spin(View<Local, const Spin> spinning, JobRunner& runner) {
    spinning.parallel(runner, [](Local& local, const Spin& s) { spinThing(local, s); });
}
void placeRoots(View<Changed<const Local>, Matrix, Without<Above>> roots, JobRunner& runner) {
    roots.parallel(runner, [](const Local& local, Matrix& m) { m.worldFromLocal = matrixOf(local); });
}

// Where the parts themselves moved, then where only what they hang on did.
template <class Depth>
void placeBelow(View<Changed<const Local>, const Above, Matrix, With<Depth>> moved,
                View<Unchanged<const Local>, const Above, Matrix, With<Depth>> still,
                Lookup<const Matrix> parents, JobRunner& runner) {
    moved.parallel(runner, [&](const Local& local, const Above& above, Matrix& m) {
        m.worldFromLocal = below(parents(above.entity)->worldFromLocal, local);
    });
    still.parallel(runner, [&](const Local& local, const Above& above, Matrix& m) {
        if (!parents.changed(above.entity)) return false;
        m.worldFromLocal = below(parents(above.entity)->worldFromLocal, local);
        return true;
    });
}

void updateBoxes(View<Changed<const Matrix>, const Extent, WorldBox> all, JobRunner& runner) {
    all.parallel(runner,
                 [](const Matrix& m, const Extent& e, WorldBox& box) { box = boxOf(m.worldFromLocal, e); });
}
void gatherLights(View<const Matrix, const Glow> lamps, Res<LightList> list) {
    list->lights.clear();
    lamps.each([&](const Matrix& m, const Glow& glow) {
        list->lights.push_back({m.worldFromLocal[3], glow.intensity});
    });
}
void cull(View<const WorldBox, Visible> all, Res<const Planes> camera, JobRunner& runner) {
    const Planes planes = *camera;
    all.parallel(runner, [&](const WorldBox& box, Visible& visible) { visible.yes = inside(box, planes); });
}
void damage(View<Health, const Harm> all) {
    all.each([](Health& health, const Harm& by) { harm(health, by); });
}
void burn(View<Spark> sparks, Commands& commands) {
    sparks.each([&](Entity entity, Spark& spark) {
        if ((spark.left -= kStep) > 0) return;
        const uint32_t seed = nextSeed(spark.seed);
        commands.destroy(entity);
        commands.create(localOf(seed), startOf(seed), spinOf(seed), Matrix{}, Extent{}, WorldBox{}, Visible{},
                        sparkOf(seed));
    });
}
void upload(View<const Matrix> all, View<Taken<const Matrix>> changed, Res<GpuRows> gpu, JobRunner& runner) {
    all.chunks([&](const RowRun& run, std::span<const Matrix>) { gpu->slotOf(*run.chunk); });
    changed.parallelChunks(runner, [&](const RowRun& run, std::span<const Matrix> rows) {
        const uint32_t slot = gpu->firstSlot[run.chunk->archetype->index][run.chunk->ordinal] + run.first;
        std::memcpy(gpu->rows.data() + slot, rows.data(), rows.size_bytes());
        gpu->copied.fetch_add(rows.size(), std::memory_order_relaxed);
    });
}

void spawnThings(World& world, uint32_t count, uint32_t seed, uint32_t movingShare, auto... more) {
    for (uint32_t i = seed; i < seed + count; ++i) {
        const bool moves = (i - seed) * movingShare < count;
        if (moves)
            world.create(localOf(i), startOf(i), spinOf(i), Matrix{}, Extent{}, WorldBox{}, Visible{},
                         more...);
        else
            world.create(localOf(i), Matrix{}, Extent{}, WorldBox{}, Visible{}, more...);
    }
}

void spawnRigs(World& world, uint32_t movingShare) {
    for (uint32_t rig = 0; rig < kRigs; ++rig) {
        const uint32_t seed = 400'000 + rig;
        const bool moves = rig * movingShare < kRigs;
        const Entity root = moves ? world.create(localOf(seed), startOf(seed), spinOf(seed), Matrix{},
                                                 Extent{}, WorldBox{}, Visible{})
                                  : world.create(localOf(seed), Matrix{}, Extent{}, WorldBox{}, Visible{});
        Entity first;
        for (uint32_t i = rig * kLimbsPerRig; i < (rig + 1) * kLimbsPerRig; ++i) {
            const Entity limb = world.create(limbOf(500'000 + i), Above{root}, Matrix{}, Extent{}, WorldBox{},
                                             Visible{}, Limb{});
            if (moves) world.add(limb, spinOf(500'000 + i));
            if (!first) first = limb;
        }
        world.create(limbOf(600'000 + rig), Above{first}, Matrix{}, Extent{}, WorldBox{}, Visible{}, Tip{});
    }
}

}  // namespace

OurFrame::OurFrame(uint32_t movingShare) {
    world_.setResource<LightList>();
    world_.setResource<GpuRows>();
    world_.setResource<Planes>(cameraPlanes());
    spawnThings(world_, kPlainThings, 0, movingShare);
    spawnThings(world_, kLamps, 100'000, movingShare, Glow{});
    spawnThings(world_, kHarmed, 200'000, movingShare, Health{}, Harm{});
    for (uint32_t i = 300'000; i < 300'000 + kSparks; ++i)
        world_.create(localOf(i), startOf(i), spinOf(i), Matrix{}, Extent{}, WorldBox{}, Visible{},
                      sparkOf(i));
    spawnRigs(world_, movingShare);
    schedule_.add("move", move);
    schedule_.add("spin", spin);
    schedule_.add("placeRoots", placeRoots);
    schedule_.add("placeLimbs", placeBelow<Limb>);
    schedule_.add("placeTips", placeBelow<Tip>);
    schedule_.add("updateBoxes", updateBoxes);
    schedule_.add("gatherLights", gatherLights);
    schedule_.add("cull", cull);
    schedule_.add("damage", damage);
    schedule_.add("burn", burn);
    schedule_.add("upload", upload);
}

uint64_t OurFrame::objectsHash() {
    uint64_t sum = 0;
    View<const Matrix, const WorldBox, const Visible>(world_, {})
        .each([&](const Matrix& m, const WorldBox& box, const Visible& v) { sum += objectHash(m, box, v); });
    return sum;
}

uint64_t OurFrame::uploadedRows() const {
    return world_.resource<GpuRows>().copied;
}

}  // namespace ag::ecs_bench
