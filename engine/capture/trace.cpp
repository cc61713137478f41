#include "engine/capture/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

namespace ag::capture {
namespace {

using Json = nlohmann::ordered_json;

constexpr int kCpu = 1, kGpu = 2;                   // processes
constexpr int kLoop = 1, kQueue = 1, kLeftOut = 2;  // their threads; those of systems follow the loop

// A row of the picture.
struct Track {
    int process = 0, thread = 0;
};
constexpr Track kFrameLoop{kCpu, kLoop}, kDevice{kGpu, kQueue};

class Trace {
  public:
    explicit Trace(const Capture& capture) : capture_(capture) {
        if (!capture.frames.empty()) {
            const Frame& first = capture.frames.front();
            start_ = first.systems.empty() ? first.cpu.begin
                                           : std::min(first.cpu.begin, first.systems.front().beginNs);
        }
        name("process_name", kCpu, 0, "CPU");
        name("thread_name", kCpu, kLoop, "frame loop");
        name("process_name", kGpu, 0, "GPU: " + capture.device);
        name("thread_name", kGpu, kQueue, "queue");
        name("thread_name", kGpu, kLeftOut, "skipped and dropped passes");
    }

    void add(const Frame& frame) {
        const std::string title =
            fmt::format("frame {}{}", frame.number, frame.forced ? " (nothing skipped)" : "");
        addCpu(frame, title);
        addSystems(frame);
        addGpu(frame, title);
        addLeftOut(frame);
        for (const Counter& counter : frame.counters)
            events_.push_back({{"name", counter.name},
                               {"ph", "C"},
                               {"pid", kCpu},
                               {"ts", micros(frame.cpu.declared)},
                               {"args", {{"value", counter.value}}}});
    }

    std::string text() const {
        const Json all = {{"displayTimeUnit", "ms"},
                          {"otherData",
                           {{"scene", capture_.scene},
                            {"device", capture_.device},
                            {"driver", capture_.driver},
                            {"settings", capture_.settings},
                            {"size", fmt::format("{}x{}", capture_.size.x, capture_.size.y)},
                            {"clock", capture_.clock}}},
                          {"traceEvents", events_}};
        return all.dump(1) + "\n";
    }

  private:
    // Whole nanoseconds, so that neighbours that touch do not overlap by rounding.
    double micros(uint64_t ns) const { return double(int64_t(ns - start_)) / 1000; }

    void name(const char* what, int process, int thread, const std::string& text) {
        events_.push_back(
            {{"name", what}, {"ph", "M"}, {"pid", process}, {"tid", thread}, {"args", {{"name", text}}}});
    }

    void slice(const std::string& title, const char* category, Track track, uint64_t begin, uint64_t end,
               Json args = Json::object()) {
        events_.push_back({{"name", title},
                           {"cat", category},
                           {"ph", "X"},
                           {"pid", track.process},
                           {"tid", track.thread},
                           {"ts", micros(begin)},
                           {"dur", double(end - begin) / 1000},
                           {"args", std::move(args)}});
    }

    // From a moment of one track to one of another, ns.
    void arrow(const char* title, Track fromTrack, uint64_t from, Track toTrack, uint64_t to) {
        const auto end = [&](const char* phase, Track track, uint64_t at) {
            Json e = {{"name", title},        {"cat", "flow"},       {"ph", phase},     {"id", flows_},
                      {"pid", track.process}, {"tid", track.thread}, {"ts", micros(at)}};
            if (*phase == 'f') e["bp"] = "e";  // the slice that is open then
            events_.push_back(std::move(e));
        };
        ++flows_;
        end("s", fromTrack, from);
        end("f", toTrack, to);
    }

    void addCpu(const Frame& f, const std::string& title) {
        slice(title, "frame", kFrameLoop, f.cpu.begin, f.cpu.submitted);
        slice("wait for the frame before last", "cpu", kFrameLoop, f.cpu.begin, f.cpu.waited);
        slice("declare passes", "cpu", kFrameLoop, f.cpu.waited, f.cpu.declared);
        slice("plan and record", "cpu", kFrameLoop, f.cpu.declared, f.cpu.recorded);
        slice("submit", "cpu", kFrameLoop, f.cpu.recorded, f.cpu.submitted);
    }

    Track trackOf(const Span& system) {
        auto found = std::ranges::find(threads_, system.thread);
        if (found == threads_.end()) {
            threads_.push_back(system.thread);
            found = threads_.end() - 1;
            name("thread_name", kCpu, kLoop + int(threads_.size()),
                 fmt::format("systems {}", threads_.size()));
        }
        return {kCpu, kLoop + 1 + int(found - threads_.begin())};
    }

    void addSystems(const Frame& f) {
        for (const Span& system : f.systems)
            slice(system.name, "system", trackOf(system), system.beginNs, system.endNs);
    }

    // The system whose data a pass takes from outside the frame, if it takes any.
    std::string_view writerOf(const PassDescription& pass) const {
        if (pass.name == "probes.points") return "extractProbes";
        const bool imports = std::ranges::any_of(pass.reads, [&](uint32_t r) {
            return r < capture_.resources.size() && capture_.resources[r].role == ResourceRole::kImport;
        });
        return imports || pass.uploads ? "extractScene" : "";
    }

    void addGpu(const Frame& f, const std::string& title) {
        if (f.gpu.empty()) return;
        slice(title, "frame", kDevice, f.gpu.front().beginNs, f.gpu.back().endNs);
        arrow("submitted", kFrameLoop, f.cpu.recorded, kDevice, f.gpu.front().beginNs);
        for (const Span& span : f.gpu) {
            const auto pass = std::ranges::find(f.passes, span.name, &PassDescription::name);
            if (pass == f.passes.end()) continue;
            slice(span.name, "pass", kDevice, span.beginNs, span.endNs,
                  {{"work", pass->work},
                   {"unit", unitName(pass->unit)},
                   {"resource bytes", pass->resourceBytes}});
            const auto writer = std::ranges::find(f.systems, writerOf(*pass), &Span::name);
            if (writer != f.systems.end())
                arrow("scene", trackOf(*writer), writer->beginNs, kDevice, span.beginNs);
        }
    }

    // Where the pass would have been: after the one before it that ran.
    void addLeftOut(const Frame& f) {
        size_t next = 0;
        uint64_t at = f.gpu.empty() ? f.cpu.submitted : f.gpu.front().beginNs;
        for (const PassDescription& pass : f.passes) {
            if (next < f.gpu.size() && f.gpu[next].name == pass.name) at = f.gpu[next++].endNs;
            if (pass.outcome == PassOutcome::kRan) continue;
            events_.push_back({{"name", pass.name},
                               {"cat", outcomeName(pass.outcome)},
                               {"ph", "i"},
                               {"s", "t"},
                               {"pid", kGpu},
                               {"tid", kLeftOut},
                               {"ts", micros(at)},
                               {"args", {{"outcome", outcomeName(pass.outcome)}, {"reason", pass.reason}}}});
        }
    }

    const Capture& capture_;
    Json events_ = Json::array();
    std::vector<uint64_t> threads_;
    uint64_t start_ = 0;
    uint64_t flows_ = 0;
};

}  // namespace

std::string traceJson(const Capture& capture) {
    Trace trace(capture);
    for (const Frame& frame : capture.frames)
        trace.add(frame);
    return trace.text();
}

}  // namespace ag::capture
