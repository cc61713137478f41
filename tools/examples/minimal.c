/* The shortest host of Afterglow GI: plain Vulkan in C99, a little rasteriser of a room, no window.
 *
 *     minimal ROOM.glb LIGHT.pfm [TRUTH.pfm]
 *
 * writes the room's bounced irradiance as its own camera sees it; with a picture to compare with, prints by
 * how much it differs. What is said to the library stands between the two lines of equals signs, and in
 * drawFrame. */
#include <afterglow/afterglow_gi.h>
#include <vulkan/vulkan.h>

#include "gbuffer.frag.h"
#include "gbuffer.vert.h"
#include "glb.h"

enum { WIDTH = 320, HEIGHT = 180, FRAMES = 64 };

static void must(int fine, const char* what) {
    if (fine) return;
    fprintf(stderr, "minimal: %s\n", what);
    exit(2);
}
#define VK(call) must((call) == VK_SUCCESS, #call)

typedef struct Buffer {
    VkBuffer handle;
    VkDeviceMemory memory;
    void* mapped;
} Buffer;
typedef struct Image {
    VkImage handle;
    VkDeviceMemory memory;
    VkImageView view;
    VkFormat format;
} Image;

static VkInstance instance;
static VkPhysicalDevice physical;
static VkDevice device;
static VkQueue queue;
static uint32_t family;
static VkCommandBuffer commands;
static VkFence fence;
static VkPipelineLayout layout;
static VkPipeline pipeline;
static Buffer vertices, indices, pixels;
static Image depth, normal, irradiance;
static Glb room;

/* ---- Vulkan of the host's own ---- */

static uint32_t memoryType(uint32_t allowed, VkMemoryPropertyFlags wanted) {
    VkPhysicalDeviceMemoryProperties p;
    vkGetPhysicalDeviceMemoryProperties(physical, &p);
    for (uint32_t i = 0; i < p.memoryTypeCount; ++i)
        if ((allowed >> i & 1) && (p.memoryTypes[i].propertyFlags & wanted) == wanted) return i;
    must(0, "no memory type fits");
    return 0;
}

static Buffer makeBuffer(VkDeviceSize bytes, VkBufferUsageFlags usage, const void* data) {
    Buffer b;
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = bytes, .usage = usage};
    VK(vkCreateBuffer(device, &info, NULL, &b.handle));
    VkMemoryRequirements r;
    vkGetBufferMemoryRequirements(device, b.handle, &r);
    const VkMemoryAllocateInfo allocation = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
        .allocationSize = r.size,
        .memoryTypeIndex = memoryType(
            r.memoryTypeBits, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)};
    VK(vkAllocateMemory(device, &allocation, NULL, &b.memory));
    VK(vkBindBufferMemory(device, b.handle, b.memory, 0));
    VK(vkMapMemory(device, b.memory, 0, VK_WHOLE_SIZE, 0, &b.mapped));
    if (data) memcpy(b.mapped, data, (size_t)bytes);
    return b;
}

static Image makeImage(VkFormat format, VkImageUsageFlags usage, VkImageAspectFlags aspect) {
    Image m = {.format = format};
    const VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
                                    .imageType = VK_IMAGE_TYPE_2D,
                                    .format = format,
                                    .extent = {WIDTH, HEIGHT, 1},
                                    .mipLevels = 1,
                                    .arrayLayers = 1,
                                    .samples = VK_SAMPLE_COUNT_1_BIT,
                                    .usage = usage};
    VK(vkCreateImage(device, &info, NULL, &m.handle));
    VkMemoryRequirements r;
    vkGetImageMemoryRequirements(device, m.handle, &r);
    const VkMemoryAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                             .allocationSize = r.size,
                                             .memoryTypeIndex = memoryType(r.memoryTypeBits, 0)};
    VK(vkAllocateMemory(device, &allocation, NULL, &m.memory));
    VK(vkBindImageMemory(device, m.handle, m.memory, 0));
    const VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                        .image = m.handle,
                                        .viewType = VK_IMAGE_VIEW_TYPE_2D,
                                        .format = format,
                                        .subresourceRange = {aspect, 0, 1, 0, 1}};
    VK(vkCreateImageView(device, &view, NULL, &m.view));
    return m;
}

