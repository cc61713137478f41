// The scene's sky in device memory: as it is seen, and as rays are drawn by it.
#pragma once

#include <memory>

#include "engine/gpu/device.h"
#include "engine/gpu/resources.h"
#include "engine/scene/sky.h"
#include "gi/sky.h"

namespace ag::render {

class SkyGpu {
  public:
    explicit SkyGpu(gpu::Device& device) : device_(device) {}

    // Of all directions, the strongest channel, W/(m² sr); null: 0.
    float meanRadiance(const std::shared_ptr<const Sky>& sky);
    // Blocking where the sky is another one. Null: none. Radiance is over `lightUnit`.
    gi::SkyOnDevice import(GraphScope scope, const std::shared_ptr<const Sky>& sky, float lightUnit,
                           ImageHandle& picture);
    uint64_t deviceBytes() const;

  private:
    void load(float lightUnit);

    gpu::Device& device_;
    std::shared_ptr<const Sky> sky_;
    float mean_ = 0, lightUnit_ = 1;
    std::unique_ptr<gpu::Image> picture_;
    std::unique_ptr<gpu::Buffer> texels_, cells_, upTo_;
    uint64_t version_ = 0;  // 0: it is not loaded
};

gi::SkyTable skyTable(const Sky& sky, float lightUnit);

}  // namespace ag::render
