// glTF 2.0 appendix B, the diffuse part: what a metallic-roughness surface reflects like Lambert.
#ifndef AG_BRDF_H
#define AG_BRDF_H

#include "common/portable.h"

AG_BEGIN

AG_FUNCTION vec3 diffuseAlbedo(vec3 baseColor, float metallic) {
    return baseColor * (1.0f - metallic);
}

AG_END
#endif
