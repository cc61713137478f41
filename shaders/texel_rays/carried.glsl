// How long what rays found holds once none are cast. Luminances of what area lights send, now and when it was found.
#ifndef AG_CARRIED_GLSL
#define AG_CARRIED_GLSL

// 1 while the area lights send about what they did, down to 0.
float stillTrue(float now, float then) { return clamp(2.0 - 4.0 * abs(now - then) / max(max(now, then), 1e-20), 0.0, 1.0); }
#endif
