// What moved, where gbuffer/fill.vert put it, and the way back to where it was a frame ago.
#define AG_SCENE_INSTANCES
#define AG_SCENE_DRAWS
#include "common/texels.glsl"
#include "scene/scene.glsl"
#ifdef AG_SKINNED
#include "skinning/skin.glsl"

layout(set = 0, binding = 2) VEC4_TEXELS(previousJoints);
layout(set = 0, binding = 3, scalar) readonly buffer SkinnedMeshes { SkinRow items[]; } skinnedMeshes;
layout(set = 0, binding = 4, scalar) readonly buffer Skin { SkinnedVertex items[]; } skin;
layout(set = 0, binding = 5, scalar) readonly buffer Positions { vec3 items[]; } modelled;

// Where the skinned mesh's vertex was a frame ago, in its frame.
vec3 bentBefore(uint skinnedMesh) {
    SkinRow f = skinnedMeshes.items[skinnedMesh];
    uint vertex = uint(gl_VertexIndex) - f.firstDeformed + f.firstVertex;
    SkinnedVertex s = skin.items[vertex];
    return skinPoint(AG_SKIN(previousJoints, f.firstJoint, s), modelled.items[vertex]);
}
#endif

layout(set = 0, binding = 1) VEC4_TEXELS(previousInstances);
layout(push_constant, scalar) uniform Push { mat4 clipFromWorld; } push;

layout(location = 0) in vec3 position;
invariant gl_Position;
layout(location = 0) out vec3 outMotion;  // m

void main() {
    int instance = drawnInstance();
    InstanceTransform t = fetchInstance(instance);
    vec3 now = transformPoint(t, position);
    vec4 p = vec4(position, 1.0);
#ifdef AG_SKINNED
    if (t.skinnedMesh != kNoSkinnedMesh) p.xyz = bentBefore(t.skinnedMesh);
#endif
    vec3 before = vec3(dot(fetchTexel(previousInstances, instance * 4 + 0), p),
                       dot(fetchTexel(previousInstances, instance * 4 + 1), p),
                       dot(fetchTexel(previousInstances, instance * 4 + 2), p));
    outMotion = before - now;
    gl_Position = push.clipFromWorld * vec4(now, 1.0);
}