static void openDevice(void) {
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pApplicationInfo = &application};
    VK(vkCreateInstance(&info, NULL, &instance));
    uint32_t count = 1;
    must(vkEnumeratePhysicalDevices(instance, &count, &physical) >= 0 && count == 1,
         "there is no Vulkan device");
    VkQueueFamilyProperties families[16];
    count = 16;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    while (family < count && (families[family].queueFlags & 3) != 3)
        ++family; /* graphics and compute */
    must(family < count, "no queue draws and computes");

    AgiRequirements needs = {AGI_INIT(AgiRequirements)};
    must(agiGetRequirements(instance, physical, vkGetInstanceProcAddr, &needs) == AGI_OK, agiLastError());
    const float priority = 1;
    const VkDeviceQueueCreateInfo queues = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = family,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority};
    const VkDeviceCreateInfo create = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                       .pNext = needs.features,
                                       .queueCreateInfoCount = 1,
                                       .pQueueCreateInfos = &queues,
                                       .enabledExtensionCount = needs.extensionCount,
                                       .ppEnabledExtensionNames = needs.extensions};
    VK(vkCreateDevice(physical, &create, NULL, &device));
    vkGetDeviceQueue(device, family, 0, &queue);
    const VkCommandPoolCreateInfo poolInfo = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
                                              .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
                                              .queueFamilyIndex = family};
    VkCommandPool pool;
    VK(vkCreateCommandPool(device, &poolInfo, NULL, &pool));
    const VkCommandBufferAllocateInfo allocation = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                                    .commandPool = pool,
                                                    .commandBufferCount = 1};
    VK(vkAllocateCommandBuffers(device, &allocation, &commands));
    const VkFenceCreateInfo fenceInfo = {.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    VK(vkCreateFence(device, &fenceInfo, NULL, &fence));
}

static VkPipelineShaderStageCreateInfo stage(VkShaderStageFlagBits which, const uint32_t* code,
                                             size_t bytes) {
    const VkShaderModuleCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO, .codeSize = bytes, .pCode = code};
    VkPipelineShaderStageCreateInfo s = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, .stage = which, .pName = "main"};
    VK(vkCreateShaderModule(device, &info, NULL, &s.module));
    return s;
}

static void makePipeline(void) {
    const VkPushConstantRange push = {VK_SHADER_STAGE_VERTEX_BIT, 0, 112};
    const VkPipelineLayoutCreateInfo layoutInfo = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                                   .pushConstantRangeCount = 1,
                                                   .pPushConstantRanges = &push};
    VK(vkCreatePipelineLayout(device, &layoutInfo, NULL, &layout));
    const VkPipelineShaderStageCreateInfo stages[] = {
        stage(VK_SHADER_STAGE_VERTEX_BIT, gbuffer_vert, sizeof gbuffer_vert),
        stage(VK_SHADER_STAGE_FRAGMENT_BIT, gbuffer_frag, sizeof gbuffer_frag)};
    const VkVertexInputBindingDescription binding = {0, 24, VK_VERTEX_INPUT_RATE_VERTEX};
    const VkVertexInputAttributeDescription attributes[] = {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, 0},
                                                            {1, 0, VK_FORMAT_R32G32B32_SFLOAT, 12}};
    const VkPipelineVertexInputStateCreateInfo input = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = 1,
        .pVertexBindingDescriptions = &binding,
        .vertexAttributeDescriptionCount = 2,
        .pVertexAttributeDescriptions = attributes};
    const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    const VkViewport port = {0, 0, WIDTH, HEIGHT, 0, 1};
    const VkRect2D all = {{0, 0}, {WIDTH, HEIGHT}};
    const VkPipelineViewportStateCreateInfo viewport = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &port,
        .scissorCount = 1,
        .pScissors = &all};
    const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO,
        .cullMode = VK_CULL_MODE_BACK_BIT,
        .lineWidth = 1};
    const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    const VkPipelineDepthStencilStateCreateInfo depthState = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO,
        .depthTestEnable = 1,
        .depthWriteEnable = 1,
        .depthCompareOp = VK_COMPARE_OP_LESS};
    const VkPipelineColorBlendAttachmentState blend = {.colorWriteMask = 0xf};
    const VkPipelineColorBlendStateCreateInfo blending = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = 1,
        .pAttachments = &blend};
    const VkPipelineRenderingCreateInfo formats = {.sType = VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                                   .colorAttachmentCount = 1,
                                                   .pColorAttachmentFormats = &normal.format,
                                                   .depthAttachmentFormat = depth.format};
    const VkGraphicsPipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                               .pNext = &formats,
                                               .stageCount = 2,
                                               .pStages = stages,
                                               .pVertexInputState = &input,
                                               .pInputAssemblyState = &assembly,
                                               .pViewportState = &viewport,
                                               .pRasterizationState = &raster,
                                               .pMultisampleState = &samples,
                                               .pDepthStencilState = &depthState,
                                               .pColorBlendState = &blending,
                                               .layout = layout};
    VK(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline));
}

