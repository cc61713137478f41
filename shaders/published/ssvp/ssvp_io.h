// Screen-space VPL propagation (Aranha et al.): clusters of virtual point lights and what each of them sees.
#ifndef AG_SSVP_IO_H
#define AG_SSVP_IO_H

#include "common/portable.h"

#ifdef __cplusplus
namespace ag::io {
#endif

const uint kMostSsvpVpls = 1024;  // of the first bounce
const uint kMostSsvpClusters = 64;
const uint kSsvpMapColumns = 8;   // of the atlas of paraboloids
const uint kNoSsvpMap = 0xffffu;  // in a light's shape row: nothing stands in its way

struct SsvpCluster {  // 3 vec4
    vec3 position;    // mean of its lights', m; its paraboloid is seen from there
    uint vplCount;    // 0: the place of before, without light
    vec3 normal;      // unit
    uint padding0;
    vec3 flux;  // sum, W
    uint padding1;
};

#ifdef __cplusplus
}  // namespace ag::io
#endif
#endif
