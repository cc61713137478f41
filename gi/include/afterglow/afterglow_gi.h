/* Afterglow GI: indirect light in real time for a Vulkan renderer of yours, without ray-tracing hardware.
 *
 * You hand over triangles once, then each frame where they stand, the lights, the camera and a G-buffer; the
 * library records into your command buffer what writes irradiance (and, if you ask for it, gloss) into an
 * image of yours.
 *
 *     agiCreateContext   once a device          agiCreateView    once a camera
 *     agiCreateScene     once a world           agiSetLights     when lights change
 *     agiAddMaterials    at loading             agiSetInstances  when things come or move
 *     agiAddMeshes       at loading             agiSetSky        when the sky changes
 *                                               agiRecord        once a frame and view
 *
 * It never submits, waits, prints, aborts or throws. A call that fails returns a negative code, and
 * agiLastError says in one sentence what is wrong. Nothing global: contexts of several devices live side by
 * side.
 *
 * Conventions
 * - Structs that you fill begin with AGI_INIT(Type); fields may be added at their ends, so structSize tells
 * what you know.
 * - Metres, seconds, radians. Light is radiometric and linear: point and spot lights in W/sr, directional
 * lights in W/m² on a plane that faces them, irradiance in W/m². Multiply irradiance by diffuse albedo / pi
 * for radiance.
 * - Right-handed world. Matrices are column-major. Clip space is Vulkan's: x right, y down, depth 0 to 1
 * either way round.
 * - The device: Vulkan 1.3, or what agiGetRequirements lists.
 * - Threads: one at a time for each context, but agiPrepare may run on another one while nothing else uses
 * its view and scene. agiLastError is the calling thread's.
 * - Frames have numbers of yours that grow from 1. Command buffers are executed in the order they were
 * recorded in, on one queue of the context's family. What a frame used is given back once you say that it is
 * done (AgiFrame::framesDone).
 * - agiRecord leaves other bound pipelines, descriptor sets, push constants and dynamic state behind, and
 * must be called outside of rendering.
 */
#ifndef AFTERGLOW_GI_H
#define AFTERGLOW_GI_H

#include <stddef.h>
#include <stdint.h>
#include <vulkan/vulkan_core.h>

#define AGI_VERSION_MAJOR 1 /* the soname: another one where something is removed or means another thing */
#define AGI_VERSION_MINOR 2
#define AGI_VERSION ((AGI_VERSION_MAJOR << 16) | AGI_VERSION_MINOR)

#if defined(__GNUC__)
#define AGI_API __attribute__((visibility("default")))
#else
#define AGI_API
#endif
#define AGI_INIT(Type) sizeof(Type), NULL

