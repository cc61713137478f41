// Irradiance terms of small diffuse emitters: E = flux x term, with flux in W and term in 1/m². Receiver at x
// with normal n; emitter at c with normal m (method notes on virtual area lights; the rectangle after Lambert
// 1760).
#ifndef AG_FORM_FACTORS_H
#define AG_FORM_FACTORS_H

#include "common/portable.h"

AG_BEGIN

// A point with a cosine lobe.
AG_FUNCTION float vplTerm(vec3 x, vec3 n, vec3 c, vec3 m) {
    vec3 d = c - x;
    float d2 = max(dot(d, d), 1e-12f);
    float cosines = max(dot(n, d), 0.0f) * max(-dot(m, d), 0.0f);
    return cosines / (kPi * d2 * d2);
}

// The disk approximation of RSMC eq. 2 and ACRSM eq. 3.9: loses energy within a few radii.
AG_FUNCTION float diskPublishedTerm(vec3 x, vec3 n, vec3 c, vec3 m, float area) {
    vec3 d = c - x;
    float d2 = max(dot(d, d), 1e-12f);
    float cosines = max(dot(n, d), 0.0f) * max(-dot(m, d), 0.0f);
    return cosines / (d2 * (kPi * d2 + area));
}

// The disk's vector irradiance in closed form: its length L times the receiver's cosine c, with a smooth
// horizon of half width s = sqrt(L): L (c + s)² / (4 s) for |c| < s. With a = p² - r² and q² = a² + 4 r² h²
// the length is L² = 4 r⁴ h² / (q (p² + r² + q) (q + a)); nothing cancels far away or at the disk's rim.
// Returns the form factor: E = flux / area x factor.
AG_FUNCTION float diskVectorFactor(vec3 x, vec3 n, vec3 c, vec3 m, float radiusSquared) {
    vec3 p = x - c;
    float h = dot(p, m);
    float p2 = dot(p, p);
    float r2 = radiusSquared;
    float a = p2 - r2;
    float g = 2.0f * r2 * h;
    float q = sqrt(a * a + 4.0f * r2 * h * h);
    float b = max(q + a, 1e-6f * r2);
    float scale = g / max(q * (p2 + r2 + q) * b, 1e-30f);
    float l2 = min(scale * g, 1.0f);                       // L²
    float lc = -(l2 * dot(n, m) + scale * b * dot(n, p));  // L c
    float ls = sqrt(l2 * sqrt(max(l2, 1e-30f)));           // L s
    float sum = max(lc + ls, 0.0f);
    float f = lc >= ls ? lc : 0.25f * sum * sum / max(ls, 1e-20f);
    return h > 0.0f ? f : 0.0f;
}

// Integral of one edge of a polygon seen from the origin, projected onto n; a and b are unit vectors.
AG_FUNCTION float edgeTerm(vec3 a, vec3 b, vec3 n) {
    vec3 axis = cross(a, b);
    float sine = length(axis);
    if (sine < 1e-9f) return 0.0f;
    return acos(clamp(dot(a, b), -1.0f, 1.0f)) * dot(axis, n) / sine;
}

// Lambert's polygon form factor of a rectangle with half sides u, v about c, clipped at the receiver's
// horizon.
AG_FUNCTION float rectangleTerm(vec3 x, vec3 n, vec3 c, vec3 m, vec3 u, vec3 v) {
    if (dot(x - c, m) <= 0.0f) return 0.0f;
    vec3 corner[4];
    corner[0] = c - u - v - x;
    corner[1] = c + u - v - x;
    corner[2] = c + u + v - x;
    corner[3] = c - u + v - x;
    vec3 clipped[8];
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        vec3 a = corner[i];
        vec3 b = corner[(i + 1) % 4];
        float da = dot(a, n);
        float db = dot(b, n);
        if (da > 0.0f) {
            clipped[count] = a;
            count += 1;
        }
        if ((da > 0.0f) != (db > 0.0f)) {
            clipped[count] = a + (b - a) * (da / (da - db));
            count += 1;
        }
    }
    if (count < 3) return 0.0f;
    float sum = 0.0f;
    for (int i = 0; i < count; ++i) {
        vec3 a = clipped[i];
        vec3 b = clipped[(i + 1) % count];
        sum += edgeTerm(a * inversesqrt(max(dot(a, a), 1e-24f)), b * inversesqrt(max(dot(b, b), 1e-24f)), n);
    }
    float area = 4.0f * length(cross(u, v));
    return abs(sum) * 0.5f * kInvPi / max(area, 1e-20f);
}

