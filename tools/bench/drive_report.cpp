#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "tools/bench/drive.h"

namespace ag::bench {
namespace {

constexpr std::array kParts = {
    std::pair{"whole", &FrameCost::whole},   std::pair{"cpu", &FrameCost::cpu},
    std::pair{"world", &FrameCost::world},   std::pair{"extract", &FrameCost::extract},
    std::pair{"render", &FrameCost::render}, std::pair{"device", &FrameCost::device}};
constexpr double kMib = 1 << 20;

uint64_t mostUploaded(const DriveReport& r) {
    uint64_t most = 0;
    for (const FrameCost& frame : r.frames)
        most = std::max(most, frame.uploadedBytes);
    return most;
}

}  // namespace

std::string driveToText(const DriveReport& r) {
    std::string out = fmt::format("{}: {} instances, {} of them move, {} lights, {} frames\n", r.scene,
                                  r.instances, r.movers, r.lights, r.frames.size());
    for (const auto& [name, part] : kParts) {
        const Spread s = r.of(part);
        out += fmt::format("  {:<8} median {:8.2f} ms   p99 {:8.2f} ({:.2f})   worst {:8.2f} ({:.2f})\n",
                           name, s.median, s.p99, s.median > 0 ? s.p99 / s.median : 0, s.worst,
                           s.median > 0 ? s.worst / s.median : 0);
    }
    out += fmt::format("  frames in which an upload waited: {}; most uploaded in a frame: {:.2f} MiB\n",
                       r.framesThatWaited, double(mostUploaded(r)) / kMib);
    for (size_t i = 0; i < r.roundMib.size(); ++i)
        out += fmt::format("  after round {}: {:.0f} MiB in use, {:.0f} MiB of them the device's\n", i + 1,
                           r.roundMib[i], double(r.roundDeviceBytes[i]) / kMib);
    for (const LongFrame& frame : r.longest) {
        out += fmt::format("  frame {:>5}: {:8.2f} ms", frame.frame, frame.ms);
        for (const Culprit& c : frame.culprits)
            out += fmt::format("; {} {:+.2f}{}", c.step, c.excess, c.why.empty() ? "" : " (" + c.why + ")");
        out += '\n';
    }
    return out;
}

std::string driveToJson(const DriveReport& r) {
    nlohmann::ordered_json json{{"scene", r.scene},   {"device", r.device}, {"instances", r.instances},
                                {"movers", r.movers}, {"lights", r.lights}, {"frames", r.frames.size()}};
    for (const auto& [name, part] : kParts) {
        const Spread s = r.of(part);
        json[std::string(name) + "_ms"] = {{"median", s.median}, {"p99", s.p99}, {"worst", s.worst}};
    }
    json["frames_that_waited"] = r.framesThatWaited;
    json["most_uploaded_bytes"] = mostUploaded(r);
    json["round_mib"] = r.roundMib;
    json["round_device_bytes"] = r.roundDeviceBytes;
    for (const LongFrame& frame : r.longest) {
        nlohmann::ordered_json row{{"frame", frame.frame}, {"ms", frame.ms}};
        for (const Culprit& c : frame.culprits)
            row["causes"].push_back({{"step", c.step}, {"excess_ms", c.excess}, {"why", c.why}});
        json["longest"].push_back(row);
    }
    return json.dump(2) + "\n";
}

}  // namespace ag::bench
