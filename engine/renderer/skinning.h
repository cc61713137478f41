// Skinned meshes' own vertices: linear-blend skinning by one compute pass, which deforms only skinned meshes
// whose joints moved since they were deformed last. Rasterisation draws them in place of their mesh's, so
// that shadow maps, RSMs and the camera know of nothing; points on surfaces read them too.
#pragma once

#include <memory>

#include "engine/core/function_ref.h"
#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/scene/render_scene.h"
#include "shaders/skinning/skinning_io.h"

namespace ag::render {

struct SceneView;

// Handles of this frame; none where the scene has no skinned meshes.
struct SkinView {
    BufferHandle skinnedMeshes;   // io::SkinRow
    BufferHandle groups;          // uint: the skinned mesh of each group of kSkinGroup deformed vertices
    BufferHandle joints;          // three vec4 each; versions are the skinned meshes'
    BufferHandle previousJoints;  // of skinned meshes in SceneView::moved, as they were a frame ago
    BufferHandle skin;            // io::SkinnedVertex a vertex of the geometry
    BufferHandle positions, attributes;  // of the geometry
    BufferHandle deformedPositions, deformedAttributes;
    explicit operator bool() const { return bool(skinnedMeshes); }
};

// Device memory behind it.
class SkinGpu {
  public:
    explicit SkinGpu(gpu::Device& device) : device_(device) {}

    void load(const GeometryArrays& geometry);
    SkinView import(GraphScope scope, const RenderScene& scene, const gpu::Buffer& positions,
                    const gpu::Buffer& attributes);

    // Copies of joints to be made before new ones take their place.
    std::vector<VkBufferCopy> copiesToPrevious(const RenderScene& scene,
                                               std::span<const RenderScene::Range> rows) const;
    const gpu::Buffer& joints() const { return *joints_; }
    const gpu::Buffer& previousJoints() const { return *previousJoints_; }

    using Stage = FunctionRef<void(std::span<const std::byte>, const gpu::Buffer&, uint64_t offset)>;
    void upload(const RenderScene& scene, Stage stage);
    uint64_t deviceBytes() const;

  private:
    void makeBuffers(const RenderScene& scene);

    gpu::Device& device_;
    uint64_t geometryVersion_ = 0;
    uint64_t tableVersion_ = 0;  // of who the skinned meshes are; 0: none
    std::unique_ptr<gpu::Buffer> skin_, skinnedMeshes_, groups_, joints_, previousJoints_;
    std::vector<uint64_t> uploadedPoses_;  // by skinned mesh
};

void addSkinning(GraphScope scope, const SceneView& scene);
// The bindings of a shader with AG_SKINNED; none if there are none.
void readSkinnedMeshes(PassBuilder& pass, const SkinView& skin);

}  // namespace ag::render
