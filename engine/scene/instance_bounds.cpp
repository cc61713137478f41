#include "engine/scene/instance_bounds.h"

#include <algorithm>
#include <cmath>

namespace ag {
namespace {

using Planes = ViewPlanes;
constexpr float kNoBox = -1e30f;  // half a side of an empty box
constexpr uint32_t kBlock = InstanceBounds::kBlock;
constexpr uint32_t kWordsPerBlock = kBlock / 64;
constexpr uint32_t kBlocksPerPiece = 64;

enum class Side { kOut, kCut, kIn };

Side sideOf(const Bounds& box, const Planes& planes) {
    if (box.empty()) return Side::kOut;
    const glm::vec3 center = (box.min + box.max) * 0.5f, half = (box.max - box.min) * 0.5f;
    Side side = Side::kIn;
    for (const glm::vec4& p : planes) {
        const float middle = glm::dot(glm::vec3(p), center) + p.w;
        const float reach = std::fabs(p.x) * half.x + std::fabs(p.y) * half.y + std::fabs(p.z) * half.z;
        if (middle + reach < 0) return Side::kOut;
        if (middle - reach < 0) side = Side::kCut;
    }
    return side;
}

std::span<const uint64_t> wordsOf(uint32_t block, std::span<const uint64_t> rows) {
    const size_t first = size_t(block) * kWordsPerBlock;
    return rows.subspan(first, std::min<size_t>(kWordsPerBlock, rows.size() - first));
}

// The least of the planes' distances; separate columns, so that the compiler takes several rows at once.
void leastDistance(const float* const center[3], const float* const half[3], uint32_t count,
                   const Planes& planes, float* least) {
    for (uint32_t i = 0; i < count; ++i) {
        float d = 1e30f;
        for (const glm::vec4& p : planes) {
            const float reach =
                std::fabs(p.x) * half[0][i] + std::fabs(p.y) * half[1][i] + std::fabs(p.z) * half[2][i];
            const float at = p.x * center[0][i] + p.y * center[1][i] + p.z * center[2][i] + p.w + reach;
            d = at < d ? at : d;
        }
        least[i] = d;
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
            const auto words = wordsOf(b, changedRows);
            if (std::ranges::all_of(words, [](uint64_t w) { return w == 0; })) continue;
            Bounds box;
            for (uint32_t row = b * kBlock, end = std::min(row + kBlock, uint32_t(rows_)); row < end; ++row)
                box.add(of(row));
            blocks_[b] = box;
        }
    });
    Bounds all;
    for (const Bounds& block : blocks_)
        all.add(block);
    return all;
}

// Sets bits of words that are zero.
void InstanceBounds::cullBlock(uint32_t b, const Planes& planes, uint64_t* visible) const {
    const uint32_t begin = b * kBlock, count = std::min(kBlock, uint32_t(rows_) - begin);
    const Side side = sideOf(blocks_[b], planes);
    if (side == Side::kOut) return;
    float least[kBlock];
    const float* const center[] = {&center_[0][begin], &center_[1][begin], &center_[2][begin]};
    const float* const half[] = {&half_[0][begin], &half_[1][begin], &half_[2][begin]};
    if (side == Side::kCut)
        leastDistance(center, half, count, planes, least);
    else
        std::copy_n(half[0], count, least);  // all but empty ones
    for (uint32_t i = 0; i < count; ++i)
        visible[i / 64] |= uint64_t(least[i] >= 0) << (i % 64);
}

void InstanceBounds::cull(const Planes& planes, std::vector<uint64_t>& visibleRows, JobRunner& runner) const {
    visibleRows.assign(blocks_.size() * kWordsPerBlock, 0);
    runner.parallelFor(uint32_t(blocks_.size()), kBlocksPerPiece, [&](uint32_t first, uint32_t last) {
        for (uint32_t b = first; b < last; ++b)
            cullBlock(b, planes, &visibleRows[b * kWordsPerBlock]);
    });
}

bool InstanceBounds::cullChanged(const Planes& planes, std::span<const uint64_t> changedRows,
                                 std::vector<uint64_t>& visibleRows) const {
    static_assert(kWordsPerBlock == 1);
    uint64_t seen = 0;
    for (uint32_t b = 0; b < blocks_.size(); ++b) {
        const uint64_t changed = changedRows[b], before = visibleRows[b];
        if (changed == 0) continue;
        visibleRows[b] = 0;
        cullBlock(b, planes, &visibleRows[b]);
        seen |= (before | visibleRows[b]) & changed;
    }
    return seen != 0;
}

}  // namespace ag
