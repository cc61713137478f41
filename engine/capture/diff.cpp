#include "engine/capture/diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/core/number.h"

namespace ag::capture {
namespace {

const PassRow* find(const std::vector<PassRow>& rows, const std::string& name) {
    const auto row = std::ranges::find(rows, name, &PassRow::name);
    return row == rows.end() ? nullptr : &*row;
}

struct Pair {
    const PassRow *a, *b;
    Spread timesA, timesB;
};

// As the frames had it where the pass ran in both, else by the warm-up, which runs everything.
std::vector<Pair> pairsOf(const Saved& a, const Saved& b) {
    constexpr uint32_t kLeast = 4;
    std::vector<Pair> pairs;
    for (const PassRow& row : a.passes) {
        const PassRow* other = find(b.passes, row.name);
        if (!other) continue;
        const bool ran = row.ms.count >= kLeast && other->ms.count >= kLeast;
        const Spread &x = ran ? row.ms : row.forced, &y = ran ? other->ms : other->forced;
        if (x.median > 0 && y.median > 0) pairs.push_back({&row, other, x, y});
    }
    return pairs;
}

double medianRatio(const std::vector<Pair>& pairs) {
    std::vector<double> ratios;
    for (const Pair& p : pairs)
        ratios.push_back(p.timesB.median / p.timesA.median);
    const double median = spreadOf(ratios).median;
    return median > 0 ? median : 1;
}

// Slower means: most of the times of one are above most of those of the other by a margin, and so are their
// least ones, which other work on the machine lengthens last.
bool isSlower(const Spread& than, const Spread& times, double common, const DiffSettings& s) {
    return times.p25 > common * than.p75 && times.median > s.leastRatio * common * than.median &&
           times.least > s.leastRatio * common * than.least &&
           times.median - common * than.median > s.leastMs;
}

void compareTimes(const std::vector<Pair>& pairs, const DiffSettings& settings, Diff& diff) {
    for (const Pair& p : pairs) {
        const TimeChange change{p.a->name, p.timesA.median, p.timesB.median,
                                p.timesB.median / (p.timesA.median * diff.commonRatio)};
        if (isSlower(p.timesA, p.timesB, diff.commonRatio, settings)) diff.slower.push_back(change);
        if (isSlower(p.timesB, p.timesA, 1 / diff.commonRatio, settings)) diff.faster.push_back(change);
    }
    std::ranges::stable_sort(diff.slower, std::greater{}, &TimeChange::ratio);
    std::ranges::stable_sort(diff.faster, std::less{}, &TimeChange::ratio);
}

bool readsAny(const PassRow* pass, const std::set<std::string>& names) {
    if (!pass) return false;
    for (size_t at = 0; at < pass->reads.size();) {
        const size_t end = std::min(pass->reads.find(';', at), pass->reads.size());
        if (names.contains(pass->reads.substr(at, end - at))) return true;
        at = end + 1;
    }
    return false;
}

// In the order of the frame, so that what follows from a change stands after it. What a changed pass writes
// counts as changed, buffers too: they have no picture to tell.
void comparePictures(const Saved& a, const Saved& b, Diff& diff) {
    std::set<std::string> tainted;
    for (const PassRow& pass : b.passes) {
        const bool follows = readsAny(&pass, tainted);
        bool changed = follows;
        for (const PictureRow& picture : b.pictures) {
            if (picture.pass != pass.name) continue;
            const auto old = std::ranges::find(a.pictures, picture.name, &PictureRow::name);
            if (old == a.pictures.end() || old->hash == picture.hash) continue;
            diff.changed.push_back({picture.name, pass.name, old->mean, picture.mean, !follows});
            changed = true;
        }
        for (size_t at = 0; changed && at < pass.writes.size();) {
            const size_t end = std::min(pass.writes.find(';', at), pass.writes.size());
            tainted.insert(pass.writes.substr(at, end - at));
            at = end + 1;
        }
    }
}

}  // namespace

Result<Saved> readCapture(const std::string& folder) {
    auto passes = readTable(folder + "/passes.csv");
    if (!passes) return passes.error();
    const auto pictures = readCsv(folder + "/pictures.csv");
    if (!pictures) return pictures.error();
    if (pictures->header.size() != 10) return Error{folder + "/pictures.csv: not a table of pictures"};
    Saved saved{.passes = std::move(*passes)};
    for (const std::vector<std::string>& c : pictures->rows)
        saved.pictures.push_back({c[0], c[1], c[9], parseNumber(c[6]).value_or(0)});
    return saved;
}

Diff compareCaptures(const Saved& a, const Saved& b, const DiffSettings& settings) {
    Diff diff;
    const std::vector<Pair> pairs = pairsOf(a, b);
    diff.commonRatio = medianRatio(pairs);
    compareTimes(pairs, settings, diff);
    comparePictures(a, b, diff);
    for (const PassRow& row : a.passes)
        if (!find(b.passes, row.name)) diff.onlyA.push_back(row.name);
    for (const PassRow& row : b.passes)
        if (!find(a.passes, row.name)) diff.onlyB.push_back(row.name);
    return diff;
}

std::string diffText(const Diff& diff) {
    std::string out = fmt::format("all passes: {:.2f} times as long (median)\n", diff.commonRatio);
    const auto times = [&](const char* word, const std::vector<TimeChange>& changes) {
        for (const TimeChange& c : changes)
            out += fmt::format("{}: {}, {:.3f} ms to {:.3f} ms, {:.2f} times beyond the others\n", word,
                               c.pass, c.msA, c.msB, c.ratio);
    };
    times("slower", diff.slower);
    times("faster", diff.faster);
    for (const PictureChange& c : diff.changed)
        out += fmt::format("changed: {} of {}, mean {:.4g} to {:.4g}{}\n", c.picture, c.pass, c.meanA,
                           c.meanB, c.first ? "" : ", after what it reads");
    for (const std::string& pass : diff.onlyA)
        out += "gone: " + pass + "\n";
    for (const std::string& pass : diff.onlyB)
        out += "new: " + pass + "\n";
    if (diff.slower.empty() && diff.faster.empty()) out += "no pass changed its time\n";
    if (diff.changed.empty()) out += "no picture changed\n";
    return out;
}

}  // namespace ag::capture
