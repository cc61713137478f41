// EXT_lights_image_based as a sky. Its specular images are prefiltered for one roughness each; the finest
// level is what they were all made from, so that alone is read, and what its coefficients of irradiance say
// follows from it.
#include <algorithm>
#include <cmath>

#include <glm/gtc/quaternion.hpp>

#include "engine/scene/gltf_internal.h"

namespace ag::gltf {
namespace {

using tinygltf::Model, tinygltf::Value;

constexpr char kExtension[] = "EXT_lights_image_based";
constexpr int kLongestRow = 2048;  // of the sky's picture

struct Cube {
    int side = 0;
    std::array<std::vector<glm::vec3>, 6> faces;  // +X -X +Y -Y +Z -Z, rows from the top, seen from within
};

// What is within it by that name or index; null: nothing.
const Value* within(const Value* value, const char* key) {
    return value && value->IsObject() && value->Has(key) ? &value->Get(key) : nullptr;
}
const Value* within(const Value* value, size_t index) {
    return value && value->IsArray() && index < value->ArrayLen() ? &value->Get(int(index)) : nullptr;
}
const Value* extensionOf(const tinygltf::ExtensionMap& extensions) {
    const auto found = extensions.find(kExtension);
    return found == extensions.end() ? nullptr : &found->second;
}

// That the file's scene is lit by.
const Value* lightOf(const Model& model) {
    const size_t scene = model.defaultScene < 0 ? 0 : size_t(model.defaultScene);
    if (scene >= model.scenes.size()) return nullptr;
    const Value* use = extensionOf(model.scenes[scene].extensions);
    if (!use || !use->IsObject()) return nullptr;
    const double index = numberOf(*use, "light", -1);
    if (!(index >= 0) || index > 1e6) return nullptr;
    return within(within(extensionOf(model.extensions), "lights"), size_t(index));
}

// RGBD: colours of a display (2.2), over a share in the place of alpha.
glm::vec3 radianceOf(const unsigned char* texel) {
    const float share = std::max(float(texel[3]), 1.0f) / 255;
    const glm::vec3 colour = glm::vec3(texel[0], texel[1], texel[2]) / 255.0f;
    return glm::pow(colour, glm::vec3(2.2f)) / share;
}

bool readFace(const Model& model, const Value* index, Cube& cube, std::vector<glm::vec3>& face) {
    if (!index || !index->IsNumber()) return false;
    const double at = index->GetNumberAsDouble();
    if (!(at >= 0 && at < double(model.images.size()))) return false;
    const tinygltf::Image& image = model.images[size_t(at)];
    if (isSkippedImage(image) || image.width != image.height) return false;
    if (cube.side == 0) cube.side = image.width;
    if (cube.side != image.width) return false;
    const size_t texels = size_t(cube.side) * size_t(cube.side);
    face.reserve(texels);
    for (size_t i = 0; i < texels; ++i)
        face.push_back(radianceOf(&image.image[4 * i]));
    return true;
}

std::optional<Cube> readFinestCube(const Model& model, const Value& light) {
    const Value* finest = within(within(&light, "specularImages"), size_t(0));
    Cube cube;
    for (size_t i = 0; i < cube.faces.size(); ++i)
        if (!readFace(model, within(finest, i), cube, cube.faces[i])) return std::nullopt;
    return cube;
}

struct FacePlace {
    size_t face;
    glm::vec2 place;  // in [0, 1], from the left and from the top
};

FacePlace facePlace(glm::vec3 d) {
    const glm::vec3 a = glm::abs(d);
    const size_t axis = a.x >= a.y && a.x >= a.z ? 0 : a.y >= a.z ? 1 : 2;
    const bool negative = d[int(axis)] < 0;
    const float sign = negative ? -1.0f : 1.0f;
    const glm::vec2 right = axis == 0   ? glm::vec2(sign * d.z, -d.y)
                            : axis == 1 ? glm::vec2(-d.x, sign * d.z)
                                        : glm::vec2(-sign * d.x, -d.y);
    return {2 * axis + negative, right / a[int(axis)] * 0.5f + 0.5f};
}

// Bilinear within a face.
glm::vec3 cubeRadiance(const Cube& cube, glm::vec3 direction) {
    const FacePlace at = facePlace(direction);
    const glm::vec2 texel = glm::clamp(at.place * float(cube.side) - 0.5f, 0.0f, float(cube.side - 1));
    const glm::ivec2 low(texel), high = glm::min(low + 1, cube.side - 1);
    const glm::vec2 f = texel - glm::vec2(low);
    const auto of = [&](int x, int y) {
        return cube.faces[at.face][size_t(y) * size_t(cube.side) + size_t(x)];
    };
    return glm::mix(glm::mix(of(low.x, low.y), of(high.x, low.y), f.x),
                    glm::mix(of(low.x, high.y), of(high.x, high.y), f.x), f.y);
}

glm::quat rotationOf(const Value& light) {
    const Value* r = within(&light, "rotation");
    glm::quat q(1, 0, 0, 0);
    for (size_t i = 0; i < 4; ++i) {
        const Value* number = within(r, i);
        if (!number || !number->IsNumber()) return {1, 0, 0, 0};
        const float n = floatOf(number->GetNumberAsDouble());
        (i == 0 ? q.x : i == 1 ? q.y : i == 2 ? q.z : q.w) = n;
    }
    const float length = glm::length(q);
    return length > 1e-6f && std::isfinite(length) ? q / length : glm::quat(1, 0, 0, 0);
}

constexpr std::array kAsides = {glm::vec2(0.25f, 0.25f), glm::vec2(0.75f, 0.25f), glm::vec2(0.25f, 0.75f),
                                glm::vec2(0.75f, 0.75f)};

// Four directions a texel.
Sky skyOf(const Cube& cube, glm::quat turn, float intensity) {
    const int width = std::clamp(4 * cube.side, 4, kLongestRow);
    Sky sky{.radiance = Image(width, width / 2)};
    const glm::vec2 size(width, width / 2);
    const glm::quat back = glm::conjugate(turn);
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 sum(0);
            for (const glm::vec2 aside : kAsides)
                sum += cubeRadiance(cube, back * skyDirection((glm::vec2(x, y) + aside) / size));
            sky.radiance.at(x, y) = glm::clamp(sum * (0.25f * intensity), 0.0f, kMostSkyRadiance);
        }
    return sky;
}

}  // namespace

void importSky(const Model& model, SceneAsset& asset) {
    const Value* light = lightOf(model);
    if (!light || !light->IsObject()) return;
    const auto cube = readFinestCube(model, *light);
    if (!cube) {
        asset.warnings.push_back("its image-based light lacks six square images of one size: it is left out");
        return;
    }
    const float intensity = std::max(floatOf(*light, "intensity", 1), 0.0f);
    asset.sky = std::make_shared<const Sky>(skyOf(*cube, rotationOf(*light), intensity));
}

}  // namespace ag::gltf
