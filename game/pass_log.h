// Times and outcomes of each pass over a run, in the order of the frame.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/frame/frame_graph.h"

namespace ag::game {

double quantile(std::vector<double> values, double q);

class PassLog {
  public:
    void add(const FrameGraph& graph);
    std::string text() const;

  private:
    struct Row {
        std::vector<double> ms;
        uint64_t frames = 0, ran = 0;
    };
    std::map<std::string, Row> rows_;
    std::vector<std::string> order_;
};

}  // namespace ag::game
