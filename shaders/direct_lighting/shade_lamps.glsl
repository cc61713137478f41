// Irradiance straight from a tile's lamps. They come sorted by cluster, so that each cluster's visibility is found once a
// pixel for all of its lamps.
#include "common/lights.h"
#include "direct_lighting/direct_lighting_io.h"
#include "gbuffer/gbuffer.glsl"

layout(local_size_x = 16, local_size_y = 16) in;  // one tile

layout(constant_id = 0) const bool kFirst = true;  // starts from zero instead of adding
layout(set = 0, binding = 0) uniform sampler2D normalMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2, scalar) readonly buffer Camera { CameraConstants camera; } camera;
layout(set = 0, binding = 3) uniform samplerBuffer lamps;
layout(set = 0, binding = 7) uniform usamplerBuffer lists;
layout(set = 0, binding = 8, scalar) readonly buffer Counts { uint items[]; } counts;
layout(set = 0, binding = 9, rgba16f) uniform image2D irradiance;
#ifdef AG_SHADOW
layout(set = 0, binding = 4) uniform samplerBuffer clusters;
layout(set = 0, binding = 6) uniform sampler2D shadowAtlas;
#include "direct_lighting/lamp_shadow.glsl"
#endif

Lamp fetchLamp(uint entry) {
    int at = int(texelFetch(lists, int(entry)).x) * 4;
    vec4 a = texelFetch(lamps, at), b = texelFetch(lamps, at + 1), c = texelFetch(lamps, at + 2);
    Lamp lamp;
    lamp.position = a.xyz;
    lamp.range = a.w;
    lamp.intensity = b.xyz;
    lamp.cluster = floatBitsToUint(b.w);
    lamp.direction = c.xyz;
    lamp.cosInner = c.w;
    lamp.cosOuter = texelFetch(lamps, at + 3).x;
    return lamp;
}

vec3 irradianceFrom(Lamp lamp, vec3 position, vec3 normal) {
    vec3 d = lamp.position - position;
    float distance_ = max(length(d), 1e-4);
    vec3 toLight = d / distance_;
    float cone = lamp.cosOuter < -1.5 ? 1.0 : spotFalloff(-dot(toLight, lamp.direction), lamp.cosInner, lamp.cosOuter);
    return lamp.intensity * (max(dot(normal, toLight), 0.0) * cone * rangeWindow(distance_, lamp.range) /
                             (distance_ * distance_));
}

void main() {
    uvec2 size = camera.camera.size;
    ivec2 pixel = min(ivec2(gl_GlobalInvocationID.xy), ivec2(size) - 1);
    uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 position = worldFromPixel(camera.camera.worldFromClip, size, pixel, depth);
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz;
    vec3 e = vec3(0.0);
    uint first = tile * kMaxLampsPerTile, end = first + counts.items[tile];
    for (uint i = first; i < end;) {
        uint cluster = fetchLamp(i).cluster;
        vec3 sum = vec3(0.0);
        for (; i < end; ++i) {
            Lamp lamp = fetchLamp(i);
            if (lamp.cluster != cluster) break;
            sum += irradianceFrom(lamp, position, normal);
        }
#ifdef AG_SHADOW
        bool shadowed = cluster != kNoLampCluster;
        float share = clusterShare(shadowed ? cluster : 0u, position, normal);
        sum *= shadowed ? share : 1.0;
#endif
        e += sum;
    }
    if (depth <= 0.0) e = vec3(0.0);
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, size))) return;
    if (!kFirst) e += imageLoad(irradiance, pixel).rgb;
    imageStore(irradiance, pixel, vec4(e, 1.0));
}
