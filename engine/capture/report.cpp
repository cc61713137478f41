#include "engine/capture/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/capture/graph_picture.h"
#include "engine/capture/report_findings.h"
#include "engine/capture/report_page.h"

namespace ag::capture {
namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::string& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(bytes.size() - i, 3);
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k)
            word = word << 8 | (k < count ? uint8_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            out += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return out;
}

// Inside <script> a '<' could end it; inside HTML it could begin something.
std::string inScript(std::string text) {
    for (size_t at = 0; (at = text.find('<', at)) != std::string::npos;)
        text.replace(at, 1, "\\u003c");
    return text;
}
std::string inHtml(const std::string& text) {
    std::string out;
    for (char c : text)
        out += c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '&' ? "&amp;" : std::string(1, c);
    return out;
}

Json columnsJson() {
    const auto column = [](const char* name, const char* help, bool words = false) {
        return Json{{"name", name}, {"help", help}, {"words", words}};
    };
    return {column("pass", "technique.step, at first in the order of the frame", true),
            column("ms", "median over the frames in which it ran"),
            column("p99", "99th percentile of the same, ms"),
            column("ms if run", "median over the warm-up, in which nothing is skipped"),
            column("skipped %", "of the frames"),
            column("work", "threads, pixels, indirect draws or bytes it asks for"),
            column("of", "what work counts", true),
            column("invocations", "of its shaders, counted by the device when nothing is skipped"),
            column("triangles", "left by clipping, counted likewise"),
            column("KiB", "of all it reads and writes"),
            column("last frame", "what became of it, and why", true),
            column("reads", "", true),
            column("writes", "", true)};
}

Json memoryColumnsJson() {
    const auto column = [](const char* name, const char* help, bool words = true) {
        return Json{{"name", name}, {"help", help}, {"words", words}};
    };
    return {column("resource", ""),
            column("KiB", "", false),
            column("kind", "image or buffer"),
            column("role", "what becomes of it after the frame"),
            column("written by", ""),
            column("read by", "")};
}

std::string spaced(std::string names) {
    for (size_t at = 0; (at = names.find(';', at)) != std::string::npos;)
        names.replace(at, 1, ", ");
    return names;
}

Json rowJson(const PassRow& r) {
    return Json::array({r.name, r.ms.median, r.ms.p99, r.forced.median, 100 * r.skippedShare(), r.work,
                        r.unit, r.invocations, r.triangles, double(r.resourceBytes) / 1024,
                        r.reason.empty() ? r.outcome : r.outcome + ": " + r.reason, spaced(r.reads),
                        spaced(r.writes)});
}

Json frameJson(const Capture& capture, size_t index) {
    const Frame& f = capture.frames[index];
    const uint64_t start = f.systems.empty() ? f.cpu.begin : std::min(f.cpu.begin, f.systems.front().beginNs);
    const auto ms = [&](uint64_t ns) { return double(int64_t(ns - start)) * 1e-6; };
    Json bars = Json::array();
    const auto bar = [&](const std::string& lane, const std::string& name, const char* kind, uint64_t begin,
                         uint64_t end) {
        bars.push_back(
            {{"lane", lane}, {"name", name}, {"kind", kind}, {"begin", ms(begin)}, {"end", ms(end)}});
    };
    std::vector<uint64_t> threads;
    for (const Span& system : f.systems) {
        const auto known = std::ranges::find(threads, system.thread);
        const size_t thread = size_t(known - threads.begin());
        if (known == threads.end()) threads.push_back(system.thread);
        bar(fmt::format("systems, thread {}", thread + 1), system.name, "system", system.beginNs,
            system.endNs);
    }
    bar("frame loop", "wait for the frame before last", "wait", f.cpu.begin, f.cpu.waited);
    bar("frame loop", "declare passes", "cpu", f.cpu.waited, f.cpu.declared);
    bar("frame loop", "plan and record", "cpu", f.cpu.declared, f.cpu.recorded);
    bar("frame loop", "submit", "cpu", f.cpu.recorded, f.cpu.submitted);
    size_t next = 0;
    for (const PassDescription& pass : f.passes) {
        if (next < f.gpu.size() && f.gpu[next].name == pass.name) {
            bar(pass.name, pass.name, "gpu", f.gpu[next].beginNs, f.gpu[next].endNs);
            ++next;
        } else {
            bars.push_back({{"lane", pass.name},
                            {"name", pass.name},
                            {"kind", "gpu"},
                            {"begin", nullptr},
                            {"end", nullptr},
                            {"why", fmt::format("{}: {}", outcomeName(pass.outcome), pass.reason)}});
        }
    }
    Json findings = findingsJson(capture, index);
    for (const Json& gap : findings["gaps"])
        bar(gap["lane"], gap["why"], "gap", gap["begin"], gap["end"]);
    const double total = f.gpu.empty() ? 0 : double(f.gpu.back().endNs - f.gpu.front().beginNs) * 1e-6;
    Json counters = Json::array();
    for (const Counter& counter : f.counters)
        counters.push_back({{"name", counter.name}, {"value", counter.value}});
    return {{"number", f.number}, {"forced", f.forced},   {"ms", total},
            {"bars", bars},       {"counters", counters}, {"findings", std::move(findings)}};
}

