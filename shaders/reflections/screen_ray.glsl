// A ray's way over the picture. Before: depthMap, normalMap, radianceMap, camera, push.p of ReflectionsMarchPush.

const float kBorder = 0.08;      // of the picture's shorter side: there what is met counts less and less
const float kFirstPixels = 1.5;  // of the way that are left out
const int kHalvings = 5;         // of a step, once a surface was passed

struct ScreenLine {     // in pixels and reversed depth, both of which are linear along a ray's picture
    vec3 from, along;
    bool endsOnScreen;  // infinitely far away
};

vec3 onScreen(vec4 clip) { return vec3((clip.xy / clip.w * 0.5 + 0.5) * vec2(camera.camera.size), clip.z / clip.w); }

// To where the ray leaves the picture, or to its vanishing point. One toward the camera ends at the lens.
ScreenLine screenLine(vec3 place, vec3 direction) {
    const float kLeast = 1e-4;
    vec4 start = camera.camera.clipFromWorld * vec4(place, 1.0), way = camera.camera.clipFromWorld * vec4(direction, 0.0);
    bool away = way.w > kLeast;
    vec4 end = away ? way : start + way * ((start.w - camera.camera.near) / max(-way.w, kLeast));
    vec3 from = onScreen(start), along = onScreen(end) - from;
    vec2 room = mix(from.xy, vec2(camera.camera.size) - from.xy, greaterThan(along.xy, vec2(0.0))) / max(abs(along.xy), vec2(1e-6));
    float within = clamp(min(room.x, room.y), 0.0, 1.0);
    return ScreenLine(from, along * within, away && within == 1.0);
}

float depthAt(vec2 place) { return texelFetch(depthMap, min(ivec2(place), ivec2(camera.camera.size) - 1), 0).x; }

bool isBehind(ScreenLine line, float s) {
    vec3 p = line.from + line.along * s;
    return p.z < depthAt(p.xy);
}

vec3 placeOn(ScreenLine line, float s) {
    vec3 p = line.from + line.along * s;
    vec4 h = camera.camera.worldFromClip * vec4(p.xy / vec2(camera.camera.size) * 2.0 - 1.0, max(p.z, 1e-9), 1.0);
    return h.xyz / h.w;
}

// How much counts what lies there.
float borderShare(vec2 place) {
    vec2 size = vec2(camera.camera.size), room = min(place, size - place);
    return clamp(min(room.x, room.y) / (kBorder * min(size.x, size.y)), 0.0, 1.0);
}

const uint kMeets = 0, kGrazes = 1, kHides = 2;

// Between `before`, in front of what is seen there, and `s`, behind it: which of the three, and where.
uint passSurface(ScreenLine line, vec3 direction, float before, inout float s) {
    for (int i = 0; i < kHalvings; ++i) {
        float middle = 0.5 * (before + s);
        bool behind = isBehind(line, middle);
        s = behind ? middle : s;
        before = behind ? before : middle;
    }
    ivec2 pixel = min(ivec2((line.from + line.along * s).xy), ivec2(camera.camera.size) - 1);
    float depth = texelFetch(depthMap, pixel, 0).x;
    vec3 normal = texelFetch(normalMap, pixel, 0).xyz, place = placeOn(line, s);
    float facing = -dot(normal, direction);
    vec3 surface = worldFromPixel(camera.camera.worldFromClip, camera.camera.size, pixel, depth);
    float beyond = abs(dot(normal, place - surface)) / max(abs(facing), 0.05);
    float most = push.p.thickness * camera.camera.near / depth + distance(place, placeOn(line, before));
    if (beyond > most) return kHides;
    return facing > 0.0 ? kMeets : kGrazes;
}

// Radiance of what the ray meets, black where it goes on to the sky; and how well that is known.
vec4 meetOnScreen(vec3 place, vec3 direction, float start) {
    ScreenLine line = screenLine(place, direction);
    float pixels = max(max(abs(line.along.x), abs(line.along.y)), 1e-3);
    uint steps = min(push.p.steps, uint(ceil(pixels)));
    float first = min(kFirstPixels / pixels, 1.0), before = 0.0;
    bool behind = false;
    for (uint i = 0; i < steps; ++i) {
        float s = mix(first, 1.0, (float(i) + start) / float(steps));
        bool now = isBehind(line, s);
        if (now && !behind) {
            float at = s;
            uint what = passSurface(line, direction, before, at);
            vec2 met = (line.from + line.along * at).xy;
            if (what == kMeets) return vec4(textureLod(radianceMap, met / vec2(camera.camera.size), 0.0).rgb, borderShare(met));
            if (what == kHides) return vec4(0.0);  // what is behind it may be anything
        }
        behind = now;
        before = s;
    }
    return vec4(vec3(0.0), line.endsOnScreen && !behind ? borderShare((line.from + line.along).xy) : 0.0);
}
