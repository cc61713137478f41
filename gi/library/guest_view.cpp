#include "gi/library/guest_view.h"

#include <algorithm>
#include <cmath>

#include "engine/core/hash.h"
#include "engine/gpu/retire.h"
#include "gi/library/host_rsm.h"
#include "gi/surfaces.h"
#include "shaders/guest/guest_io.h"

namespace ag::guest {
namespace {

constexpr VkFormat kHalf4 = VK_FORMAT_R16G16B16A16_SFLOAT;

// A host's perspective, as far as it matters: how depth comes from the distance along the axis.
struct HostPerspective {
    glm::mat4 clipFromView;
    float sign;     // of view space's z before the camera
    float a, b;     // depth = (a z + b) / (sign z)
    float nearest;  // m, a near plane of ours

    explicit HostPerspective(const AgiFrame& f) {
        for (int i = 0; i < 16; ++i)
            clipFromView[i / 4][i % 4] = f.clipFromView[i];
        sign = clipFromView[2][3];
        a = clipFromView[2][2];
        b = clipFromView[3][2];
        const float nearDepth = f.depthReversed ? 1.0f : 0.0f;
        nearest = std::abs(b / (sign * nearDepth - a));
    }
};

// Reversed depth without a far plane, in units of `length` m about the camera's `position` in those units.
RenderCamera cameraOf(const AgiFrame& f, glm::vec3 position, float length) {
    const HostPerspective p(f);
    glm::mat3 viewFromWorld;
    for (int i = 0; i < 9; ++i)
        viewFromWorld[i / 3][i % 3] = f.viewFromWorld[i];
    RenderCamera camera{.position = position, .near = p.nearest / length};
    glm::mat4 clipFromView(0);
    for (int column = 0; column < 3; ++column)
        for (const int row : {0, 1, 3})
            clipFromView[column][row] = p.clipFromView[column][row];
    clipFromView[3][2] = camera.near;
    glm::mat4 view(viewFromWorld);
    view[3] = glm::vec4(viewFromWorld * -position, 1);
    camera.clipFromWorld = clipFromView * view;
    camera.worldFromClip = glm::mat4(glm::inverse(glm::dmat4(camera.clipFromWorld)));
    const glm::mat3 worldFromView = glm::transpose(viewFromWorld);
    camera.forward = worldFromView * glm::vec3(0, 0, p.sign);
    camera.up = worldFromView * glm::vec3(0, p.clipFromView[1][1] < 0 ? 1.0f : -1.0f, 0);
    camera.verticalFov = 2 * std::atan(1 / std::abs(p.clipFromView[1][1]));
    return camera;
}

// As far as subtracting the jitter is exact.
bool isNearly(const glm::mat4& a, const glm::mat4& b) {
    float most = 0, difference = 0;
    for (int i = 0; i < 16; ++i) {
        most = std::max(most, std::abs(a[i / 4][i % 4]));
        difference = std::max(difference, std::abs(a[i / 4][i % 4] - b[i / 4][i % 4]));
    }
    return difference <= 1e-6f * most;
}

bool wantsGloss(const AgiFrame& f) {
    return f.gloss.view && f.baseColor.view && f.roughnessMetallic.view;
}

gpu::ImageDesc descOf(const AgiImage& image, const AgiFrame& f, const char* name) {
    return {.name = name, .format = image.format, .size = {f.width, f.height}};
}

}  // namespace

// The frame's images as ours, or only their formats where nothing is recorded.
struct GuestView::Images {
    std::unique_ptr<gpu::Image> depth, normal, baseColor, roughnessMetallic, irradiance, gloss;

