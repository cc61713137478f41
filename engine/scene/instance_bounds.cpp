#include "engine/scene/instance_bounds.h"

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

constexpr float kNoBox = -1e30f;  // half a side of an empty box
constexpr uint32_t kBlock = InstanceBounds::kBlock;
static_assert(kBlock == 64, "a word of bits");
constexpr uint32_t kBlocksPerPiece = 64;

// The least of the planes' distances, of boxes' farthest corners and of their nearest. Separate
// columns, so that the compiler takes several boxes at once.
template <bool kNearestToo>
void leastDistances(const std::array<std::vector<float>, 3>& center,
                    const std::array<std::vector<float>, 3>& half, size_t first, uint32_t count,
                    const ViewPlanes& planes, float* __restrict farthest, float* __restrict nearest) {
    const float *const cx = &center[0][first], *const cy = &center[1][first], *const cz = &center[2][first];
    const float *const hx = &half[0][first], *const hy = &half[1][first], *const hz = &half[2][first];
    std::fill_n(farthest, count, 1e30f);
    if (kNearestToo) std::fill_n(nearest, count, 1e30f);
    for (const glm::vec4& p : planes) {
        const glm::vec3 size = glm::abs(glm::vec3(p));
        for (uint32_t i = 0; i < count; ++i) {
            const float middle = p.x * cx[i] + p.y * cy[i] + p.z * cz[i] + p.w;
            const float reach = size.x * hx[i] + size.y * hy[i] + size.z * hz[i];
            const float out = middle + reach, in = middle - reach;
            farthest[i] = out < farthest[i] ? out : farthest[i];
            if (kNearestToo) nearest[i] = in < nearest[i] ? in : nearest[i];
        }
    }
}

}  // namespace

ViewPlanes viewPlanes(const glm::mat4& m) {
    const auto row = [&](int i) { return glm::vec4(m[0][i], m[1][i], m[2][i], m[3][i]); };
    // Of small views most things are beyond the far plane.
    return {row(2), row(3) - row(2), row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1)};
}

void InstanceBounds::resize(size_t rows) {
    rows_ = rows;
    const size_t blocks = (rows + kBlock - 1) / kBlock;
    for (int k = 0; k < 3; ++k) {
        center_[size_t(k)].resize(blocks * kBlock, 0);
        half_[size_t(k)].resize(blocks * kBlock, kNoBox);
    }
    blocks_.resize(blocks);
    for (size_t k = 0; k < 3; ++k) {
        blockCenter_[k].resize(blocks, 0);
        blockHalf_[k].resize(blocks, kNoBox);
    }
}

void InstanceBounds::clear(uint32_t row) {
    for (int k = 0; k < 3; ++k) {
        center_[size_t(k)][row] = 0;
        half_[size_t(k)][row] = kNoBox;
    }
}

void InstanceBounds::copy(uint32_t row, const InstanceBounds& from, uint32_t fromRow) {
    for (size_t k = 0; k < 3; ++k) {
        center_[k][row] = from.center_[k][fromRow];
        half_[k][row] = from.half_[k][fromRow];
    }
}

Bounds InstanceBounds::of(uint32_t row) const {
    const glm::vec3 c(center_[0][row], center_[1][row], center_[2][row]),
        h(half_[0][row], half_[1][row], half_[2][row]);
    return {c - h, c + h};
}

Bounds InstanceBounds::fold(std::span<const uint64_t> changedRows, JobRunner& runner) {
    runner.parallelFor(uint32_t(blocks_.size()), kBlocksPerPiece, [&](uint32_t first, uint32_t last) {
        for (uint32_t b = first; b < last; ++b) {
            if (changedRows[b] == 0) continue;
            Bounds box;
            for (uint32_t row = b * kBlock, end = std::min(row + kBlock, uint32_t(rows_)); row < end; ++row)
                box.add(of(row));
            blocks_[b] = box;
            const bool none = box.empty();
            const glm::vec3 c = none ? glm::vec3(0) : 0.5f * (box.min + box.max);
            // Rounding must leave every row's box in its block's.
            const glm::vec3 h =
                none ? glm::vec3(kNoBox) : 0.5f * (box.max - box.min) * 1.000001f + glm::abs(c) * 1e-6f;
            for (int k = 0; k < 3; ++k)
                blockCenter_[size_t(k)][b] = c[k], blockHalf_[size_t(k)][b] = h[k];
        }
    });
    Bounds all;
    for (const Bounds& block : blocks_)
        all.add(block);
    return all;
}

uint64_t InstanceBounds::rowsInSight(uint32_t block, const ViewPlanes& planes) const {
    const uint32_t begin = block * kBlock, count = std::min(kBlock, uint32_t(rows_) - begin);
    float least[kBlock];
    leastDistances<false>(center_, half_, begin, count, planes, least, nullptr);
    uint64_t rows = 0;
    for (uint32_t i = 0; i < count; ++i)
        rows |= uint64_t(least[i] >= 0) << i;
    return rows;
}

// All but empty ones.
uint64_t InstanceBounds::soundRows(uint32_t block) const {
    const uint32_t begin = block * kBlock, count = std::min(kBlock, uint32_t(rows_) - begin);
    uint64_t rows = 0;
    for (uint32_t i = 0; i < count; ++i)
        rows |= uint64_t(half_[0][begin + i] >= 0) << i;
    return rows;
}

void InstanceBounds::cullPiece(uint32_t first, const ViewPlanes& planes, std::span<const uint64_t> wanted,
                               std::vector<uint64_t>& visible) const {
    const uint32_t count = std::min(kBlocksPerPiece, uint32_t(blocks_.size()) - first);
    float farthest[kBlocksPerPiece], nearest[kBlocksPerPiece];
    leastDistances<true>(blockCenter_, blockHalf_, first, count, planes, farthest, nearest);
    for (uint32_t i = 0; i < count; ++i) {
        const uint32_t b = first + i;
        if (!wanted.empty() && wanted[b] == 0) continue;
        visible[b] = farthest[i] < 0 ? 0 : nearest[i] >= 0 ? soundRows(b) : rowsInSight(b, planes);
    }
}

void InstanceBounds::cull(const ViewPlanes& planes, std::vector<uint64_t>& visibleRows,
                          JobRunner& runner) const {
    visibleRows.resize(blocks_.size());
    runner.parallelFor(uint32_t(blocks_.size()), kBlocksPerPiece, [&](uint32_t first, uint32_t last) {
        for (uint32_t b = first; b < last; b += kBlocksPerPiece)
            cullPiece(b, planes, {}, visibleRows);
    });
}

bool InstanceBounds::cullChanged(const ViewPlanes& planes, std::span<const uint64_t> changedRows,
                                 std::vector<uint64_t>& visibleRows) const {
    uint64_t seen = 0;
    std::array<uint64_t, kBlocksPerPiece> before{};
    for (uint32_t first = 0; first < blocks_.size(); first += kBlocksPerPiece) {
        const uint32_t count = std::min(kBlocksPerPiece, uint32_t(blocks_.size()) - first);
        const auto changed = changedRows.subspan(first, count);
        if (std::ranges::all_of(changed, [](uint64_t word) { return word == 0; })) continue;
        std::copy_n(&visibleRows[first], count, before.begin());
        cullPiece(first, planes, changedRows, visibleRows);
        for (uint32_t i = 0; i < count; ++i)
            seen |= (before[i] | visibleRows[first + i]) & changed[i];
    }
    return seen != 0;
}

}  // namespace ag
