// A host's device as the library uses it: what is behind an AgiContext.
#pragma once

#include "engine/gpu/context.h"
#include "engine/gpu/pipeline.h"
#include "engine/gpu/resources.h"
#include "gi/include/afterglow/afterglow_gi.h"

namespace ag::guest {

class GuestContext {
  public:
    // `info` is whole.
    explicit GuestContext(const AgiContextInfo& info);
    ~GuestContext();
    GuestContext(const GuestContext&) = delete;
    GuestContext& operator=(const GuestContext&) = delete;

    gpu::Context& gpu() { return gpu_; }
    gpu::PipelineLibrary& pipelines() { return pipelines_; }
    VkSampler albedoSampler() const { return albedoSampler_; }
    // What a draw binds where its material has no map: one white texel.
    VkImageView white() const { return white_.view(); }
    // Once, into the first command buffer of all.
    void fillWhite(VkCommandBuffer commands);
    // What was recorded into the frame's command buffer will not be executed.
    void forgetFrame(uint64_t frame);

    // Of a frame that is about to be recorded.
    void beginFrame(uint64_t frame, uint64_t framesDone);
    uint64_t lastFrame() const { return lastFrame_; }
    uint64_t nameScene() { return ++scenes_; }  // another number for each

  private:
    void makeSampler();

    gpu::Context gpu_;
    gpu::PipelineLibrary pipelines_;
    gpu::Image white_;
    VkSampler albedoSampler_ = VK_NULL_HANDLE;
    uint64_t whiteFrame_ = 0;  // that fills it; 0: none yet
    uint64_t lastFrame_ = 0, scenes_ = 0;
};

// With the instance's functions, and those of the device if there is one.
gpu::Functions loadFunctions(PFN_vkGetInstanceProcAddr getInstanceProcAddr, VkInstance instance,
                             VkDevice device);

}  // namespace ag::guest
