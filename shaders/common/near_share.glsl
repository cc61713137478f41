// Points that stand for surfaces, and rays that find the surfaces themselves where points are too near.
#ifndef AG_NEAR_SHARE_GLSL
#define AG_NEAR_SHARE_GLSL

// Of surfaces so far away: the hemisphere's ray has those that are near, draws to points on them the others.
float nearShare(float distance_, float reach) { return clamp(2.0 - 2.0 * distance_ / max(reach, 1e-20), 0.0, 1.0); }
#endif
