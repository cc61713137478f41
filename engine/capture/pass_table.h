// What each pass cost over a capture's frames: passes.csv.
#pragma once

#include "engine/capture/capture.h"
#include "engine/core/result.h"

namespace ag::capture {

// Of times in ms; all 0 where there are none.
struct Spread {
    uint32_t count = 0;
    double least = 0, p25 = 0, median = 0, p75 = 0, p99 = 0;
};
Spread spreadOf(std::vector<double> values);

struct PassRow {
    std::string name;
    Spread ms;      // of the frames in which it ran
    Spread forced;  // of the warm-up, which runs it whether it needs to or not; the first frame is left out
    uint32_t ran = 0, skipped = 0, dropped = 0;  // frames
    std::string outcome, reason;                 // in the last frame
    uint64_t work = 0;
    std::string unit;
    bool counted = false;      // the device did: what follows; else it is all 0
    uint64_t invocations = 0;  // of all its shaders
    uint64_t vertices = 0, fragments = 0, triangles = 0;
    uint64_t resourceBytes = 0;
    std::string reads, writes;  // names with semicolons between

    double skippedShare() const {
        const uint32_t frames = ran + skipped + dropped;
        return frames ? double(skipped) / frames : 0;
    }
};

// In the order of the frame; every pass that any frame declared has a row.
std::vector<PassRow> makeTable(const Capture& capture);
std::string tableCsv(const std::vector<PassRow>& rows);
Result<std::vector<PassRow>> readTable(const std::string& path);

// The images and buffers that the last recorded frame's passes touch: resources.csv.
struct ResourceRow {
    std::string name, kind, role;
    uint64_t sizeBytes = 0;
    std::string writtenBy, readBy;  // names with semicolons between
};
std::vector<ResourceRow> resourceRows(const Capture& capture);
std::string resourcesCsv(const Capture& capture);

// Without the row of quotes that CSV also knows: cells hold neither commas nor line ends.
struct CsvFile {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;  // as long as the header
};
Result<CsvFile> readCsv(const std::string& path);

}  // namespace ag::capture
