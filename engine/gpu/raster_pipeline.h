// What a raster pipeline is made of besides its shaders: vertices, fixed functions, targets.
#pragma once

#include <span>

#include "engine/gpu/pipeline.h"

namespace ag::gpu {

// Fails (failure.h) if the device cannot make it.
VkPipeline makeRasterPipeline(Context& context, const RasterState& state,
                              std::span<const VkPipelineShaderStageCreateInfo> stages,
                              VkPipelineLayout layout);

}  // namespace ag::gpu
