#include <cstring>

#include "tools/ecs_bench/frame.h"

namespace ag::ecs_bench {

void PlainFrame::fill(Kind& kind, uint32_t count, uint32_t seed, bool moves, bool spins) {
    for (uint32_t i = 0; i < count; ++i) {
        kind.local.push_back(moves ? localOf(seed + i) : limbOf(seed + i));
        if (moves) kind.velocity.push_back(startOf(seed + i));
        if (spins) kind.spin.push_back(spinOf(seed + i));
    }
    kind.matrix.resize(count);
    kind.extent.resize(count);
    kind.box.resize(count);
    kind.visible.resize(count);
}

PlainFrame::PlainFrame() {
    fill(things_, kPlainThings, 0, true, true);
    fill(lamps_, kLamps, 100'000, true, true);
    fill(harmed_, kHarmed, 200'000, true, true);
    fill(rigs_, kRigs, 400'000, true, true);
    fill(limbs_, kRigs * kLimbsPerRig, 500'000, false, true);
    fill(tips_, kRigs, 600'000, false, false);
    glow_.resize(kLamps);
    health_.resize(kHarmed);
    harm_.resize(kHarmed);
    for (uint32_t i = 0; i < kSparks; ++i)
        addSpark(300'000 + i);
    for (uint32_t i = 0; i < kRigs * kLimbsPerRig; ++i)
        limbs_.above.push_back(i / kLimbsPerRig);
    for (uint32_t i = 0; i < kRigs; ++i)
        tips_.above.push_back(i * kLimbsPerRig);
    uint32_t slots = 0;
    for (Kind* kind : kinds_) {
        kind->slot = slots;
        slots += uint32_t(kind->size());
    }
    gpu_.resize(slots);
}

void PlainFrame::addSpark(uint32_t seed) {
    sparkOwners_.push_back(handles_.take(uint32_t(sparks_.size()), 0));
    sparks_.local.push_back(localOf(seed));
    sparks_.velocity.push_back(startOf(seed));
    sparks_.spin.push_back(spinOf(seed));
    sparks_.matrix.emplace_back();
    sparks_.extent.emplace_back();
    sparks_.box.emplace_back();
    sparks_.visible.emplace_back();
    spark_.push_back(sparkOf(seed));
}

void PlainFrame::removeSpark(uint32_t row) {
    const auto fillHole = [row](auto& column) {
        column[row] = column.back();
        column.pop_back();
    };
    handles_.release(sparkOwners_[row]);
    fillHole(sparkOwners_);
    if (row < sparkOwners_.size()) handles_.find(sparkOwners_[row])->row = row;
    fillHole(sparks_.local);
    fillHole(sparks_.velocity);
    fillHole(sparks_.spin);
    fillHole(sparks_.matrix);
    fillHole(sparks_.extent);
    fillHole(sparks_.box);
    fillHole(sparks_.visible);
    fillHole(spark_);
}

void PlainFrame::respawnSparks() {
    std::array<uint32_t, kSparks> seeds;
    size_t count = 0;
    for (size_t i = burnt_.size(); i-- > 0;) {  // from the back: rows before stay where they are
        seeds[count++] = nextSeed(spark_[burnt_[i]].seed);
        removeSpark(burnt_[i]);
    }
    for (size_t i = 0; i < count; ++i)
        addSpark(seeds[i]);
}

void PlainFrame::run() {
    for (Kind* kind : kinds_) {
        Local* local = kind->local.data();
        Velocity* velocity = kind->velocity.data();
        for (size_t i = 0, n = kind->velocity.size(); i < n; ++i)
            moveThing(local[i], velocity[i]);
    }
    for (Kind* kind : kinds_) {
        Local* local = kind->local.data();
        const Spin* spin = kind->spin.data();
        for (size_t i = 0, n = kind->spin.size(); i < n; ++i)
            spinThing(local[i], spin[i]);
    }
    for (Kind* kind : {&things_, &lamps_, &harmed_, &sparks_, &rigs_}) {
        const Local* local = kind->local.data();
        Matrix* matrix = kind->matrix.data();
        for (size_t i = 0, n = kind->size(); i < n; ++i)
            matrix[i].worldFromLocal = matrixOf(local[i]);
    }
    for (auto [kind, parents] : {std::pair(&limbs_, &rigs_), std::pair(&tips_, &limbs_)}) {
        const Local* local = kind->local.data();
        const uint32_t* above = kind->above.data();
        const Matrix* parent = parents->matrix.data();
        Matrix* matrix = kind->matrix.data();
        for (size_t i = 0, n = kind->size(); i < n; ++i)
            matrix[i].worldFromLocal = below(parent[above[i]].worldFromLocal, local[i]);
    }
    for (Kind* kind : kinds_) {
        const Matrix* matrix = kind->matrix.data();
        const Extent* extent = kind->extent.data();
        WorldBox* box = kind->box.data();
        for (size_t i = 0, n = kind->size(); i < n; ++i)
            box[i] = boxOf(matrix[i].worldFromLocal, extent[i]);
    }
    lights_.clear();
    for (size_t i = 0; i < lamps_.size(); ++i)
        lights_.push_back({lamps_.matrix[i].worldFromLocal[3], glow_[i].intensity});
    for (Kind* kind : kinds_) {
        const WorldBox* box = kind->box.data();
        Visible* visible = kind->visible.data();
        const Planes planes = planes_;
        for (size_t i = 0, n = kind->size(); i < n; ++i)
            visible[i].yes = inside(box[i], planes);
    }
    for (size_t i = 0; i < health_.size(); ++i)
        harm(health_[i], harm_[i]);
    burnt_.clear();
    for (uint32_t i = 0; i < spark_.size(); ++i)
        if ((spark_[i].left -= kStep) <= 0) burnt_.push_back(i);
    for (const Kind* kind : kinds_)
        std::memcpy(gpu_.data() + kind->slot, kind->matrix.data(), kind->size() * sizeof(Matrix));
    respawnSparks();
}

uint64_t PlainFrame::objectsHash() const {
    uint64_t sum = 0;
    for (const Kind* kind : kinds_)
        for (size_t i = 0; i < kind->size(); ++i)
            sum += objectHash(kind->matrix[i], kind->box[i], kind->visible[i]);
    return sum;
}

}  // namespace ag::ecs_bench
