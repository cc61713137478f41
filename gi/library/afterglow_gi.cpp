// The C functions: each looks at what it is given, then does it. See the header for what they promise.
#include "gi/include/afterglow/afterglow_gi.h"

#include <limits>

#include "engine/core/number.h"
#include "gi/library/arguments.h"
#include "gi/library/border.h"
#include "gi/library/guest_scene.h"
#include "gi/library/guest_view.h"
#include "shaders/rsm/rsm_io.h"

using namespace ag;
using namespace ag::guest;

struct AgiContext_T {
    explicit AgiContext_T(const AgiContextInfo& info) : context(info) {}
    GuestContext context;
    std::vector<AgiView> views;
    bool lost = false;  // the device is
};

struct AgiScene_T {
    explicit AgiScene_T(AgiContext context) : owner(context), scene(context->context) {}
    AgiContext owner;
    GuestScene scene;
};

struct AgiView_T {
    AgiView_T(AgiContext context, const gi::BounceLightSettings& settings)
        : owner(context), view(context->context, settings) {
        context->views.push_back(this);
    }
    ~AgiView_T() { std::erase(owner->views, this); }
    AgiContext owner;
    GuestView view;
    std::vector<std::string> names, values;  // that agiGetOption handed out
};

namespace {

static_assert(AGI_MOST_LIGHTS == io::kMaxBounceLights);

// Of a device that is not there any more nothing is asked for.
void refuseIfLost(AgiContext context) {
    if (context->lost) throw Failure(FailureKind::kDeviceLost, "the graphics device was lost");
}

template <class Body>
AgiResult acrossOn(AgiContext context, Body&& body) {
    const AgiResult result = across([&] {
        refuseIfLost(context);
        body();
    });
    if (result == AGI_ERROR_DEVICE_LOST) context->lost = true;
    return result;
}

// Nothing of the frame's command buffer will be executed: what its views know of the device is not so.
void startAnewAfter(AgiContext context, AgiView failed, uint64_t frame) noexcept {
    context->context.forgetFrame(frame);
    for (AgiView view : context->views)
        if (view == failed || view->view.last.frame == frame) (void)across([&] { view->view.startAnew(); });
}

// What to switch on, for as long as the library lives.
const VkPhysicalDeviceFeatures2* featuresFor(const gpu::DeviceInfo& info) {
    static const auto make = [](bool subgroupSizes) {
        auto all = std::make_unique<gpu::DeviceFeatures>();
        gpu::enable(*all, {.lanes = {.requested = subgroupSizes}});
        return all;
    };
    static const auto with = make(true), without = make(false);
    return info.lanes.requested ? &with->core : &without->core;
}

// A frame as one of the view's size would be, for agiPrepare before the first one.
AgiFrame frameLike(const AgiFrame& last) {
    AgiFrame f = last;
    f.frame = std::max<uint64_t>(f.frame, 1);
    const float turn[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const float perspective[16] = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 0, -1, 0, 0, 0.1f, 0};
    if (f.clipFromView[11] != 0) return f;
    std::copy_n(turn, 9, f.viewFromWorld);
    std::copy_n(perspective, 16, f.clipFromView);
    f.depthReversed = 1;
    f.depth.format = VK_FORMAT_D32_SFLOAT;
    f.normal.format = VK_FORMAT_R16G16B16A16_SFLOAT;
    return f;
}

}  // namespace

uint32_t agiVersion(void) {
    return AGI_VERSION;
}

const char* agiLastError(void) {
    return lastError();
}

AgiResult agiGetRequirements(VkInstance instance, VkPhysicalDevice device,
                             PFN_vkGetInstanceProcAddr getInstanceProcAddr, AgiRequirements* requirements) {
    return across([&] {
        throwFailures();
        refuseUnless(instance && device && getInstanceProcAddr,
                     "instance, device or getInstanceProcAddr is null");
        const gpu::Functions vk = loadFunctions(getInstanceProcAddr, instance, VK_NULL_HANDLE);
        const gpu::DeviceInfo info = gpu::describeDevice(vk, device);
        if (const std::string missing = gpu::whatIsMissing(info); !missing.empty())
            throw Failure(FailureKind::kUnsupported, missing);
        AgiRequirements out{};
        out.features = featuresFor(info);
        if (info.apiVersion < VK_API_VERSION_1_3) {
            out.extensionCount = uint32_t(gpu::extensionsOf13().size());
            out.extensions = gpu::extensionsOf13().data();
        }
        give(out, requirements, "requirements are null");
    });
}

