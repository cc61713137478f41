#include "tools/viewer/truth_view.h"

#include <fmt/format.h>

#include "engine/gpu/transfer.h"

namespace ag::viewer {
namespace {

float meanOf(const Image& image) {
    double sum = 0;
    for (const glm::vec3& p : image.pixels)
        sum += double(p.x + p.y + p.z);
    return float(sum / (3.0 * double(image.pixels.size())));
}

glm::uvec2 sizeOf(const Image& image) {
    return {image.width, image.height};
}

}  // namespace

reference::PixelFilter filterOf(const render::AntialiasingSettings& s) {
    const bool filters = s.mode == render::Antialiasing::kTemporal;
    return filters ? reference::PixelFilter::kBlackmanHarris : reference::PixelFilter::kCenter;
}

bool TruthView::follow(const RenderScene& scene, glm::uvec2 size, reference::PixelFilter filter, bool on,
                       gpu::Device& device) {
    radiance_ = {};
    if (!on) return pause(), false;
    if (!tracing_) tracing_.emplace();
    tracing_->follow(scene, size, filter);
    auto newest = tracing_->newest();
    if (newest && newest == picture_) return false;
    if (!newest) numbers_ = "path tracing...";
    if (!newest) picture_ = nullptr;
    if (newest) take(std::move(newest), device);
    return picture_ != nullptr;
}

void TruthView::pause() {
    tracing_.reset();
    picture_ = nullptr;
}

void TruthView::take(std::shared_ptr<const TruthPicture> picture, gpu::Device& device) {
    const Image& mean = picture->mean;
    device.waitIdle();  // frames in flight may read the one before
    if (!image_ || image_->desc().size != sizeOf(mean))
        image_ = std::make_unique<gpu::Image>(device, gpu::ImageDesc{.name = "viewer.truth",
                                                                     .format = VK_FORMAT_R32G32B32A32_SFLOAT,
                                                                     .size = sizeOf(mean)});
    std::vector<glm::vec4> texels;
    for (const glm::vec3& p : mean.pixels)
        texels.emplace_back(p, 1);
    gpu::uploadImage(device, *image_, 0, std::as_bytes(std::span(texels)));
    mean_ = meanOf(mean);
    picture_ = std::move(picture);
    ++version_;
}

ImageHandle TruthView::add(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                           const render::CompositeSettings& composite, const BesideSettings& settings) {
    const render::RenderOutputs& ours = frame.outputs;
    if (!tracing_) return ours.display;
    radiance_ = render::addLayer(scope, view, frame, render::Layer::kRadiance);
    scope.output(radiance_);
    if (!picture_) return ours.display;
    return addBeside(scope, view, frame, composite,
                     {scope.importImage("viewer.truth", *image_, version_), 1, mean_}, settings);
}

void TruthView::compare(render::Renderer& renderer) {
    if (!radiance_) return;  // a layer is shown
    const auto error = compareWithTruth(*picture_, render::readImage(renderer, radiance_));
    numbers_ = error ? fmt::format(
                           "{} paths a pixel, {:.1f} s, noise {:.3f}\nrelative RMSE {:.4f}, trimmed {:.4f}\n"
                           "tone RMSE {:.4f}, mean ratio {:.4f}",
                           picture_->samples, picture_->seconds, picture_->noise, error->relativeRmse,
                           error->trimmedRelativeRmse, error->toneRmse, error->meanRatio)
                     : error.error().message;
}

Result<std::string> TruthView::save(render::Renderer& renderer, const std::string& stem) const {
    if (!radiance_) return Error{"there is no radiance to compare while a layer is shown"};
    const Image ours = render::readImage(renderer, radiance_);
    const auto error = compareWithTruth(*picture_, ours);
    if (!error) return error.error();
    const std::pair<const char*, const Image*> files[] = {
        {"_1", &picture_->halves[0]}, {"_2", &picture_->halves[1]}, {"_ours", &ours}};
    for (const auto& [end, image] : files)
        if (Status saved = saveImage(*image, stem + end + ".exr"); !saved) return saved.error();
    std::string lines;
    for (const DifferenceField& field : differenceFields())
        lines += fmt::format("{} {:.6g}\n", field.name, (*error).*field.member);
    return lines;
}

}  // namespace ag::viewer
