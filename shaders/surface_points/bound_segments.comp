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

vec4 placeOf(uint point) { return fetchTexel(points, int(min(point, push.p.pointCount - 1)) * 4); }

// The last segment may have fewer points, and where an instance left there are none: 0.
float radiusOf(uint point) {
    float radius = fetchTexel(points, int(min(point, push.p.pointCount - 1)) * 4 + 1).w;
    return point < push.p.pointCount ? radius : 0.0;
}

void main() {
    uint segment = push.p.firstGroup * gl_WorkGroupSize.x + gl_GlobalInvocationID.x, first = segment * kSegmentPoints;
    if (first >= push.p.pointCount) return;
    vec3 least = vec3(3.0e38), most = vec3(-3.0e38);
    float area = 0.0;
    for (uint i = first; i < first + kSegmentPoints; ++i) {
        vec3 p = placeOf(i).xyz;
        float radius = radiusOf(i);
        least = radius > 0.0 ? min(least, p) : least;
        most = radius > 0.0 ? max(most, p) : most;
        area += kPi * radius * radius;
    }
    vec3 centre = area > 0.0 ? 0.5 * (least + most) : vec3(0.0);
    float radius2 = 0.0;
    for (uint i = first; i < first + kSegmentPoints; ++i) {
        vec3 d = placeOf(i).xyz - centre;
        radius2 = max(radius2, radiusOf(i) > 0.0 ? dot(d, d) : 0.0);
    }
    segments.items[segment] = SurfaceSegment(centre, packHalf2x16(vec2(sqrt(radius2), area)));
}
