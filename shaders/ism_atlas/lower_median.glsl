// Four texels of a map as one of the coarser level.
#ifndef AG_LOWER_MEDIAN_GLSL
#define AG_LOWER_MEDIAN_GLSL

// Of two planes the nearer first; none goes last.
void nearerFirst(inout vec4 a, inout vec4 b) {
    bool swap = b.w > 0.0 && (a.w <= 0.0 || b.w < a.w);
    vec4 first = swap ? b : a;
    b = swap ? a : b;
    a = first;
}

// By distance, of those that were met.
vec4 lowerMedian(vec4 a, vec4 b, vec4 c, vec4 d) {
    nearerFirst(a, b);
    nearerFirst(c, d);
    nearerFirst(a, c);
    nearerFirst(b, d);
    nearerFirst(b, c);
    return c.w > 0.0 ? b : a;
}
#endif
