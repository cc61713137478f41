#include "engine/renderer/debug_view.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ag::render {
namespace {

enum class Show : uint32_t { kLight, kReflectance, kDirection, kDistance, kDisplay };
enum class Copy : uint32_t { kLight, kSum, kDepth, kDifference, kPlain };

struct Row {
    LayerInfo info;
    Show show;
};

constexpr std::array<Row, size_t(Layer::kCount)> kLayers = {
    {{{"final", "display values, 0 to 1", "the picture: radiance, exposed and tonemapped"}, Show::kDisplay},
     {{"radiance", "W/(m² sr)", "light towards the camera"}, Show::kLight},
     {{"direct", "W/m²", "irradiance straight from suns and lamps, before albedo", true}, Show::kLight},
     {{"emissive", "W/m²", "irradiance straight from emissive surfaces, before albedo", true}, Show::kLight},
     {{"sky", "W/m²", "irradiance straight from the sky, before albedo", true}, Show::kLight},
     {{"indirect", "W/m²", "irradiance of all bounces, before albedo", true}, Show::kLight},
     {{"bounce1", "W/m²", "irradiance of the first bounce, before albedo", true}, Show::kLight},
     {{"bounce2", "W/m²", "irradiance of all bounces after the first, before albedo", true}, Show::kLight},
     {{"irradiance", "W/m²", "irradiance, direct and of all bounces, before albedo", true}, Show::kLight},
     {{"albedo", "0 to 1", "diffuse reflectance"}, Show::kReflectance},
     {{"normal", "unit vector", "shading normal in the world"}, Show::kDirection},
     {{"depth", "m", "distance along the camera's axis"}, Show::kDistance},
     {{"rsm", "W/m²", "radiosity over the RSMs"}, Show::kLight},
     {{"importance", "0 to 1", "importance over the RSMs"}, Show::kDisplay},
     {{"clusters", "display values, 0 to 1", "clusters as colours over the scene"}, Show::kDisplay},
     {{"vals", "display values, 0 to 1", "area lights as polygons over the scene"}, Show::kDisplay},
     {{"light_clusters", "display values, 0 to 1",
       "punctual lights and what they light in the colours of shared shadow maps"},
      Show::kDisplay},
     {{"ism", "m", "imperfect shadow maps side by side"}, Show::kDistance}}};

ImageHandle layerImage(GraphScope scope, glm::uvec2 size) {
    return scope.image("debug_view.layer", {.format = VK_FORMAT_R32G32B32A32_SFLOAT, .size = size});
}

ImageHandle addCopy(GraphScope scope, const SceneView& scene, ImageHandle first, ImageHandle second,
                    Copy mode, ImageHandle third = {}) {
    if (!first) return {};
    const ImageHandle out = layerImage(scope, scope.info(first).size);
    const float unit = mode == Copy::kDepth   ? scene.scene->camera.near * scene.units.length
                       : mode == Copy::kPlain ? 1
                                              : scene.units.light;
    scope.fullscreen("debug_view.copy_layer", "debug_view/copy_layer.frag")
        .sample("first", first)
        .sample("second", second ? second : first)
        .sample("third", third ? third : first)
        .constant("kMode", mode)
        .constant("kThird", bool(third))
        .push(unit)
        .colorClear(out, glm::vec4(0));
    return out;
}

// Of those that are there.
ImageHandle addSum(GraphScope scope, const SceneView& scene, std::array<ImageHandle, 3> terms) {
    std::array<ImageHandle, 3> there;
    size_t count = 0;
    for (const ImageHandle term : terms)
        if (term) there[count++] = term;
    return addCopy(scope, scene, there[0], there[1], count > 1 ? Copy::kSum : Copy::kLight, there[2]);
}

// A view that draws over the camera's surfaces.
PassBuilder beginSurfaceView(GraphScope scope, std::string_view name, std::string_view shader,
                             const SceneView& scene, const RenderFrame& f) {
    PassBuilder pass = scope.fullscreen(name, shader);
    pass.sample("depthMap", f.gbuffer.surfaces.depth)
        .sample("normalMap", f.gbuffer.surfaces.normal)
        .read("camera", scene.camera);
    return pass;
}

ImageHandle addClusters(GraphScope scope, const SceneView& scene, const RenderFrame& f) {
    const ImageHandle out = layerImage(scope, scene.grid.size);
    beginSurfaceView(scope, "debug_view.clusters", "debug_view/clusters.frag", scene, f)
        .read("texels", f.bounce.rsm.texels)
        .read("faces", f.bounce.rsm.faces)
        .read("slotOfTexel", f.bounce.clusters.slotOfTexel)
        .read("candidates", f.bounce.clusters.candidates)
        .push(f.bounce.rsm.atlas)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addVals(GraphScope scope, const SceneView& scene, const RenderFrame& f) {
    const ImageHandle out = layerImage(scope, scene.grid.size);
    beginSurfaceView(scope, "debug_view.vals", "debug_view/vals.frag", scene, f)
        .read("vals", f.bounce.vals.vals)
        .read("shapes", f.bounce.vals.shapes)
        .push(f.bounce.vals.count)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addLightClusters(GraphScope scope, const SceneView& scene, const RenderFrame& f) {
    const ImageHandle out = layerImage(scope, scene.grid.size);
    beginSurfaceView(scope, "debug_view.light_clusters", "debug_view/light_clusters.frag", scene, f)
        .read("lights", f.punctual.lists.lights)
        .push(f.punctual.lists.lightCount)
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addIsmView(GraphScope scope, const SceneView& scene, const gi::IsmAtlas& isms) {
    const uint32_t columns = uint32_t(std::ceil(std::sqrt(float(isms.mapCount))));
    const uint32_t rows = (isms.mapCount + columns - 1) / columns;
    const ImageHandle out = layerImage(scope, glm::uvec2(columns, rows) * isms.tileSize);
    struct Push {
        uint32_t mapCount, tileSize, columns;
        float metres;
    };
    scope.fullscreen("debug_view.ism", "debug_view/ism.frag")
        .read("planes", isms.planes)
        .constant("kParaboloid", isms.mapping == gi::IsmMapping::kParaboloid)
        .push(Push{isms.mapCount, isms.tileSize, columns, scene.units.length})
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addRsmView(GraphScope scope, const SceneView& scene, const RenderFrame& f) {
    const ImageHandle out = layerImage(scope, f.bounce.rsm.atlas.size);
    struct Push {
        io::RsmAtlas atlas;
        float light;
    };
    scope.fullscreen("debug_view.rsm", "debug_view/rsm.frag")
        .read("texels", f.bounce.rsm.texels)
        .push(Push{f.bounce.rsm.atlas, scene.units.light})
        .colorClear(out, glm::vec4(0));
    return out;
}

ImageHandle addImportanceView(GraphScope scope, const RenderFrame& f) {
    const ImageHandle out = layerImage(scope, f.bounce.rsm.atlas.size);
    scope.fullscreen("debug_view.importance", "debug_view/importance.frag")
        .read("faces", f.bounce.rsm.faces)
        .read("pyramid", f.bounce.importance.pyramid)
        .push(io::ImportanceSettings{.atlasSize = f.bounce.rsm.atlas.size,
                                     .faceCount = f.bounce.rsm.atlas.faceCount,
                                     .pyramidStride = f.bounce.importance.pyramidStride})
        .colorClear(out, glm::vec4(0));
    return out;
}

// That of our area lights whose irradiance the layer is.
gi::Term termOf(Layer layer) {
    switch (layer) {
        case Layer::kBounce1:
            return gi::Term::kFirstBounce;
        case Layer::kBounce2:
            return gi::Term::kLaterBounces;
        case Layer::kEmissive:
            return gi::Term::kEmissive;
        case Layer::kIndirect:
            return gi::Term::kBounces;
        default:
            return gi::Term::kAll;
    }
}

// What irradiance is of more than one term, with the first bounce beside it.
bool hasLaterBeside(const gi::BounceLight& f) {
    return f.irradiance.image && f.bounce1.image && f.irradiance.image != f.bounce1.image;
}

}  // namespace

const LayerInfo& layerInfo(Layer layer) {
    return kLayers[size_t(layer)].info;
}

std::optional<Layer> layerFromName(std::string_view name) {
    if (name == "bounces") return Layer::kIndirect;  // its name as a term
    for (size_t i = 0; i < kLayers.size(); ++i)
        if (kLayers[i].info.name == name) return Layer(i);
    return std::nullopt;
}

std::optional<Layer> layerOfKey(int digit) {
    constexpr std::array kOfKeys = {Layer::kFinal,      Layer::kDirect,   Layer::kBounce1,
                                    Layer::kIrradiance, Layer::kAlbedo,   Layer::kNormal,
                                    Layer::kRsm,        Layer::kClusters, Layer::kVals};
    const Layer layer = kOfKeys.at(size_t(digit - 1));
    return layer == Layer::kFinal ? std::nullopt : std::optional(layer);
}

bool isPicture(Layer layer) {
    return layer == Layer::kFinal || layer == Layer::kRadiance;
}

RenderSettings settingsOf(Layer layer, RenderSettings s) {
    if (isPicture(layer)) return s;
    s.bounce.valShading.glossy = false;
    if (s.technique == Technique::kAreaLights) s.bounce.term = termOf(layer);
    s.antialiasing.mode = Antialiasing::kOff;
    return s;
}

bool hasLayer(const RenderFrame& f, Layer layer) {
    switch (layer) {
        case Layer::kDirect:
            return bool(f.direct.image);
        case Layer::kEmissive:
            return f.bounce.irradiance.image && f.bounce.term == gi::Term::kEmissive;
        case Layer::kSky:
            return bool(f.sky.image);
        case Layer::kIndirect:
            return bool(f.bounce.irradiance.image);
        case Layer::kBounce1:
            return bool(f.bounce.bounce1.image);
        case Layer::kBounce2:
            return f.bounce.irradiance.image &&
                   (f.bounce.term == gi::Term::kLaterBounces || hasLaterBeside(f.bounce));
        case Layer::kIrradiance:
            return f.direct.image || f.bounce.irradiance.image || f.sky.image;
        case Layer::kRsm:
            return !f.bounce.rsm.empty();
        case Layer::kImportance:
            return bool(f.bounce.importance.pyramid);
        case Layer::kClusters:
            return bool(f.bounce.clusters.slotOfTexel);
        case Layer::kVals:
            return f.bounce.vals.vals && f.bounce.vals.shapes;
        case Layer::kLightClusters:
            return bool(f.punctual.lists.lights);
        case Layer::kIsm:
            return bool(f.bounce.isms.planes);
        default:
            return true;
    }
}

ImageHandle addLayer(GraphScope scope, const SceneView& scene, const RenderFrame& f, Layer layer) {
    if (!hasLayer(f, layer)) return {};
    const ImageHandle direct = f.direct.image, bounce = f.bounce.irradiance.image;
    switch (layer) {
        case Layer::kFinal:
            return addCopy(scope, scene, f.outputs.display, {}, Copy::kPlain);
        case Layer::kRadiance:
            return addCopy(scope, scene, f.outputs.radiance, {}, Copy::kLight);
        case Layer::kDirect:
            return addCopy(scope, scene, direct, {}, Copy::kLight);
        case Layer::kIndirect:
        case Layer::kEmissive:
            return addCopy(scope, scene, bounce, {}, Copy::kLight);
        case Layer::kSky:
            return addCopy(scope, scene, f.sky.image, {}, Copy::kLight);
        case Layer::kBounce1:
            return addCopy(scope, scene, f.bounce.bounce1.image, {}, Copy::kLight);
        case Layer::kBounce2:
            if (!hasLaterBeside(f.bounce)) return addCopy(scope, scene, bounce, {}, Copy::kLight);
            return addCopy(scope, scene, bounce, f.bounce.bounce1.image, Copy::kDifference);
        case Layer::kIrradiance:
            return addSum(scope, scene, {direct, bounce, f.sky.image});
        case Layer::kAlbedo:
            return addCopy(scope, scene, f.gbuffer.surfaces.albedo, {}, Copy::kPlain);
        case Layer::kNormal:
            return addCopy(scope, scene, f.gbuffer.surfaces.normal, {}, Copy::kPlain);
        case Layer::kDepth:
            return addCopy(scope, scene, f.gbuffer.surfaces.depth, {}, Copy::kDepth);
        case Layer::kRsm:
            return addRsmView(scope, scene, f);
        case Layer::kImportance:
            return addImportanceView(scope, f);
        case Layer::kClusters:
            return addClusters(scope, scene, f);
        case Layer::kVals:
            return addVals(scope, scene, f);
        case Layer::kLightClusters:
            return addLightClusters(scope, scene, f);
        case Layer::kIsm:
            return addIsmView(scope, scene, f.bounce.isms);
        case Layer::kCount:
            break;
    }
    return {};
}

ImageHandle addLayerView(GraphScope scope, const SceneView& scene, const RenderFrame& frame, Layer layer,
                         glm::uvec2 size, const CompositeSettings& settings) {
    const ImageHandle source = addLayer(scope, scene, frame, layer);
    const ImageHandle out =
        scope.image("debug_view.display", {.format = VK_FORMAT_R8G8B8A8_UNORM, .size = size});
    struct Push {
        float exposure;
        uint32_t mode;
    };
    scope.fullscreen("debug_view.show_layer", "debug_view/show_layer.frag")
        .sample("layer", source ? source : frame.gbuffer.surfaces.depth)
        // Nothing to show is black, not whatever stands in for it.
        .constant("kShow", uint32_t(source ? kLayers[size_t(layer)].show : Show::kLight))
        .push(Push{source ? std::exp2(settings.exposure) : 0.0f, uint32_t(settings.tonemap)})
        .colorClear(out, glm::vec4(0));
    return out;
}

}  // namespace ag::render
