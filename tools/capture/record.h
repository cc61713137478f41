// Renders frames and notes what each step did when.
#pragma once

#include "engine/core/function_ref.h"
#include "tools/capture/capture.h"

namespace ag::capture {

struct RecordSettings {
    gi::GiSettings gi;
    FrameGraphOptions graph;
    glm::uvec2 size{640, 360};
    uint32_t warmUp = 6;   // frames before, with nothing skipped: pipelines get made, every pass gets a time
    uint32_t frames = 32;  // of which the table is made
};

// The scene of the next frame; a schedule that makes it leaves its systems' spans.
using NextScene = FunctionRef<const RenderScene&(std::vector<Span>& systems)>;

// Times: frames as they are, two in flight.
void recordFrames(gi::GiRenderer& renderer, NextScene next, const RecordSettings& settings, Capture& capture);

// Pictures: one frame in which no memory is shared, read back, and one for each debug view of a buffer.
void recordPictures(gi::GiRenderer& renderer, const RenderScene& scene, const RecordSettings& settings,
                    Capture& capture);

}  // namespace ag::capture
