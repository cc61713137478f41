#include "tools/viewer/preset_view.h"

#include <algorithm>

namespace ag::viewer {

double passesMs(const FrameGraph& graph) {
    double sum = 0;
    for (const PassReport& pass : graph.report())
        if (pass.outcome == PassOutcome::kRan) sum += pass.gpuMs;
    return sum;
}

void PresetView::forget() {
    if (!renderer_) return;
    renderer_->waitIdle();  // our last frame reads its picture
    renderer_.reset();
    preset_.clear();
}

void PresetView::loadMaterials(const GeometryArrays& geometry) {
    if (renderer_) renderer_->loadMaterials(geometry);
}

void PresetView::render(const RenderScene& scene, glm::uvec2 size, const std::string& preset,
                        const render::AntialiasingSettings& antialiasing, const FrameGraphOptions& options,
                        gpu::Device& device) {
    if (size != size_ || preset != preset_) forget();
    if (!renderer_) {
        renderer_ = std::make_unique<render::Renderer>(device);
        renderer_->load(*scene.geometry);
    }
    preset_ = preset;
    size_ = size;
    render::RenderSettings settings;
    render::applyPreset(preset, settings);
    settings.antialiasing = antialiasing;
    renderer_->render(scene, size, settings, options,
                      [&](GraphScope scope, const render::SceneView&, const render::RenderFrame& frame) {
                          radiance_ = frame.outputs.radiance;
                          scope.output(radiance_);
                      });
    const bool ran = std::ranges::any_of(
        renderer_->graph().report(), [](PassOutcome o) { return o == PassOutcome::kRan; },
        &PassReport::outcome);
    version_ += ran || version_ == 0;
}

ImageHandle PresetView::add(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                            const render::CompositeSettings& composite,
                            const BesideSettings& settings) const {
    const ImageHandle picture =
        scope.importImage("viewer.other_preset", renderer_->graph().physical(radiance_), version_);
    return addBeside(scope, view, frame, composite, {picture, renderer_->units().light}, settings);
}

}  // namespace ag::viewer