static void move(Image m, VkImageAspectFlags aspect, VkImageLayout from, VkImageLayout to) {
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = from,
        .newLayout = to,
        .image = m.handle,
        .subresourceRange = {aspect, 0, 1, 0, 1}};
    const VkDependencyInfo info = {.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                   .imageMemoryBarrierCount = 1,
                                   .pImageMemoryBarriers = &barrier};
    vkCmdPipelineBarrier2(commands, &info);
}

/* clip = projection * view, columns; ordinary depth with a far plane. */
static float projection[16], view[9], eye[3], clipFromWorld[16];
static void placeCamera(void) {
    const float near = room.nearPlane, far = 100, y = 1 / tanf(room.verticalFov / 2), *c = room.camera;
    projection[0] = y * HEIGHT / WIDTH, projection[5] = -y, projection[10] = far / (near - far),
    projection[11] = -1;
    projection[14] = near * far / (near - far);
    for (int i = 0; i < 9; ++i)
        view[i] = c[i % 3 * 3 + i / 3]; /* the rotation turned over */
    memcpy(eye, c + 9, sizeof eye);
    float world[16] = {0};
    for (int column = 0; column < 3; ++column)
        for (int r = 0; r < 3; ++r) {
            world[column * 4 + r] = view[column * 3 + r];
            world[12 + r] -= view[column * 3 + r] * eye[column];
        }
    world[15] = 1;
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r)
            for (int k = 0; k < 4; ++k)
                clipFromWorld[column * 4 + r] += projection[k * 4 + r] * world[column * 4 + k];
}

