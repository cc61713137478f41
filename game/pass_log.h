// Times and outcomes of each pass over a run, in the order of the frame.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "game/time_histogram.h"

namespace ag::game {

class PassLog {
  public:
    void add(const FrameGraph& graph);
    std::string text() const;

  private:
    struct Row {
        TimeHistogram ms;
        uint64_t frames = 0, ran = 0;
    };
    std::map<std::string, Row> rows_;
    std::vector<std::string> order_;
};

}  // namespace ag::game
