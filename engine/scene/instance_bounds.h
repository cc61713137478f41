// World bounds of every instance, by blocks: refreshed where instances changed, folded for the scene, and
// tested against a view's planes.
#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "engine/jobs/job_graph.h"
#include "engine/scene/render_scene.h"

namespace ag {

// Far, near, left, right, bottom, top of a clip matrix with reversed depth; a point p is inside where
// dot(plane, (p, 1)) >= 0 for all. With an infinite far plane nothing is beyond that.
using ViewPlanes = std::array<glm::vec4, 6>;
ViewPlanes viewPlanes(const glm::mat4& clipFromWorld);

class InstanceBounds {
  public:
    static constexpr uint32_t kBlock = 64;  // rows, a word of bits

    void resize(size_t rows);  // those it has stay; new ones are empty until they are set
    void clear(uint32_t row);  // to an empty box, which is never in sight
    size_t size() const { return rows_; }
    // Rows of different blocks, or different rows of one, may be set from several threads.
    void set(uint32_t row, const RenderInstance& instance, const Bounds& local);
    void copy(uint32_t row, const InstanceBounds& from, uint32_t fromRow);
    Bounds of(uint32_t row) const;
    // Folds the blocks any of whose rows the words say changed; returns the bounds of all.
    Bounds fold(std::span<const uint64_t> changedRows, JobRunner& runner);
    // A bit a row: whether its box reaches into the view. Boxes that only touch count; a box near a corner
    // may count though it is outside.
    void cull(const ViewPlanes& planes, std::vector<uint64_t>& visibleRows, JobRunner& runner) const;
    // The same, where it is known as it was before the rows changed that the words say. False: none of them
    // is in sight or was.
    bool cullChanged(const ViewPlanes& planes, std::span<const uint64_t> changedRows,
                     std::vector<uint64_t>& visibleRows) const;

  private:
    using Columns = std::array<std::vector<float>, 3>;  // a coordinate each: several boxes are tested at once

    // Blocks from `first` on, a piece of them: bits of rows whose blocks `wanted` names, the others' stay.
    void cullPiece(uint32_t first, const ViewPlanes& planes, std::span<const uint64_t> wanted,
                   std::vector<uint64_t>& visible) const;
    uint64_t rowsInSight(uint32_t block, const ViewPlanes& planes) const;
    uint64_t soundRows(uint32_t block) const;

    size_t rows_ = 0;
    Columns center_, half_, blockCenter_, blockHalf_;
    std::vector<Bounds> blocks_;
};

inline void InstanceBounds::set(uint32_t row, const RenderInstance& instance, const Bounds& local) {
    const glm::mat4x3& m = instance.worldFromLocal;
    const glm::vec3 c = (local.min + local.max) * 0.5f, h = (local.max - local.min) * 0.5f;
    for (int k = 0; k < 3; ++k) {
        center_[size_t(k)][row] = m[0][k] * c.x + m[1][k] * c.y + m[2][k] * c.z + m[3][k];
        half_[size_t(k)][row] =
            std::fabs(m[0][k]) * h.x + std::fabs(m[1][k]) * h.y + std::fabs(m[2][k]) * h.z;
    }
}

}  // namespace ag
