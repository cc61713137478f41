#include "gi/library/host_rsm.h"

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

#include "engine/core/hash.h"

namespace ag::guest {
namespace {

AgiRsmFace faceFor(const SceneOnDevice& device, const gi::RsmSet& rsm, const io::RsmFace& face) {
    AgiRsmFace out{.light = rsm.lightIds[face.map],
                   .area = {{int32_t(face.origin.x), int32_t(face.origin.y)}, {face.size, face.size}}};
    const glm::dvec3 origin = device.origin();
    const glm::mat4 clip = glm::scale(face.clipFromWorld, glm::vec3(1 / device.units().length));
    std::copy_n(&origin.x, 3, out.origin);
    std::copy_n(&clip[0].x, 16, out.clipFromLocal);
    return out;
}

}  // namespace

void addHostRsm(GraphScope scope, const SceneOnDevice& device, const AgiFrame& f, gi::RsmSet& rsm) {
    std::vector<AgiRsmFace> faces;
    for (uint32_t i = 0; i < rsm.lightFaceCount; ++i)
        faces.push_back(faceFor(device, rsm, rsm.faceInfo[i]));
    const uint64_t key = combineHash(hashBytes(std::as_bytes(std::span(faces))), f.drawRsmVersion);
    rsm.inputsVersion = combineHash(rsm.inputsVersion, key);
    scope.callback("guest.host_rsms")
        .colorClear(rsm.normal, glm::vec4(0))
        .colorClear(rsm.albedo, glm::vec4(0))
        .depthClear(rsm.depth)
        .key(key)
        .record([draw = f.drawRsmFace, user = f.drawRsmUser, faces](const PassRecording& to) {
            for (const AgiRsmFace& face : faces)
                draw(user, to.commands, &face);
        });
}

}  // namespace ag::guest
