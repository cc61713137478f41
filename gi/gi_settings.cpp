#include "gi/gi_settings.h"

#include "engine/core/settings.h"

namespace ag::gi {

bool applyPreset(std::string_view name, GiSettings& gi) {
    if (name == "none") {
        gi.valShading.enabled = false;
    } else if (name == "rsmc") {
        gi.valShading.shape = ValShape::kDisk;
        gi.importance.viewWeight = 1;  // the geometry term toward the view alone
        gi.valClustering.distanceWeight = gi.valClustering.normalWeight = 1;
        gi.valClustering.chromaWeight = 10;
    } else {
        return name == "afterglow";
    }
    return true;
}

void registerSettings(Settings& s, GiSettings& gi) {
    s.add({"rsm", "resolution", 0, 1024, "texels",
           "side of a light map, rounded down to a power of two; 0: as each light says"},
          &gi.rsm.resolution);
    s.add({"rsm", "sun_margin", 0, 1, "", "part of the scene's width added round a sun's map"},
          &gi.rsm.sunMargin);
    s.add({"rsm", "near", 0.001, 1, "m", "near plane of spot and point faces"}, &gi.rsm.nearDistance);
    s.add({"importance", "view_weight", 0, 1, "", "seed clusters by flux (0) or by what faces the view (1)"},
          &gi.importance.viewWeight);
    s.add({"val_clustering", "count", 16, 1024, "clusters", "clusters over all bounce lights"},
          &gi.valClustering.count);
    s.add({"val_clustering", "distance_weight", 0, 1000, "1/m2", "metric: squared distance"},
          &gi.valClustering.distanceWeight);
    s.add({"val_clustering", "normal_weight", 0, 1000, "", "metric: 1 - cosine of the normals"},
          &gi.valClustering.normalWeight);
    s.add({"val_clustering", "chroma_weight", 0, 1000, "", "metric: squared difference of flux colour"},
          &gi.valClustering.chromaWeight);
    s.add({"val_clustering", "settle_frames", 0, 1000, "frames",
           "clustering steps after the light maps last changed"},
          &gi.valClustering.settleFrames);
    s.add({"val_shading", "enabled", 0, 0, "", "indirect light at all"}, &gi.valShading.enabled);
    s.add(
        {"val_shading", "shape", 0, 0, "", "form factor of an area light", {"point", "disk", "vector_disk"}},
        &gi.valShading.shape);
    s.add({"shadow_maps", "resolution", 64, 4096, "texels",
           "side of a spot's map or a cascade; cube faces half"},
          &gi.shadowMaps.resolution);
    s.add({"shadow_maps", "cascades", 1, 4, "", "cascades of a sun"}, &gi.shadowMaps.cascades);
    s.add({"shadow_maps", "cascade_distance", 1, 10000, "m", "reach of the last cascade, cut to the scene"},
          &gi.shadowMaps.cascadeDistance);
    s.add({"shadow_maps", "cascade_split", 0, 1, "", "0 uniform, 1 logarithmic"},
          &gi.shadowMaps.cascadeSplit);
    s.add({"shadow_maps", "near", 0.001, 1, "m", "near plane of spot and point views"},
          &gi.shadowMaps.nearDistance);
    s.add({"composite", "exposure", -20, 20, "stops", "of the display image"}, &gi.composite.exposure);
    s.add({"composite", "tonemap", 0, 0, "", "curve of the display image", {"none", "reinhard", "aces"}},
          &gi.composite.tonemap);
}

}  // namespace ag::gi
