#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// A ball round the points of each segment of the curve: about the middle of their box.
#include "common/texels.glsl"
#include "surface_points/surface_points_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { PointPush p; } push;

layout(set = 0, binding = 0) VEC4_TEXELS(points);
layout(set = 0, binding = 1, scalar) writeonly buffer Segments { SurfaceSegment items[]; } segments;

vec3 placeOf(uint segment, uint i) {
    return fetchTexel(points, int(min(segment * kSegmentPoints + i, push.p.pointCount - 1)) * 4).xyz;
}

// The last segment may have fewer points.
float areaOf(uint segment, uint i) {
    uint point = segment * kSegmentPoints + i;
    float radius = fetchTexel(points, int(min(point, push.p.pointCount - 1)) * 4 + 1).w;
    return point < push.p.pointCount ? kPi * radius * radius : 0.0;
}

void main() {
    uint segment = push.p.firstGroup * gl_WorkGroupSize.x + gl_GlobalInvocationID.x;
    if (segment * kSegmentPoints >= push.p.pointCount) return;
    vec3 least = vec3(3.0e38), most = vec3(-3.0e38);
    for (uint i = 0; i < kSegmentPoints; ++i) {
        vec3 p = placeOf(segment, i);
        least = min(least, p);
        most = max(most, p);
    }
    vec3 centre = 0.5 * (least + most);
    float radius2 = 0.0, area = 0.0;
    for (uint i = 0; i < kSegmentPoints; ++i) {
        vec3 d = placeOf(segment, i) - centre;
        radius2 = max(radius2, dot(d, d));
        area += areaOf(segment, i);
    }
    segments.items[segment] = SurfaceSegment(centre, packHalf2x16(vec2(sqrt(radius2), area)));
}
