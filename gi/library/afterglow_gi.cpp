// The C functions: each looks at what it is given, then does it. See the header for what they promise.
#include "gi/include/afterglow/afterglow_gi.h"

#include <limits>
#include <numbers>

#include "engine/core/number.h"
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

glm::vec3 vec3Of(const float* v) {
    return {v[0], v[1], v[2]};
}
glm::dvec3 dvec3Of(const double* v) {
    return {v[0], v[1], v[2]};
}
bool isDirection(const float* v) {
    const float length = glm::length(vec3Of(v));
    return isFinite(v, 3) && length > 0.99f && length < 1.01f;
}
bool isLight(const float* v, size_t count) {
    return isFinite(v, count) && std::all_of(v, v + count, [](float x) { return x >= 0; });
}

GuestMaterial materialOf(const AgiMaterial& m) {
    refuseUnless(isLight(m.albedo, 3), "a material's albedo is not finite or is negative");
    refuseUnless(!m.albedoMap || isLight(m.albedoMapMean, 3),
                 "a material's albedoMapMean is not finite or is negative");
    refuseUnless(m.alphaCutoff >= 0 && m.alphaCutoff <= 1, "a material's alphaCutoff is not between 0 and 1");
    refuseUnless(m.coverage >= 0 && m.coverage <= 1, "a material's coverage is not between 0 and 1");
    return {.albedo = vec3Of(m.albedo),
            .mean = vec3Of(m.albedoMapMean),
            .map = m.albedoMap,
            .alphaCutoff = m.albedoMap ? m.alphaCutoff : 0,
            .coverage = m.coverage,
            .doubleSided = m.doubleSided != 0};
}

std::vector<GuestMaterial> materialsOf(uint32_t count, const AgiMaterial* materials) {
    std::vector<GuestMaterial> out;
    for (uint32_t i = 0; i < count; ++i)
        out.push_back(materialOf(wholeOf(materials, i, "materials are null")));
    return out;
}

template <class T>
std::vector<T> copyOf(const void* from, uint32_t stride, uint32_t count) {
    const gi::Strided<T> items{static_cast<const std::byte*>(from), stride};
    std::vector<T> out(count);
    for (uint32_t i = 0; i < count; ++i)
        out[i] = items[i];
    return out;
}

GuestMesh meshOf(const AgiMesh& m, size_t materials) {
    refuseUnless(m.vertexBuffer && m.indexBuffer, "a mesh has no vertex or index buffer");
    refuseUnless(m.positions && m.normals && m.indices, "a mesh's host memory is null");
    refuseUnless(m.vertexCount > 0 && m.indexCount > 0 && m.indexCount % 3 == 0,
                 "a mesh has no vertices, or not three indices a triangle");
    refuseUnless(m.positionStride >= 12 && m.normalStride >= 12 && (m.uvStride == 0 || m.uvStride >= 8),
                 "a mesh's stride is shorter than what it strides over");
    refuseUnless(m.indexType == VK_INDEX_TYPE_UINT16 || m.indexType == VK_INDEX_TYPE_UINT32,
                 "a mesh's indices are neither UINT16 nor UINT32");
    refuseUnless(m.material < materials, "a mesh's material is none of the scene's");
    GuestMesh mesh{.given = m};
    mesh.positions = copyOf<glm::vec3>(m.positions, m.positionStride, m.vertexCount);
    mesh.normals = copyOf<glm::vec3>(m.normals, m.normalStride, m.vertexCount);
    if (m.uvs && m.uvStride > 0) mesh.uvs = copyOf<glm::vec2>(m.uvs, m.uvStride, m.vertexCount);
    if (m.indexType == VK_INDEX_TYPE_UINT32) {
        mesh.indices = copyOf<uint32_t>(m.indices, 4, m.indexCount);
    } else {
        const std::vector<uint16_t> narrow = copyOf<uint16_t>(m.indices, 2, m.indexCount);
        mesh.indices.assign(narrow.begin(), narrow.end());
    }
    for (const uint32_t index : mesh.indices)
        refuseUnless(index < m.vertexCount, "a mesh's index is past its vertices");
    for (const glm::vec3& p : mesh.positions) {
        refuseUnless(isFinite(&p.x, 3), "a mesh's position is not finite");
        mesh.bounds.add(p);
    }
    for (glm::vec3& n : mesh.normals)
        if (!isFinite(&n.x, 3)) n = glm::vec3(0);
    mesh.given.positions = mesh.given.normals = mesh.given.uvs = mesh.given.indices = nullptr;
    return mesh;
}

