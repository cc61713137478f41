#include "tests/guest/guest_host.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "engine/gpu/transfer.h"

namespace ag::test {
namespace {

constexpr float kNear = 0.05f, kFar = 40.0f;
const glm::vec3 kEye(0.2f, 1.4f, 2.2f);

VkFormat normalFormat(AgiNormalEncoding encoding) {
    switch (encoding) {
        case AGI_NORMAL_XYZ_UNSIGNED:
            return VK_FORMAT_R8G8B8A8_UNORM;
        case AGI_NORMAL_OCTAHEDRAL_SIGNED:
            return VK_FORMAT_R16G16_SNORM;
        case AGI_NORMAL_OCTAHEDRAL_UNSIGNED:
            return VK_FORMAT_R16G16_UNORM;
        default:
            return VK_FORMAT_R16G16B16A16_SFLOAT;
    }
}

// Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors".
glm::vec2 octahedral(glm::vec3 n) {
    n /= std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
    const glm::vec2 sign(n.x >= 0 ? 1 : -1, n.y >= 0 ? 1 : -1);
    return n.z >= 0 ? glm::vec2(n) : (1.0f - glm::abs(glm::vec2(n.y, n.x))) * sign;
}

void copy3(double (&to)[3], const glm::dvec3& from) {
    for (int i = 0; i < 3; ++i)
        to[i] = from[i];
}

template <class T>
void append(std::vector<std::byte>& bytes, T value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof value);
}

void appendNormal(std::vector<std::byte>& bytes, AgiNormalEncoding encoding, glm::vec3 n) {
    switch (encoding) {
        case AGI_NORMAL_XYZ_UNSIGNED:
            return append(bytes, glm::packUnorm4x8(glm::vec4(0.5f + 0.5f * n, 0)));
        case AGI_NORMAL_OCTAHEDRAL_SIGNED:
            return append(bytes, glm::packSnorm2x16(octahedral(n)));
        case AGI_NORMAL_OCTAHEDRAL_UNSIGNED:
            return append(bytes, glm::packUnorm2x16(0.5f + 0.5f * octahedral(n)));
        default:
            return append(bytes, glm::packHalf4x16(glm::vec4(n, 0)));
    }
}

std::unique_ptr<gpu::Image> makeImage(const char* name, VkFormat format, glm::uvec2 size) {
    return std::make_unique<gpu::Image>(device(),
                                        gpu::ImageDesc{.name = name, .format = format, .size = size});
}

AgiImage given(const std::unique_ptr<gpu::Image>& image) {
    return {image->handle(), image->view(), image->desc().format};
}

std::unique_ptr<gpu::Image> makeResult(const char* name, glm::uvec2 size) {
    auto image = makeImage(name, VK_FORMAT_R16G16B16A16_SFLOAT, size);
    device().runOnce([&](VkCommandBuffer commands) {
        const VkImageMemoryBarrier2 barrier{
            .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
            .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
            .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
            .newLayout = VK_IMAGE_LAYOUT_GENERAL,
            .image = image->handle(),
            .subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}};
        const VkDependencyInfo info{.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .imageMemoryBarrierCount = 1,
                                    .pImageMemoryBarriers = &barrier};
        device().vk().CmdPipelineBarrier2(commands, &info);
    });
    return image;
}

}  // namespace

HostCamera::HostCamera(const Room& room, const GbufferLayout& layout, glm::dvec3 place) {
    copy3(frame_.cameraPosition, place + glm::dvec3(kEye));
    for (const int i : {0, 4, 8})
        frame_.viewFromWorld[i] = 1;
    setPerspective(layout, 1.0f);
    const glm::vec2 size(layout.size);
    fillGbuffer(layout, [&](uint32_t x, uint32_t y) -> Pixel {
        const glm::vec2 ndc = 2.0f * (glm::vec2(x, y) + 0.5f) / size - 1.0f;
        const float* clip = frame_.clipFromView;
        const glm::vec3 ray(ndc.x / clip[0], ndc.y / clip[5], -1);  // its length along z is 1
        const auto hit = castRay(room, kEye, ray);
        return hit ? Pixel{hit->distance, hit->normal} : Pixel{};
    });
    giveImages(layout);
}

