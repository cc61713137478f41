// glTF and GLB files to the importer; what it lets through must hold together.
#include <cmath>

#include "engine/scene/deform.h"
#include "engine/scene/gltf_import.h"
#include "engine/scene/static_scene.h"
#include "tests/fuzz/as_file.h"

namespace {

void require(bool good) {
    if (!good) std::abort();
}

void checkAsset(const ag::SceneAsset& asset) {
    const ag::GeometryArrays& g = asset.geometry;
    for (const ag::Primitive& p : g.primitives) {
        require(size_t(p.firstIndex) + p.indexCount <= g.indices.size() && p.material < g.materials.size());
        for (uint32_t i = p.firstIndex; i < p.firstIndex + p.indexCount; ++i)
            require(size_t(p.vertexOffset) + g.indices[i] < g.positions.size());
    }
    for (const ag::VertexAttributes& a : g.attributes)
        require(std::isfinite(a.normal.x + a.normal.y + a.normal.z));
    const ag::RenderScene scene = ag::staticScene(asset);
    for (const ag::RenderInstance& i : scene.instances)
        require(i.primitive < g.primitives.size() && std::isfinite(glm::length(i.worldFromLocal[3])));
    ag::SceneAsset moved = asset;
    for (ag::SceneNode& node : moved.nodes)
        node.extras.clipStart = 0.37f;
    for (const ag::RenderScene& posed : {scene, ag::staticScene(moved)}) {
        const ag::DeformedVertices bent = ag::deformSkinnedMeshes(posed);
        for (const ag::RenderSkinnedMesh& f : posed.skinnedMeshes)
            for (uint32_t v = 0; v < f.vertexCount; ++v)
                require(std::isfinite(glm::length(glm::dvec3(bent.positions[f.firstDeformed + v]))));
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    const ag::ImportLimits limits{.fileBytes = 1 << 20,
                                  .vertices = 100'000,
                                  .indices = 300'000,
                                  .zeroElements = 1000,
                                  .nodes = 1000,
                                  .joints = 10'000,
                                  .keyValues = 100'000,
                                  .imageSide = 512,
                                  .imageTexels = 1 << 18,
                                  .layerTexels = 1 << 20};
    const auto asset = ag::importGltf(ag::fuzz::asFile(bytes, size, ".glb"), limits);
    if (asset)
        checkAsset(*asset);
    else
        require(!asset.error().message.empty());
    return 0;
}