GuestInstance instanceOf(const AgiInstance& i, const GuestScene& scene) {
    refuseUnless(i.mesh < scene.meshes().size() && scene.meshes()[i.mesh].there,
                 "an instance's mesh is none of the scene's");
    refuseUnless(isFinite(i.position, 3) && isFinite(i.linear, 9), "an instance's transform is not finite");
    GuestInstance out{.id = i.id, .mesh = i.mesh, .movable = i.movable != 0, .position = dvec3Of(i.position)};
    for (int column = 0; column < 3; ++column)
        out.linear[column] = vec3Of(i.linear + 3 * column);
    return out;
}

GuestLight lightOf(const AgiLight& l) {
    refuseUnless(l.kind >= AGI_LIGHT_DIRECTIONAL && l.kind <= AGI_LIGHT_SPOT, "a light's kind is none");
    refuseUnless(isFinite(l.position, 3), "a light's position is not finite");
    refuseUnless(isLight(l.intensity, 3) && isLight(&l.range, 1) && isLight(&l.budgetShare, 1),
                 "a light's intensity, range or budgetShare is not finite or is negative");
    refuseUnless(l.kind == AGI_LIGHT_POINT || isDirection(l.direction),
                 "a light's direction is not a unit vector");
    refuseUnless(l.kind != AGI_LIGHT_SPOT || (l.innerAngle >= 0 && l.innerAngle <= l.outerAngle &&
                                              l.outerAngle < std::numbers::pi_v<float> / 2),
                 "a spot's angles are not 0 <= innerAngle <= outerAngle < pi/2");
    refuseUnless(l.mapSize == 0 || (l.mapSize >= 32 && l.mapSize <= 1024),
                 "a light's mapSize is not 32 to 1024");
    return {.light = {.kind = LightKind(l.kind),
                      .direction = l.kind == AGI_LIGHT_POINT ? glm::vec3(0, -1, 0) : vec3Of(l.direction),
                      .intensity = vec3Of(l.intensity),
                      .range = l.range,
                      .innerConeAngle = l.innerAngle,
                      .outerConeAngle = l.outerAngle,
                      .resolution = l.mapSize ? l.mapSize : 512,
                      .budgetShare = l.budgetShare,
                      .id = l.id},
            .position = dvec3Of(l.position)};
}

bool isRotation(const float* m) {
    const glm::vec3 x = vec3Of(m), y = vec3Of(m + 3), z = vec3Of(m + 6);
    const glm::vec3 lengths(glm::length(x), glm::length(y), glm::length(z));
    const glm::vec3 skew(glm::dot(x, y), glm::dot(y, z), glm::dot(z, x));
    return isFinite(m, 9) && glm::all(glm::lessThan(glm::abs(lengths - 1.0f), glm::vec3(1e-3f))) &&
           glm::all(glm::lessThan(glm::abs(skew), glm::vec3(1e-3f)));
}

bool isPerspective(const float* m) {
    return isFinite(m, 16) && m[3] == 0 && m[7] == 0 && std::abs(m[11]) == 1 && m[15] == 0 && m[0] != 0 &&
           m[5] != 0 && m[14] != 0;
}

void refuseBadImages(const AgiFrame& f) {
    refuseUnless(f.depth.view && f.normal.view && f.irradiance.view && f.irradiance.image,
                 "a frame lacks its depth, normal or irradiance image");
    refuseUnless(f.irradiance.format == VK_FORMAT_R16G16B16A16_SFLOAT &&
                     (!f.gloss.view || f.gloss.format == VK_FORMAT_R16G16B16A16_SFLOAT),
                 "results are R16G16B16A16_SFLOAT");
    refuseUnless(!f.gloss.view || (f.baseColor.view && f.roughnessMetallic.view),
                 "gloss needs baseColor and roughnessMetallic");
    refuseUnless(f.normalEncoding >= 0 && f.normalEncoding <= AGI_NORMAL_OCTAHEDRAL_UNSIGNED,
                 "a frame's normalEncoding is none");
    refuseUnless(f.roughnessChannel < 4 && f.metallicChannel < 4, "a channel is 0 to 3");
}

