#include "game/pass_log.h"

#include <fmt/format.h>

#include <algorithm>

namespace ag::game {

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

void PassLog::add(const FrameGraph& graph) {
    for (const PassReport& pass : graph.report()) {
        auto [entry, added] = rows_.try_emplace(std::string(pass.name));
        if (added) order_.push_back(entry->first);
        ++entry->second.frames;
        entry->second.ran += pass.outcome == PassOutcome::kRan;
        if (pass.gpuMs > 0) entry->second.ms.push_back(pass.gpuMs);
    }
}

std::string PassLog::text() const {
    std::string out = fmt::format("{:<36} {:>10} {:>10} {:>8}\n", "pass", "median ms", "p99 ms", "skipped");
    for (const std::string& name : order_) {
        const Row& row = rows_.at(name);
        out += fmt::format("{:<36} {:>10.3f} {:>10.3f} {:>7.0f}%\n", name, quantile(row.ms, 0.5),
                           quantile(row.ms, 0.99), 100.0 * double(row.frames - row.ran) / double(row.frames));
    }
    return out;
}

}  // namespace ag::game
