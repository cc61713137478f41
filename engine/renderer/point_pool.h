// The points that stand for the scene's surfaces, on the host: at first along one curve through all
// instances, then with ranges for instances that come later, and holes where some left. Knows which elements
// differ from what was uploaded, so that what comes and goes uploads only its own.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/renderer/mesh_points.h"
#include "engine/renderer/range_pool.h"
#include "shaders/later_bounces/later_bounces_io.h"

namespace ag::render {

constexpr uint32_t kSurfaceSamples = 1u << 17;  // over the whole scene, at first
constexpr uint32_t kBouncePoints = 1u << 12;    // of them, for light that bounces on
constexpr uint32_t kEmissivePoints = 1u << 12;  // on emissive surfaces

// Elements of an array that changed; merged, so that none is copied twice.
class ChangedElements {
  public:
    void add(uint32_t begin, uint32_t end) { ranges_.push_back({begin, end}); }
    void clear() { ranges_.clear(); }
    bool empty() const { return ranges_.empty(); }
    std::span<const RenderScene::Range> merged();  // ascending; those that nearly meet are one

  private:
    std::vector<RenderScene::Range> ranges_;
};

class PointPool {
  public:
    void load(const GeometryArrays& geometry);  // samples every mesh
    // All chosen anew. `whole`: see chooseBouncePoints; `lightUnit`: chooseEmissivePoints.
    void start(const RenderScene& scene, bool whole, float lightUnit);
    // Takes in which of `rows` came, went or became something else. False: what is bent by joints did, or
    // there is more than twice the surface there was; then it must start() anew.
    bool follow(const RenderScene& scene, std::span<const RenderScene::Range> rows);
    bool isEmpty() const { return samples_.empty(); }

    // Static points first, then those that may move.
    std::span<const io::SurfaceSample> samples() const { return samples_; }
    std::span<const float> pointAreas() const { return areas_; }  // by instance
    // Reflecting, then emissive ones.
    std::span<const io::BouncePoint> bouncePoints() const { return bounces_; }
    uint32_t staticCount() const { return layers_[0].count(); }
    uint32_t emissiveCount() const { return uint32_t(bounces_.size()) - reflecting_; }
    uint32_t reflectingCount() const { return reflecting_; }
    float emissiveFlux() const { return emissiveFlux_; }  // W, mean of the channels
    // m² that a point stands for in the mean, when they were chosen last.
    float reflectingArea() const { return reflectingArea_; }
    float emissiveArea() const { return emissiveArea_; }

    // Another number: of the arrays' places (all of them changed), of static points, of bounce points.
    uint64_t layoutVersion() const { return layoutVersion_; }
    uint64_t staticVersion() const { return staticVersion_; }
    uint64_t bounceVersion() const { return bounceVersion_; }

    ChangedElements changedSamples, changedAreas, changedBounces;

  private:
    struct Row {
        uint32_t primitive = kNoPrimitive, skinnedMesh = kNoSkinnedMesh;
        bool movable = false, onCurve = false;
        RangePool::Range range;  // of its layer's spare points
        bool operator==(const Row& o) const {
            return primitive == o.primitive && skinnedMesh == o.skinnedMesh && movable == o.movable;
        }
    };
    struct Layer {
        uint32_t first = 0, curve = 0, spare = 0;  // points
        RangePool ranges;                          // of the spare ones
        uint32_t count() const { return curve + spare; }
    };
    static Row rowOf(const RenderInstance& instance);
    void chooseBounces(const RenderScene& scene);
    void chooseEmissive(const RenderScene& scene);
    void indexCurves();
    void makeRoom(uint32_t layer, uint32_t spare);
    void drop(uint32_t row);
    void add(const RenderScene& scene, uint32_t row);
    void addBounces(const RenderScene& scene, uint32_t row, MeshPoints& mesh, float area);
    glm::vec3 albedoOn(const RenderScene& scene, uint32_t row, MeshPoints& mesh, uint32_t sample);
    void punch(uint32_t point);

    std::vector<MeshPoints> meshes_;
    std::vector<Row> rows_;
    Layer layers_[2];  // static, movable
    std::vector<io::SurfaceSample> samples_;
    std::vector<glm::vec2> uvs_;
    std::vector<glm::vec3> tints_;
    std::vector<float> areas_;
    std::vector<io::BouncePoint> bounces_;
    uint32_t reflecting_ = 0;
    std::vector<uint32_t> freeBounces_;
    std::vector<std::vector<uint32_t>> bouncesOf_;  // by row; empty until something comes or goes
    // Points on the curves by row: places in curvePoints_ from firstCurvePoint_[row] on, relative to the
    // layer.
    std::vector<uint32_t> firstCurvePoint_, curvePoints_;
    double density_ = 0;    // points/m²
    double startArea_ = 0;  // m², in all when it was started
    double area_ = 0;       // now
    double unseen_ = 0;     // of it, no bounce point stands for
    bool whole_ = false;
    float lightUnit_ = 1, emissiveFlux_ = 0, reflectingArea_ = 0, emissiveArea_ = 0;
    uint64_t layoutVersion_ = 0, staticVersion_ = 0, bounceVersion_ = 0;
};

}  // namespace ag::render
