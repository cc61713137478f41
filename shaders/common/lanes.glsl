// A workgroup of kLanes invocations that work on one thing, a tile or a light, and exchange values: as one subgroup, or
// where no subgroup has a size one can ask for, through shared memory. Sums are in the order of the lanes. All lanes
// call these together.
#ifndef AG_LANES_GLSL
#define AG_LANES_GLSL

#extension GL_KHR_shader_subgroup_basic : require
#extension GL_KHR_shader_subgroup_arithmetic : require
#extension GL_KHR_shader_subgroup_ballot : require
#extension GL_KHR_shader_subgroup_shuffle : require
#extension GL_EXT_control_flow_attributes : require

const uint kMostLanes = 64;
layout(constant_id = 102) const uint kLanes = 8;  // 4 to kMostLanes
layout(constant_id = 103) const bool kSharedLanes = false;
layout(constant_id = 104) const bool kOrderedSubgroups = true;  // subgroupAdd sums in the order of the lanes (CPU devices)
layout(local_size_x_id = 102) in;

shared uvec4 laneValues[kMostLanes];

uint laneIndex() { return kSharedLanes ? gl_LocalInvocationID.x : gl_SubgroupInvocationID; }

// What lanes wrote to shared memory before is there for all after.
void laneBarrier() {
    if (kSharedLanes) {
        barrier();
    } else {
        memoryBarrierShared();
        subgroupBarrier();
    }
}

void shareLane(uvec4 value) {
    barrier();
    laneValues[gl_LocalInvocationID.x] = value;
    barrier();
}

// Over the first `Count` lanes. Loops stay loops: unrolled for 32 lanes, a kernel of many sums takes a CPU's driver half a
// minute to compile.
#define AG_LANE_REDUCE(Name, Native, Count, T, Pack, Unpack, Op)                  \
    T Name(T value) {                                                             \
        if (!kSharedLanes) return Native(value);                                  \
        shareLane(Pack(value));                                                   \
        T all = Unpack(laneValues[0]);                                            \
        [[dont_unroll]] for (uint i = 1; i < (Count); ++i)                        \
            all = Op(all, Unpack(laneValues[i]));                                 \
        return all;                                                               \
    }
#define AG_LANE_FOLD(Name, Native, T, Pack, Unpack, Op) AG_LANE_REDUCE(Name, Native, kLanes, T, Pack, Unpack, Op)
#define AG_LANE_SCAN(Name, Native, T, Pack, Unpack, Op) AG_LANE_REDUCE(Name, Native, laneIndex() + 1, T, Pack, Unpack, Op)

// Sums of floats depend on their order.
#define AG_ORDERED_SUM(Name, Native, Count, T)                                     \
    T Name(T value) {                                                              \
        if (kOrderedSubgroups) return Native(value);                               \
        T all = subgroupShuffle(value, 0);                                         \
        [[dont_unroll]] for (uint i = 1; i < kLanes; ++i) {                        \
            T other = subgroupShuffle(value, i);                                   \
            if (i < (Count)) all += other;                                         \
        }                                                                          \
        return all;                                                                \
    }
AG_ORDERED_SUM(orderedAdd, subgroupAdd, kLanes, float)
AG_ORDERED_SUM(orderedAdd, subgroupAdd, kLanes, vec2)
AG_ORDERED_SUM(orderedAdd, subgroupAdd, kLanes, vec3)
AG_ORDERED_SUM(orderedAdd, subgroupAdd, kLanes, vec4)
AG_ORDERED_SUM(orderedInclusiveAdd, subgroupInclusiveAdd, laneIndex() + 1, float)

#define AG_LANE_SHUFFLE(T, Pack, Unpack)                                          \
    T laneShuffle(T value, uint lane) {                                           \
        if (!kSharedLanes) return subgroupShuffle(value, lane);                   \
        shareLane(Pack(value));                                                   \
        return Unpack(laneValues[lane]);                                          \
    }