Json dataJson(const Capture& capture, const std::vector<PassRow>& table,
              const std::vector<ReportPicture>& pictures) {
    Json data = {
        {"columns", columnsJson()}, {"rows", Json::array()},   {"memoryColumns", memoryColumnsJson()},
        {"memory", Json::array()},  {"frames", Json::array()}, {"pictures", Json::array()}};
    for (const PassRow& row : table)
        data["rows"].push_back(rowJson(row));
    for (const ResourceRow& row : resourceRows(capture))
        data["memory"].push_back({row.name, double(row.sizeBytes) / 1024, row.kind, row.role,
                                  spaced(row.writtenBy), spaced(row.readBy)});
    for (size_t i = 1; i < capture.frames.size(); ++i)  // the first makes pipelines
        data["frames"].push_back(frameJson(capture, i));
    for (const ReportPicture& p : pictures)
        data["pictures"].push_back(
            {{"name", p.name}, {"pass", p.pass}, {"data", "data:image/png;base64," + base64(p.png)}});
    return data;
}

}  // namespace

std::string reportHtml(const Capture& capture, const std::vector<PassRow>& table,
                       const std::vector<ReportPicture>& pictures) {
    std::string out = "<!doctype html>\n<html lang='en'><head><meta charset='utf-8'><title>" +
                      inHtml(capture.scene) + " captured</title>\n<link rel='icon' href='data:,'><style>" +
                      kReportStyle + "</style></head><body>\n";
    out += fmt::format("<h1>{}</h1><p class='note'>{}x{}, {} on {} ({}). Clock: {}.</p>\n",
                       inHtml(capture.scene), capture.size.x, capture.size.y, inHtml(capture.settings),
                       inHtml(capture.device), inHtml(capture.driver), inHtml(capture.clock));
    out +=
        "<h2>Timeline</h2><p class='note'>A column a frame, as high as its GPU time (<i class='key "
        "forced'></i> "
        "warm-up, nothing skipped). The slowest is chosen; click another to see it below.</p>"
        "<div id='strip'></div><p id='which'></p><div id='dearest'></div><p class='note' id='counters'></p>"
        "<h3>What would make it faster</h3><ul id='advice'></ul>"
        "<h3>Gaps</h3><ul id='gaps'></ul>"
        "<h3>Made anew, and why</h3><ul id='anew'></ul>"
        "<p class='note'><i class='key'></i> passes on the GPU, <i class='key cpu'></i> the frame loop (<i "
        "class='key wait'></i> waiting for the device), <i class='key gap'></i> gaps, "
        "<i class='key system'></i> systems of the schedule, all on one clock:</p>"
        "<div id='gantt' class='scroll'></div>\n"
        "<h2>Passes</h2><p class='note'>Dearest first; click a header to sort otherwise.</p><div "
        "class='scroll'><table id='table'>"
        "<thead><tr id='head'></tr></thead><tbody id='rows'></tbody></table></div>\n"
        "<h2>Compare pictures</h2><select id='left'></select> left of the line, <select id='right'></select> "
        "right of it <input id='cut' type='range' min='0' max='100' value='50' step='0.1'>"
        "<br><div id='slider'><img id='under' alt=''><img id='over' class='over' alt=''><b "
        "id='line'></b></div>\n"
        "<h2>Pictures</h2><div id='pictures'></div>\n";
    out +=
        "<h2>Memory</h2><div class='scroll'><table><thead><tr id='memory-head'></tr></thead><tbody "
        "id='memory'>"
        "</tbody></table></div>\n"
        "<h2>Frame graph</h2><p class='note'>Green ran in the last frame, grey was skipped, white was "
        "dropped.</p><div class='scroll'>" +
        frameGraphSvg(capture) + "</div>\n";
    if (!capture.systems.empty())
        out += "<h2>Schedule</h2><div class='scroll'>" + scheduleSvg(capture) + "</div>\n";
    return out + "<script>\nconst capture = " + inScript(dataJson(capture, table, pictures).dump()) + ";\n" +
           kReportScript + "</script></body></html>\n";
}

}  // namespace ag::capture
