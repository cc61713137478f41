// Float RGB images for references, comparisons and pictures, with the files they live in.
#pragma once

#include <glm/glm.hpp>
#include <map>
#include <string>
#include <vector>

#include "engine/core/result.h"

namespace ag {

struct Image {
    int width = 0, height = 0;
    std::vector<glm::vec3> pixels;                  // rows from the top
    std::map<std::string, std::string> attributes;  // what was measured, by name; only EXR files keep them

    Image() = default;
    Image(int w, int h) : width(w), height(h), pixels(size_t(w) * size_t(h), glm::vec3(0)) {}
    glm::vec3& at(int x, int y) { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
    const glm::vec3& at(int x, int y) const { return pixels[size_t(y) * size_t(width) + size_t(x)]; }
};

// By extension: .exr and .pfm hold linear floats; .png takes display values in [0, 1]. A file that cannot be
// written whole is not left behind.
Status saveImage(const Image& image, const std::string& path);
Result<Image> loadImage(const std::string& path);  // .exr, .hdr or .pfm

}  // namespace ag