    static std::unique_ptr<gpu::Image> borrow(gpu::Context& context, const AgiImage& image, const AgiFrame& f,
                                              const char* name) {
        if (!image.view) return nullptr;
        return std::make_unique<gpu::Image>(context, descOf(image, f, name), image.image, image.view);
    }
    Images() = default;
    Images(gpu::Context& context, const AgiFrame& f)
        : depth(borrow(context, f.depth, f, "guest.depth")),
          normal(borrow(context, f.normal, f, "guest.normal")),
          baseColor(borrow(context, f.baseColor, f, "guest.base_color")),
          roughnessMetallic(borrow(context, f.roughnessMetallic, f, "guest.roughness_metallic")),
          irradiance(borrow(context, f.irradiance, f, "guest.irradiance")),
          gloss(borrow(context, f.gloss, f, "guest.gloss")) {}
};

GuestView::GuestView(GuestContext& context, const gi::BounceLightSettings& settings)
    : context_(context), settings_(settings) {
    gi::registerSettings(options_, settings_);
    startAnew();
}

GuestView::~GuestView() {
    gpu::retireOwned(context_.gpu(), std::move(graph_));
}

void GuestView::startAnew() {
    gpu::retireOwned(context_.gpu(), std::move(graph_));
    history_ = {};
    hostFrames_ = {};
    surfaces_ = std::make_unique<SceneOnDevice>(context_.gpu());
    rsms_ = std::make_unique<RsmDraws>(context_);
    graph_ = std::make_unique<FrameGraph>(&context_.gpu(), &context_.pipelines());
}

void GuestView::noteCamera(const AgiFrame& f) {
    const glm::dvec3 position(f.cameraPosition[0], f.cameraPosition[1], f.cameraPosition[2]);
    const RenderCamera now = cameraOf(f, surfaces_->toOurs(position), surfaces_->units().length);
    if (now.clipFromWorld != eyes_.camera.clipFromWorld) ++eyes_.cameraVersion;
    eyes_.camera = now;
    AgiFrame still = f;
    for (int axis = 0; axis < 2; ++axis)
        still.clipFromView[8 + axis] -= f.jitter[axis] * f.clipFromView[11];
    const glm::mat4 steady = cameraOf(still, now.position, surfaces_->units().length).clipFromWorld;
    if (isNearly(steady, eyes_.steadyClip)) return;
    eyes_.steadyClip = steady;
    ++eyes_.viewVersion;
}

gi::Surfaces GuestView::readSurfaces(GraphScope scope, const AgiFrame& f, const Images& images) const {
    const glm::uvec2 size(f.width, f.height);
    const bool glossy = wantsGloss(f);
    const auto import = [&](const char* name, const std::unique_ptr<gpu::Image>& image,
                            const AgiImage& given) {
        const uint64_t version = f.frame + 1;  // another one each frame
        return image ? scope.importImage(name, *image, version)
                     : scope.importImage(name, ImageInfo{.format = given.format, .size = size}, version);
    };
    gi::Surfaces s{.depth = scope.image("guest.read_depth", {.format = VK_FORMAT_R32_SFLOAT, .size = size}),
                   .normal = scope.image("guest.read_normal", {.format = kHalf4, .size = size}),
                   .size = size,
                   .normalMapped = true,
                   .view = eyes_.camera};
    if (glossy) {
        s.albedo = scope.image("guest.read_albedo", {.format = kHalf4, .size = size});
        s.reflectance = scope.image("guest.read_reflectance", {.format = kHalf4, .size = size});
    }
    s.camera = gi::addCamera(scope, "guest.camera", eyes_.camera, size);
    const HostPerspective p(f);
    const io::ReadSurfacesPush push{.depthScale = p.nearest / p.b,
                                    .depthOffset = -p.nearest * p.a / (p.sign * p.b),
                                    .farthest = f.depthReversed ? 0.0f : 1.0f};
    PassBuilder pass = scope.fullscreen(
        "guest.read_surfaces", glossy ? "guest/read_surfaces_glossy.frag" : "guest/read_surfaces.frag");
    pass.sample("hostDepth", import("guest.depth", images.depth, f.depth))
        .sample("hostNormal", import("guest.normal", images.normal, f.normal))
        .constant("kNormalEncoding", uint32_t(f.normalEncoding))
        .push(push)
        .colorClear(s.depth, glm::vec4(0))
        .colorClear(s.normal, glm::vec4(0));
    if (glossy)
        pass.sample("hostBaseColor", import("guest.base_color", images.baseColor, f.baseColor))
            .sample("hostMaterial",
                    import("guest.roughness_metallic", images.roughnessMetallic, f.roughnessMetallic))
            .constant("kRoughnessChannel", f.roughnessChannel)
            .constant("kMetallicChannel", f.metallicChannel)
            .colorClear(s.albedo, glm::vec4(0))
            .colorClear(s.reflectance, glm::vec4(0));
    return s;
}

namespace {

// The sum of what there is of both.
void writeLight(GraphScope scope, const char* name, ImageHandle light, ImageHandle sky, ImageHandle any,
                ImageHandle to, float scale) {
    const glm::uvec2 size = scope.info(to).size;
    scope.compute(name, "guest/write_light.comp")
        .sample("light", light ? light : any)
        .sample("sky", sky ? sky : any)
        .write("result", to)
        .constant("kLit", bool(light))
        .constant("kSky", bool(sky))
        .push(scale)
        .dispatchThreads(size.x, size.y);
}

}  // namespace

gi::BounceLight GuestView::declare(GraphScope scope, GuestScene& scene, const AgiFrame& f,
                                   const Images& images, History& history) {
    // What the camera sees
    const gi::Surfaces surfaces = readSurfaces(scope, f, images);

    // Indirect light
    gi::World world = surfaces_->world();
    world.versions.camera = eyes_.cameraVersion;
    world.versions.view = eyes_.viewVersion;
    const gi::Occluders occluders = surfaces_->occluders(scope);
    const auto draw = [&](GraphScope at, gi::RsmSet& rsm) {
        if (f.drawRsmFace)
            addHostRsm(at, *surfaces_, f, rsm);
        else
            rsms_->add(at, scene, *surfaces_, occluders.instances, rsm);
    };
    const float unit = surfaces_->units().light;
    const gi::BounceLightInputs in{.surfaces = surfaces,
                                   .world = world,
                                   .occluders = occluders,
                                   .sky = surfaces_->sky(scope),
                                   .drawRsm = draw,
                                   .probes = surfaces_->probes(),
                                   .lightUnit = unit};
    const gi::BounceLight light = gi::addBounceLight(scope, in, raySettings(), history.bounce);

    // Light of the sky
    const gi::SkyLight sky = gi::addSkyLight(scope, surfaces, settings_.spacing,
                                             {in.sky, occluders, world.versions}, settings_.sky, history.sky);

    // To the host
    const Borrowed written{VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL};
    const auto result = [&](const char* name, const std::unique_ptr<gpu::Image>& image) {
        const ImageInfo info{.format = kHalf4, .size = surfaces.size};
        return image ? scope.borrowImage(name, *image, written) : scope.borrowImage(name, info, written);
    };
    writeLight(scope, "guest.write_irradiance", light.irradiance.image, sky.image, surfaces.normal,
               result("guest.irradiance", images.irradiance), unit);
    if (wantsGloss(f))
        writeLight(scope, "guest.write_gloss", light.gloss, sky.gloss, surfaces.normal,
                   result("guest.gloss", images.gloss), unit);
    return light;
}

// Readings of a frame that the device is not done with are none.
void GuestView::keepReadings(const AgiFrame& f, gi::ProbeReadings before) {
    uint64_t& slot = hostFrames_[graph_->frame() % kFramesInFlight];
    if (slot > f.framesDone) history_.bounce.probes.readings = std::move(before);
    slot = f.frame;
}

void GuestView::record(GuestScene& scene, VkCommandBuffer commands, const AgiFrame& f) {
    const glm::dvec3 position(f.cameraPosition[0], f.cameraPosition[1], f.cameraPosition[2]);
    if (surfaces_->update(scene, position)) {
        graph_->reset();
        history_ = {};
    }
    if (f.cut) gi::forgetPixels(*graph_);
    noteCamera(f);
    context_.fillWhite(commands);
    surfaces_->upload(commands);
    const Images images(context_.gpu(), f);
    graph_->beginFrame({.timing = f.timed ? TimingMode::kBracketed : TimingMode::kOff});
    gi::ProbeReadings before = history_.bounce.probes.readings;
    const gi::BounceLight light = declare(*graph_, scene, f, images, history_);
    keepReadings(f, std::move(before));
    graph_->execute(commands);
    virtualLights_ = light.vals.count;
    last = f;
}

void GuestView::prepare(GuestScene& scene, const AgiFrame& f) {
    // Of a frame that counts for nothing: with a graph, an origin and a camera of its own, whatever happens.
    struct Kept {
        GuestView& view;
        std::unique_ptr<SceneOnDevice> surfaces =
            std::exchange(view.surfaces_, std::make_unique<SceneOnDevice>(view.context_.gpu()));
        Eyes eyes = view.eyes_;
        ~Kept() {
            view.surfaces_ = std::move(surfaces);
            view.eyes_ = eyes;
        }
    } kept{*this};
    surfaces_->update(scene, glm::dvec3(f.cameraPosition[0], f.cameraPosition[1], f.cameraPosition[2]));
    noteCamera(f);
    FrameGraph plan(&context_.gpu(), &context_.pipelines());
    // While nothing changes, from the second frame on, there are rays.
    History none;
    for (int i = 0; i < 2; ++i) {
        plan.beginFrame({});
        declare(plan, scene, f, Images(), none);
        plan.preparePipelines();
    }
}

// Without rays where the device cannot cast them.
gi::BounceLightSettings GuestView::raySettings() const {
    gi::BounceLightSettings s = settings_;
    if (!gi::canCastRays(context_.gpu().info(), s)) gi::turnRaysOff(s);
    return s;
}

float GuestView::settled() const {
    const auto share = [](uint32_t since, uint32_t frames) {
        return std::min(float(since) / float(std::max(frames, 1u)), 1.0f);
    };
    const gi::BounceLightHistory& h = history_.bounce;
    float sum = share(h.valClustering.settling.sinceChange, settings_.valClustering.settleFrames), parts = 1;
    if (raySettings().texelRays.enabled)
        sum += share(h.gatherGrid.light.sinceChange, gi::framesToRest(settings_)), ++parts;
    if (surfaces_->hasSky() && settings_.sky.enabled)
        sum += share(history_.sky.settling.sinceChange, gi::framesToRest(settings_.sky, settings_.spacing)),
            ++parts;
    return sum / parts;
}

}  // namespace ag::guest