// Integral of a polygon's edge from unit vector a to b: their cross product times angle / sine. The arc
// cosine is Abramowitz & Stegun 4.4.45, 7e-5 rad at most off.
AG_FUNCTION vec3 edgeVector(vec3 a, vec3 b) {
    float x = clamp(dot(a, b), -0.9999f, 0.9999f);
    float y = abs(x);
    float p = 1.5707288f + y * (-0.2121144f + y * (0.0742610f - 0.0187293f * y));
    float root = sqrt(1.0f + y);
    float acute = p / root;  // acos(y) / sqrt(1 - y²)
    float angle = x >= 0.0f ? acute : kPi * inversesqrt(1.0f - y * y) - acute;
    return cross(a, b) * angle;
}

// A rectangle's vector irradiance from its four edges (Lambert 1760), exact above the horizon; across it, as
// for the disk: the cosine rule of a cap of the same size. Half sides u, v about c; lit along m. Returns the
// form factor: E = flux / area x factor.
AG_FUNCTION float rectangleVectorFactor(vec3 x, vec3 n, vec3 c, vec3 m, vec3 u, vec3 v) {
    vec3 d = c - x;
    vec3 p0 = d - u - v;
    vec3 p1 = d + u - v;
    vec3 p2 = d + u + v;
    vec3 p3 = d - u + v;
    p0 *= inversesqrt(max(dot(p0, p0), 1e-20f));
    p1 *= inversesqrt(max(dot(p1, p1), 1e-20f));
    p2 *= inversesqrt(max(dot(p2, p2), 1e-20f));
    p3 *= inversesqrt(max(dot(p3, p3), 1e-20f));
    vec3 sum = edgeVector(p0, p1) + edgeVector(p1, p2) + edgeVector(p2, p3) + edgeVector(p3, p0);
    float facing = -dot(d, m);  // height above the rectangle
    vec3 f = sum * (dot(sum, d) >= 0.0f ? 0.5f * kInvPi : -0.5f * kInvPi);
    float l = min(sqrt(max(dot(f, f), 1e-30f)), 1.0f);
    float lc = dot(n, f);
    float ls = l * sqrt(l);
    float above = max(lc + ls, 0.0f);
    float factor = lc >= ls ? lc : 0.25f * above * above / max(ls, 1e-20f);
    return facing > 0.0f ? factor : 0.0f;
}

