#include "gi/importance.h"

namespace ag::gi {
namespace {

// Nodes of a full 2x2 pyramid over the largest face's blocks.
uint32_t pyramidNodes(uint32_t largestFace) {
    uint32_t nodes = 0;
    for (uint32_t side = io::blocksAlong(largestFace); side > 0; side /= 2)
        nodes += side * side;
    return nodes;
}

}  // namespace

Importance addImportance(GraphScope scope, const RsmSet& rsm, BufferHandle viewPoints,
                         const ImportanceSettings& settings) {
    if (rsm.empty()) return {};
    Importance importance{.pyramidStride = pyramidNodes(rsm.largestFace), .viewWeight = settings.viewWeight};
    const io::ImportanceSettings push{.atlasSize = rsm.atlas.size,
                                      .faceCount = rsm.atlas.faceCount,
                                      .pyramidStride = importance.pyramidStride,
                                      .viewWeight = settings.viewWeight};
    importance.pyramid =
        scope.buffer("importance.pyramid",
                     {.sizeBytes = uint64_t(importance.pyramidStride) * rsm.atlas.faceCount * sizeof(float)});
    if (importance.viewDependent()) importance.viewPoints = viewPoints;

    const uint32_t along = io::blocksAlong(rsm.largestFace);
    PassBuilder evaluate =
        scope.compute("importance.evaluate", importance.viewDependent() ? "importance/evaluate_view.comp"
                                                                        : "importance/evaluate_flux.comp");
    evaluate.read("texels", rsm.texels).read("faces", rsm.faces).read("maps", rsm.maps);
    if (importance.viewDependent()) evaluate.read("viewPoints", importance.viewPoints);
    evaluate.write("pyramid", importance.pyramid)
        .push(push)
        .dispatchGroups((along * along + 63) / 64, rsm.atlas.faceCount);

    scope.compute("importance.build_pyramid", "importance/build_pyramid.comp")
        .read("faces", rsm.faces)
        .readWrite("pyramid", importance.pyramid)
        .push(push)
        .dispatchGroups(rsm.atlas.faceCount);
    return importance;
}

}  // namespace ag::gi
