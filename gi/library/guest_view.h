// A host's camera and its G-buffer: what is behind an AgiView. Its frame is a list of passes like the
// renderer's.
#pragma once

#include <memory>

#include "engine/core/settings.h"
#include "gi/bounce_light.h"
#include "gi/library/rsm_draws.h"
#include "gi/library/scene_on_device.h"

namespace ag::guest {

class GuestView {
  public:
    GuestView(GuestContext& context, const gi::BounceLightSettings& settings);
    ~GuestView();
    GuestView(const GuestView&) = delete;
    GuestView& operator=(const GuestView&) = delete;

    void record(GuestScene& scene, VkCommandBuffer commands, const AgiFrame& frame);
    // Pipelines and points for a frame like that, without one.
    void prepare(GuestScene& scene, const AgiFrame& frame);
    // Without anything of the frames before.
    void startAnew();

    Settings& options() { return options_; }
    FrameGraph& graph() { return *graph_; }
    const gi::ProbeReadings& readings() const { return history_.bounce.probes.readings; }
    uint32_t virtualLights() const { return virtualLights_; }
    float settled() const;
    GuestContext& context() const { return context_; }
    AgiFrame last{};  // as it was recorded last, or as agiCreateView was told

  private:
    struct Images;
    struct History {
        gi::BounceLightHistory bounce;
        gi::SkyHistory sky;
    };
    gi::BounceLight declare(GraphScope scope, GuestScene& scene, const AgiFrame& frame, const Images& images,
                            History& history);
    gi::Surfaces readSurfaces(GraphScope scope, const AgiFrame& frame, const Images& images) const;
    void noteCamera(const AgiFrame& frame);
    gi::BounceLightSettings raySettings() const;
    void keepReadings(const AgiFrame& frame, gi::ProbeReadings before);

    GuestContext& context_;
    gi::BounceLightSettings settings_;
    Settings options_;
    std::unique_ptr<FrameGraph> graph_;
    History history_;
    std::unique_ptr<SceneOnDevice> surfaces_;
    std::unique_ptr<RsmDraws> rsms_;
    struct Eyes {
        RenderCamera camera;
        glm::mat4 steadyClip{0};  // without the camera's jitter
        // Of the camera, and of where it would look without its jitter.
        uint64_t cameraVersion = 1, viewVersion = 1;
    };
    Eyes eyes_;
    uint32_t virtualLights_ = 0;
    std::array<uint64_t, kFramesInFlight> hostFrames_{};  // in which the graph's last frames were recorded
};

}  // namespace ag::guest