HostCamera::HostCamera(const RenderCamera& camera, glm::dvec3 origin, const Image& depth,
                       const Image& normal) {
    const GbufferLayout layout{.size = {uint32_t(depth.width), uint32_t(depth.height)},
                               .normals = AGI_NORMAL_XYZ_SIGNED};
    copy3(frame_.cameraPosition, origin + glm::dvec3(camera.position));
    const glm::vec3 right = glm::cross(camera.forward, camera.up);
    for (int column = 0; column < 3; ++column) {
        frame_.viewFromWorld[3 * column] = right[column];
        frame_.viewFromWorld[3 * column + 1] = camera.up[column];
        frame_.viewFromWorld[3 * column + 2] = -camera.forward[column];
    }
    setPerspective(layout, camera.verticalFov);
    fillGbuffer(layout, [&](uint32_t x, uint32_t y) {
        return Pixel{depth.at(int(x), int(y)).x, normal.at(int(x), int(y))};
    });
    giveImages(layout);
}

void HostCamera::giveImages(const GbufferLayout& layout) {
    frame_.structSize = sizeof frame_;
    frame_.width = layout.size.x;
    frame_.height = layout.size.y;
    frame_.normalEncoding = layout.normals;
    frame_.depth = given(depth_);
    frame_.normal = given(normal_);
    irradiance_ = makeResult("host.irradiance", layout.size);
    frame_.irradiance = given(irradiance_);
    if (!layout.gloss) return;
    gloss_ = makeResult("host.gloss", layout.size);
    frame_.gloss = given(gloss_);
    frame_.baseColor = given(baseColor_);
    frame_.roughnessMetallic = given(material_);
    frame_.roughnessChannel = 2;
    frame_.metallicChannel = 0;
}

// Depth (a z + b) / -z of z < 0 before the camera.
void HostCamera::setPerspective(const GbufferLayout& layout, float verticalFov) {
    const float aspect = float(layout.size.x) / float(layout.size.y), focal = 1 / std::tan(verticalFov / 2);
    const float span = kFar - kNear;
    const bool reversed = layout.reversedDepth;
    frame_.clipFromView[0] = focal / aspect;
    frame_.clipFromView[5] = -focal;
    frame_.clipFromView[11] = -1;
    if (layout.farPlane) {
        frame_.clipFromView[10] = reversed ? kNear / span : -kFar / span;
        frame_.clipFromView[14] = reversed ? kNear * kFar / span : -kNear * kFar / span;
    } else {
        frame_.clipFromView[10] = reversed ? 0.0f : -1.0f;
        frame_.clipFromView[14] = reversed ? kNear : -kNear;
    }
    frame_.depthReversed = reversed;
}

void HostCamera::fillGbuffer(const GbufferLayout& layout,
                             const std::function<Pixel(uint32_t, uint32_t)>& at) {
    const float* clip = frame_.clipFromView;
    const float farthest = layout.reversedDepth ? 0.0f : 1.0f;
    std::vector<std::byte> depths, normals, colors, materials;
    for (uint32_t y = 0; y < layout.size.y; ++y)
        for (uint32_t x = 0; x < layout.size.x; ++x) {
            const Pixel pixel = at(x, y);
            const float z = -pixel.distance;
            append(depths, z < 0 ? (clip[10] * z + clip[14]) / -z : farthest);
            appendNormal(normals, layout.normals, pixel.normal);
            append(colors, glm::packUnorm4x8({0.8f, 0.7f, 0.6f, 1}));
            append(materials, glm::packUnorm4x8({1, 0, 0.3f, 0}));  // metal, nothing, roughness
        }
    depth_ = makeImage("host.depth", VK_FORMAT_D32_SFLOAT, layout.size);
    normal_ = makeImage("host.normal", normalFormat(layout.normals), layout.size);
    baseColor_ = makeImage("host.base_color", VK_FORMAT_R8G8B8A8_UNORM, layout.size);
    material_ = makeImage("host.material", VK_FORMAT_R8G8B8A8_UNORM, layout.size);
    gpu::uploadImage(device(), *depth_, 0, depths);
    gpu::uploadImage(device(), *normal_, 0, normals);
    gpu::uploadImage(device(), *baseColor_, 0, colors);
    gpu::uploadImage(device(), *material_, 0, materials);
}

