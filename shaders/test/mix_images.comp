#version 460
// Two images into one, so that every input and its order shows in the result.
layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant) uniform Push { float value; } push;
layout(set = 0, binding = 0) uniform sampler2D first;
layout(set = 0, binding = 1) uniform sampler2D second;
layout(set = 0, binding = 2, rgba32f) writeonly uniform image2D result;

void main() {
    ivec2 p = ivec2(gl_GlobalInvocationID.xy);
    vec4 a = texelFetch(first, p, 0), b = texelFetch(second, p, 0);
    imageStore(result, p, fract(a * 0.7 + b * 0.21 + vec4(push.value, vec2(p) * 0.01, 1.0)));
}
