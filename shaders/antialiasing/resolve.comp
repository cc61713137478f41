#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
// Temporal anti-aliasing and upscaling: the mean of a pixel's samples over frames, each weighted by its distance. What the
// frame before knew is looked up where the surface was then, and kept within the colours about unless nothing changed. While
// the jitter rests, a pixel follows the change of its own samples, so what it converged to is not lost.
#include "antialiasing/antialiasing_io.h"
#include "common/pixel_rays.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(set = 0, binding = 0) uniform sampler2D radianceMap;
layout(set = 0, binding = 1) uniform sampler2D depthMap;
layout(set = 0, binding = 2) uniform sampler2D motionMap;  // m to where the surface was; read only if kMotion
layout(set = 0, binding = 3) uniform sampler2D previousPicture;
layout(set = 0, binding = 4) uniform sampler2D previousSamples;
layout(set = 0, binding = 5, scalar) uniform Cameras { ReprojectionCameras c; } cameras;  // of the output, without jitter
layout(set = 0, binding = 6, rgba16f) uniform writeonly image2D picture;  // a: that of the sample nearest
// rgb: of this frame alone; a: samples the picture stands for, negative where something moves.
layout(set = 0, binding = 7, rgba16f) uniform writeonly image2D samples;
layout(constant_id = 0) const bool kMotion = false;
layout(push_constant, scalar) uniform Push { ResolvePush push; };

struct Neighbours {
    vec3 sum, low, high;
    float weight, alpha;
    ivec2 front;  // nearest to the camera
    bool moves;
};

Neighbours gather(vec2 place, vec2 scale, ivec2 size) {
    ivec2 centre = clamp(ivec2(floor(place - push.jitter)), ivec2(0), size - 1);
    Neighbours n = Neighbours(vec3(0.0), vec3(kMostHalf), vec3(0.0), 0.0, 0.0, centre, false);
    float closest = 0.0;
    [[unroll]] for (int y = -1; y <= 1; ++y)
        [[unroll]] for (int x = -1; x <= 1; ++x) {
            ivec2 at = clamp(centre + ivec2(x, y), ivec2(0), size - 1);
            vec4 c = min(texelFetch(radianceMap, at, 0), vec4(kMostHalf));
            vec2 off = (vec2(centre + ivec2(x, y)) + 0.5 + push.jitter - place) / scale;
            float weight = filterWeight(off.x) * filterWeight(off.y);
            n.sum += weight * c.rgb;
            n.weight += weight;
            n.low = min(n.low, c.rgb);
            n.high = max(n.high, c.rgb);
            if (x == 0 && y == 0) n.alpha = c.a;
            float depth = texelFetch(depthMap, at, 0).x;
            if (depth > closest) n.front = at;
            closest = max(closest, depth);
            if (kMotion) n.moves = n.moves || texelFetch(motionMap, at, 0).w > 0.0;
        }
    return n;
}

// Pixels: what is nearer to one's centre is there, or divisions that are a bit off would move the picture on in every frame.
const float kRounding = 1.0 / 512.0;

// Where what is seen in the pixel was seen in the frame before, in pixels of the output; far off: nowhere.
vec2 placeBefore(ivec2 pixel, ivec2 front, vec2 size) {
    ReprojectionCameras c = cameras.c;
    float reversed = texelFetch(depthMap, front, 0).x;
    vec3 toward = placeOf(c.now, vec2(pixel), 1.0);
    vec3 motion = kMotion ? texelFetch(motionMap, front, 0).xyz : vec3(0.0);
    vec4 place = reversed > 0.0 ? vec4(c.now.eye + toward * (push.near / reversed) + motion, 1.0) : vec4(toward, 0.0);
    vec4 clip = c.previousClipFromWorld * place;
    vec2 at = clip.w > 0.0 ? (clip.xy / clip.w * 0.5 + 0.5) * size - 0.5 : vec2(-1e4), middle = floor(at + 0.5);
    return mix(at, middle, lessThan(abs(at - middle), vec2(kRounding)));
}

// Catmull-Rom through linear taps; those of the corners count for less than a hundredth and are left out.
vec3 previousAt(vec2 at, vec2 size) {
    vec2 base = floor(at), f = at - base;
    vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w3 = f * f * (-0.5 + 0.5 * f);
    vec2 w1 = 1.0 + f * f * (-2.5 + 1.5 * f), middle = 1.0 - w0 - w3, between = (middle - w1) / middle;
    vec2 low = (base - 0.5) / size, mid = (base + 0.5 + between) / size, high = (base + 2.5) / size;
    vec4 sum = vec4(textureLod(previousPicture, mid, 0.0).rgb, 1.0) * (middle.x * middle.y);
    sum += vec4(textureLod(previousPicture, vec2(low.x, mid.y), 0.0).rgb, 1.0) * (w0.x * middle.y);
    sum += vec4(textureLod(previousPicture, vec2(high.x, mid.y), 0.0).rgb, 1.0) * (w3.x * middle.y);
    sum += vec4(textureLod(previousPicture, vec2(mid.x, low.y), 0.0).rgb, 1.0) * (middle.x * w0.y);
    sum += vec4(textureLod(previousPicture, vec2(mid.x, high.y), 0.0).rgb, 1.0) * (middle.x * w3.y);
    return sum.rgb / sum.a;
}

// As it comes back from the image, so that what stays the same differs by nothing.
vec3 roundedToHalf(vec3 v) {
    v = min(v, vec3(kMostHalf));
    return vec3(unpackHalf2x16(packHalf2x16(v.rg)), unpackHalf2x16(packHalf2x16(v.bb)).x);
}

void main() {
    ivec2 whole = imageSize(picture), pixel = min(ivec2(gl_GlobalInvocationID.xy), whole - 1);
    ivec2 size = textureSize(radianceMap, 0);
    vec2 scale = vec2(size) / vec2(whole);
    Neighbours n = gather((vec2(pixel) + 0.5) * scale, scale, size);
    vec3 now = roundedToHalf(n.sum / max(n.weight, 1e-6));

    bool elsewhere = push.sameView == 0 || n.moves;
    vec2 at = elsewhere ? placeBefore(pixel, n.front, vec2(whole)) : vec2(pixel);
    ivec2 nearest = ivec2(floor(at + 0.5));
    bool known = push.most > 0.0 && all(greaterThanEqual(nearest, ivec2(0))) && all(lessThan(nearest, whole));
    nearest = clamp(nearest, ivec2(0), whole - 1);
    vec4 before = texelFetch(previousSamples, nearest, 0);
    vec3 past = elsewhere ? previousAt(at, vec2(whole)) : texelFetch(previousPicture, pixel, 0).rgb;
    float count = known ? abs(before.a) : 0.0;

    bool follows = push.rests != 0 && known && !elsewhere && before.a > 0.0;
    if (push.stands == 0) past = clamp(past, n.low, n.high);
    count = min(count, push.most);
    vec3 result = count > 0.0 ? (past * count + n.sum) / (count + n.weight) : now;
    if (follows) {
        vec3 kept = texelFetch(previousPicture, pixel, 0).rgb;
        result = now == before.rgb ? kept : clamp(kept + (now - before.rgb), n.low, n.high);
    }
    float stands = follows ? before.a : count + n.weight;

    if (any(greaterThanEqual(ivec2(gl_GlobalInvocationID.xy), whole))) return;
    imageStore(picture, pixel, vec4(result, n.alpha));
    imageStore(samples, pixel, vec4(now, n.moves ? -stands : stands));
}