static void drawRoom(void) {
    const VkRenderingAttachmentInfo color = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                             .imageView = normal.view,
                                             .imageLayout = VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                                             .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                             .storeOp = VK_ATTACHMENT_STORE_OP_STORE};
    const VkRenderingAttachmentInfo far = {.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
                                           .imageView = depth.view,
                                           .imageLayout = VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                                           .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
                                           .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
                                           .clearValue = {.depthStencil = {1, 0}}};
    const VkRenderingInfo rendering = {.sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
                                       .renderArea = {{0, 0}, {WIDTH, HEIGHT}},
                                       .layerCount = 1,
                                       .colorAttachmentCount = 1,
                                       .pColorAttachments = &color,
                                       .pDepthAttachment = &far};
    move(normal, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
         VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    move(depth, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_UNDEFINED,
         VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL);
    vkCmdBeginRendering(commands, &rendering);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
    const VkDeviceSize zero = 0;
    vkCmdBindVertexBuffers(commands, 0, 1, &vertices.handle, &zero);
    vkCmdBindIndexBuffer(commands, indices.handle, 0, VK_INDEX_TYPE_UINT32);
    for (uint32_t i = 0; i < room.instanceCount; ++i) {
        const GlbMesh* mesh = &room.meshes[room.instances[i].mesh];
        float push[28];
        memcpy(push, clipFromWorld, sizeof clipFromWorld);
        for (int k = 0; k < 12; ++k)
            push[16 + k] = room.instances[i].world[k % 4 * 3 + k / 4]; /* rows */
        vkCmdPushConstants(commands, layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof push, push);
        vkCmdDrawIndexed(commands, mesh->indexCount, 1, mesh->firstIndex, (int32_t)mesh->firstVertex, 0);
    }
    vkCmdEndRendering(commands);
    move(normal, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
    move(depth, VK_IMAGE_ASPECT_DEPTH_BIT, VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
         VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
}

/* ====================================================================================================== */

static AgiContext context;
static AgiScene scene;
static AgiView look;
#define AGI(call) must((call) == AGI_OK, agiLastError())

static void handOver(void) {
    const AgiContextInfo info = {AGI_INIT(AgiContextInfo),   .instance = instance,
                                 .physicalDevice = physical, .device = device,
                                 .queueFamily = family,      .getInstanceProcAddr = vkGetInstanceProcAddr};
    AGI(agiCreateContext(&info, &context));
    AGI(agiCreateScene(context, &scene));
    uint32_t first;
    for (uint32_t i = 0; i < room.materialCount; ++i) {
        AgiMaterial material = {AGI_INIT(AgiMaterial)};
        memcpy(material.albedo, room.albedo[i], sizeof material.albedo);
        AGI(agiAddMaterials(scene, 1, &material, &first));
    }
    for (uint32_t i = 0; i < room.meshCount; ++i) {
        const GlbMesh* m = &room.meshes[i];
        const float* at = room.vertices + m->firstVertex * 6;
        const AgiMesh mesh = {AGI_INIT(AgiMesh),
                              .vertexBuffer = vertices.handle,
                              .indexBuffer = indices.handle,
                              .positionOffset = m->firstVertex * 24,
                              .normalOffset = m->firstVertex * 24 + 12,
                              .indexOffset = m->firstIndex * 4,
                              .positionStride = 24,
                              .normalStride = 24,
                              .vertexCount = m->vertexCount,
                              .indexCount = m->indexCount,
                              .indexType = VK_INDEX_TYPE_UINT32,
                              .material = m->material,
                              .positions = at,
                              .normals = at + 3,
                              .indices = room.indices + m->firstIndex};
        AGI(agiAddMeshes(scene, 1, &mesh, &first));
    }
    for (uint32_t i = 0; i < room.instanceCount; ++i) {
        AgiInstance thing = {AGI_INIT(AgiInstance), .id = i, .mesh = room.instances[i].mesh};
        memcpy(thing.linear, room.instances[i].world, sizeof thing.linear);
        for (int k = 0; k < 3; ++k)
            thing.position[k] = room.instances[i].world[9 + k];
        AGI(agiSetInstances(scene, 1, &thing));
    }
    AgiLight lights[8];
    for (uint32_t i = 0; i < room.lightCount; ++i) {
        const GlbLight* l = &room.lights[i];
        lights[i] = (AgiLight){AGI_INIT(AgiLight),
                               .id = i,
                               .kind = (AgiLightKind)l->kind,
                               .range = l->range,
                               .innerAngle = l->inner,
                               .outerAngle = l->outer,
                               .budgetShare = 1};
        memcpy(lights[i].direction, l->direction, sizeof l->direction);
        memcpy(lights[i].intensity, l->intensity, sizeof l->intensity);
        for (int k = 0; k < 3; ++k)
            lights[i].position[k] = l->position[k];
    }
    AGI(agiSetLights(scene, room.lightCount, lights));
    const AgiViewInfo viewInfo = {AGI_INIT(AgiViewInfo), .width = WIDTH, .height = HEIGHT,
                                  .preset = "medium"};
    AGI(agiCreateView(context, &viewInfo, &look));
}

static void recordLight(uint64_t number) {
    AgiFrame frame = {AGI_INIT(AgiFrame),
                      .frame = number,
                      .framesDone = number - 1,
                      .width = WIDTH,
                      .height = HEIGHT,
                      .depth = {depth.handle, depth.view, depth.format},
                      .normal = {normal.handle, normal.view, normal.format},
                      .normalEncoding = AGI_NORMAL_XYZ_SIGNED,
                      .irradiance = {irradiance.handle, irradiance.view, irradiance.format}};
    for (int k = 0; k < 3; ++k)
        frame.cameraPosition[k] = eye[k];
    memcpy(frame.viewFromWorld, view, sizeof view);
    memcpy(frame.clipFromView, projection, sizeof projection);
    AGI(agiRecord(look, scene, commands, &frame));
}

static void takeLeave(void) {
    agiDestroyView(look);
    agiDestroyScene(scene);
    agiDestroyContext(context);
}

/* ====================================================================================================== */

static void drawFrame(uint64_t number) {
    const VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    VK(vkBeginCommandBuffer(commands, &begin));
    drawRoom();
    if (number == 1)
        move(irradiance, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_GENERAL);
    recordLight(number);
    if (number == FRAMES) {
        move(irradiance, VK_IMAGE_ASPECT_COLOR_BIT, VK_IMAGE_LAYOUT_GENERAL, VK_IMAGE_LAYOUT_GENERAL);
        const VkBufferImageCopy copy = {.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                                        .imageExtent = {WIDTH, HEIGHT, 1}};
        vkCmdCopyImageToBuffer(commands, irradiance.handle, VK_IMAGE_LAYOUT_GENERAL, pixels.handle, 1, &copy);
    }
    VK(vkEndCommandBuffer(commands));
    const VkSubmitInfo submit = {
        .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO, .commandBufferCount = 1, .pCommandBuffers = &commands};
    VK(vkQueueSubmit(queue, 1, &submit, fence));
    VK(vkWaitForFences(device, 1, &fence, VK_TRUE, UINT64_MAX));
    VK(vkResetFences(device, 1, &fence));
}

static float half(uint16_t h) {
    const int exponent = h >> 10 & 31;
    return ldexpf((float)(h & 1023) + (exponent ? 1024 : 0), (exponent ? exponent : 1) - 25);
}

int main(int count, char** arguments) {
    must(count == 3 || count == 4, "usage: minimal ROOM.glb LIGHT.pfm [TRUTH.pfm]");
    must(glbLoad(arguments[1], &room), "the room cannot be read");
    openDevice();
    vertices = makeBuffer(room.vertexCount * 24, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT, room.vertices);
    indices = makeBuffer(room.indexCount * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, room.indices);
    pixels = makeBuffer(WIDTH * HEIGHT * 8, VK_BUFFER_USAGE_TRANSFER_DST_BIT, NULL);
    depth = makeImage(VK_FORMAT_D32_SFLOAT,
                      VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                      VK_IMAGE_ASPECT_DEPTH_BIT);
    normal = makeImage(VK_FORMAT_R16G16B16A16_SFLOAT,
                       VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT,
                       VK_IMAGE_ASPECT_COLOR_BIT);
    irradiance =
        makeImage(VK_FORMAT_R16G16B16A16_SFLOAT, VK_IMAGE_USAGE_STORAGE_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT,
                  VK_IMAGE_ASPECT_COLOR_BIT);
    makePipeline();
    placeCamera();
    handOver();
    for (uint64_t frame = 1; frame <= FRAMES; ++frame)
        drawFrame(frame);
    takeLeave();

    FILE* out = fopen(arguments[2], "wb");
    must(out != NULL, "the picture cannot be written");
    fprintf(out, "PF\n%d %d\n-1.0\n", WIDTH, HEIGHT);
    static float rgb[HEIGHT][WIDTH][3], truth[HEIGHT][WIDTH][3];
    const uint16_t* texels = pixels.mapped;
    for (int i = 0; i < WIDTH * HEIGHT * 3; ++i) /* PFM begins at the bottom */
        rgb[HEIGHT - 1 - i / 3 / WIDTH][i / 3 % WIDTH][i % 3] = half(texels[i / 3 * 4 + i % 3]);
    fwrite(rgb, sizeof rgb, 1, out);
    must(fclose(out) == 0, "the picture cannot be written");
    if (count == 3) return 0;

    int width = 0, height = 0;
    FILE* in = fopen(arguments[3], "rb");
    must(in && fscanf(in, "PF %d %d %*f", &width, &height) == 2 && width == WIDTH && height == HEIGHT &&
             fgetc(in) == '\n' && fread(truth, sizeof truth, 1, in) == 1,
         "the truth is no PFM of that size");
    double square = 0, sum = 0, ours = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 3; ++i) {
        const double a = (&truth[0][0][0])[i], b = (&rgb[0][0][0])[i];
        square += (a - b) * (a - b), sum += a, ours += b;
    }
    const double n = WIDTH * HEIGHT * 3.0;
    printf("mean ratio %.4f, relative RMSE %.4f\n", ours / sum, sqrt(square / n) / (sum / n));
    return 0;
}
