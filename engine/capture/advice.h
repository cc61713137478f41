// Settings that would make a frame cheaper: what each saves of its own passes' times, and what it costs in
// error. Both by measured ratios (docs/capture.md), so they say which to try first, not what will come out.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/capture/capture.h"

namespace ag::capture {

struct Saving {
    std::string_view technique;
    double ms = 0;
};

struct Advice {
    std::string assignment;  // "val_clustering.count=64", as --set takes it
    std::string from;        // "128"
    double savedMs = 0;
    std::vector<Saving> savings;  // greatest first
    double errorTimes = 1;        // what the error of `term` grows by, as a factor
    std::string_view term;
};

// Greatest saving first; nothing below a hundredth of the frame.
std::vector<Advice> adviceFor(const Frame& frame, const render::RenderSettings& gi);

// The next faster steps of the frame budget's ladder, which change several settings at once.
struct StepAdvice {
    std::string step;
    std::string assignments;  // what it changes, with blanks between
    double savedMs = 0;       // of the passes of indirect light, by the ladder's ratios
    double errorTimes = 1;    // of the first bounce
};
std::vector<StepAdvice> fasterSteps(const Frame& frame, const render::RenderSettings& gi);

}  // namespace ag::capture
