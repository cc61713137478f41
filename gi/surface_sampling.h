// Choosing points on surfaces: a pure function of triangles and where they stand.
#pragma once

#include <span>
#include <vector>

#include "engine/core/bounds.h"
#include "engine/core/function_ref.h"
#include "gi/strided.h"
#include "shaders/surface_points/surface_points_io.h"

namespace ag::gi {

// Triangles as they were modelled.
struct SampledMesh {
    Strided<glm::vec3> positions, normals;
    Strided<glm::vec2> uvs;             // none: zero
    Strided<uint32_t> colors;           // A2B10G10R10, linear; none: white
    std::span<const uint32_t> indices;  // three a triangle
    bool blocksLight = true;            // others have no points
    bool doubleSided = false;           // else its back reflects nothing
};

struct SampledInstance {
    glm::mat4x3 worldFromLocal{1};
    uint32_t mesh = 0;
    bool movable = false;
    bool isPresent = true;  // else it has no surface
    // Of an instance that is bent by joints: its vertices as they are now, and where its mesh's index 0 lies
    // among the device's deformed ones.
    Strided<glm::vec3> deformed;
    uint32_t firstDeformed = 0;
};

struct SampledScene {
    std::span<const SampledMesh> meshes;
    std::span<const SampledInstance> instances;
    Bounds bounds;  // of all instances
    FunctionRef<bool(uint32_t mesh, glm::vec2 uv)>
        isCutOut;  // an alpha-masked surface, at a place of its texture
};

struct SurfaceSamples {
    // Along two curves: neighbours in the list are neighbours in space. First those of all that is static,
    // whole segments of kSegmentPoints, then those of movable instances.
    std::vector<io::SurfaceSample> samples;
    std::vector<glm::vec2> uvs;    // of the vertices, parallel to the samples
    std::vector<glm::vec3> tints;  // the vertices' colours there, likewise
    uint32_t staticCount = 0;
    std::vector<float> pointAreas;  // m², one side: what a point of each of the scene's instances stands for
};

// About `count` points along curves through all surfaces that block light, so that every n-th of any stretch
// is spread evenly over it: at equal steps of area, but no instance is stood for by fewer than 24 as long as
// a quarter of the points suffices for that. The same scene gives the same points.
SurfaceSamples sampleSurfaces(const SampledScene& scene, uint32_t count);

}  // namespace ag::gi
