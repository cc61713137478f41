// The corners of what a texel covers of its surface. Needs the buffers of rsm/footprint.glsl and `edges`, two for each
// texel of a map of surfaces.
#ifndef AG_TEXEL_CORNERS_GLSL
#define AG_TEXEL_CORNERS_GLSL

#include "common/sampling.h"
#include "rsm/footprint.glsl"

// Of a point that stands for surface round it: a square of half its sides, drawn out to where the surface ends nearby.
// Those that make a cluster's outline are the nearest to a crease: what stood out over it would light nothing, and what
// did not reach it would leave the crease dark. Clusters side by side touch it by a corner each; drawn out along it
// they leave nothing between them.
void pointCorners(RsmSurface s, uint point, out vec3 corners[4]) {
    float width = sqrt(s.area);
    SurfaceEdge near = edges.items[point * 2];
    vec3 t, b;
    orthonormalBasis(s.normal, t, b);
    float along = 0.25;
    if (near.distance < width) {
        along = 0.75;
        t = near.inward;
        b = cross(s.normal, t);
    }
    for (int i = 0; i < 4; ++i) {
        vec3 off = width * (t * (i == 1 || i == 2 ? -0.25 : 0.25) + b * (i > 1 ? -along : along));
        for (int k = 0; k < 2; ++k) {
            SurfaceEdge e = edges.items[point * 2 + k];
            float inward = dot(off, e.inward);
            if (e.distance < width && inward < 0.0) off -= e.inward * (inward + e.distance);
        }
        corners[i] = s.position + off;
    }
}

void texelCorners(uint texel, uint mapIndex, uint atlasWidth, out vec3 corners[4]) {
    TexelView v = viewTexel(texel, mapIndex, atlasWidth);
    if (v.map.kind == kMapOfSurfaces) {
        pointCorners(v.s, v.map.firstPoint + rsmIndexInFace(texel, v.face, atlasWidth), corners);
        return;
    }
    Reach r = reachOf(v);
    corners[0] = onPlane(v, vec2(r.right, r.up));
    corners[1] = onPlane(v, vec2(-r.left, r.up));
    corners[2] = onPlane(v, vec2(-r.left, -r.down));
    corners[3] = onPlane(v, vec2(r.right, -r.down));
}
#endif
