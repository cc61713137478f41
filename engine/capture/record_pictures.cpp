// Reading back what the passes made.
#include <array>
#include <optional>

#include "engine/capture/record.h"

namespace ag::capture {
namespace {

std::string_view formatName(VkFormat format) {
    switch (format) {
        case VK_FORMAT_R8G8B8A8_UNORM:
            return "rgba8";
        case VK_FORMAT_R16G16B16A16_SFLOAT:
            return "rgba16f";
        case VK_FORMAT_R32G32B32A32_SFLOAT:
            return "rgba32f";
        case VK_FORMAT_R32_SFLOAT:
            return "r32f";
        case VK_FORMAT_D32_SFLOAT:
            return "d32f";
        default:
            return "";  // not read back
    }
}

// The pass that wrote a resource last.
std::string writerOf(const FrameDescription& frame, uint32_t resource) {
    std::string name;
    for (const PassDescription& pass : frame.passes)
        for (uint32_t written : pass.writes)
            if (written == resource && pass.outcome == PassOutcome::kRan) name = pass.name;
    return name;
}

// Debug views stand for the buffer that they show.
struct BufferView {
    render::Layer layer;
    BufferHandle shown;
};

std::array<BufferView, 6> bufferViews(const render::RenderFrame& f) {
    return {{{render::Layer::kRsm, f.bounce.rsm.texels},
             {render::Layer::kImportance, f.bounce.importance.pyramid},
             {render::Layer::kClusters, f.bounce.clusters.slotOfTexel},
             {render::Layer::kVals, f.bounce.vals.vals},
             {render::Layer::kIsm, f.bounce.isms.planes},
             {render::Layer::kLightClusters, f.punctual.lists.lights}}};
}

void recordView(render::Renderer& renderer, const RenderScene& scene, const RecordSettings& settings,
                const FrameGraphOptions& options, size_t index, Capture& capture) {
    ImageHandle shown;
    BufferHandle source;
    render::Layer layer{};
    renderer.render(scene, settings.size, settings.gi, options,
                    [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& f) {
                        layer = bufferViews(f)[index].layer;
                        source = bufferViews(f)[index].shown;
                        if (source) shown = render::addLayer(scope, view, f, layer);
                        scope.output(f.outputs.display);
                        if (shown) scope.output(shown);
                    });
    if (!shown) return;
    const std::string writer = writerOf(renderer.graph().describe(), source.index);
    if (writer.empty()) return;  // nothing in it that this frame made
    capture.pictures.push_back({.name = "view." + std::string(render::layerInfo(layer).name),
                                .pass = writer,
                                .format = "rgba32f",
                                .pixels = render::readImage(renderer, shown)});
}

}  // namespace

Status recordPictures(render::Renderer& renderer, const RenderScene& scene, const RecordSettings& settings,
                      gpu::RenderDoc renderDoc, const std::string& rdcPath, Capture& capture) {
    FrameGraphOptions options = settings.graph;
    options.skip = options.alias = false;
    options.timing = TimingMode::kCounts;
    if (renderDoc) renderDoc.begin();
    BufferHandle exposure;
    renderer.render(scene, settings.size, settings.gi, options,
                    [&](GraphScope scope, const render::SceneView&, const render::RenderFrame& f) {
                        scope.output(f.outputs.display);
                        exposure = f.outputs.exposure;
                        if (exposure) scope.output(exposure);
                    });
    for (const PassCount& count : renderer.graph().counts())
        capture.counts.push_back({std::string(count.name), count});
    renderer.waitIdle();
    if (const Status captured = renderDoc ? renderDoc.end(rdcPath) : Ok{}; !captured) return captured;
    options.timing = TimingMode::kOff;
    capture.look = {
        .cameraNear = scene.camera.near,
        .exposure = exposure ? render::readExposure(renderer, exposure) : settings.gi.composite.exposure,
        .tonemap = uint32_t(settings.gi.composite.tonemap)};
    const FrameDescription frame = renderer.graph().describe();
    for (uint32_t i = 0; i < frame.resources.size(); ++i) {
        const ResourceDescription& r = frame.resources[i];
        const bool made = r.role == ResourceRole::kOwned || r.role == ResourceRole::kHistory;
        const std::string writer = made && r.image ? writerOf(frame, i) : "";
        if (writer.empty()) continue;
        const std::string_view format = formatName(renderer.graph().physical(r.image).desc().format);
        if (format.empty()) continue;
        capture.pictures.push_back({.name = r.name,
                                    .pass = writer,
                                    .format = std::string(format),
                                    .pixels = render::readImage(renderer, r.image)});
    }
    for (size_t i = 0; i < bufferViews({}).size(); ++i)
        recordView(renderer, scene, settings, options, i, capture);
    return Ok{};
}

}  // namespace ag::capture
