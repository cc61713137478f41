// Surfaces on screen from their depth along the camera's axis, and how alike two of them and their light are.
#ifndef AG_PIXEL_RAYS_H
#define AG_PIXEL_RAYS_H

#include "common/portable.h"

AG_BEGIN

struct PixelRays {  // a pixel's surface lies at eye + depth x (corner + x right + y down), depth in m along
                    // the axis
    vec3 eye;
    vec3 corner;  // through the centre of pixel 0, 0
    vec3 right;   // a pixel on
    vec3 down;
};

struct ReprojectionCameras {  // of this frame and the one before
    mat4 previousClipFromWorld;
    PixelRays now, before;
    float pixelSize;  // m at 1 m depth
};

// Relative to the eye, m.
AG_FUNCTION vec3 placeOf(PixelRays rays, vec2 pixel, float depth) {
    return depth * (rays.corner + pixel.x * rays.right + pixel.y * rays.down);
}

AG_FUNCTION float luminance(vec3 linear) {  // Rec. 709
    return dot(linear, vec3(0.2126f, 0.7152f, 0.0722f));
}

// Mean over the channels of their products: second moments of light that differs by colour alone are not 0.
AG_FUNCTION float meanProduct(vec3 a, vec3 b) {
    return dot(a, b) / 3.0f;
}

// 1 on one plane and facing one way, else less. `apart`: m between two surface points; `footprint`: m a pixel
// covers.
AG_FUNCTION float likeness(vec3 normal, vec3 apart, float footprint, vec3 otherNormal) {
    float off = dot(normal, apart) / footprint, facing = max(dot(normal, otherNormal), 0.0f);
    float f2 = facing * facing, f8 = f2 * f2 * f2 * f2;
    return f8 * f8 / (1.0f + off * off * off * off);
}

AG_END

#endif
