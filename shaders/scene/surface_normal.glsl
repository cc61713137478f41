// The shading normal of a fragment: interpolated, turned to the viewer's side, bent by the normal map.
#ifndef AG_SURFACE_NORMAL_GLSL
#define AG_SURFACE_NORMAL_GLSL

// Tangent frame from screen-space derivatives of position and uv, for files without tangents (Mikkelsen 2020's
// surface gradients reduce to this for one map).
mat3 derivativeFrame(vec3 position, vec3 n, vec2 uv) {
    vec3 dpx = dFdx(position), dpy = dFdy(position);
    vec2 dux = dFdx(uv), duy = dFdy(uv);
    vec3 r1 = cross(dpy, n), r2 = cross(n, dpx);
    vec3 t = r1 * dux.x + r2 * duy.x;
    vec3 b = r1 * dux.y + r2 * duy.y;
    float scale = inversesqrt(max(max(dot(t, t), dot(b, b)), 1e-30));
    return mat3(t * scale, b * scale, n);
}

vec3 bentNormal(SurfaceMaterial m, vec3 position, vec3 n, vec4 tangent) {
    vec3 mapped = sampleLinear(m.uv, m.layers.z).xyz * 2.0 - 1.0;
    mapped.xy *= m.normalScale;
    bool hasTangent = dot(tangent.xyz, tangent.xyz) > 1e-12;
    vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
    t *= inversesqrt(max(dot(t, t), 1e-30));
    mat3 given = mat3(t, cross(n, t) * tangent.w, n);
    mat3 derived = derivativeFrame(position, n, m.uv);
    vec3 bent = hasTangent ? given * mapped : derived * mapped;
    bent = dot(bent, bent) > 1e-12 ? normalize(bent) : n;
    return m.layers.z < 0 ? n : bent;
}
#endif
