#include "engine/renderer/antialiasing.h"

#include <cmath>

#include "engine/core/hash.h"
#include "gi/pixel_rays.h"
#include "shaders/antialiasing/antialiasing_io.h"
#include "shaders/common/sampling.h"

namespace ag::render {
namespace {

// Samples that what was known counts for at most. After other light that is little: at edges the colours
// about say nothing against what is known.
constexpr float kMostWhileLightChanges = 3, kMostWhileChanging = 6, kMostOnceRelit = 0.5f, kAll = 65504;

float mostKept(bool stands, bool relitNow, const AntialiasingHistory& h) {
    if (stands && h.stood) return kAll;
    if (stands) return h.relit ? kMostOnceRelit : kMostWhileChanging;
    return relitNow ? kMostWhileLightChanges : kMostWhileChanging;
}

}  // namespace

PixelGrid choosePixels(const AntialiasingSettings& s, glm::uvec2 output, const RenderScene& scene,
                       uint64_t version, AntialiasingHistory& h) {
    PixelGrid grid{.size = output, .output = output, .version = combineHash(version, scene.instancesVersion)};
    if (s.mode != Antialiasing::kTemporal) {
        h = {};
        return grid;
    }
    grid.size = glm::max(glm::uvec2(glm::vec2(output) * s.scale + 0.5f), 1u);
    // What moves is no reason to sample all other pixels elsewhere; what it leaves behind is, once it stands.
    const bool moves = h.instances != 0 && h.instances != scene.instancesVersion;
    h.instances = scene.instancesVersion;
    if (h.moves && !moves) ++h.stops;
    h.moves = moves;
    const uint32_t frames = uint32_t(std::ceil(float(s.frames) / (s.scale * s.scale)));
    const uint64_t still = combineHash(combineHash(version, h.stops), hashValue(output));
    grid.step = h.settling.advance(still, frames);
    if (h.settling.sinceChange < frames) {
        // Any run of Halton's sequence is spread evenly.
        grid.jitter = io::halton23(uint32_t(grid.step % frames) + 1) - 0.5f;
    }
    return grid;
}

ImageHandle addAntialiasing(GraphScope scope, const SceneView& scene, const gi::Surfaces& surfaces,
                            ImageHandle radiance, const AntialiasingSettings& s, AntialiasingHistory& h) {
    if (s.mode != Antialiasing::kTemporal) return radiance;
    const PixelGrid& grid = scene.grid;
    const RenderCamera& camera = scene.scene->camera;
    const bool sameOrigin = h.originVersion == scene.scene->originVersion;
    const RenderCamera before = sameOrigin ? h.camera : camera;
    const bool rests = grid.jitter == glm::vec2(0), stands = h.version == grid.version,
               relit = h.lightsVersion != scene.scene->lightsVersion;
    const ImageInfo info{.format = VK_FORMAT_R16G16B16A16_SFLOAT, .size = grid.output};
    const HistoryImage picture = scope.historyImage("antialiasing.picture", info),
                       samples = scope.historyImage("antialiasing.samples", info);
    const BufferHandle cameras =
        gi::addReprojectionCameras(scope, "antialiasing.cameras", camera, before, grid.output);
    scope.compute("antialiasing.resolve", "antialiasing/resolve.comp")
        .sample("radianceMap", radiance)
        .sample("depthMap", surfaces.depth)
        .sample("motionMap", surfaces.motion ? surfaces.motion : surfaces.normal)
        .samplePrevious("previousPicture", picture, Sampler::kLinearClamp)
        .samplePrevious("previousSamples", samples, Sampler::kNearestClamp)
        .read("cameras", cameras)
        .write("picture", picture.current)
        .write("samples", samples.current)
        .constant("kMotion", bool(surfaces.motion))
        .push(io::ResolvePush{.jitter = grid.jitter,
                              .near = camera.near,
                              .most = sameOrigin && picture.valid ? mostKept(stands, relit, h) : 0,
                              .stands = stands,
                              .sameView = before.clipFromWorld == camera.clipFromWorld,
                              .rests = rests && h.rested})
        .step(grid.step)
        .dispatchThreads(grid.output.x, grid.output.y);
    h.camera = camera;
    h.originVersion = scene.scene->originVersion;
    h.version = grid.version;
    h.relit = !(stands && h.stood) && (relit || h.relit);
    h.lightsVersion = scene.scene->lightsVersion;
    h.stood = stands;
    h.rested = rests;
    return picture.current;
}

ImageHandle addSmoothEdges(GraphScope scope, ImageHandle display, const AntialiasingSettings& s) {
    if (s.mode != Antialiasing::kSpatial) return display;
    const ImageHandle smooth = scope.image("antialiasing.smooth", scope.info(display));
    scope.fullscreen("antialiasing.smooth_edges", "antialiasing/smooth_edges.frag")
        .sample("aliased", display, Sampler::kLinearClamp)
        .colorClear(smooth, glm::vec4(0));
    return smooth;
}

}  // namespace ag::render