AgiResult agiCreateContext(const AgiContextInfo* given, AgiContext* context) {
    return across([&] {
        throwFailures();
        const AgiContextInfo info = whole(given, "info is null");
        refuseUnless(context != nullptr, "context is null");
        refuseUnless(info.instance && info.physicalDevice && info.device && info.getInstanceProcAddr,
                     "instance, physicalDevice, device or getInstanceProcAddr is null");
        refuseUnless((info.allocate == nullptr) == (info.release == nullptr),
                     "allocate and release come together");
        *context = new AgiContext_T(info);
    });
}

void agiDestroyContext(AgiContext context) {
    (void)across([&] { delete context; });
}

AgiResult agiGetMemory(AgiContext context, AgiMemory* memory) {
    return across([&] {
        refuseUnless(context != nullptr, "context is null");
        gpu::MemoryAllocator& allocator = context->context.gpu().memory();
        AgiMemory out{};
        out.deviceBytes = allocator.liveBytes();
        out.blockBytes = allocator.blockBytes();
        give(out, memory, "memory is null");
    });
}

AgiResult agiCreateScene(AgiContext context, AgiScene* scene) {
    return across([&] {
        refuseUnless(context && scene, "context or scene is null");
        *scene = new AgiScene_T(context);
    });
}

void agiDestroyScene(AgiScene scene) {
    (void)across([&] { delete scene; });
}

AgiResult agiAddMaterials(AgiScene scene, uint32_t count, const AgiMaterial* materials, uint32_t* firstId) {
    return across([&] {
        refuseUnless(scene && firstId, "scene or firstId is null");
        *firstId = scene->scene.addMaterials(materialsOf(count, materials));
    });
}

AgiResult agiUpdateMaterials(AgiScene scene, uint32_t firstId, uint32_t count, const AgiMaterial* materials) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        refuseUnless(uint64_t(firstId) + count <= scene->scene.materials().size(),
                     "materials are none of the scene's");
        scene->scene.updateMaterials(firstId, materialsOf(count, materials));
    });
}

AgiResult agiAddMeshes(AgiScene scene, uint32_t count, const AgiMesh* given, uint32_t* firstId) {
    return across([&] {
        refuseUnless(scene && firstId, "scene or firstId is null");
        *firstId = scene->scene.addMeshes(meshesOf(count, given, scene->scene.materials().size()));
    });
}

AgiResult agiRemoveMeshes(AgiScene scene, uint32_t firstId, uint32_t count) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        const auto& meshes = scene->scene.meshes();
        refuseUnless(uint64_t(firstId) + count <= meshes.size(), "meshes are none of the scene's");
        for (uint32_t i = firstId; i < firstId + count; ++i)
            refuseUnless(meshes[i].there && meshes[i].instances == 0,
                         "a mesh is gone already, or has instances");
        scene->scene.removeMeshes(firstId, count);
    });
}

AgiResult agiSetInstances(AgiScene scene, uint32_t count, const AgiInstance* given) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        for (const GuestInstance& instance : instancesOf(count, given, scene->scene))
            scene->scene.setInstance(instance);
    });
}

AgiResult agiRemoveInstances(AgiScene scene, uint32_t count, const uint64_t* ids) {
    return across([&] {
        refuseUnless(scene && (ids || count == 0), "scene or ids is null");
        std::vector<uint64_t> sorted(ids, ids + count);
        std::ranges::sort(sorted);
        refuseUnless(std::ranges::adjacent_find(sorted) == sorted.end(), "an id is there twice");
        for (const uint64_t id : sorted)
            refuseUnless(scene->scene.has(id), "an id is none of the scene's instances");
        for (uint32_t i = 0; i < count; ++i)
            scene->scene.removeInstance(ids[i]);
    });
}

AgiResult agiSetLights(AgiScene scene, uint32_t count, const AgiLight* given) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        scene->scene.setLights(lightsOf(count, given));
    });
}

AgiResult agiSetSky(AgiScene scene, const AgiSky* given) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        scene->scene.setSky(skyOf(given));
    });
}

AgiResult agiSetProbes(AgiScene scene, uint32_t count, const AgiProbe* given) {
    return across([&] {
        refuseUnless(scene && (given || count == 0), "scene or probes is null");
        scene->scene.setProbes(probesOf(count, given));
    });
}

AgiResult agiCreateView(AgiContext context, const AgiViewInfo* given, AgiView* view) {
    return across([&] {
        refuseUnless(context && view, "context or view is null");
        const AgiViewInfo info = whole(given, "info is null");
        gi::BounceLightSettings settings;
        refuseUnless(gi::applyQuality(info.preset ? info.preset : "medium", settings),
                     "a preset is low, medium, high or ultra");
        settings.laterBounces.enabled = true;  // what comes out is all of the bounced light
        *view = new AgiView_T(context, settings);
        (*view)->view.last.width = info.width;
        (*view)->view.last.height = info.height;
    });
}