uvec4 packFloat(float v) { return uvec4(floatBitsToUint(v), 0, 0, 0); }
uvec4 packVec2(vec2 v) { return uvec4(floatBitsToUint(v), 0, 0); }
uvec4 packVec3(vec3 v) { return uvec4(floatBitsToUint(v), 0); }
uvec4 packVec4(vec4 v) { return floatBitsToUint(v); }
uvec4 packUint(uint v) { return uvec4(v, 0, 0, 0); }
uvec4 packBool(bool v) { return uvec4(v, 0, 0, 0); }
float unpackFloat(uvec4 v) { return uintBitsToFloat(v.x); }
vec2 unpackVec2(uvec4 v) { return uintBitsToFloat(v.xy); }
vec3 unpackVec3(uvec4 v) { return uintBitsToFloat(v.xyz); }
vec4 unpackVec4(uvec4 v) { return uintBitsToFloat(v); }
uint unpackUint(uvec4 v) { return v.x; }
bool unpackBool(uvec4 v) { return v.x != 0; }
#define AG_PLUS(a, b) (a + b)
#define AG_OR(a, b) (a | b)

AG_LANE_FOLD(laneAdd, orderedAdd, float, packFloat, unpackFloat, AG_PLUS)
AG_LANE_FOLD(laneAdd, orderedAdd, vec2, packVec2, unpackVec2, AG_PLUS)
AG_LANE_FOLD(laneAdd, orderedAdd, vec3, packVec3, unpackVec3, AG_PLUS)
AG_LANE_FOLD(laneAdd, orderedAdd, vec4, packVec4, unpackVec4, AG_PLUS)
AG_LANE_FOLD(laneMin, subgroupMin, float, packFloat, unpackFloat, min)
AG_LANE_FOLD(laneMin, subgroupMin, vec3, packVec3, unpackVec3, min)
AG_LANE_FOLD(laneMin, subgroupMin, uint, packUint, unpackUint, min)
AG_LANE_FOLD(laneMax, subgroupMax, float, packFloat, unpackFloat, max)
AG_LANE_FOLD(laneMax, subgroupMax, vec3, packVec3, unpackVec3, max)
AG_LANE_FOLD(laneMax, subgroupMax, uint, packUint, unpackUint, max)
AG_LANE_FOLD(laneOr, subgroupOr, uint, packUint, unpackUint, AG_OR)
AG_LANE_SCAN(laneInclusiveAdd, orderedInclusiveAdd, float, packFloat, unpackFloat, AG_PLUS)
AG_LANE_SCAN(laneInclusiveMax, subgroupInclusiveMax, uint, packUint, unpackUint, max)
AG_LANE_SHUFFLE(bool, packBool, unpackBool)
AG_LANE_SHUFFLE(uint, packUint, unpackUint)
AG_LANE_SHUFFLE(vec3, packVec3, unpackVec3)

uint laneExclusiveMax(uint value) {
    if (!kSharedLanes) return subgroupExclusiveMax(value);
    shareLane(packUint(value));
    uint all = 0;
    [[dont_unroll]] for (uint i = 0; i < laneIndex(); ++i) all = max(all, laneValues[i].x);
    return all;
}

uint laneBroadcastFirst(uint value) { return kSharedLanes ? laneShuffle(value, 0) : subgroupBroadcastFirst(value); }

// Of the lanes that say yes: how many there are, and how many before this one.
struct LaneVote {
    uint count, before;
};

LaneVote laneVote(bool yes) {
    if (!kSharedLanes) {
        uvec4 ballot = subgroupBallot(yes);
        return LaneVote(subgroupBallotBitCount(ballot), subgroupBallotExclusiveBitCount(ballot));
    }
    shareLane(packBool(yes));
    LaneVote vote = LaneVote(0, 0);
    [[dont_unroll]] for (uint i = 0; i < kLanes; ++i) {
        vote.before = i == laneIndex() ? vote.count : vote.before;
        vote.count += laneValues[i].x;
    }
    return vote;
}
#endif
