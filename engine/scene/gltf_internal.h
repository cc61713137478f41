// The parts of the importer, in the order they run. Private to engine/scene.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_import.h"

namespace ag::gltf {

constexpr float kFarthest = 1e12f;  // m: squares stay within the range of floats

using Fault = std::optional<std::string>;  // what is wrong, without the file's name

// Before anything is parsed: the JSON as tinygltf reads it. Buffers without bytes, which compressed files
// have in place of what they decompress to, get one; images of other formats in the text itself are of a type
// that it knows. `binary`: buffer 0 is the GLB's own.
std::string readableJson(std::string_view json, bool binary);
// Before validate: EXT_meshopt_compression's views and KHR_draco_mesh_compression's primitives become plain
// buffers.
Fault decompress(tinygltf::Model& model, const ImportLimits& limits);

// What the file asks for; `canRequire`: whether a file that is lost without an extension can be shown.
std::vector<SceneFeature> featuresOf(const tinygltf::Model& model);
bool canRequire(std::string_view extension);

// Everything an index, a count or an offset could break.
Fault validate(const tinygltf::Model& model, const ImportLimits& limits);
Fault checkSkins(const tinygltf::Model& model, const ImportLimits& limits);
Fault checkAnimations(const tinygltf::Model& model, const ImportLimits& limits);

// Elements of a validated accessor as floats (normalised integers converted), `components` of each kept or
// padded with zero; sparse values applied.
std::vector<float> readFloats(const tinygltf::Model& model, int accessor, int components);
std::vector<uint32_t> readUints(const tinygltf::Model& model, int accessor, int components);

// Which elements an accessor's sparse values replace; its ranges are checked already.
std::vector<uint32_t> sparseRows(const tinygltf::Model& model, const tinygltf::Accessor& accessor);

// Of an image that no package here reads; its texture is left out.
void skipImage(tinygltf::Image& image);
bool isSkippedImage(const tinygltf::Image& image);
// The image a texture shows, of a validated file; -1: none that can be read (KHR_texture_basisu alone).
int imageOf(const tinygltf::Model& model, int texture);

void importMaterials(const tinygltf::Model& model, SceneAsset& asset);
// After importMaterials: sets every material's class and layers.
Fault importTextures(const tinygltf::Model& model, SceneAsset& asset, const ImportLimits& limits);
// The surroundings that light the file's scene; none: as it was.
void importSky(const tinygltf::Model& model, SceneAsset& asset);
// The set of texture coordinates that a material's textures are looked up with, and whether another of its
// textures asks for a second set.
std::pair<int, bool> uvSetsOf(const tinygltf::Material& m);
// Whether a node asks for other morph weights than its mesh has.
bool hasOwnMorph(const tinygltf::Model& model, const tinygltf::Node& n);
// The file's meshes, then one for each of its nodes that has morph weights of its own. `meshOfNode`: of each
// node of the file in the asset.
Fault importMeshes(const tinygltf::Model& model, SceneAsset& asset, std::vector<int32_t>& meshOfNode);
// `newIndex`: of each node of the file in the asset, -1: not in its scene.
Fault importNodes(const tinygltf::Model& model, std::span<const int32_t> meshOfNode,
                  const ImportLimits& limits, SceneAsset& asset, std::vector<int32_t>& newIndex);

// A primitive's joints and weights: the strongest four of each vertex. None: empty.
Fault readSkin(const tinygltf::Model& model, const tinygltf::Primitive& p, const std::string& what,
               std::vector<SkinVertex>& skin);
// After importNodes.
Fault importSkins(const tinygltf::Model& model, std::span<const int32_t> newIndex, SceneAsset& asset,
                  const ImportLimits& limits);
Fault importAnimations(const tinygltf::Model& model, std::span<const int32_t> newIndex, SceneAsset& asset);

// A number in an extension's object, or the fallback.
double numberOf(const tinygltf::Value& object, const char* key, double fallback);
// The same within the range in which products stay finite.
float floatOf(const tinygltf::Value& object, const char* key, double fallback);
float floatOf(double number);

}  // namespace ag::gltf
