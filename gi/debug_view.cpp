#include "gi/debug_view.h"

#include <array>
#include <cmath>

namespace ag::gi {
namespace {

enum class Show : uint32_t { kLight, kReflectance, kDirection, kDistance, kDisplay };
enum class Copy : uint32_t { kLight, kSum, kDepth, kDifference, kPlain };

struct LayerInfo {
    std::string_view name;
    Show show;
};

constexpr std::array<LayerInfo, size_t(Layer::kCount)> kLayers = {{{"final", Show::kDisplay},
                                                                   {"radiance", Show::kLight},
                                                                   {"direct", Show::kLight},
                                                                   {"indirect", Show::kLight},
                                                                   {"bounce1", Show::kLight},
                                                                   {"bounce2", Show::kLight},
                                                                   {"irradiance", Show::kLight},
                                                                   {"albedo", Show::kReflectance},
                                                                   {"normal", Show::kDirection},
                                                                   {"depth", Show::kDistance},
                                                                   {"rsm", Show::kLight},
                                                                   {"importance", Show::kDisplay},
                                                                   {"clusters", Show::kDisplay},
                                                                   {"vals", Show::kDisplay},
                                                                   {"lamp_clusters", Show::kDisplay},
                                                                   {"ism", Show::kDistance}}};

ImageHandle layerImage(FrameGraph& graph, glm::uvec2 size) {
    return graph.image("debug_view.layer", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = size});
}

ImageHandle addCopy(FrameGraph& graph, const SceneView& scene, ImageHandle first, ImageHandle second,
                    Copy mode) {
    if (!first) return {};
    const ImageHandle out = layerImage(graph, graph.info(first).size);
    const float unit = mode == Copy::kDepth   ? scene.scene->camera.near * scene.units.length
                       : mode == Copy::kPlain ? 1
                                              : scene.units.light;
    graph.fullscreen("debug_view.copy_layer", "debug_view/copy_layer.frag")
        .sample("first", first)
        .sample("second", second ? second : first)
        .spec(0, uint32_t(mode))
        .push(unit)
        .colorClear(out, glm::vec4(0));
    return out;
}

// A view that draws over the camera's surfaces.
PassBuilder beginSurfaceView(FrameGraph& graph, std::string_view name, std::string_view shader,
                             const SceneView& scene, const GiFrame& f) {
    PassBuilder pass = graph.fullscreen(name, shader);
    pass.sample("depthMap", f.gbuffer.depth)
        .sample("normalMap", f.gbuffer.normal)
        .read("camera", scene.camera);
    return pass;
}

ImageHandle addClusters(FrameGraph& graph, const SceneView& scene, const GiFrame& f) {
    const ImageHandle out = layerImage(graph, scene.size);
    beginSurfaceView(graph, "debug_view.clusters", "debug_view/clusters.frag", scene, f)
        .read("texels", f.rsm.texels)
        .read("faces", f.rsm.faces)
        .read("slotOfTexel", f.clusters.slotOfTexel)
        .read("candidates", f.clusters.candidates)
        .push(f.rsm.atlas)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addVals(FrameGraph& graph, const SceneView& scene, const GiFrame& f) {
    const ImageHandle out = layerImage(graph, scene.size);
    beginSurfaceView(graph, "debug_view.vals", "debug_view/vals.frag", scene, f)
        .read("vals", f.vals.vals)
        .read("shapes", f.vals.shapes)
        .push(f.vals.count)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addLampClusters(FrameGraph& graph, const SceneView& scene, const GiFrame& f) {
    const ImageHandle out = layerImage(graph, scene.size);
    beginSurfaceView(graph, "debug_view.lamp_clusters", "debug_view/lamp_clusters.frag", scene, f)
        .read("lamps", f.lampLists.lamps)
        .push(f.lampLists.lampCount)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addIsmView(FrameGraph& graph, const SceneView& scene, const IsmAtlas& isms) {
    const uint32_t columns = uint32_t(std::ceil(std::sqrt(float(isms.mapCount))));
    const uint32_t rows = (isms.mapCount + columns - 1) / columns;
    const ImageHandle out = layerImage(graph, glm::uvec2(columns, rows) * isms.tileSize);
    struct Push {
        uint32_t mapCount, tileSize, columns;
        float metres;
    };
    graph.fullscreen("debug_view.ism", "debug_view/ism.frag")
        .read("planes", isms.planes)
        .spec(3, isms.mapping == IsmMapping::kParaboloid)
        .push(Push{isms.mapCount, isms.tileSize, columns, scene.units.length})
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addRsmView(FrameGraph& graph, const SceneView& scene, const GiFrame& f) {
    const ImageHandle out = layerImage(graph, f.rsm.atlas.size);
    struct Push {
        io::RsmAtlas atlas;
        float light;
    };
    graph.fullscreen("debug_view.rsm", "debug_view/rsm.frag")
        .read("texels", f.rsm.texels)
        .push(Push{f.rsm.atlas, scene.units.light})
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addImportanceView(FrameGraph& graph, const GiFrame& f) {
    const ImageHandle out = layerImage(graph, f.rsm.atlas.size);
    graph.fullscreen("debug_view.importance", "debug_view/importance.frag")
        .read("faces", f.rsm.faces)
        .read("pyramid", f.importance.pyramid)
        .push(io::ImportanceSettings{.atlasSize = f.rsm.atlas.size,
                                     .faceCount = f.rsm.atlas.faceCount,
                                     .pyramidStride = f.importance.pyramidStride})
        .colorClear(out, glm::vec4(0));
    return out;
}

}  // namespace

std::string_view layerName(Layer layer) {
    return kLayers[size_t(layer)].name;
}

std::optional<Layer> layerFromName(std::string_view name) {
    for (size_t i = 0; i < kLayers.size(); ++i)
        if (kLayers[i].name == name) return Layer(i);
    return std::nullopt;
}

bool showsGloss(Layer layer) {
    return layer == Layer::kFinal || layer == Layer::kRadiance;
}

ImageHandle addLayer(FrameGraph& graph, const SceneView& scene, const GiFrame& f, Layer layer) {
    const bool lit = !f.rsm.empty();
    const ImageHandle direct = f.direct.image, bounce = f.indirect.image;
    switch (layer) {
        case Layer::kFinal:
            return addCopy(graph, scene, f.outputs.display, {}, Copy::kPlain);
        case Layer::kRadiance:
            return addCopy(graph, scene, f.outputs.radiance, {}, Copy::kLight);
        case Layer::kDirect:
            return addCopy(graph, scene, direct, {}, Copy::kLight);
        case Layer::kIndirect:
            return addCopy(graph, scene, bounce, {}, Copy::kLight);
        case Layer::kBounce1:
            return addCopy(graph, scene, f.bounce1.image, {}, Copy::kLight);
        case Layer::kBounce2:
            return f.indirect.image != f.bounce1.image
                       ? addCopy(graph, scene, f.indirect.image, f.bounce1.image, Copy::kDifference)
                       : ImageHandle{};
        case Layer::kIrradiance:
            return addCopy(graph, scene, direct ? direct : bounce, direct ? bounce : ImageHandle{},
                           direct && bounce ? Copy::kSum : Copy::kLight);
        case Layer::kAlbedo:
            return addCopy(graph, scene, f.gbuffer.albedo, {}, Copy::kPlain);
        case Layer::kNormal:
            return addCopy(graph, scene, f.gbuffer.normal, {}, Copy::kPlain);
        case Layer::kDepth:
            return addCopy(graph, scene, f.gbuffer.depth, {}, Copy::kDepth);
        case Layer::kRsm:
            return lit ? addRsmView(graph, scene, f) : ImageHandle{};
        case Layer::kImportance:
            return lit ? addImportanceView(graph, f) : ImageHandle{};
        case Layer::kClusters:
            return lit ? addClusters(graph, scene, f) : ImageHandle{};
        case Layer::kVals:
            return lit ? addVals(graph, scene, f) : ImageHandle{};
        case Layer::kLampClusters:
            return f.lampLists.lamps ? addLampClusters(graph, scene, f) : ImageHandle{};
        case Layer::kIsm:
            return f.isms.planes ? addIsmView(graph, scene, f.isms) : ImageHandle{};
        case Layer::kCount:
            break;
    }
    return {};
}

ImageHandle addLayerView(FrameGraph& graph, const SceneView& scene, const GiFrame& frame, Layer layer,
                         glm::uvec2 size, const CompositeSettings& settings) {
    const ImageHandle source = addLayer(graph, scene, frame, layer);
    const ImageHandle out =
        graph.image("debug_view.display", {.format = VK_FORMAT_R8G8B8A8_UNORM, .size = size});
    struct Push {
        float exposure;
        uint32_t mode;
    };
    graph.fullscreen("debug_view.show_layer", "debug_view/show_layer.frag")
        .sample("layer", source ? source : frame.gbuffer.depth)
        // Nothing to show is black, not whatever stands in for it.
        .spec(0, uint32_t(source ? kLayers[size_t(layer)].show : Show::kLight))
        .push(Push{source ? std::exp2(settings.exposure) : 0.0f, uint32_t(settings.tonemap)})
        .colorClear(out, glm::vec4(0));
    return out;
}

}  // namespace ag::gi
