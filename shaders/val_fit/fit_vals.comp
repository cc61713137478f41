#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Clusters to virtual area lights: centre, area and flux, the rectangle that has the cluster's second moments in the
// light's plane (a uniform rectangle's are a third of its half sides squared), and the convex polygon of its farthest
// texels. Empty clusters and the padding to whole subgroups become black lights.
#include "common/sampling.h"
#include "common/texels.glsl"
#include "rsm/rsm.glsl"
#include "surface_points/surface_points_io.h"
#include "val_clustering/covariance.glsl"
#include "val_fit/val_fit_io.h"

layout(local_size_x = 64) in;
layout(push_constant, scalar) uniform Push { ValFitPush p; } push;

layout(set = 0, binding = 0, scalar) readonly buffer Clusters { Cluster items[]; } clusters;
layout(set = 0, binding = 3, scalar) readonly buffer Extents { ClusterExtent items[]; } extents;
layout(set = 0, binding = 4) VEC4_TEXELS(texels);
layout(set = 0, binding = 5, scalar) uniform Faces { RsmFace items[kMaxRsmFaces]; } faces;
layout(set = 0, binding = 6, scalar) uniform Maps { RsmMap items[kMaxRsmMaps]; } maps;
layout(set = 0, binding = 7, scalar) readonly buffer Edges { SurfaceEdge items[]; } edges;
layout(set = 0, binding = 8, scalar) readonly buffer PreviousVals { Val items[]; } previousVals;
layout(set = 0, binding = 1, scalar) writeonly buffer Vals { Val items[]; } vals;
layout(set = 0, binding = 2, scalar) writeonly buffer Shapes { ValShapeVectors items[]; } shapes;

#include "val_fit/texel_corners.glsl"
layout(set = 0, binding = 9, scalar) readonly buffer Sights { uint items[]; } sights;  // of rays, if kTraced
layout(constant_id = 0) const bool kTraced = false;

// Fewer texels than this have no outline worth following.
const float kLeastTexels = 8.0;
const float kLeastFill = 0.5;     // of the cluster's area by the polygon

void fitRectangle(Cluster c, vec3 t, vec3 b, inout ValShapeVectors shape) {
    mat3 moments = covarianceOf(c);
    float tt = dot(t, moments * t), bb = dot(b, moments * b), tb = dot(t, moments * b);
    float middle = 0.5 * (tt + bb), half_ = 0.5 * (tt - bb);
    float spread = sqrt(half_ * half_ + tb * tb);
    // Half the angle of (half_, tb): the direction of the larger moment.
    float cosine = spread > 1e-12 ? sqrt(max(0.5 * (1.0 + half_ / spread), 0.0)) : 1.0;
    float sine = sqrt(max(1.0 - cosine * cosine, 0.0)) * (tb < 0.0 ? -1.0 : 1.0);
    vec3 axis = t * cosine + b * sine, across = cross(c.normal, axis);
    // A single texel has no moments: then, and for slivers, a share of the cluster's own size.
    float least = 0.05 * sqrt(c.area);
    float u = max(sqrt(max(3.0 * (middle + spread), 0.0)), least);
    float v = max(sqrt(max(3.0 * (middle - spread), 0.0)), least);
    shape.halfU = axis * u;
    shape.halfV = across * v;
    shape.inverseRectangle = 0.25 / (u * v);
}

struct PolygonMoments {
    float area;
    vec2 centre;
    vec3 covariance;  // xx, xy, yy
};

// Over the triangles between the origin and each side.
PolygonMoments momentsOf(vec2 corners[kValCorners]) {
    float area = 0.0;
    vec2 first = vec2(0.0);
    vec3 second = vec3(0.0);
    for (int i = 0; i < int(kValCorners); ++i) {
        vec2 p = corners[i], q = corners[(i + 1) % int(kValCorners)], r = p + q;
        float triangle = 0.5 * (p.x * q.y - p.y * q.x);
        area += triangle;
        first += triangle / 3.0 * r;
        second += triangle / 12.0 * (vec3(r.x * r.x, r.x * r.y, r.y * r.y) + vec3(p.x * p.x, p.x * p.y, p.y * p.y) +
                                     vec3(q.x * q.x, q.x * q.y, q.y * q.y));
    }
    float inverse = 1.0 / max(area, 1e-20);
    vec2 centre = first * inverse;
    return PolygonMoments(area, centre, second * inverse - vec3(centre.x * centre.x, centre.x * centre.y,
                                                                centre.y * centre.y));
}

// The linear radiosity over the polygon, relative to its mean, that parts the centre of its flux (the origin) from that
// of its area as its texels do: 1 + slope . (y - centre), as (slope, value at the origin, mean second moment). Nowhere below
// zero.
vec4 gradientOf(PolygonMoments m, vec2 areaCentre, vec2 corners[kValCorners]) {
    vec3 k = m.covariance;
    float det = k.x * k.z - k.y * k.y;
    if (det < 1e-6 * (k.x + k.z) * (k.x + k.z)) return vec4(0.0, 0.0, 1.0, 0.0);
    vec2 slope = vec2(k.y * areaCentre.y - k.z * areaCentre.x, k.y * areaCentre.x - k.x * areaCentre.y) / det;
    float least = 0.0;
    for (int i = 0; i < int(kValCorners); ++i) least = min(least, dot(slope, corners[i] - m.centre));
    slope /= max(-least, 1.0);
    return vec4(slope, 1.0 - dot(slope, m.centre), 0.5 * (k.x + k.z));
}

