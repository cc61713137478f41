#include "engine/capture/schedule_spans.h"

namespace ag::capture {

void noteSystems(const Schedule& schedule, std::vector<Span>& spans) {
    for (size_t i = 0; i < schedule.spans().size(); ++i) {
        const SystemSpan& span = schedule.spans()[i];
        spans.push_back({schedule.name(i), span.beginNs, span.endNs, span.thread});
    }
}

void describeSchedule(Schedule& schedule, Capture& capture) {
    const JobGraph& graph = schedule.graph();
    const uint32_t first = uint32_t(capture.systems.size());
    capture.scheduleDot += graph.graphviz();
    for (uint32_t i = 0; i < graph.nodes.size(); ++i) {
        capture.systems.push_back(graph.nodes[i].name);
        for (uint32_t next : graph.nodes[i].next)
            capture.systemEdges.push_back({first + i, first + next});
    }
}

}  // namespace ag::capture
