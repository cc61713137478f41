#include "engine/renderer/picture_version.h"

#include <utility>

#include "engine/core/hash.h"

namespace ag::render {

uint64_t PictureVersion::next(const RenderScene& scene, const RenderSettings& settings) {
    const bool otherSettings = std::exchange(settings_, settings) != settings;
    const bool otherSky = std::exchange(sky_, scene.sky) != scene.sky;
    changes_ += otherSettings || otherSky;
    uint64_t version = changes_;
    for (const uint64_t part :
         {scene.geometry->version, scene.lightsVersion, scene.cameraVersion, scene.originVersion})
        version = combineHash(version, part);
    return version;
}

}  // namespace ag::render
