#include "engine/renderer/sky_gpu.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>

#include "engine/core/hash.h"
#include "engine/gpu/retire.h"
#include "engine/gpu/transfer.h"

namespace ag::render {
namespace {

using io::kMostHalf;

}  // namespace

gi::SkyTable skyTable(const Sky& sky, float lightUnit) {
    return gi::makeSkyTable({{sky.radiance.width, sky.radiance.height}, sky.radiance.pixels}, lightUnit);
}

// A sun in its picture is small, and not what surfaces get.
float SkyGpu::meanRadiance(const std::shared_ptr<const Sky>& sky) {
    if (!sky) return 0;
    if (sky_ == sky) return mean_;
    double sum = 0;
    for (const glm::vec3& p : sky->radiance.pixels)
        sum += double(std::max({p.x, p.y, p.z}));
    mean_ = float(sum / double(sky->radiance.pixels.size()));
    sky_ = sky;
    version_ = 0;
    return mean_;
}

void SkyGpu::load(float lightUnit) {
    const gi::SkyTable table = skyTable(*sky_, lightUnit);
    for (auto* old : {&texels_, &cells_, &upTo_})
        gpu::retire(device_, std::move(*old));
    texels_ =
        gpu::loadBuffer(device_, {.name = "scene.sky_texels", .texelFormat = gpu::kVec4Texels}, table.texels);
    cells_ = gpu::loadBuffer(device_, {.name = "scene.sky_cells"}, table.cells);
    upTo_ = gpu::loadBuffer(device_, {.name = "scene.sky_up_to"}, table.upTo);
    std::vector<uint64_t> halves;
    const Image& radiance = sky_->radiance;
    for (const glm::vec3& p : radiance.pixels)
        halves.push_back(glm::packHalf4x16(glm::vec4(glm::min(p / lightUnit, glm::vec3(kMostHalf)), 1)));
    gpu::retireOwned(device_, std::move(picture_));  // it may be in use
    picture_ = std::make_unique<gpu::Image>(
        device_, gpu::ImageDesc{.name = "scene.sky_picture",
                                .format = VK_FORMAT_R16G16B16A16_SFLOAT,
                                .size = {uint32_t(radiance.width), uint32_t(radiance.height)}});
    gpu::uploadImage(device_, *picture_, 0, std::as_bytes(std::span(halves)));
    lightUnit_ = lightUnit;
    version_ = hashBytes(std::as_bytes(std::span(radiance.pixels)), hashValue(lightUnit));
}

gi::SkyOnDevice SkyGpu::import(GraphScope scope, const std::shared_ptr<const Sky>& sky, float lightUnit,
                               ImageHandle& picture) {
    if (!sky) return {};
    meanRadiance(sky);  // it may be another one
    if (version_ == 0 || lightUnit_ != lightUnit) load(lightUnit);
    picture = scope.importImage("scene.sky_picture", *picture_, version_);
    return {.texels = scope.importBuffer("scene.sky_texels", *texels_, version_),
            .cells = scope.importBuffer("scene.sky_cells", *cells_, version_),
            .upTo = scope.importBuffer("scene.sky_up_to", *upTo_, version_),
            .version = version_};
}

uint64_t SkyGpu::deviceBytes() const {
    uint64_t bytes = picture_ ? uint64_t(picture_->desc().size.x) * picture_->desc().size.y * 8 : 0;
    for (const auto* buffer : {texels_.get(), cells_.get(), upTo_.get()})
        if (buffer) bytes += buffer->sizeBytes();
    return bytes;
}

}  // namespace ag::render
