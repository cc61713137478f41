#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
// Spatial anti-aliasing after FXAA (Lottes 2009): along an edge between brighter and darker pixels each is mixed with the
// other side by where between the edge's ends it lies, as a line that is not upright covers it.
#include "antialiasing/antialiasing_io.h"
#include "common/pixel_rays.h"

layout(set = 0, binding = 0) uniform sampler2D aliased;  // display values
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;

const int kMostSteps = 12;  // pixels from which an edge's end is looked for, each way
const float kMostOfSmall = 0.75;  // pixels toward the other side

float lumaAt(vec2 place) { return luminance(textureLod(aliased, place, 0.0).rgb); }

// Pixels along the edge until the mean of its two sides is no longer what it is here; `off`: by how much it then differs.
float wayToEnd(vec2 from, vec2 along, float mean, float least, out float off) {
    int steps = 1;
    for (; steps < kMostSteps; ++steps) {
        off = lumaAt(from + along * float(steps)) - mean;
        if (abs(off) >= least) break;
    }
    return float(steps);
}

void main() {
    vec2 texel = 1.0 / vec2(textureSize(aliased, 0));
    vec4 middle = textureLod(aliased, uv, 0.0);
    float m = luminance(middle.rgb), l[9];
    for (int i = 0; i < 9; ++i) l[i] = lumaAt(uv + texel * vec2(i % 3 - 1, i / 3 - 1));
    float high = max(m, max(max(l[1], l[3]), max(l[5], l[7]))), low = min(m, min(min(l[1], l[3]), min(l[5], l[7])));
    display = middle;
    if (high - low < max(kLeastContrast, kRelativeContrast * high)) return;

    float acrossRows = abs(l[0] + l[6] - 2.0 * l[3]) + 2.0 * abs(l[1] + l[7] - 2.0 * m) + abs(l[2] + l[8] - 2.0 * l[5]);
    float acrossColumns = abs(l[0] + l[2] - 2.0 * l[1]) + 2.0 * abs(l[3] + l[5] - 2.0 * m) + abs(l[6] + l[8] - 2.0 * l[7]);
    bool level = acrossRows >= acrossColumns;
    vec2 across = level ? vec2(0.0, texel.y) : vec2(texel.x, 0.0), along = level ? vec2(texel.x, 0.0) : vec2(0.0, texel.y);
    float before = level ? l[1] : l[3], after = level ? l[7] : l[5];
    bool toAfter = abs(after - m) > abs(before - m);
    float other = toAfter ? after : before;
    if (!toAfter) across = -across;

    // Halfway between the two rows a linear tap is their mean.
    float mean = 0.5 * (m + other), least = 0.25 * abs(other - m), offBack, offOn;
    vec2 edge = uv + 0.5 * across;
    float back = wayToEnd(edge, -along, mean, least, offBack), on = wayToEnd(edge, along, mean, least, offOn);
    float nearer = back < on ? offBack : offOn;
    bool coversThis = (nearer > 0.0) != (m > mean);  // at the nearer end the other side's colour goes on
    float share = coversThis ? 0.5 - min(back, on) / (back + on) : 0.0;
    // What stands out of all its neighbours is smaller than a pixel.
    float about = (2.0 * (l[1] + l[3] + l[5] + l[7]) + l[0] + l[2] + l[6] + l[8]) / 12.0;
    float stands = smoothstep(0.0, 1.0, min(abs(about - m) / (high - low), 1.0));
    share = max(share, kMostOfSmall * stands * stands);
    display = vec4(textureLod(aliased, uv + across * share, 0.0).rgb, middle.a);
}
