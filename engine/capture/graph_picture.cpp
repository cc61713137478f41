#include "engine/capture/graph_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace ag::capture {
namespace {

constexpr double kColumn = 236, kRow = 30, kBoxWidth = 176, kBoxHeight = 22, kTop = 48, kMargin = 16;

struct Node {
    std::string label, title;
    uint32_t column = 0, row = 0;
    std::string_view fill = "#eef3f8";
};

struct Edge {
    uint32_t from = 0, to = 0;
    std::string title;
};

double left(const Node& n) {
    return kMargin + n.column * kColumn;
}
double middle(const Node& n) {
    return kTop + n.row * kRow + kBoxHeight / 2;
}

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text)
        out += c == '<'    ? "&lt;"
               : c == '>'  ? "&gt;"
               : c == '&'  ? "&amp;"
               : c == '\'' ? "&#39;"
                           : std::string(1, c);
    return out;
}

// From the box's right side to the next one's left; within a column or back, round its right side.
std::string edgePath(const Node& a, const Node& b) {
    const double x0 = left(a) + kBoxWidth, y0 = middle(a), y1 = middle(b);
    if (b.column > a.column) {
        const double x1 = left(b), bend = std::min(40 + (x1 - x0) * 0.3, (x1 - x0) * 0.6);
        return fmt::format("M{} {}C{} {} {} {} {} {}", x0, y0, x0 + bend, y0, x1 - bend, y1, x1, y1);
    }
    const double x1 = left(b) + kBoxWidth, out = 14 + std::min(std::abs(y1 - y0) * 0.25, 30.0);
    return fmt::format("M{} {}C{} {} {} {} {} {}", x0, y0, std::max(x0, x1) + out, y0, std::max(x0, x1) + out,
                       y1, x1, y1);
}

std::string draw(const std::vector<Node>& nodes, const std::vector<Edge>& edges,
                 const std::vector<std::string>& headers) {
    uint32_t columns = 1, rows = 1;
    for (const Node& n : nodes) {
        columns = std::max(columns, n.column + 1);
        rows = std::max(rows, n.row + 1);
    }
    const double width = 2 * kMargin + columns * kColumn, height = kTop + rows * kRow + kMargin;
    std::string out = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{0:.0f}' height='{1:.0f}' viewBox='0 0 {0:.0f} "
        "{1:.0f}' "
        "font-family='sans-serif' font-size='11'>\n<defs><marker id='tip' viewBox='0 0 8 8' refX='7' "
        "refY='4' "
        "markerWidth='7' markerHeight='7' orient='auto'><path d='M0 0L8 4L0 8z' "
        "fill='#5a6b7d'/></marker></defs>\n"
        "<rect width='100%' height='100%' fill='#fff'/>\n",
        width, height);
    for (size_t c = 0; c < headers.size(); ++c)
        out += fmt::format("<text x='{}' y='30' font-size='13' font-weight='bold' fill='#333'>{}</text>\n",
                           kMargin + double(c) * kColumn, escaped(headers[c]));
    for (const Edge& e : edges)
        out += fmt::format(
            "<path d='{}' fill='none' stroke='#5a6b7d' stroke-opacity='0.55' "
            "marker-end='url(#tip)'><title>{}</title></path>\n",
            edgePath(nodes[e.from], nodes[e.to]), escaped(e.title));
    for (const Node& n : nodes)
        out += fmt::format(
            "<g><title>{}</title><rect x='{}' y='{}' width='{}' height='{}' rx='4' fill='{}' "
            "stroke='#5a6b7d'/><text x='{}' y='{}' fill='#111'>{}</text></g>\n",
            escaped(n.title), left(n), middle(n) - kBoxHeight / 2, kBoxWidth, kBoxHeight, n.fill, left(n) + 6,
            middle(n) + 4, escaped(n.label));
    return out + "</svg>\n";
}

std::string techniqueOf(const std::string& pass) {
    return pass.substr(0, pass.find('.'));
}

std::string_view fillOf(PassOutcome outcome) {
    return outcome == PassOutcome::kRan ? "#bfe8c0" : outcome == PassOutcome::kSkipped ? "#dcdfe3" : "#fff";
}

}  // namespace

std::string frameGraphSvg(const Capture& capture) {
    if (capture.frames.empty()) return draw({}, {}, {});
    const std::vector<PassDescription>& passes = capture.frames.back().passes;
    std::vector<std::string> techniques;
    std::vector<uint32_t> used;
    std::vector<Node> nodes;
    std::map<uint32_t, uint32_t> writer;                             // of a resource
    std::map<std::pair<uint32_t, uint32_t>, std::string> resources;  // of an edge
    for (uint32_t p = 0; p < passes.size(); ++p) {
        const std::string technique = techniqueOf(passes[p].name);
        const auto column = uint32_t(std::ranges::find(techniques, technique) - techniques.begin());
        if (column == techniques.size()) techniques.push_back(technique), used.push_back(0);
        const size_t dot = passes[p].name.find('.');
        nodes.push_back({.label = dot == std::string::npos ? passes[p].name : passes[p].name.substr(dot + 1),
                         .title = fmt::format("{}: {}{}{}", passes[p].name, outcomeName(passes[p].outcome),
                                              passes[p].reason.empty() ? "" : ", ", passes[p].reason),
                         .column = column,
                         .row = used[column]++,
                         .fill = fillOf(passes[p].outcome)});
        for (uint32_t r : passes[p].reads)
            if (const auto from = writer.find(r); from != writer.end() && from->second != p) {
                std::string& names = resources[{from->second, p}];
                names += (names.empty() ? "" : ", ") + capture.resources[r].name;
            }
        for (uint32_t r : passes[p].writes)
            writer[r] = p;
    }
    std::vector<Edge> edges;
    for (const auto& [ends, names] : resources)
        edges.push_back({ends.first, ends.second, names});
    return draw(nodes, edges, techniques);
}

std::string scheduleSvg(const Capture& capture) {
    std::vector<Node> nodes;
    std::vector<Edge> edges;
    for (const std::string& system : capture.systems)
        nodes.push_back({.label = system, .title = system});
    // Edges go forward, so one walk finds the longest way to each.
    for (uint32_t n = 0; n < nodes.size(); ++n)
        for (const auto& [before, after] : capture.systemEdges)
            if (before == n) nodes[after].column = std::max(nodes[after].column, nodes[n].column + 1);
    std::map<uint32_t, uint32_t> used;
    for (Node& n : nodes)
        n.row = used[n.column]++;
    for (const auto& [before, after] : capture.systemEdges)
        edges.push_back({before, after, nodes[before].label + " before " + nodes[after].label});
    return draw(nodes, edges, {});
}

}  // namespace ag::capture
