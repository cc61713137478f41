// Irradiance straight from a tile's lamps. They come sorted by cluster, so that each cluster's visibility is found once a
// pixel for all of its lamps. AG_QUADS: for one pixel in each 2 x 2, and beside it what arrived if nothing cast shadows.
#include "gbuffer/gbuffer.glsl"

layout(constant_id = 0) const bool kFirst = true;  // starts from zero instead of adding
layout(constant_id = 2) const float kShadowReach = 0.0;
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 3) uniform samplerBuffer lamps;
layout(set = 0, binding = 7) uniform usamplerBuffer lists;
#include "direct_lighting/lamp.glsl"
layout(set = 0, binding = 2, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 8, scalar) readonly buffer Counts { uint items[]; } counts;
#ifdef AG_QUADS
const uint kStep = 2;
layout(local_size_x = 8, local_size_y = 8) in;  // one tile
layout(set = 0, binding = 9, rgba16f) uniform writeonly image2D shadowed;
layout(set = 0, binding = 10, rgba16f) uniform writeonly image2D unshadowed;
#else
const uint kStep = 1;
layout(local_size_x = 16, local_size_y = 16) in;
layout(set = 0, binding = 9, rgba16f) uniform image2D irradiance;
#endif
#ifdef AG_SHADOW
layout(set = 0, binding = 4) uniform samplerBuffer clusters;
layout(set = 0, binding = 6) uniform sampler2D shadowAtlas;
#include "direct_lighting/lamp_shadow.glsl"
#endif

void main() {
    uvec2 size = camera.camera.size;
    ivec2 pixel = min(ivec2(gl_GlobalInvocationID.xy * kStep), ivec2(size) - 1);
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 e = vec3(0.0), all = vec3(0.0);
    uint first = tile * kMaxLampsPerTile, end = first + counts.items[tile];
    for (uint i = first; i < end;) {
        uint cluster = lampAt(texelFetch(lists, int(i)).x).cluster;
        float share = 1.0;
#ifdef AG_SHADOW
        bool casts = cluster != kNoLampCluster;
        share = clusterShare(casts ? cluster : 0u, position, normal);
        share = casts ? share : 1.0;
#endif
        for (; i < end; ++i) {
            Lamp lamp = lampAt(texelFetch(lists, int(i)).x);
            if (lamp.cluster != cluster) break;
            float distance2;
            vec3 from = irradianceFrom(lamp, position, normal, distance2);
            all += from;
            e += (1.0 - (1.0 - share) * shadowWeight(lamp, distance2, kShadowReach)) * from;
        }
    }
    if (depth <= 0.0) e = all = vec3(0.0);
#ifdef AG_QUADS
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy * kStep, size))) return;
    imageStore(shadowed, ivec2(gl_GlobalInvocationID.xy), vec4(e, 1.0));
    imageStore(unshadowed, ivec2(gl_GlobalInvocationID.xy), vec4(all, 1.0));
#else
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    if (!kFirst) e += imageLoad(irradiance, pixel).rgb;
    imageStore(irradiance, pixel, vec4(e, 1.0));
#endif
}
