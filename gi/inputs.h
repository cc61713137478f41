// What indirect light is made from, as a host hands it over each frame: buffers and images, lights, and what
// moved.
#pragma once

#include <span>

#include "engine/core/bounds.h"
#include "engine/core/light_kind.h"
#include "engine/core/render_camera.h"
#include "engine/core/render_probe.h"
#include "engine/frame/frame_graph.h"

namespace ag::gi {

// What the camera sees, pixel by pixel.
struct Surfaces {
    ImageHandle depth;   // reversed, 0: no surface
    ImageHandle normal;  // rgba16f: unit normal; roughness
    ImageHandle albedo;  // rgba16f: diffuse albedo; metallic
    ImageHandle
        reflectance;     // rgba16f: specular, head on; at grazing angles; invalid when no material is glossy
    ImageHandle motion;  // rgba16f: m to where the surface was a frame ago; invalid when nothing moved
    glm::uvec2 size{0};
    bool normalMapped = false;  // normals of a surface differ from pixel to pixel
    uint32_t spacing = 1;       // of the camera's pixels from one of these to the next
    glm::uvec2 place{0};        // of these in squares of so many
    RenderCamera view;          // of these pixels
    BufferHandle camera;        // the same as io::CameraConstants
};

// A light whose reflective shadow map is drawn: its first bounce and all that follow are indirect light.
struct RsmLight {
    LightKind kind = LightKind::kPoint;
    glm::vec3 position{0};          // m
    glm::vec3 direction{0, -1, 0};  // the way the light travels, unit
    glm::vec3 intensity{1};         // W/sr; directional: W/m² on a plane facing the light
    float range = 0;                // m, 0: no limit
    float innerConeAngle = 0;       // radians from the axis
    float outerConeAngle = 0.785398f;
    uint32_t resolution = 512;  // texels of a square map, or of about as many on six faces
    float budgetShare = 1;      // weight of its share of the cluster budget, times its flux
    uint64_t id = 0;            // stable identity, for carrying clusters over

    bool operator==(const RsmLight&) const = default;
};

// Occluders as trees for rays (shaders/bvh/bvh_io.h); see OccluderTrees.
struct TracedOccluders {
    BufferHandle nodes, triangles;  // texel buffer of uvec4; io::BvhTriangle
    BufferHandle masks;             // io::BvhMask of each triangle; invalid: none is masked
    // Texel buffers of uvec4 of this frame: io::BvhPlace; nodes over what moves, invalid where that is left
    // out.
    BufferHandle places, moverNodes;
    uint64_t staticVersion = 0;  // changes with what is static in them and with where that stands
    float snapping = 1.0f / 16;  // pixels, of the corners that a rasteriser draws between
    // They are of what was static some frames ago: good for rays whose light must not go out meanwhile.
    bool stale = false;
    explicit operator bool() const { return nodes && !stale; }
};

// Points on surfaces, carried by their instances: what visibility is made from, and where light bounces on.
struct Occluders {
    BufferHandle instances;          // io::Instance rows
    BufferHandle samples;            // io::SurfaceSample; also a texel buffer of vec4
    BufferHandle pointAreas;         // m² that a sample of each instance stands for: a texel buffer of float
    uint32_t sampleCount = 0;        // 0: no surface
    uint32_t staticSampleCount = 0;  // the first ones are on what is static
    // io::BouncePoint: some of the samples, to reflect light, then some on emissive surfaces, to shine; the
    // number of each is a square of a power of two, or 0.
    BufferHandle bouncePoints;
    uint32_t bouncePointCount = 0, emissivePointCount = 0;
    float emissiveFlux = 0;  // W, mean of the channels: of the points that shine
    // m² that a point of either kind stands for in the mean; 0: not known.
    float bouncePointArea = 0, emissivePointArea = 0;
    // Vertices of instances that joints bend, as they are now; none: there are no such.
    BufferHandle deformedPositions, deformedAttributes;
    TracedOccluders trees;       // none: no rays
    uint64_t staticVersion = 0;  // changes when an instance that is not movable may have moved
    float extent = 0;            // m: no two points are farther apart
    float rayOffset = 0;         // see rayOffset()
};

// Numbers that are equal as long as what they stand for is.
struct Versions {
    uint64_t scene = 0;      // of what was loaded, unlike any before
    uint64_t instances = 1;  // where anything stands
    uint64_t lights = 1, camera = 1;
    uint64_t view = 1;    // of the camera, wherever in its pixels it samples
    uint64_t origin = 1;  // of coordinates: histories in world space end when it moves
};

// A ball round something that moved since the frame before.
struct MovedThing {
    uint32_t id = 0;  // of the thing, from frame to frame
    glm::vec3 centre{0};
    float radius = 0;  // m
};
constexpr uint32_t kMostMovedThings = 64;  // more are not small, and not looked at one by one

struct World {
    std::span<const RsmLight> lights;  // those beyond io::kMaxBounceLights are left out
    // Of more lights what bounces is looked for at points of surfaces, with later bounces alone.
    std::span<const RsmLight> otherLights;
    Bounds bounds;  // of all surfaces
    Versions versions;
    // What moved, if that is all that changed and no more than kMostMovedThings; else empty.
    std::span<const MovedThing> moved;
    float extent = 0;  // m, of the bounds; steady while things move at their edge
};

}  // namespace ag::gi
