// What was seen of a scene's frames: the plain data behind the table, the trace, the graph and the report.
#pragma once

#include <string>
#include <vector>

#include "engine/core/image.h"
#include "engine/frame/frame_description.h"
#include "engine/renderer/renderer.h"

namespace ag::capture {

// A system of the schedule, or a pass on the device; on the host's steady clock.
struct Span {
    std::string name;
    uint64_t beginNs = 0, endNs = 0;
    uint64_t thread = 0;  // of a system
};

struct Counter {
    std::string_view name;
    double value = 0;
};

// What the device counted in a pass when it ran.
struct Count {
    std::string pass;
    PassCount counted;
};

struct Frame {
    uint64_t number = 0;  // the graph's
    bool forced = false;  // warm-up: nothing was skipped
    render::FrameMoments cpu;
    std::vector<PassDescription> passes;  // with what became of each
    std::vector<Span> gpu;                // of those that ran, in order
    std::vector<Span> systems;            // of the schedule that fed the frame, if one did
    std::vector<Counter> counters;
    std::vector<std::string> madeAnew;  // sentences
};

// An intermediate as it was after the last frame.
struct Picture {
    std::string name;  // of the resource, or view.NAME for what a debug view makes of a buffer
    std::string pass;  // that wrote it last
    std::string format;
    Image pixels;
};

// What pictures need to be shown as the frame itself was.
struct Look {
    float cameraNear = 0.1f;  // m; gives depths their distances
    float exposure = 0;       // stops
    uint32_t tonemap = 0;     // render::Tonemap
};

struct Capture {
    std::string scene, device, driver, settings, clock;  // clock: how both sides' times were brought together
    glm::uvec2 size{0};
    render::RenderSettings gi;
    Look look;
    std::vector<Frame> frames;
    std::vector<ResourceDescription> resources;  // of the last frame; its passes' reads and writes point here
    std::vector<Picture> pictures;
    std::vector<Count> counts;  // of the frame the pictures are from; empty where the device counts nothing
    std::string frameDot, scheduleDot;                       // for Graphviz
    std::vector<std::string> systems;                        // of the schedule, in order
    std::vector<std::pair<uint32_t, uint32_t>> systemEdges;  // before, after
};

}  // namespace ag::capture
