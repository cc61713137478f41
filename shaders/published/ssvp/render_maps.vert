#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Triangles on a cluster's paraboloid (Heidrich & Seidel 1998): bent at their corners, straight between, as in SSVP.
#define AG_SCENE_INSTANCES
#define AG_SCENE_DRAWS
#include "scene/scene.glsl"
#include "common/sampling.h"
#include "published/ssvp/ssvp_io.h"

layout(push_constant, scalar) uniform Push { uint cluster; float farDistance; } push;
layout(set = 0, binding = 10, scalar) readonly buffer Clusters { SsvpCluster items[]; } clusters;

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv;
layout(location = 4) in vec4 color;

layout(location = 0) out vec3 outPosition;
layout(location = 1) out vec3 outNormal;
layout(location = 2) out vec2 outUv;
layout(location = 3) flat out uint outMaterial;
layout(location = 4) out vec3 outFromCluster;  // m, in its frame
layout(location = 5) out vec3 outColor;

const float kLeastDenominator = 0.1;  // behind the cluster, far outside the disk

void main() {
    InstanceTransform t = fetchInstance(drawnInstance());
    SsvpCluster cluster = clusters.items[push.cluster];
    outPosition = transformPoint(t, position);
    outNormal = transformNormal(t, normal);
    outUv = uv;
    outMaterial = t.material;
    outColor = color.rgb;
    vec3 d = outPosition - cluster.position, x, y;
    orthonormalBasis(cluster.normal, x, y);
    outFromCluster = vec3(dot(d, x), dot(d, y), dot(d, cluster.normal));
    float distance_ = length(d);
    vec2 bent = outFromCluster.xy / max(distance_ + outFromCluster.z, kLeastDenominator * max(distance_, 1e-6));
    // A cluster without light shows nothing.
    float depth = cluster.vplCount > 0 ? 1.0 - distance_ / push.farDistance : -1.0;
    gl_Position = vec4(bent, depth, 1.0);
}
