// Occluders as trees that compute shaders trace rays through (shaders/bvh): what is static as one, each mesh
// that moves as one of its own, and each frame one over the movable instances' boxes.
#pragma once

#include <array>
#include <vector>

#include "engine/core/function_ref.h"
#include "gi/bvh.h"
#include "gi/inputs.h"
#include "gi/surface_sampling.h"
#include "shaders/bvh/bvh_io.h"

namespace ag::gi {

// A tree's nodes in OccluderTrees, and the box its grid spans.
struct TreeRange {
    uint32_t firstNode = 0, endNode = 0;
    Bounds bounds;
    bool empty() const { return firstNode == endNode; }
};

struct OccluderTrees {
    std::vector<glm::uvec4> nodes;
    std::vector<io::BvhTriangle> triangles;
    std::vector<io::BvhMask> masks;  // of each triangle; empty: none is masked
    TreeRange everythingStatic;      // in the world
    std::vector<TreeRange> ofMesh;   // in the mesh's own coordinates; empty of those that nothing movable has
};

enum class TreesOf { kStatic, kAll };
// What rays of a frame need. `atRest`: they are cast only while nothing moves.
struct TracedBy {
    TreesOf of = TreesOf::kStatic;
    bool atRest = false;
};

// What a mesh sends at a place of its texture: of light that bounces, without its vertices' colours, and by
// itself.
struct SentAt {
    glm::vec3 reflectance{0};
    glm::vec3 radiance{0};  // W/(m² sr)
};
using LookUpSent = FunctionRef<SentAt(uint32_t mesh, glm::vec2 uv)>;
constexpr auto kSendsNothing = [](uint32_t, glm::vec2) { return SentAt{}; };

// Where a triangle of a masked mesh is cut out, by its corners' texture coordinates.
using LookUpMask = FunctionRef<io::BvhMask(uint32_t mesh, const std::array<glm::vec2, 3>& uvs)>;
constexpr auto kNoMask = [](uint32_t, const std::array<glm::vec2, 3>&) { return io::BvhMask{}; };

// Of all surfaces that block light, or of static ones alone. The cost is that of sorting all triangles some
// 18 times: half a second for 250,000 on one core; and 16 calls of `sentAt` for each.
OccluderTrees buildOccluderTrees(const SampledScene& scene, TreesOf of = TreesOf::kAll,
                                 LookUpSent sentAt = kSendsNothing, LookUpMask maskOf = kNoMask);

// When trees are built: at once for what is new, else when what is static has not changed for some frames, as
// long as it moves there are none.
class TreeUpkeep {
  public:
    enum class Task { kNone, kUse, kBuild };
    // Once a frame. `version`: of what is static; never 0.
    Task next(uint64_t version);
    void forget() { *this = {}; }

  private:
    uint64_t built_ = 0, wanted_ = 0;
    uint32_t restedFrames_ = 0;
};

// Where rays from other coordinates meet a tree.
io::BvhPlace placeOf(const TreeRange& tree, const glm::mat4x3& treeFromWorld);

struct MoverTree {
    std::vector<glm::uvec4> nodes;  // items: movable instances, in the order of places from kBvhFirstMover on
    std::vector<io::BvhPlace> places;  // of all trees
    struct Scratch {
        std::vector<Bounds> boxes;
        std::vector<io::BvhPlace> places;  // of the boxes
        Bvh bvh;
    } scratch;
};

// Where the trees stand now: some 2 ms for 10,000 movable instances.
MoverTree placeTrees(const OccluderTrees& trees, std::span<const SampledInstance> instances);
// The same in memory of a frame before.
void placeTrees(const OccluderTrees& trees, std::span<const SampledInstance> instances, MoverTree& result);

// Of a ray to what is outside of everything, in the scene's extent: no surface is farther.
constexpr float kRayReaches = 4;

// What a pass reads that casts rays into all that is static and all that moves.
void readTrees(PassBuilder& pass, const TracedOccluders& trees);

}  // namespace ag::gi
