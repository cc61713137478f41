// Importance of a block of RSM texels: its flux against what an unobstructed white surface would reflect
// (rho_f), and how much of the view it faces (rho_v, cosine form of ACRSM). A small share for every lit block makes
// seeding uniform over lit texels when all else is zero.
#include "common/lane_loop.glsl"
#include "common/texels.glsl"
#include "importance/pyramid.glsl"
#include "rsm/rsm.glsl"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ImportanceSettings settings; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(texels);
layout(set = 0, binding = 1, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 2, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 3, scalar) writeonly buffer Pyramid { float items[]; } pyramid;
#ifdef AG_VIEW_TERM
layout(set = 0, binding = 4) VEC4_TEXELS(viewPoints);
#endif

struct BlockSum {
    float weight, litCount;
    vec3 position, normal;  // of the brightest texel
};

BlockSum sumBlock(uvec2 origin, uint side) {
    BlockSum sum = BlockSum(0.0, 0.0, vec3(0.0), vec3(0.0, 1.0, 0.0));
    float brightest = 0.0;
    for (uint i = 0; i < side * side; ++i) {
        uvec2 coord = origin + uvec2(i % side, i / side);
        RsmSurface s = AG_RSM_FETCH(texels, rsmIndexOfCoord(coord, push.settings.atlasSize.x));
        sum.weight += s.weight;
        sum.litCount += s.weight > 0.0 ? 1.0 : 0.0;
        if (s.weight > brightest) {
            brightest = s.weight;
            sum.position = s.position;
            sum.normal = s.normal;
        }
    }
    return sum;
}

// Flux of a white texel on the light's axis, W (mean channel).
float fullWeight(RsmMap map, uint faceSize) {
    float texel = 2.0 * map.tanHalf / float(faceSize);
    return max((map.intensity.x + map.intensity.y + map.intensity.z) / 3.0 * texel * texel, 1e-30);
}

#ifdef AG_VIEW_TERM
float facingTerm(vec4 a, vec3 n, vec3 position, vec3 normal) {
    vec3 d = a.xyz - position;
    d *= inversesqrt(max(dot(d, d), 1e-12));
    return a.w * max(dot(d, normal), 0.0) * max(-dot(d, n), 0.0);
}

float viewTerm(vec3 position, vec3 normal) {
    float sum = 0.0;
    if (kLaneParallel) {
        for (uint base = 0; base < kSeedingViewPoints; base += kSubgroupSize) {
            int mine = int(base + gl_SubgroupInvocationID) * 2;
            vec4 a = fetchTexel(viewPoints, mine);
            vec3 n = fetchTexel(viewPoints, mine + 1).xyz;
            [[unroll]] for (uint lane = 0; lane < kSubgroupSize; ++lane)
                sum += facingTerm(subgroupShuffle(a, lane), subgroupShuffle(n, lane), position, normal);
        }
    } else {
        for (uint i = 0; i < kSeedingViewPoints; ++i)
            sum += facingTerm(fetchTexel(viewPoints, int(i) * 2), fetchTexel(viewPoints, int(i) * 2 + 1).xyz,
                              position, normal);
    }
    return sum / float(kSeedingViewPoints);
}
#endif

void main() {
    // Every lane stays alive for the shuffles: those past a face's blocks work on its last one and store nothing.
    uint faceIndex = gl_WorkGroupID.y;
    RsmFace face = faces.items[faceIndex];
    uint side = blockSide(face.size), along = blocksAlong(face.size), blocks = along * along;
    uint code = min(gl_GlobalInvocationID.x, blocks - 1);
    BlockSum block = sumBlock(face.origin + cellFromMorton(code) * side, side);
    float texelCount = float(side * side);
    float importance = block.weight / texelCount / fullWeight(maps.items[face.map], face.size);
#ifdef AG_VIEW_TERM
    importance = mix(importance, viewTerm(block.position, block.normal), push.settings.viewWeight);
#endif
    float litShare = block.litCount / texelCount;
    importance = litShare > 0.0 ? max(importance, 0.0) + 1e-4 * litShare : 0.0;
    if (gl_GlobalInvocationID.x < blocks)
        pyramid.items[faceIndex * push.settings.pyramidStride + code] = importance;
}