// The farthest texels' farthest corners, so that neighbours' polygons meet and those in a crease reach it.
void fitPolygon(Cluster c, ClusterExtent extent, vec3 t, vec3 b, inout ValShapeVectors shape) {
    for (int i = 0; i < int(kValCorners); ++i) {
        vec3 corners[4];
        texelCorners(extent.texels[i], c.map, push.p.atlasWidth, corners);
        float angle = float(i) * (kPi / 4.0), most = -3.0e38;
        for (int k = 0; k < 4; ++k) {
            vec2 p = vec2(dot(corners[k] - c.position, t), dot(corners[k] - c.position, b));
            float reach = dot(p, vec2(cos(angle), sin(angle)));
            if (reach > most) shape.corners[i] = p;
            most = max(most, reach);
        }
    }
    PolygonMoments m = momentsOf(shape.corners);
    if (c.texelCount >= kLeastTexels && m.area > kLeastFill * c.area) {
        shape.inversePolygon = 1.0 / m.area;
        shape.gradient = gradientOf(m, vec2(dot(extent.areaCentre, t), dot(extent.areaCentre, b)), shape.corners);
        return;
    }
    vec2 u = vec2(dot(shape.halfU, t), dot(shape.halfU, b)), v = vec2(dot(shape.halfV, t), dot(shape.halfV, b));
    vec2 rectangle[4] = vec2[](u + v, v - u, -u - v, u - v);
    for (int i = 0; i < int(kValCorners); ++i) shape.corners[i] = rectangle[i / 2];
    shape.inversePolygon = shape.inverseRectangle;
}

float thicknessOf(Cluster c) { return sqrt(max(dot(c.normal, covarianceOf(c) * c.normal), 0.0)); }

// Whether any of the texels that were asked sees the place (trace_sights.comp).
bool anySees(uint light, uint place) {
    uint seen = 0, first = (light * kSightPlaces + place) * kSightTexels;
    for (uint i = 0; i < kSightTexels; ++i) seen |= sights.items[first + i];
    return seen != 0;
}


// A light stays where it was while its texels' centre and plane are near to that, so that what it sees need not be looked
// for again: its outline is that of its texels all the same.
const float kMostDrift = 0.1;       // over the radius of a disk of the cluster's area
const float kLeastCosine = 0.9986;  // 3 degrees

// Where the centre and the plane are taken to be, and how far texels reach before it.
void stayWhereItWas(Val old, inout Cluster c, inout float before) {
    vec3 moved = c.position - old.position;
    float most = kMostDrift * sqrt(c.area * kInvPi), nowBefore = before + dot(moved, old.normal);
    bool stays = old.flux != vec3(0.0) && dot(moved, moved) < most * most && abs(nowBefore - old.before) < most &&
                 dot(c.normal, old.normal) > kLeastCosine;
    if (!stays) return;
    c.position = old.position;
    c.normal = old.normal;
    before = old.before;
}

void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= push.p.valCount) return;
    Val val = Val(vec3(0.0), 1.0, vec3(0.0, 1.0, 0.0), 0.0, vec3(0.0), 0.0);
    ValShapeVectors shape;
    shape.halfU = vec3(0.5, 0.0, 0.0);
    shape.halfV = vec3(0.0, 0.0, 0.5);
    shape.inverseRectangle = shape.inversePolygon = 1.0;
    shape.gradient = vec4(0.0, 0.0, 1.0, 0.0);
    for (int k = 0; k < int(kValCorners); ++k) shape.corners[k] = vec2(0.0);
    if (i < push.p.clusterCount) {
        Cluster c = clusters.items[i];
        if (c.texelCount > 0.0) {
            float before = extents.items[i].before, thickness = thicknessOf(c);
            // Where no texel sees the middle of them all, that lies within what they are on: a shell or a corner lit from
            // outside, not stairs or folds.
            if (kTraced && !anySees(i, kSightOfMiddle)) thickness = -thickness;
            // A light looks out from just before its texels. Where none of them sees that place, as between the ground
            // and the roof that are one cluster, it becomes the light of the texel nearest to it.
            if (kTraced && !anySees(i, kSightOfPlace)) {
                c.position = AG_RSM_FETCH(texels, extents.items[i].nearest).position;
                before = 0.0;
            }
            if (push.p.known == 1) stayWhereItWas(previousVals.items[i], c, before);
            val = Val(c.position, c.area, c.normal, thickness, c.flux, before);
            vec3 t, b;
            orthonormalBasis(c.normal, t, b);
            fitRectangle(c, t, b, shape);
            fitPolygon(c, extents.items[i], t, b, shape);
        }
    }
    vals.items[i] = val;
    shapes.items[i] = shape;
}
