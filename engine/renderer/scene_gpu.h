// The scene in device memory: geometry and textures uploaded once, transforms streamed as changed ranges,
// lights and draw commands when they change. What the passes see of it is SceneView: typed handles of one
// frame.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/renderer/draw_lists.h"
#include "engine/renderer/pixel_grid.h"
#include "engine/renderer/render_units.h"
#include "engine/renderer/scene_points.h"
#include "engine/renderer/scene_trees.h"
#include "engine/renderer/skinning.h"
#include "engine/renderer/sky_gpu.h"
#include "engine/scene/render_scene.h"
#include "shaders/scene/scene_io.h"

namespace ag::render {

// Of DrawLists, by what is drawn into them: the same from frame to frame as long as lights are, so that what
// is culled for them lasts.
struct ViewSlots {
    uint32_t camera = 0, moved = 0, everything = 0, blended = 0;
    uint32_t firstRsm = 0, firstCascade = 0, firstLight = 0;  // a row each
    uint32_t count = 0;
};
// For each light at most a cube of RSMs and one of shadow views.
ViewSlots viewSlots(const RenderScene& scene);

// Handles of this frame's scene, and what the techniques need to declare draws.
struct SceneView {
    const RenderScene* scene = nullptr;
    DrawLists* draws = nullptr;
    ViewSlots slots;
    Geometry geometry;
    uint64_t loadedVersion = 0;  // of the geometry loaded, unlike any before
    SkinView skin;
    BufferHandle instances;          // io::Instance rows; versions are the draws' (see DrawLists)
    BufferHandle previousInstances;  // the rows of `moved` as they were in the frame before
    std::span<const RenderScene::Range>
        moved;              // rows that stood elsewhere then; others are new or did not move
    bool replaced = false;  // something came or went, too, or nobody knows what did
    BufferHandle materials;
    BufferHandle camera;     // io::CameraConstants
    BufferHandle commands;   // indirect draws of all views
    BufferHandle drawnRows;  // the instances that they draw: a texel buffer of uint
    std::array<ImageHandle, 4> srgbTextures, linearTextures;  // classes 256, 512, 1024, 2048
    PixelGrid grid;                                           // the camera's pixels
    bool sharp = true;  // it sees textures averaged over no more than a pixel
    RenderCamera eye;   // the scene's camera as those see
    RenderUnits units;  // of everything above
    float extent = 0;   // see steadyExtent()
    bool hasEmissive = false;
    bool hasGlossy = false;       // a material that is not Lambert
    float leastRoughness = 1;     // of those that are not
    bool wholeMaterials = false;  // what light goes on from reflects it with its specular lobe, too
    bool hasNormalMaps = false;
    gi::Occluders points;        // of these what points there are
    uint64_t staticVersion = 0;  // changes when an instance that is not movable may have moved
    gi::TracedOccluders trees;   // where asked for
    gi::SkyOnDevice sky;         // none: black
    ImageHandle skyPicture;      // rgba16f, equirectangular: what is seen of it
};

class SceneGpu {
  public:
    explicit SceneGpu(gpu::Device& device);
    ~SceneGpu();
    SceneGpu(const SceneGpu&) = delete;
    SceneGpu& operator=(const SceneGpu&) = delete;

    // Blocking: geometry, materials and textures of a scene just loaded.
    void load(const GeometryArrays& geometry);
    // Of the scene loaded: factors of materials and the version differ. Nothing may be under way.
    void changeMaterials(const GeometryArrays& geometry, RenderUnits units);
    // Of the scene loaded: what follows comes in other units. Nothing may be under way.
    void useUnits(const GeometryArrays& geometry, RenderUnits units);
    // Of its materials and its sky, W/(m² sr).
    float strongestEmission(const RenderScene& scene) {
        return std::max(strongestEmission_, sky_.meanRadiance(scene.sky));
    }

    // Once a frame before the passes are declared: bounds, buckets.
    void beginFrame(const RenderScene& scene, JobRunner& jobs) { draws_.beginFrame(scene, jobs); }
    SceneView import(GraphScope scope, const RenderScene& scene, const PixelGrid& grid,
                     std::optional<gi::TracedBy> traced, bool wholeMaterials);
    // After the passes are declared (all views culled), before they are recorded: copies what changed.
    // `previous`: whether a pass reads where things were in the frame before.
    enum class Previous : uint8_t { kUnread, kKept };
    void upload(VkCommandBuffer commands, FrameGraph& graph, const SceneView& view, Previous previous,
                uint32_t frameSlot);

    DrawLists& draws() { return draws_; }
    uint64_t uploadedBytes() const { return uploadedBytes_; }  // in the last frame
    uint64_t deviceBytes() const;

  private:
    struct Staging {
        std::unique_ptr<gpu::Buffer> buffer;
        uint64_t used = 0;
    };
    void loadMaterials(const GeometryArrays& geometry, RenderUnits units);
    void noteTextures(const GeometryArrays& geometry);
    float leastRoughnessOf(const Material& m) const;
    void loadTextures(const GeometryArrays& geometry);
    void stage(VkCommandBuffer commands, uint32_t frameSlot, std::span<const std::byte> bytes,
               const gpu::Buffer& to, uint64_t offset);
    void keepPrevious(VkCommandBuffer commands, const SceneView& view);
    void uploadInstances(VkCommandBuffer commands, const RenderScene& scene, uint32_t frameSlot);
    void uploadDraws(VkCommandBuffer commands, const ViewDraws& draws, uint32_t frameSlot);
    void reserveBuffers(const RenderScene& scene);
    void reserveDraws(const RenderScene& scene);
    void noteMovements(const RenderScene& scene);
    std::unique_ptr<gpu::Buffer> grown(std::unique_ptr<gpu::Buffer> old, const char* name, uint64_t bytes,
                                       VkFormat texel, bool indirect);

    gpu::Device& device_;
    DrawLists draws_;
    SkinGpu skin_;
    SceneTrees trees_;
    ScenePoints points_;
    SkyGpu sky_;
    uint64_t geometryVersion_ = 0, loads_ = 0;
    float strongestEmission_ = 0;
    uint64_t materialsVersion_ = 0;
    bool hasGlossy_ = false, hasNormalMaps_ = false;
    float leastRoughness_ = 1;
    // Of a linear layer that is some material's roughness.
    std::array<std::vector<std::optional<uint8_t>>, kTextureClassCount> leastGreen_;
    std::unique_ptr<gpu::Buffer> positions_, attributes_, indices_, materials_, instances_,
        previousInstances_, commands_, drawnRows_;
    std::array<std::unique_ptr<gpu::Image>, 4> srgb_, linear_;
    float lightUnit_ = 1;
    uint64_t staticVersion_ = 0, notedVersion_ = 0;           // notedVersion_: of the instances it is about
    std::vector<io::Instance> rows_;                          // scratch for the conversion
    std::vector<VkDrawIndexedIndirectCommand> viewCommands_;  // scratch
    std::vector<RenderScene::Range> moved_;                   // scratch: of SceneView
    uint64_t instancesVersion_ = 0;                           // last uploaded
    std::array<Staging, kFramesInFlight> staging_;
    uint64_t uploadedBytes_ = 0;
};

}  // namespace ag::render