void agiDestroyView(AgiView view) {
    (void)across([&] { delete view; });
}

AgiResult agiGetOption(AgiView view, uint32_t index, AgiOption* option) {
    return across([&] {
        refuseUnless(view != nullptr, "view is null");
        const auto& all = view->view.options().all();
        refuseUnless(index < all.size(), "there is no such option");
        const Setting& setting = all[index];
        view->names.resize(all.size());
        view->values.resize(all.size());
        view->names[index] = setting.info.group + "." + setting.info.name;
        view->values[index] = settingText(setting, settingValue(setting));
        AgiOption out{};
        out.name = view->names[index].c_str();
        out.unit = setting.info.unit.c_str();
        out.help = setting.info.help.c_str();
        out.value = view->values[index].c_str();
        out.least = setting.info.min;
        out.most = setting.info.max;
        give(out, option, "option is null");
    });
}

AgiResult agiSetOption(AgiView view, const char* name, const char* value) {
    return across([&] {
        refuseUnless(view && name && value, "view, name or value is null");
        const Status set = view->view.options().set(std::string(name) + "=" + value);
        if (!set) throw BadArgument(set.error().message);
    });
}

AgiResult agiPrepare(AgiView view, AgiScene scene) {
    if (!view) return across([] { refuseUnless(false, "view is null"); });
    return acrossOn(view->owner, [&] {
        refuseUnless(scene && scene->owner == view->owner, "scene is null or another context's");
        refuseUnless(view->view.last.width > 0 && view->view.last.height > 0, "the view has no size yet");
        view->view.prepare(scene->scene, frameLike(view->view.last));
    });
}

AgiResult agiRecord(AgiView view, AgiScene scene, VkCommandBuffer commands, const AgiFrame* given) {
    if (!view) return across([] { refuseUnless(false, "view is null"); });
    uint64_t begun = 0;
    const AgiResult result = acrossOn(view->owner, [&] {
        refuseUnless(scene && scene->owner == view->owner, "scene is null or another context's");
        refuseUnless(commands != VK_NULL_HANDLE, "commands are null");
        const AgiFrame frame = whole(given, "frame is null");
        GuestContext& context = view->owner->context;
        refuseBadFrame(frame, context.lastFrame());
        refuseUnless(frame.drawRsmFace || scene->scene.allHaveBuffers(),
                     "a mesh has no vertex and index buffer, and the frame no drawRsmFace");
        context.beginFrame(frame.frame, frame.framesDone);
        begun = frame.frame;
        view->view.record(scene->scene, commands, frame);
    });
    if (result != AGI_OK && begun) startAnewAfter(view->owner, view, begun);
    return result;
}

AgiResult agiGetPasses(AgiView view, uint32_t* count, AgiPass* passes) {
    return across([&] {
        refuseUnless(view && count, "view or count is null");
        const std::span<const PassReport> report = view->view.graph().report();
        const uint32_t room = passes ? *count : 0;
        *count = passes ? uint32_t(std::min<size_t>(room, report.size())) : uint32_t(report.size());
        for (uint32_t i = 0; passes && i < *count; ++i)
            passes[i] = {report[i].name.data(), float(report[i].gpuMs),
                         report[i].outcome == PassOutcome::kRan, reasonText(report[i].reason).data()};
    });
}

AgiResult agiGetReadings(AgiView view, uint32_t count, const uint64_t* ids, AgiReading* readings) {
    return across([&] {
        refuseUnless(view && (count == 0 || (ids && readings)), "view, ids or readings is null");
        constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
        for (uint32_t i = 0; i < count; ++i) {
            const auto known = view->view.readings().of(ids[i]);
            const glm::vec3 direct = known ? known->direct : glm::vec3(kUnknown);
            const glm::vec3 bounced = known ? known->bounced : glm::vec3(kUnknown);
            for (int c = 0; c < 3; ++c)
                readings[i].direct[c] = direct[c], readings[i].bounced[c] = bounced[c];
        }
    });
}

AgiResult agiGetStatus(AgiView view, AgiStatus* status) {
    return across([&] {
        refuseUnless(view != nullptr, "view is null");
        AgiStatus out{};
        out.virtualLights = view->view.virtualLights();
        out.settled = view->view.settled();
        give(out, status, "status is null");
    });
}
