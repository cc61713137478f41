#include "game/pass_log.h"

#include <fmt/format.h>

namespace ag::game {

void PassLog::add(const FrameGraph& graph) {
    for (const PassReport& pass : graph.report()) {
        auto [entry, added] = rows_.try_emplace(std::string(pass.name));
        if (added) order_.push_back(entry->first);
        ++entry->second.frames;
        entry->second.ran += pass.outcome == PassOutcome::kRan;
        entry->second.ms.add(pass.gpuMs);
    }
}

std::string PassLog::text() const {
    std::string out = fmt::format("{:<36} {:>10} {:>10} {:>8}\n", "pass", "median ms", "p99 ms", "skipped");
    for (const std::string& name : order_) {
        const Row& row = rows_.at(name);
        out += fmt::format("{:<36} {:>10.3f} {:>10.3f} {:>7.0f}%\n", name, row.ms.quantile(0.5),
                           row.ms.quantile(0.99), 100.0 * double(row.frames - row.ran) / double(row.frames));
    }
    return out;
}

}  // namespace ag::game
