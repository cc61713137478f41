// From culled draw lists to the draws of a raster pass.
#pragma once

#include "engine/renderer/scene_gpu.h"

namespace ag::render {

// kShapes: all too, but without their materials, as kOpaqueOnly.
enum class DrawFilter { kAll, kShapes, kOpaqueOnly, kMaskedOnly };

// Normal maps bend what the camera sees, and it does not see single-sided surfaces from behind (glTF). Light
// meets the surface itself and does not pass it either way.
enum class Viewer { kCamera, kLight };

// What of a view is drawn, for whom and where.
struct DrawOptions {
    glm::uvec4 viewport{0};  // see RasterDraw
    DrawFilter filter = DrawFilter::kAll;
    Viewer viewer = Viewer::kLight;
    DrawLayer layer = DrawLayer::kAll;
};

// One RasterDraw per non-empty bucket: the variant's constants (kTextureClass, kAlphaMask, kNormalMaps), the
// view's matrix as push constant.
void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              const glm::mat4& clipFromWorld, const DrawOptions& options);
// The same with other push constants, for views that are no matrix.
void drawView(PassBuilder& pass, const SceneView& scene, const ViewDraws& view,
              std::span<const std::byte> push, const DrawOptions& options);
bool hasMasked(const SceneView& scene);  // any alpha-masked surface
void bindBaseColors(PassBuilder& pass, const SceneView& scene, Sampler sampler);
// The bindings of scene/scene.glsl with AG_SCENE_MATERIALS.
void bindMaterials(PassBuilder& pass, const SceneView& scene, Sampler sampler = Sampler::kTrilinearRepeat);

}  // namespace ag::render
