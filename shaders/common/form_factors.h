// Irradiance terms of small diffuse emitters: E = flux x term, with flux in W and term in 1/m². Receiver at x with
// normal n; emitter at c with normal m (method notes on virtual area lights; the rectangle after Lambert 1760).
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

// The disk's vector irradiance in closed form: its length times the receiver's cosine, with a smooth horizon.
AG_FUNCTION float diskVectorTerm(vec3 x, vec3 n, vec3 c, vec3 m, float area) {
    vec3 p = x - c;
    float h = dot(p, m);
    float p2 = max(dot(p, p), 1e-12f);
    float r2 = max(area * kInvPi, 1e-12f);
    float t = p2 + r2;
    float a = p2 - r2;
    // t² - 4 r² (p² - h²), written so that nothing cancels at the disk's rim.
    float q = sqrt(max(a * a + 4.0f * r2 * h * h, 1e-24f));
    // p² - r² - q likewise, for far away.
    float difference = a > 0.0f ? -4.0f * r2 * h * h / (a + q) : a - q;
    vec3 v = (m * difference - p * (2.0f * h)) * (r2 / (q * (t + q)));
    float l2 = max(dot(v, v), 1e-30f);
    float l = sqrt(l2);
    float c1 = dot(n, v);   // l x cosine
    float s1 = l * sqrt(l); // l x sqrt(l): the horizon's half width times l
    float sum = c1 + s1;
    float f = c1 >= s1 ? c1 : (sum > 0.0f ? sum * sum / (4.0f * s1) : 0.0f);
    return h > 0.0f ? max(f, 0.0f) / (r2 * kPi) : 0.0f;
}

// Integral of one edge of a polygon seen from the origin, projected onto n; a and b are unit vectors.
AG_FUNCTION float edgeTerm(vec3 a, vec3 b, vec3 n) {
    vec3 axis = cross(a, b);
    float sine = length(axis);
    if (sine < 1e-9f) return 0.0f;
    return acos(clamp(dot(a, b), -1.0f, 1.0f)) * dot(axis, n) / sine;
}

// Lambert's polygon form factor of a rectangle with half sides u, v about c, clipped at the receiver's horizon.
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

AG_END
#endif
