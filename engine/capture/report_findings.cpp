#include "engine/capture/report_findings.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/capture/advice.h"
#include "engine/capture/gaps.h"

namespace ag::capture {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kMostAdvices = 6, kMostTechniques = 3;

std::string errorText(double times, std::string_view term) {
    const double percent = 100 * (times - 1);
    if (percent < 1) return fmt::format("the error of {} does not grow", term);
    return fmt::format("the error of {} grows by {:.0f} %", term, percent);
}

std::string whereSaved(const Advice& a) {
    std::string text;
    for (size_t i = 0; i < std::min(a.savings.size(), kMostTechniques); ++i)
        text += fmt::format("{}{} {:.2f}", i ? ", " : "", a.savings[i].technique, a.savings[i].ms);
    return text;
}

std::string sentenceOf(const Advice& a) {
    return fmt::format("{} (now {}) saves about {:.2f} ms ({}); {}.", a.assignment, a.from, a.savedMs,
                       whereSaved(a), errorText(a.errorTimes, a.term));
}

std::string sentenceOf(const StepAdvice& s) {
    return fmt::format("The budget's step \"{}\" saves about {:.2f} ms in all; {}: {}", s.step, s.savedMs,
                       errorText(s.errorTimes, "the first bounce"), s.assignments);
}

Json adviceJson(const Frame& frame, const render::RenderSettings& gi) {
    Json sentences = Json::array();
    const std::vector<Advice> advices = adviceFor(frame, gi);
    for (size_t i = 0; i < std::min(advices.size(), kMostAdvices); ++i)
        sentences.push_back(sentenceOf(advices[i]));
    for (const StepAdvice& step : fasterSteps(frame, gi))
        sentences.push_back(sentenceOf(step));
    return sentences;
}

}  // namespace

Json findingsJson(const Capture& capture, size_t frame) {
    Json gaps = Json::array();
    for (const Gap& gap : gapsOf(capture.frames, frame))
        gaps.push_back({{"lane", gap.of == Gap::Of::kDevice ? "device idle" : "frame loop"},
                        {"begin", gap.beginNs},
                        {"end", gap.endNs},
                        {"why", gap.why}});
    const Frame& f = capture.frames[frame];
    return {{"advice", adviceJson(f, capture.gi)}, {"gaps", gaps}, {"anew", f.madeAnew}};
}

}  // namespace ag::capture
