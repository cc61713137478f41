// The parts of the importer, in the order they run. Private to engine/scene.
#pragma once

#include <tiny_gltf.h>

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/scene/gltf_import.h"

namespace ag::gltf {

using Fault = std::optional<std::string>;  // what is wrong, without the file's name

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

void importMaterials(const tinygltf::Model& model, SceneAsset& asset);
// After importMaterials: sets every material's class and layers.
Fault importTextures(const tinygltf::Model& model, SceneAsset& asset, const ImportLimits& limits);
Fault importMeshes(const tinygltf::Model& model, SceneAsset& asset);
// `newIndex`: of each node of the file in the asset, -1: not in its scene.
Fault importNodes(const tinygltf::Model& model, SceneAsset& asset, std::vector<int32_t>& newIndex);

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