#ifdef __cplusplus
extern "C" {
#endif

typedef struct AgiContext_T* AgiContext;
typedef struct AgiScene_T* AgiScene;
typedef struct AgiView_T* AgiView;

typedef enum AgiResult {
    AGI_OK = 0,
    AGI_ERROR_ARGUMENT = -1,      /* what you passed cannot be; nothing was changed */
    AGI_ERROR_UNSUPPORTED = -2,   /* the device lacks something */
    AGI_ERROR_HOST_MEMORY = -3,   /* out of it; see agiRecord for what that means there */
    AGI_ERROR_DEVICE_MEMORY = -4, /* the same */
    AGI_ERROR_DEVICE_LOST = -5,   /* destroy views, scenes and the context */
    AGI_ERROR_INTERNAL = -6,      /* a mistake of the library's: the sentence names the place */
    AGI_RESULT_MAX = 0x7fffffff
} AgiResult;

/* Of the library in use, as AGI_VERSION. */
AGI_API uint32_t agiVersion(void);

/* Of the last call of this thread that failed; never null, valid until the next one. */
AGI_API const char* agiLastError(void);

/* ---- The device ---- */

/* What the device must be created with. `features` heads a chain of features to switch on
 * (VkPhysicalDeviceFeatures2 with pNext); what is not VK_TRUE in it is not needed. Strings and chain live as
 * long as the library. */
typedef struct AgiRequirements {
    size_t structSize;
    void* next;
    uint32_t extensionCount; /* of the device */
    const char* const* extensions;
    const VkPhysicalDeviceFeatures2* features;
} AgiRequirements;

/* AGI_ERROR_UNSUPPORTED where the device cannot be used; the sentence says what it lacks. */
AGI_API AgiResult agiGetRequirements(VkInstance instance, VkPhysicalDevice device,
                                     PFN_vkGetInstanceProcAddr getInstanceProcAddr,
                                     AgiRequirements* requirements);

/* A piece of device memory that you give. `mapped` must be set where the library asks for host-visible
 * memory, which must be coherent; the piece begins at a multiple of 256 bytes. */
typedef struct AgiMemoryPiece {
    VkDeviceMemory memory;
    VkDeviceSize offset;
    void* mapped;
    void* owner; /* yours; handed back with the piece */
} AgiMemoryPiece;

typedef struct AgiContextInfo {
    size_t structSize;
    const void* next;
    VkInstance instance;
    VkPhysicalDevice physicalDevice;
    VkDevice device;
    uint32_t queueFamily; /* of the command buffers that agiRecord records into: graphics and compute */
    PFN_vkGetInstanceProcAddr getInstanceProcAddr;
    VkPipelineCache pipelineCache;               /* or null; must outlive the context */
    const VkAllocationCallbacks* hostAllocation; /* for Vulkan's objects; or null; must outlive the context */
    /* Device memory in pieces of 64 MiB and more; VK_SUCCESS or an error. Both null: vkAllocateMemory. */
    VkResult (*allocate)(void* user, VkDeviceSize bytes, uint32_t memoryType, VkBool32 hostVisible,
                         AgiMemoryPiece* piece);
    void (*release)(void* user, const AgiMemoryPiece* piece);
    void* user;
} AgiContextInfo;

AGI_API AgiResult agiCreateContext(const AgiContextInfo* info, AgiContext* context);
/* The device is done with all frames; views and scenes are destroyed before. Null is nothing. */
AGI_API void agiDestroyContext(AgiContext context);

typedef struct AgiMemory {
    size_t structSize;
    const void* next;
    uint64_t deviceBytes; /* in use */
    uint64_t blockBytes;  /* taken from the device or from your callback */
} AgiMemory;
AGI_API AgiResult agiGetMemory(AgiContext context, AgiMemory* memory);

/* ---- The scene ---- */

AGI_API AgiResult agiCreateScene(AgiContext context, AgiScene* scene);
/* At any time; views that used it may be recorded with another one. Null is nothing. */
AGI_API void agiDestroyScene(AgiScene scene);

typedef struct AgiMaterial {
    size_t structSize;
    const void* next;
    float albedo[3];        /* diffuse, linear; times albedoMap */
    float albedoMapMean[3]; /* mean colour of albedoMap, for bounces after the first; ignored without a map */
    VkImageView albedoMap;  /* or null; in SHADER_READ_ONLY_OPTIMAL whenever agiRecord's commands run */
    float alphaCutoff;      /* > 0: texels of albedoMap with less alpha are holes */
    float coverage;         /* then: the share of the surface that is no hole, 0 to 1 */
    uint32_t doubleSided;   /* else light that meets the back is absorbed */
    uint32_t reserved;      /* not read */
    /* Since 1.2: W/(m² sr) that it shines by itself, the mean of its map; from its front alone if it is not
     * doubleSided. */
    float emissive[3];
} AgiMaterial;

/* Ids are firstId, firstId + 1, ... */
AGI_API AgiResult agiAddMaterials(AgiScene scene, uint32_t count, const AgiMaterial* materials,
                                  uint32_t* firstId);
/* Cost: where one differs, points and trees are made anew as by a new instance (see agiSetInstances). A lamp
 * that flickers is better given as a light. */
AGI_API AgiResult agiUpdateMaterials(AgiScene scene, uint32_t firstId, uint32_t count,
                                     const AgiMaterial* materials);

/* Triangles. The buffers are yours (VERTEX_BUFFER and INDEX_BUFFER usage) and are read when reflective shadow
 * maps are drawn; null if you draw those (AgiFrame::drawRsmFace). What lies in host memory is the same data,
 * copied during the call, for points on the surfaces. */
typedef struct AgiMesh {
    size_t structSize;
    const void* next;
    VkBuffer vertexBuffer, indexBuffer;
    VkDeviceSize positionOffset, normalOffset, uvOffset; /* bytes: float[3], float[3], float[2] */
    VkDeviceSize indexOffset;                            /* bytes into indexBuffer */
    uint32_t positionStride, normalStride, uvStride;     /* bytes; 0 for uvStride: there are none */
    uint32_t vertexCount, indexCount;                    /* three indices a triangle */
    VkIndexType indexType;                               /* UINT16 or UINT32 */
    uint32_t material;
    uint32_t clockwise;    /* fronts are wound so; else counter-clockwise */
    const void* positions; /* host memory, with the same strides */
    const void* normals;
    const void* uvs; /* or null */
    const void* indices;
} AgiMesh;

AGI_API AgiResult agiAddMeshes(AgiScene scene, uint32_t count, const AgiMesh* meshes, uint32_t* firstId);
/* No instance may use them; their buffers may go once the frames recorded so far are done. */
AGI_API AgiResult agiRemoveMeshes(AgiScene scene, uint32_t firstId, uint32_t count);

typedef struct AgiInstance {
    size_t structSize;
    const void* next;
    uint64_t id; /* yours, of the thing from frame to frame */
    uint32_t mesh;
    uint32_t movable;   /* it will move; if others move, all that is kept of static ones is made anew */
    double position[3]; /* of the mesh's origin in the world, m */
    float linear[9];    /* columns: where the mesh's axes point */
} AgiInstance;

/* New ids are added, known ones moved. Cost: when an id or a mesh is new, points on all surfaces are chosen
 * anew by the next agiPrepare or agiRecord (some 100 ms for a large scene); a move costs a row of 64 bytes,
 * and 64 more of the tree over what is movable wherever rays are cast. Triangles are kept as trees for rays,
 * about 80 bytes each in host memory and in each view: of what is not movable one, of each mesh that movable
 * instances have another; built in the first frame and when such instances have come, gone or moved, or a
 * mesh became movable, and then rested for 16 frames, half a second for 250,000 triangles; until then shadow
 * maps are made from points, and no rays are cast but to the sky. */
AGI_API AgiResult agiSetInstances(AgiScene scene, uint32_t count, const AgiInstance* instances);
/* Ids that are not there are an error. */
AGI_API AgiResult agiRemoveInstances(AgiScene scene, uint32_t count, const uint64_t* ids);

typedef enum AgiLightKind {
    AGI_LIGHT_DIRECTIONAL = 0,
    AGI_LIGHT_POINT = 1,
    AGI_LIGHT_SPOT = 2,
    AGI_LIGHT_KIND_MAX = 0x7fffffff
} AgiLightKind;

#define AGI_MOST_LIGHTS 8 /* that bounce; the library looks at the first ones */

/* A light whose bounces are wanted. Its direct light is your business. */
typedef struct AgiLight {
    size_t structSize;
    const void* next;
    uint64_t id; /* yours, of the light from frame to frame */
    AgiLightKind kind;
    double position[3];
    float direction[3];           /* that the light travels in, unit */
    float intensity[3];           /* W/sr; directional: W/m² */
    float range;                  /* m, 0: no limit; as in KHR_lights_punctual */
    float innerAngle, outerAngle; /* of a spot, from its axis */
    float budgetShare;            /* weight of its share of the virtual lights beside its flux; usually 1 */
    uint32_t mapSize;             /* texels along its reflective shadow map's side, 32 to 1024; 0: 512 */
} AgiLight;

/* All of them, in the place of those before. */
AGI_API AgiResult agiSetLights(AgiScene scene, uint32_t count, const AgiLight* lights);

/* Light from everywhere where nothing stands, since 1.2: a picture of all directions, twice as wide as high
 * or a single texel. Rows go from the zenith (+Y) to the nadir, columns round from -X by -Z, +X and +Z. A sun
 * in it lights like a large one: give it as a directional light instead. */
typedef struct AgiSky {
    size_t structSize;
    const void* next;
    uint32_t width, height;
    const float* radiance; /* host memory, copied: 3 * width * height floats, W/(m² sr), 0 to 1e6 */
    /* Columns: where the picture's axes point in the world; all zero: as they are. */
    float worldFromPicture[9];
    uint32_t reserved; /* not read */
} AgiSky;

/* In the place of the one before; null: none. Its light is found by rays, one a pixel that light is gathered
 * at and frame, and is whole where it stands still for some hundred frames. */
AGI_API AgiResult agiSetSky(AgiScene scene, const AgiSky* sky);

/* A point whose irradiance you want to read. */
typedef struct AgiProbe {
    uint64_t id;
    double position[3];
    float normal[3]; /* unit; zero: the mean over all directions */
} AgiProbe;
typedef struct AgiReading {
    float direct[3];  /* W/m², of the lights that bounce */
    float bounced[3]; /* W/m², and of what is emissive; nothing straight from the sky */
} AgiReading;

/* All of them, at most 4096, in the place of those before. */
AGI_API AgiResult agiSetProbes(AgiScene scene, uint32_t count, const AgiProbe* probes);

/* ---- Views ---- */

typedef struct AgiViewInfo {
    size_t structSize;
    const void* next;
    uint32_t width, height; /* pixels of the G-buffer; AgiFrame may change them */
    const char* preset;     /* "low", "medium", "high", "ultra"; null: "medium" */
} AgiViewInfo;

AGI_API AgiResult agiCreateView(AgiContext context, const AgiViewInfo* info, AgiView* view);
/* At any time. Null is nothing. */
AGI_API void agiDestroyView(AgiView view);

typedef struct AgiOption {
    size_t structSize;
    const void* next;
    const char *name, *unit, *help; /* "val_clustering.count" */
    const char* value;              /* as it is now; valid until the next call about this view */
    double least, most;
} AgiOption;

/* Of a view, by number from 0; AGI_ERROR_ARGUMENT past the last one. */
AGI_API AgiResult agiGetOption(AgiView view, uint32_t index, AgiOption* option);
AGI_API AgiResult agiSetOption(AgiView view, const char* name, const char* value);

/* Makes what the first agiRecord of this scene in this view would else stop for: pipelines, points on
 * surfaces. */
AGI_API AgiResult agiPrepare(AgiView view, AgiScene scene);

typedef enum AgiNormalEncoding {
    AGI_NORMAL_XYZ_SIGNED = 0,   /* xyz, of a signed format */
    AGI_NORMAL_XYZ_UNSIGNED = 1, /* the same as 0.5 + 0.5 n, of an unsigned format */
    AGI_NORMAL_OCTAHEDRAL_SIGNED = 2,
    AGI_NORMAL_OCTAHEDRAL_UNSIGNED = 3,
    AGI_NORMAL_ENCODING_MAX = 0x7fffffff
} AgiNormalEncoding;

/* An image of yours, of the frame's size, one mip and layer. */
typedef struct AgiImage {
    VkImage image;
    VkImageView view; /* of depth: of the depth aspect alone */
    VkFormat format;
} AgiImage;

/* What a light sees through one square of the reflective shadow maps: one a spot or directional light, six a
 * point light. */
typedef struct AgiRsmFace {
    uint64_t light;          /* AgiLight::id */
    VkRect2D area;           /* of the attachments: viewport and scissor */
    double origin[3];        /* in the world: positions in clipFromLocal's space are relative to it, m */
    float clipFromLocal[16]; /* depth 1 at the light, 0 farthest */
} AgiRsmFace;

typedef struct AgiFrame {
    size_t structSize;
    const void* next;
    uint64_t frame;      /* number of the frame being recorded, not less than in any call before */
    uint64_t framesDone; /* the device is done with all frames up to this one */
    uint32_t width, height;

    double cameraPosition[3];
    float viewFromWorld[9]; /* rotation, columns; the camera looks along an axis of view space: see
                               clipFromView */
    float clipFromView[16]; /* a perspective of Vulkan's clip space, depth of either direction, far plane or
                               none */
    uint32_t depthReversed; /* 0 is farthest; else 1 is */

    /* G-buffer: in SHADER_READ_ONLY_OPTIMAL, written and visible to fragment and compute shaders; left so. */
    AgiImage depth;
    AgiImage normal; /* shading normal in world space */
    AgiNormalEncoding normalEncoding;
    /* For gloss; null images: none. Base colour as glTF has it (linear when sampled), and roughness and
     * metallic by the channels named, 0 to 3. */
    AgiImage baseColor, roughnessMetallic;
    uint32_t roughnessChannel, metallicChannel;

    /* Results: R16G16B16A16_SFLOAT with STORAGE usage, in GENERAL before and after. What they held is
     * overwritten. */
    /* W/m² on each pixel's surface: of the sky, of what is emissive, and of all bounces of these and the
     * lights. While nothing changes rays make it truer, for a thousand frames and more (AgiStatus::settled).
     */
    AgiImage irradiance;
    AgiImage gloss; /* W/(m² sr): what glossy materials reflect of the same light beyond that; or null */

    uint32_t cut;   /* the camera jumped: what was known of the pixels counts for nothing */
    uint32_t timed; /* passes are timed; with barriers round each, so that the frame takes longer */

    /* Instead of the library, which draws the scene's meshes from their buffers: draws into a face what is to
     * reflect the light. Called from agiRecord, on its thread, for every face of every light, within dynamic
     * rendering whose attachments are cleared to zero: color 0 R16G16B16A16_SFLOAT, the unit normal in world
     * space on the light's side, and 1; color 1 R16G16B16A16_SFLOAT, diffuse albedo, and 1; depth D32_SFLOAT,
     * test GREATER. It leaves rendering as it was. Null: the library draws. */
    void (*drawRsmFace)(void* user, VkCommandBuffer commands, const AgiRsmFace* face);
    void* drawRsmUser;
    uint64_t drawRsmVersion; /* change it when what you would draw changes. While it and all faces are as they
                                were, nothing is called; else every face is. */

    /* Since 1.2: what clipFromView is moved by for anti-aliasing, in clip space over w (pixel offsets times 2
     * / size). For bounced light a camera that differs in nothing else stands still; without it, one that
     * jitters never does. Of the sky's light the pixels that are gathered first are averaged on. */
    float jitter[2];
} AgiFrame;

/* Records the frame's indirect light into `commands`, which is in the recording state. After an error the
 * command buffer must not be submitted; record the frame again, with the same number, into another one.
 * Unless it was AGI_ERROR_ARGUMENT, all views of that frame start anew. Without any light, sky or emissive
 * material the results are black. */
AGI_API AgiResult agiRecord(AgiView view, AgiScene scene, VkCommandBuffer commands, const AgiFrame* frame);

/* ---- What happened ---- */

typedef struct AgiPass {
    const char* name;
    float milliseconds; /* on the device, of the last frame whose times arrived; 0 if not timed */
    uint32_t ran;
    const char* reason; /* why it ran, or why not */
} AgiPass;

/* Of the frame recorded last. `passes` null: only the count; else `count` is room before and number after. */
AGI_API AgiResult agiGetPasses(AgiView view, uint32_t* count, AgiPass* passes);

/* What probes of these ids read, two frames ago or more; ids that are not known yet read NaN. */
AGI_API AgiResult agiGetReadings(AgiView view, uint32_t count, const uint64_t* ids, AgiReading* readings);

typedef struct AgiStatus {
    size_t structSize;
    const void* next;
    uint32_t virtualLights; /* in the frame recorded last */
    float settled; /* 0 to 1: how far the light has settled since anything last changed: the mean of how far
                      the virtual lights have, rays to lights (not in preset low), and rays to the sky where
                      there is one */
} AgiStatus;
AGI_API AgiResult agiGetStatus(AgiView view, AgiStatus* status);

#ifdef __cplusplus
}
#endif
#endif
