// The structs both languages share lie the same in both: compiled shaders against offsetof.
#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <map>

#include "engine/gpu/shader_files.h"
#include "shaders/direct_lighting/direct_lighting_io.h"
#include "shaders/importance/importance_io.h"
#include "shaders/ism_atlas/ism_atlas_io.h"
#include "shaders/later_bounces/later_bounces_io.h"
#include "shaders/probes/probes_io.h"
#include "shaders/rsm/rsm_io.h"
#include "shaders/scene/scene_io.h"
#include "shaders/shadow_maps/shadow_maps_io.h"
#include "shaders/skinning/skinning_io.h"
#include "shaders/surface_points/surface_points_io.h"
#include "shaders/val_clustering/val_clustering_io.h"
#include "shaders/val_fit/val_fit_io.h"
#include "shaders/val_shading/val_shading_io.h"

namespace ag {
namespace {

struct Member {
    const char* name;
    size_t offset;
};
struct Layout {
    size_t sizeBytes;
    std::vector<Member> members;
};

#define AG_MEMBER(T, m)        \
    Member {                   \
#m, offsetof(io::T, m) \
    }

const std::map<std::string, Layout>& layouts() {
    static const std::map<std::string, Layout> all = {
        {"CameraConstants",
         {sizeof(io::CameraConstants),
          {AG_MEMBER(CameraConstants, clipFromWorld), AG_MEMBER(CameraConstants, worldFromClip),
           AG_MEMBER(CameraConstants, position), AG_MEMBER(CameraConstants, near),
           AG_MEMBER(CameraConstants, size)}}},
        {"Sun",
         {sizeof(io::Sun),
          {AG_MEMBER(Sun, direction), AG_MEMBER(Sun, firstView), AG_MEMBER(Sun, irradiance),
           AG_MEMBER(Sun, viewCount)}}},
        {"LampPush", {sizeof(io::LampPush), {AG_MEMBER(LampPush, lampCount)}}},
        {"ShadowView",
         {sizeof(io::ShadowView),
          {AG_MEMBER(ShadowView, clipFromWorld), AG_MEMBER(ShadowView, origin), AG_MEMBER(ShadowView, size),
           AG_MEMBER(ShadowView, texelSize), AG_MEMBER(ShadowView, farDistance)}}},
        {"SkinRow",
         {sizeof(io::SkinRow),
          {AG_MEMBER(SkinRow, firstVertex), AG_MEMBER(SkinRow, vertexCount),
           AG_MEMBER(SkinRow, firstDeformed), AG_MEMBER(SkinRow, firstJoint)}}},
        {"SkinnedVertex",
         {sizeof(io::SkinnedVertex), {AG_MEMBER(SkinnedVertex, joints), AG_MEMBER(SkinnedVertex, weights)}}},
        {"VertexRow",
         {sizeof(io::VertexRow),
          {AG_MEMBER(VertexRow, normal), AG_MEMBER(VertexRow, tangent), AG_MEMBER(VertexRow, uv)}}},
        {"Probe",
         {sizeof(io::Probe),
          {AG_MEMBER(Probe, position), AG_MEMBER(Probe, idLow), AG_MEMBER(Probe, normal),
           AG_MEMBER(Probe, idHigh)}}},
        {"BouncePoint",
         {sizeof(io::BouncePoint),
          {AG_MEMBER(BouncePoint, positionLocal), AG_MEMBER(BouncePoint, instance),
           AG_MEMBER(BouncePoint, normalLocal), AG_MEMBER(BouncePoint, area), AG_MEMBER(BouncePoint, albedo),
           AG_MEMBER(BouncePoint, edgesLocal)}}},
        {"ProbeRow",
         {sizeof(io::ProbeRow),
          {AG_MEMBER(ProbeRow, direct), AG_MEMBER(ProbeRow, idLow), AG_MEMBER(ProbeRow, bounced),
           AG_MEMBER(ProbeRow, idHigh)}}},
        {"RsmFace",
         {sizeof(io::RsmFace),
          {AG_MEMBER(RsmFace, worldFromClip), AG_MEMBER(RsmFace, clipFromWorld), AG_MEMBER(RsmFace, origin),
           AG_MEMBER(RsmFace, size), AG_MEMBER(RsmFace, map)}}},
        {"RsmMap",
         {sizeof(io::RsmMap),
          {AG_MEMBER(RsmMap, position), AG_MEMBER(RsmMap, kind), AG_MEMBER(RsmMap, direction),
           AG_MEMBER(RsmMap, range), AG_MEMBER(RsmMap, intensity), AG_MEMBER(RsmMap, cosInner),
           AG_MEMBER(RsmMap, cosOuter), AG_MEMBER(RsmMap, tanHalf), AG_MEMBER(RsmMap, firstFace),
           AG_MEMBER(RsmMap, faceCount), AG_MEMBER(RsmMap, firstCluster), AG_MEMBER(RsmMap, clusterCount),
           AG_MEMBER(RsmMap, lightIdLow), AG_MEMBER(RsmMap, candidateRadius)}}},
        {"RsmTexel",
         {sizeof(io::RsmTexel),
          {AG_MEMBER(RsmTexel, position), AG_MEMBER(RsmTexel, area), AG_MEMBER(RsmTexel, normal),
           AG_MEMBER(RsmTexel, weight), AG_MEMBER(RsmTexel, flux), AG_MEMBER(RsmTexel, emitterCosine)}}},
        {"RsmAtlas",
         {sizeof(io::RsmAtlas),
          {AG_MEMBER(RsmAtlas, size), AG_MEMBER(RsmAtlas, faceCount), AG_MEMBER(RsmAtlas, mapCount)}}},
        {"ViewPoint",
         {sizeof(io::ViewPoint),
          {AG_MEMBER(ViewPoint, position), AG_MEMBER(ViewPoint, weight), AG_MEMBER(ViewPoint, normal),
           AG_MEMBER(ViewPoint, depth)}}},
        {"ImportanceSettings",
         {sizeof(io::ImportanceSettings),
          {AG_MEMBER(ImportanceSettings, atlasSize), AG_MEMBER(ImportanceSettings, faceCount),
           AG_MEMBER(ImportanceSettings, pyramidStride), AG_MEMBER(ImportanceSettings, viewWeight)}}},
        {"ClusterSeed",
         {sizeof(io::ClusterSeed),
          {AG_MEMBER(ClusterSeed, position), AG_MEMBER(ClusterSeed, tile), AG_MEMBER(ClusterSeed, normal),
           AG_MEMBER(ClusterSeed, map), AG_MEMBER(ClusterSeed, chroma), AG_MEMBER(ClusterSeed, age)}}},
        {"Cluster",
         {sizeof(io::Cluster),
          {AG_MEMBER(Cluster, position), AG_MEMBER(Cluster, area), AG_MEMBER(Cluster, normal),
           AG_MEMBER(Cluster, texelCount), AG_MEMBER(Cluster, flux), AG_MEMBER(Cluster, lightIdLow),
           AG_MEMBER(Cluster, chroma), AG_MEMBER(Cluster, age), AG_MEMBER(Cluster, covarianceDiagonal),
           AG_MEMBER(Cluster, map), AG_MEMBER(Cluster, covarianceMixed), AG_MEMBER(Cluster, cosineSpread)}}},
        {"ClusterSettings",
         {sizeof(io::ClusterSettings),
          {AG_MEMBER(ClusterSettings, metricWeights), AG_MEMBER(ClusterSettings, clusterCount),
           AG_MEMBER(ClusterSettings, atlasSize), AG_MEMBER(ClusterSettings, mapCount),
           AG_MEMBER(ClusterSettings, viewWeight), AG_MEMBER(ClusterSettings, lookPeriod),
           AG_MEMBER(ClusterSettings, step)}}},
        {"Val",
         {sizeof(io::Val),
          {AG_MEMBER(Val, position), AG_MEMBER(Val, area), AG_MEMBER(Val, normal), AG_MEMBER(Val, thickness),
           AG_MEMBER(Val, flux), AG_MEMBER(Val, before)}}},
        {"ValShapeVectors",
         {sizeof(io::ValShapeVectors),
          {AG_MEMBER(ValShapeVectors, halfU), AG_MEMBER(ValShapeVectors, inverseRectangle),
           AG_MEMBER(ValShapeVectors, halfV), AG_MEMBER(ValShapeVectors, inversePolygon),
           AG_MEMBER(ValShapeVectors, corners), AG_MEMBER(ValShapeVectors, gradient)}}},
        {"ClusterExtent",
         {sizeof(io::ClusterExtent),
          {AG_MEMBER(ClusterExtent, texels), AG_MEMBER(ClusterExtent, before),
           AG_MEMBER(ClusterExtent, areaCentre)}}},
        {"SurfaceEdge",
         {sizeof(io::SurfaceEdge), {AG_MEMBER(SurfaceEdge, inward), AG_MEMBER(SurfaceEdge, distance)}}},
        {"SurfacePoint",
         {sizeof(io::SurfacePoint),
          {AG_MEMBER(SurfacePoint, position), AG_MEMBER(SurfacePoint, bend), AG_MEMBER(SurfacePoint, normal),
           AG_MEMBER(SurfacePoint, radius), AG_MEMBER(SurfacePoint, edges)}}},
        {"SurfaceSegment",
         {sizeof(io::SurfaceSegment),
          {AG_MEMBER(SurfaceSegment, centre), AG_MEMBER(SurfaceSegment, radiusAndArea)}}},
        {"IsmSplatPush",
         {sizeof(io::IsmSplatPush),
          {AG_MEMBER(IsmSplatPush, pointCount), AG_MEMBER(IsmSplatPush, firstSegment),
           AG_MEMBER(IsmSplatPush, endSegment), AG_MEMBER(IsmSplatPush, tileSize),
           AG_MEMBER(IsmSplatPush, firstEntry), AG_MEMBER(IsmSplatPush, entryCount),
           AG_MEMBER(IsmSplatPush, diskRadius), AG_MEMBER(IsmSplatPush, inverseExtent),
           AG_MEMBER(IsmSplatPush, contents)}}},
        {"IsmPlace",
         {sizeof(io::IsmPlace),
          {AG_MEMBER(IsmPlace, position), AG_MEMBER(IsmPlace, contents), AG_MEMBER(IsmPlace, normal),
           AG_MEMBER(IsmPlace, before), AG_MEMBER(IsmPlace, made)}}},
        {"IsmFinish", {sizeof(io::IsmFinish), {AG_MEMBER(IsmFinish, made), AG_MEMBER(IsmFinish, touched)}}},
        {"PointPush",
         {sizeof(io::PointPush), {AG_MEMBER(PointPush, firstGroup), AG_MEMBER(PointPush, pointCount)}}},
        {"IsmMapState",
         {sizeof(io::IsmMapState), {AG_MEMBER(IsmMapState, pointCount), AG_MEMBER(IsmMapState, kept)}}},
        {"ValShadingPush",
         {sizeof(io::ValShadingPush),
          {AG_MEMBER(ValShadingPush, valCount), AG_MEMBER(ValShadingPush, firstVal),
           AG_MEMBER(ValShadingPush, tileSize), AG_MEMBER(ValShadingPush, tiles),
           AG_MEMBER(ValShadingPush, nearReach), AG_MEMBER(ValShadingPush, ismTileSize)}}}};
    return all;
}

TEST(IoLayout, CompiledShadersAgreeWithTheHeaders) {
    std::map<std::string, int> seen;
    int modules = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(AFTERGLOW_SHADER_DIR)) {
        if (entry.path().extension() != ".spv") continue;
        const std::string path =
            std::filesystem::relative(entry.path(), AFTERGLOW_SHADER_DIR).replace_extension().string();
        const auto module = gpu::loadShader(path);
        ASSERT_TRUE(module) << module.error().message;
        EXPECT_LE(module->pushSizeBytes, 128u) << path;
        ++modules;
        for (const gpu::ShaderStruct& s : module->structs) {
            const auto known = layouts().find(s.name);
            if (known == layouts().end()) continue;
            ++seen[s.name];
            ASSERT_EQ(s.members.size(), known->second.members.size()) << path << ' ' << s.name;
            for (size_t m = 0; m < s.members.size(); ++m) {
                EXPECT_EQ(s.members[m].name, known->second.members[m].name) << path << ' ' << s.name;
                EXPECT_EQ(s.members[m].offset, known->second.members[m].offset)
                    << path << ' ' << s.name << '.' << s.members[m].name;
            }
        }
    }
    EXPECT_GT(modules, 20);
    for (const auto& [name, layout] : layouts())
        EXPECT_GT(seen[name], 0) << name << " appears in no shader";
}

}  // namespace
}  // namespace ag
