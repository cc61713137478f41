#include "engine/capture/pass_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <sstream>

#include "engine/core/safe_file.h"

namespace ag::capture {
namespace {

constexpr const char* kHeader =
    "pass,ms_median,ms_p99,ms_least,ms_p25,ms_p75,ms_samples,forced_ms_median,forced_ms_p99,forced_ms_least,"
    "forced_ms_p25,forced_ms_p75,forced_ms_samples,ran,skipped,dropped,skipped_share,outcome,reason,work,"
    "unit,"
    "counted,invocations,vertices,triangles,fragments,resource_bytes,reads,writes";

std::string namesOf(const std::vector<uint32_t>& resources, const Capture& capture) {
    std::string out;
    for (uint32_t r : resources)
        out += (out.empty() ? "" : ";") + capture.resources[r].name +
               (capture.resources[r].role == ResourceRole::kPrevious ? " (previous)" : "");
    return out;
}

double milliseconds(const Span& span) {
    return double(span.endNs - span.beginNs) * 1e-6;
}

std::string spreadCells(const Spread& s) {
    return fmt::format("{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}", s.median, s.p99, s.least, s.p25, s.p75,
                       s.count);
}

template <class T>
T number(const std::string& cell) {
    T value{};
    std::from_chars(cell.data(), cell.data() + cell.size(), value);
    return value;
}

Spread spreadFrom(const std::vector<std::string>& cells, size_t at) {
    return {.count = number<uint32_t>(cells[at + 5]),
            .least = number<double>(cells[at + 2]),
            .p25 = number<double>(cells[at + 3]),
            .median = number<double>(cells[at]),
            .p75 = number<double>(cells[at + 4]),
            .p99 = number<double>(cells[at + 1])};
}

std::vector<std::string> split(const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream in(line);
    for (std::string cell; std::getline(in, cell, ',');)
        cells.push_back(cell);
    if (!line.empty() && line.back() == ',') cells.emplace_back();
    return cells;
}

}  // namespace

Spread spreadOf(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const auto at = [&](double q) { return values[size_t(q * double(values.size() - 1) + 0.5)]; };
    return {uint32_t(values.size()), values.front(), at(0.25), at(0.5), at(0.75), at(0.99)};
}

std::vector<PassRow> makeTable(const Capture& capture) {
    struct Times {
        std::vector<double> ms, forced;
    };
    std::vector<PassRow> rows;
    std::map<std::string, Times> times;
    for (size_t f = 0; f < capture.frames.size(); ++f) {
        const Frame& frame = capture.frames[f];
        for (const Span& span : frame.gpu)
            if (!frame.forced || f > 0)
                (frame.forced ? times[span.name].forced : times[span.name].ms).push_back(milliseconds(span));
        size_t place = 0;  // a pass that only some frames have stands where they have it
        for (const PassDescription& pass : frame.passes) {
            auto row = std::ranges::find(rows, pass.name, &PassRow::name);
            if (row == rows.end())
                row = rows.insert(rows.begin() + std::ptrdiff_t(place), {.name = pass.name});
            place = size_t(row - rows.begin()) + 1;
            row->outcome = outcomeName(pass.outcome);
            row->reason = pass.reason;
            row->work = pass.work;
            row->unit = unitName(pass.unit);
            row->resourceBytes = pass.resourceBytes;
            if (frame.forced) continue;
            row->ran += pass.outcome == PassOutcome::kRan;
            row->skipped += pass.outcome == PassOutcome::kSkipped;
            row->dropped += pass.outcome == PassOutcome::kDropped;
        }
    }
    // Indices are those of the last frame.
    for (const PassDescription& pass :
         capture.frames.empty() ? std::vector<PassDescription>{} : capture.frames.back().passes) {
        const auto row = std::ranges::find(rows, pass.name, &PassRow::name);
        row->reads = namesOf(pass.reads, capture);
        row->writes = namesOf(pass.writes, capture);
    }
    for (const Count& count : capture.counts) {
        const auto row = std::ranges::find(rows, count.pass, &PassRow::name);
        if (row == rows.end()) continue;
        row->counted = true;
        row->invocations = count.counted.invocations();
        row->vertices = count.counted.vertices;
        row->fragments = count.counted.fragments;
        row->triangles = count.counted.triangles;
    }
    for (PassRow& row : rows) {
        row.ms = spreadOf(times[row.name].ms);
        row.forced = spreadOf(times[row.name].forced);
    }
    return rows;
}

std::string tableCsv(const std::vector<PassRow>& rows) {
    std::string out = std::string(kHeader) + "\n";
    for (const PassRow& r : rows)
        out +=
            fmt::format("{},{},{},{},{},{},{:.4f},{},{},{},{},{},{},{},{},{},{},{},{}\n", r.name,
                        spreadCells(r.ms), spreadCells(r.forced), r.ran, r.skipped, r.dropped,
                        r.skippedShare(), r.outcome, r.reason, r.work, r.unit, int(r.counted), r.invocations,
                        r.vertices, r.triangles, r.fragments, r.resourceBytes, r.reads, r.writes);
    return out;
}

std::vector<ResourceRow> resourceRows(const Capture& capture) {
    constexpr std::string_view kRoles[] = {"kept or scratch", "history", "history before", "import"};
    std::vector<ResourceRow> rows;
    for (const ResourceDescription& r : capture.resources)
        rows.push_back({.name = r.name,
                        .kind = r.image ? "image" : "buffer",
                        .role = std::string(kRoles[size_t(r.role)]),
                        .sizeBytes = r.sizeBytes});
    const auto note = [](std::string& list, const std::string& pass) {
        list += (list.empty() ? "" : ";") + pass;
    };
    if (capture.frames.empty()) return {};
    for (const PassDescription& pass : capture.frames.back().passes) {
        for (uint32_t r : pass.writes)
            note(rows[r].writtenBy, pass.name);
        for (uint32_t r : pass.reads)
            note(rows[r].readBy, pass.name);
    }
    std::erase_if(rows, [](const ResourceRow& r) { return r.writtenBy.empty() && r.readBy.empty(); });
    return rows;
}

std::string resourcesCsv(const Capture& capture) {
    std::string out = "resource,kind,role,bytes,written_by,read_by\n";
    for (const ResourceRow& r : resourceRows(capture))
        out += fmt::format("{},{},{},{},{},{}\n", r.name, r.kind, r.role, r.sizeBytes, r.writtenBy, r.readBy);
    return out;
}

Result<CsvFile> readCsv(const std::string& path) {
    const auto text = readFile(path);
    if (!text) return text.error();
    std::istringstream in(*text);
    CsvFile file;
    for (std::string line; std::getline(in, line);) {
        std::vector<std::string> cells = split(line);
        if (file.header.empty()) {
            file.header = std::move(cells);
            continue;
        }
        if (cells.size() != file.header.size())
            return Error{fmt::format("{}: line {} has {} cells where the header has {}", path,
                                     file.rows.size() + 2, cells.size(), file.header.size())};
        file.rows.push_back(std::move(cells));
    }
    return file;
}

Result<std::vector<PassRow>> readTable(const std::string& path) {
    const auto file = readCsv(path);
    if (!file) return file.error();
    if (file->header != split(kHeader)) return Error{path + ": not a table of passes of this version"};
    std::vector<PassRow> rows;
    for (const std::vector<std::string>& c : file->rows)
        rows.push_back({.name = c[0],
                        .ms = spreadFrom(c, 1),
                        .forced = spreadFrom(c, 7),
                        .ran = number<uint32_t>(c[13]),
                        .skipped = number<uint32_t>(c[14]),
                        .dropped = number<uint32_t>(c[15]),
                        .outcome = c[17],
                        .reason = c[18],
                        .work = number<uint64_t>(c[19]),
                        .unit = c[20],
                        .counted = c[21] == "1",
                        .invocations = number<uint64_t>(c[22]),
                        .vertices = number<uint64_t>(c[23]),
                        .fragments = number<uint64_t>(c[25]),
                        .triangles = number<uint64_t>(c[24]),
                        .resourceBytes = number<uint64_t>(c[26]),
                        .reads = c[27],
                        .writes = c[28]});
    return rows;
}

}  // namespace ag::capture