std::vector<glm::vec3> HostCamera::download(const gpu::Image& image) const {
    const size_t count = size_t(frame_.width) * frame_.height;
    std::vector<uint64_t> texels(count);
    gpu::downloadImage(device(), image, VK_IMAGE_LAYOUT_GENERAL, std::as_writable_bytes(std::span(texels)));
    std::vector<glm::vec3> picture(count);
    for (size_t i = 0; i < count; ++i)
        picture[i] = glm::vec3(glm::unpackHalf4x16(texels[i]));
    return picture;
}

AgiContextInfo contextInfo(const HostHooks& hooks) {
    AgiContextInfo info{AGI_INIT(AgiContextInfo)};
    info.instance = device().context().instance();
    info.physicalDevice = device().context().physical();
    info.device = device().handle();
    info.queueFamily = device().queueFamily();
    info.getInstanceProcAddr =
        hooks.getInstanceProcAddr ? hooks.getInstanceProcAddr : device().vk().GetInstanceProcAddr;
    info.allocate = hooks.allocate;
    info.release = hooks.release;
    info.user = hooks.user;
    return info;
}

HostRoom::HostRoom() {
    vertices_ = gpu::loadBuffer(device(), {.name = "host.vertices", .vertexOrIndex = true}, room_.vertices);
    indices_ = gpu::loadBuffer(device(), {.name = "host.indices", .vertexOrIndex = true}, room_.indices);
}

AgiMesh HostRoom::mesh(uint32_t firstIndex, uint32_t count, uint32_t material) const {
    AgiMesh mesh{AGI_INIT(AgiMesh)};
    mesh.vertexBuffer = vertices_->handle();
    mesh.indexBuffer = indices_->handle();
    mesh.positionOffset = offsetof(RoomVertex, position);
    mesh.normalOffset = offsetof(RoomVertex, normal);
    mesh.positionStride = mesh.normalStride = sizeof(RoomVertex);
    mesh.indexOffset = firstIndex * sizeof(uint16_t);
    mesh.vertexCount = uint32_t(room_.vertices.size());
    mesh.indexCount = count;
    mesh.indexType = VK_INDEX_TYPE_UINT16;
    mesh.material = material;
    mesh.positions = &room_.vertices[0].position;
    mesh.normals = &room_.vertices[0].normal;
    mesh.indices = &room_.indices[firstIndex];
    return mesh;
}

std::vector<AgiMesh> HostRoom::meshes() const {
    const uint32_t walls = room_.wallIndices;
    return {mesh(0, walls, 0), mesh(walls, uint32_t(room_.indices.size()) - walls, 1)};
}

std::vector<AgiInstance> HostRoom::instances(glm::dvec3 place) const {
    std::vector<AgiInstance> out;
    for (const uint32_t mesh : {0u, 1u}) {
        AgiInstance instance{AGI_INIT(AgiInstance)};
        instance.id = 10 + mesh;
        instance.mesh = mesh;
        instance.movable = mesh == 1;
        for (int i = 0; i < 3; ++i)
            instance.position[i] = place[i];
        for (const int i : {0, 4, 8})
            instance.linear[i] = 1;
        out.push_back(instance);
    }
    return out;
}

