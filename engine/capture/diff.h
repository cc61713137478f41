// Two captures side by side: which passes got slower, and which changed their pictures.
#pragma once

#include "engine/capture/pass_table.h"
#include "engine/core/result.h"

namespace ag::capture {

// A line of pictures.csv.
struct PictureRow {
    std::string name, pass, hash;
    double mean = 0;
};

struct Saved {  // a capture's folder, read again
    std::vector<PassRow> passes;
    std::vector<PictureRow> pictures;
};
Result<Saved> readCapture(const std::string& folder);

struct DiffSettings {
    double leastRatio = 1.5;  // of a pass's times, beyond what all passes together changed
    double leastMs = 0.1;     // and what that must come to
};

struct TimeChange {
    std::string pass;
    double msA = 0, msB = 0;
    double ratio = 1;  // beyond the common one
};
struct PictureChange {
    std::string picture, pass;
    double meanA = 0, meanB = 0;
    bool first = false;  // no picture that the pass reads has changed
};

struct Diff {
    double commonRatio = 1;  // the median of all passes' B / A: another machine, other load
    std::vector<TimeChange> slower, faster;
    std::vector<PictureChange> changed;
    std::vector<std::string> onlyA, onlyB;  // passes
};

Diff compareCaptures(const Saved& a, const Saved& b, const DiffSettings& settings);
std::string diffText(const Diff& diff);

}  // namespace ag::capture
