// How much of what rays found to believe: the positive part of James and Stein's estimator, over some pixels.
#ifndef AG_SHRINKAGE_GLSL
#define AG_SHRINKAGE_GLSL

const float kDoubt = 2.0;  // neighbours' errors are correlated: more noise is left than the filtered variance says

// `found`: sum of the squares of what was found; `noise`: of its variances.
float trustIn(float found, float noise) { return max(found - kDoubt * noise, 0.0) / max(found, 1e-30); }
#endif