AgiLight spotAt(glm::dvec3 place) {
    AgiLight light{AGI_INIT(AgiLight)};
    light.id = 3;
    light.kind = AGI_LIGHT_SPOT;
    light.position[0] = place.x + 0.5;
    light.position[1] = place.y + 2.6;
    light.position[2] = place.z + 0.5;
    light.direction[0] = 0.6f;
    light.direction[1] = -0.8f;
    for (float& channel : light.intensity)
        channel = 30;
    light.innerAngle = 0.4f;
    light.outerAngle = 0.6f;
    light.budgetShare = 1;
    light.mapSize = 64;
    return light;
}

AgiResult HostRoom::fill(AgiScene scene, glm::dvec3 place) const {
    AgiMaterial materials[2] = {{AGI_INIT(AgiMaterial)}, {AGI_INIT(AgiMaterial)}};
    for (int c = 0; c < 3; ++c) {
        materials[0].albedo[c] = 0.7f;
        materials[1].albedo[c] = c == 0 ? 0.8f : 0.2f;
    }
    uint32_t first = 0;
    const std::vector<AgiMesh> shapes = meshes();
    const std::vector<AgiInstance> things = instances(place);
    const AgiLight light = spotAt(place);
    AgiResult result = agiAddMaterials(scene, 2, materials, &first);
    if (result == AGI_OK) result = agiAddMeshes(scene, uint32_t(shapes.size()), shapes.data(), &first);
    if (result == AGI_OK) result = agiSetInstances(scene, uint32_t(things.size()), things.data());
    if (result == AGI_OK) result = agiSetLights(scene, 1, &light);
    return result;
}

Guest::Guest(const HostHooks& hooks) {
    const AgiContextInfo info = contextInfo(hooks);
    EXPECT_EQ(agiCreateContext(&info, &context), AGI_OK) << agiLastError();
    EXPECT_EQ(agiCreateScene(context, &scene), AGI_OK) << agiLastError();
}

Guest::Guest(const HostRoom& room, const HostHooks& hooks, glm::dvec3 place) : Guest(hooks) {
    EXPECT_EQ(room.fill(scene, place), AGI_OK) << agiLastError();
}

Guest::~Guest() {
    for (AgiView view : views_)
        agiDestroyView(view);
    agiDestroyScene(scene);
    agiDestroyContext(context);
}

AgiView Guest::addView(const HostCamera& camera, const char* preset) {
    AgiViewInfo info{AGI_INIT(AgiViewInfo)};
    info.width = camera.frame().width;
    info.height = camera.frame().height;
    info.preset = preset;
    AgiView view = nullptr;
    EXPECT_EQ(agiCreateView(context, &info, &view), AGI_OK) << agiLastError();
    views_.push_back(view);
    return view;
}

void Guest::drawFrame(std::initializer_list<std::pair<AgiView, const HostCamera*>> views) {
    ++frame;
    device().runOnce([&](VkCommandBuffer commands) {
        for (const auto& [view, camera] : views) {
            AgiFrame f = camera->frame();
            f.frame = frame;
            f.framesDone = frame - 1;
            if (change) change(f);
            EXPECT_EQ(agiRecord(view, scene, commands, &f), AGI_OK) << agiLastError();
        }
    });
}

void Guest::drawFrames(int count, AgiView view, const HostCamera& camera) {
    for (int i = 0; i < count; ++i)
        drawFrame({{view, &camera}});
}

double meanOf(const std::vector<glm::vec3>& picture) {
    glm::dvec3 sum(0);
    for (const glm::vec3& p : picture)
        sum += glm::dvec3(p);
    return (sum.x + sum.y + sum.z) / (3.0 * double(picture.size()));
}

double relativeError(const std::vector<glm::vec3>& picture, const std::vector<glm::vec3>& expected) {
    double square = 0;
    for (size_t i = 0; i < picture.size(); ++i) {
        const glm::dvec3 d = glm::dvec3(picture[i]) - glm::dvec3(expected[i]);
        square += glm::dot(d, d);
    }
    return std::sqrt(square / (3.0 * double(picture.size()))) / meanOf(expected);
}

}  // namespace ag::test
