#version 460
// A counter that remembers: what stood there a step ago, plus one.
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) readonly buffer Previous { uint items[]; } previous;
layout(set = 0, binding = 1) writeonly buffer Current { uint items[]; } current;

void main() { current.items[gl_GlobalInvocationID.x] = previous.items[gl_GlobalInvocationID.x] + 1; }