// A polygon's vector irradiance in the frame of its plane: receiver at p (z its height) with normal n, eight
// corners counter-clockwise about the origin, equal neighbours allowed. Each edge is the cross product of the
// unit vectors to its ends times angle / sine, as in edgeVector; horizon as for the disk. Radiosity varies
// over the polygon as gradient.xy . y + gradient.z: it is taken where the mean direction to the polygon meets
// it, plus what the receiver's cosine adds to first order (its logarithm's slope times the second moment
// gradient.w), less so where the polygon fills the view. Returns the form factor: E = flux / area x factor.
// Nearer to the plane than `least` [m] counts as that far before it: the receiver is not a point but has some
// width, and in a crease rounding would decide on which side of the plane it is. Only where it faces the
// polygon: not in the plane itself, nor beyond a convex edge. Behind the plane it counts so only as near as
// rounding may put it there: what is farther is behind a thin wall.
AG_FUNCTION float polygonVectorFactor(vec3 p, vec3 n, vec2 corners[8], vec4 gradient, float least) {
    const float kLeastSine = 1e-3f;
    const float kBehindSine = 4e-3f;
    float away = sqrt(dot(p, p));
    least = max(least, kLeastSine * away);
    float toward = -(n.x * p.x + n.y * p.y) * inversesqrt(max(p.x * p.x + p.y * p.y, 1e-20f));
    float before = p.z > least                             ? 1.0f
                   : p.z > -min(least, kBehindSine * away) ? clamp(20.0f * toward, 0.0f, 1.0f)
                                                           : 0.0f;
    p.z = max(p.z, least);
    vec3 sum = vec3(0.0f);
    vec3 a = vec3(corners[7].x - p.x, corners[7].y - p.y, -p.z);
    float ra = inversesqrt(max(dot(a, a), 1e-20f));
    for (int i = 0; i < 8; ++i) {
        vec3 b = vec3(corners[i].x - p.x, corners[i].y - p.y, -p.z);
        float rb = inversesqrt(max(dot(b, b), 1e-20f));
        sum += edgeVector(a * ra, b * rb);
        a = b;
        ra = rb;
    }
    vec3 f = sum * (-0.5f * kInvPi);
    float l = min(sqrt(max(dot(f, f), 1e-30f)), 1.0f);
    float lc = dot(n, f);
    float ls = l * sqrt(l);
    float above = max(lc + ls, 0.0f);
    float factor = lc >= ls ? lc : 0.25f * above * above / max(ls, 1e-20f);
    vec3 d = f * (-p.z / min(f.z, -1e-12f));  // from the receiver to the plane
    float radiosity = gradient.x * (p.x + d.x) + gradient.y * (p.y + d.y) + gradient.z;
    float nd = max(dot(n, d), 0.0f);
    float tilt = gradient.w * (gradient.x * n.x + gradient.y * n.y);
    radiosity += tilt * nd / (nd * nd + gradient.w + 1e-12f);
    return before * factor * clamp(radiosity, 0.0f, 4.0f);
}

// A light that stands for texels at several heights sends a receiver among them the light of those below it
// alone: their share, and how far below the receiver they are in the mean [m]. z: the receiver's height over
// the light's plane; thickness: standard deviation of the texels' heights. A logistic distribution, which has
// both in closed form.
AG_FUNCTION vec2 layersBelow(float z, float thickness) {
    float perUnit = 1.8137994f / thickness;  // pi / sqrt(3) over the deviation
    float t = perUnit * z;
    float e = exp(-abs(t));
    float share = (t > 0.0f ? 1.0f : e) / (1.0f + e);
    return vec2(share, (max(t, 0.0f) + log(1.0f + e)) / (perUnit * max(share, 1e-6f)));
}

// Whether a receiver, in the light's frame, is outside of a light whose texels bulge: 0 behind what they are
// on, 1 before it. That is taken for a paraboloid within the light's outline, of the texels' mean second
// moment in the plane [m²], whose heights have the deviation `thickness` (0.29 of what it falls in twice that
// moment, over a disk), and whose top is `top` over the plane.
AG_FUNCTION float outsideBulge(vec3 p, vec2 corners[8], float top, float thickness, float secondMoment) {
    bool beside = false;
    for (int i = 0; i < 8; ++i) {
        vec2 a = corners[i], side = corners[(i + 1) % 8] - a;
        beside = beside || side.x * (p.y - a.y) - side.y * (p.x - a.x) < 0.0f;
    }
    float height = top - thickness * (p.x * p.x + p.y * p.y) / max(1.2f * secondMoment, 1e-20f);
    float t = clamp((p.z - height) / (0.5f * thickness) - 0.5f, 0.0f, 1.0f);
    return p.z < 0.0f ? 0.0f : beside ? 1.0f : t * t * (3.0f - 2.0f * t);
}

AG_END
#endif
