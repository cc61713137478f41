#include <cstdlib>
#include <filesystem>

#include "engine/scene/gltf_export.h"
#include "engine/scene/gltf_import.h"
#include "tools/stress/cases.h"

namespace ag::stress {
namespace {

namespace fs = std::filesystem;

// Through a file and the importer, as bad geometry comes.
Result<SceneAsset> throughFile(const SceneAsset& asset) {
    char folder[] = "/tmp/afterglow_stress_XXXXXX";
    if (!mkdtemp(folder)) return Error{"no temporary folder can be made"};
    const std::string file = std::string(folder) + "/scene.glb";
    const Status written = exportGlb(asset, file);
    Result<SceneAsset> read = written ? importGltf(file) : Result<SceneAsset>(written.error());
    std::error_code ignored;
    fs::remove_all(folder, ignored);
    return read;
}

// Every primitive gets a triangle of one point, and one whose corners lie on a line.
SceneAsset withFlatTriangles() {
    SceneAsset asset = cornell();
    GeometryArrays& g = asset.geometry;
    std::vector<uint32_t> indices;
    for (Primitive& p : g.primitives) {
        const auto first = g.indices.begin() + p.firstIndex;
        const uint32_t begin = uint32_t(indices.size()), a = *first, b = first[1];
        indices.insert(indices.end(), first, first + p.indexCount);
        indices.insert(indices.end(), {a, a, a, a, b, a});
        p.firstIndex = begin;
        p.indexCount += 6;
    }
    g.indices = std::move(indices);
    return asset;
}

SceneAsset withNormals(FunctionRef<void(size_t, glm::vec3&)> change) {
    SceneAsset asset = cornell();
    for (size_t i = 0; i < asset.geometry.attributes.size(); ++i)
        change(i, asset.geometry.attributes[i].normal);
    return asset;
}

void sameImage(const Bench& bench, const std::string& name, const SceneAsset& bad) {
    if (!bench.wants(name)) return;
    auto read = throughFile(bad);
    if (!read) return bench.report({name, "relative RMSE", 1, 0, read.error().message});
    const Still truth = renderStill(bench, throughFile(cornell()).value()), still = renderStill(bench, *read);
    bench.report({name, "relative RMSE", relativeRmse(truth.image, still.image), 1e-3, still.fault});
}

}  // namespace

void runBadGeometry(const Bench& bench) {
    sameImage(bench, "triangles without area", withFlatTriangles());
    sameImage(bench, "normals of any length",
              withNormals([](size_t i, glm::vec3& n) { n *= 1e-3f + 37.0f * float(i % 5); }));
    sameImage(bench, "missing normals", withNormals([](size_t, glm::vec3& n) { n = glm::vec3(0); }));
    sameImage(bench, "normals that are no numbers",
              withNormals([](size_t i, glm::vec3& n) { n[int(i % 3)] = i % 2 ? NAN : INFINITY; }));
    const std::string name = "a corner that is no number";
    if (!bench.wants(name)) return;
    SceneAsset bad = cornell();
    bad.geometry.positions[7].y = NAN;
    const auto read = throughFile(bad);
    bench.report({name,
                  "files read that should be refused",
                  read ? 1.0 : 0.0,
                  0,
                  {},
                  read ? "" : read.error().message});
}

}  // namespace ag::stress
