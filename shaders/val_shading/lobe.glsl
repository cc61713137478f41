// How wide a specular lobe is.
#ifndef AG_LOBE_GLSL
#define AG_LOBE_GLSL

const float kLeastRoughness = 0.15;

// Of half vectors: the GGX parameter alpha.
float lobeWidth(float roughness) {
    float root = max(roughness, kLeastRoughness);
    return root * root;
}
#endif