void refuseBadFrame(const AgiFrame& f, uint64_t lastFrame) {
    refuseUnless(f.frame > 0 && f.frame >= lastFrame, "frames' numbers grow from 1");
    refuseUnless(f.framesDone < f.frame, "a frame that is being recorded cannot be done");
    refuseUnless(f.width > 0 && f.height > 0 && f.width <= 16384 && f.height <= 16384,
                 "a frame's width or height is not 1 to 16384");
    refuseUnless(isFinite(f.cameraPosition, 3), "a frame's cameraPosition is not finite");
    refuseUnless(isRotation(f.viewFromWorld), "a frame's viewFromWorld is not a rotation");
    refuseUnless(isPerspective(f.clipFromView), "a frame's clipFromView is not a perspective");
    refuseBadImages(f);
}

// Nothing of the frame's command buffer will be executed: what its views know of the device is not so.
void startAnewAfter(AgiContext context, AgiView failed, uint64_t frame) noexcept {
    context->context.forgetFrame(frame);
    for (AgiView view : context->views)
        if (view == failed || view->view.last.frame == frame) (void)across([&] { view->view.startAnew(); });
}

std::string requirementsMissing(const gpu::DeviceInfo& info) {
    std::string missing;
    for (const std::string& m : info.missing)
        missing += (missing.empty() ? "" : ", ") + m;
    return missing.empty() ? missing : info.name + " lacks " + missing;
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
        static const auto features = [] {
            auto all = std::make_unique<gpu::DeviceFeatures>();
            gpu::requireAll(*all);
            return all;
        }();
        const gpu::Functions vk = loadFunctions(getInstanceProcAddr, instance, VK_NULL_HANDLE);
        const gpu::DeviceInfo info = gpu::describeDevice(vk, device);
        if (const std::string missing = requirementsMissing(info); !missing.empty())
            throw Failure(FailureKind::kUnsupported, missing);
        AgiRequirements out{};
        out.features = &features->core;
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
        std::vector<GuestMesh> meshes;
        for (uint32_t i = 0; i < count; ++i)
            meshes.push_back(meshOf(wholeOf(given, i, "meshes are null"), scene->scene.materials().size()));
        *firstId = scene->scene.addMeshes(std::move(meshes));
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
        std::vector<GuestInstance> instances;
        for (uint32_t i = 0; i < count; ++i)
            instances.push_back(instanceOf(wholeOf(given, i, "instances are null"), scene->scene));
        for (const GuestInstance& instance : instances)
            scene->scene.setInstance(instance);
    });
}

AgiResult agiRemoveInstances(AgiScene scene, uint32_t count, const uint64_t* ids) {
    return across([&] {
        refuseUnless(scene && (ids || count == 0), "scene or ids is null");
        for (uint32_t i = 0; i < count; ++i) {
            refuseUnless(scene->scene.has(ids[i]), "an id is none of the scene's instances");
            refuseUnless(std::find(ids, ids + i, ids[i]) == ids + i, "an id is there twice");
        }
        for (uint32_t i = 0; i < count; ++i)
            scene->scene.removeInstance(ids[i]);
    });
}

AgiResult agiSetLights(AgiScene scene, uint32_t count, const AgiLight* given) {
    return across([&] {
        refuseUnless(scene != nullptr, "scene is null");
        std::vector<GuestLight> lights;
        for (uint32_t i = 0; i < count; ++i)
            lights.push_back(lightOf(wholeOf(given, i, "lights are null")));
        scene->scene.setLights(std::move(lights));
    });
}

AgiResult agiSetProbes(AgiScene scene, uint32_t count, const AgiProbe* given) {
    return across([&] {
        refuseUnless(scene && (given || count == 0), "scene or probes is null");
        refuseUnless(count <= gi::kMostProbes, "there are more than 4096 probes");
        std::vector<GuestProbe> probes;
        for (const AgiProbe& p : std::span(given, count)) {
            const bool any = vec3Of(p.normal) == glm::vec3(0);
            refuseUnless(isFinite(p.position, 3) && (any || isDirection(p.normal)),
                         "a probe's position is not finite, or its normal neither zero nor a unit vector");
            probes.push_back({p.id, dvec3Of(p.position), vec3Of(p.normal)});
        }
        scene->scene.setProbes(std::move(probes));
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
