// The chart of time against error as SVG: a stranger shall see at once who is left and low.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/bench/report.h"
#include "tools/bench/svg.h"

namespace ag::bench {
namespace {

constexpr double kPanelWidth = 560, kPanelHeight = 400, kLeft = 64, kRight = 16, kTop = 56, kBottom = 52;
constexpr double kHeader = 76, kLegendRow = 22;
constexpr std::array<std::string_view, 10> kColors = {"#d1495b", "#2e6f95", "#edae49", "#66a182", "#8d5a97",
                                                      "#c8702a", "#3d9fae", "#5b5b5b", "#a3b18a", "#b56576"};
constexpr std::string_view kPathsName = "path tracing for the same time";

struct Point {
    double ms, error;
    std::string label;
    bool pareto;
};

struct Series {
    std::string name;
    std::vector<Point> points;
};

std::vector<std::string> distinct(const Report& report, std::string Row::*field) {
    std::vector<std::string> names;
    for (const Row& row : report.rows)
        if (!row.isPathTracing() && std::ranges::find(names, row.*field) == names.end())
            names.push_back(row.*field);
    return names;
}

// A technique's rows in a scene, from fast to slow; path tracing has a point for each time it was stopped at.
std::vector<Series> seriesOf(const Report& report, const std::string& scene) {
    std::vector<Series> all;
    Series paths{std::string(kPathsName), {}};
    for (const std::string& technique : distinct(report, &Row::technique)) {
        Series series{technique, {}};
        for (const Row& row : report.rows) {
            if (row.isPathTracing() || row.scene != scene || row.technique != technique ||
                row.gpuMsMedian <= 0)
                continue;
            series.points.push_back({row.indirectMs(), row.error.relativeRmse, row.variant, row.pareto});
        }
        all.push_back(series);
    }
    for (const Row& row : report.rows)
        if (row.isPathTracing() && row.scene == scene)
            paths.points.push_back({row.gpuMsMedian, row.error.relativeRmse, "", false});
    all.push_back(paths);
    for (Series& series : all) {
        // Axes are logarithmic. An error of which noise was all is 0.
        std::erase_if(series.points, [](const Point& p) { return p.ms <= 0 || p.error <= 0; });
        std::ranges::sort(series.points, {}, &Point::ms);
    }
    return all;
}

struct Axis {
    double low, high;  // powers of ten's exponents
    double begin, end;
    double at(double value) const { return begin + (std::log10(value) - low) / (high - low) * (end - begin); }
};

Axis axisOver(const std::vector<Series>& all, double Point::*value, double begin, double end) {
    double low = 1e30, high = 1e-30;
    for (const Series& series : all)
        for (const Point& p : series.points) {
            low = std::min(low, p.*value);
            high = std::max(high, p.*value);
        }
    if (low > high) low = 0.1, high = 1;
    return {std::log10(low) - 0.12, std::log10(high) + 0.12, begin, end};
}

// 1, 2 and 5 times the powers of ten within the axis.
std::vector<double> ticks(const Axis& axis) {
    std::vector<double> values;
    for (int exponent = int(std::floor(axis.low)); exponent <= int(std::ceil(axis.high)); ++exponent)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double value = digit * std::pow(10.0, exponent);
            if (std::log10(value) > axis.low && std::log10(value) < axis.high) values.push_back(value);
        }
    return values;
}

std::string frameOf(const Axis& x, const Axis& y, const std::string& title) {
    std::string out = svgText(x.begin, y.end - 10, "start", 15, title);
    for (const double v : ticks(x)) {
        out += fmt::format("<line x1='{0:.1f}' x2='{0:.1f}' y1='{1:.1f}' y2='{2:.1f}' stroke='#e4e4e4'/>\n",
                           x.at(v), y.begin, y.end);
        out += svgText(x.at(v), y.begin + 16, "middle", 11, fmt::format("{:g}", v));
    }
    for (const double v : ticks(y)) {
        out += fmt::format("<line x1='{1:.1f}' x2='{2:.1f}' y1='{0:.1f}' y2='{0:.1f}' stroke='#e4e4e4'/>\n",
                           y.at(v), x.begin, x.end);
        out += svgText(x.begin - 6, y.at(v) + 4, "end", 11, fmt::format("{:g}", v));
    }
    out += fmt::format(
        "<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='none' stroke='#999'/>\n", x.begin,
        y.end, x.end - x.begin, y.begin - y.end);
    out += svgText((x.begin + x.end) / 2, y.begin + 36, "middle", 12, "ms a frame for indirect light");
    const double middle = (y.begin + y.end) / 2;
    out += fmt::format(
        "<text x='{0:.1f}' y='{1:.1f}' text-anchor='middle' font-size='12' fill='#333' "
        "transform='rotate(-90 {0:.1f} {1:.1f})'>relative RMSE of irradiance</text>\n",
        x.begin - 46, middle);
    return out;
}

std::string drawSeries(const Series& series, const Axis& x, const Axis& y, std::string_view color) {
    const bool paths = series.name == kPathsName;
    std::string line, marks;
    for (const Point& p : series.points) {
        line += fmt::format("{:.1f},{:.1f} ", x.at(p.ms), y.at(p.error));
        marks += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='{}' fill='{}' stroke='{}'/>\n", x.at(p.ms),
                             y.at(p.error), paths ? 2.5 : 4.5, color, p.pareto ? "#000" : "none");
        if (!p.label.empty())
            marks += svgText(x.at(p.ms) + 7, y.at(p.error) - 5, "start", 10, p.label, color);
    }
    return fmt::format("<polyline points='{}' fill='none' stroke='{}' stroke-width='1.6'{}/>\n", line, color,
                       paths ? " stroke-dasharray='3 3'" : "") +
           marks;
}

// A staircase under which nothing measured lies.
std::string drawFront(const std::vector<Series>& all, const Axis& x, const Axis& y) {
    std::vector<Point> front;
    for (const Series& series : all)
        for (const Point& p : series.points)
            if (p.pareto) front.push_back(p);
    std::ranges::sort(front, {}, &Point::ms);
    if (front.empty()) return "";
    std::string path = fmt::format("M{:.1f},{:.1f}", x.at(front[0].ms), y.end);
    double before = y.end;
    for (const Point& p : front) {
        path += fmt::format(" L{:.1f},{:.1f} L{:.1f},{:.1f}", x.at(p.ms), before, x.at(p.ms), y.at(p.error));
        before = y.at(p.error);
    }
    return fmt::format(
        "<path d='{} L{:.1f},{:.1f}' fill='none' stroke='#000' stroke-opacity='0.25' "
        "stroke-width='5'/>\n",
        path, x.end, before);
}

}  // namespace

std::string toSvg(const Report& report) {
    const std::vector<std::string> scenes = distinct(report, &Row::scene);
    std::vector<std::string> names = distinct(report, &Row::technique);
    names.emplace_back(kPathsName);
    const auto colorOf = [&](const std::string& name) {
        return kColors[size_t(std::ranges::find(names, name) - names.begin()) % kColors.size()];
    };
    const size_t columns = std::min<size_t>(scenes.size(), 2), rows = (scenes.size() + 1) / 2;
    const double width = std::max(double(columns) * kPanelWidth, 760.0);
    const double legend = kLegendRow * std::ceil(double(names.size()) / 4);
    const double height = kHeader + double(rows) * kPanelHeight + legend + 12;
    std::string out = svgBegin(width, height);
    out += svgText(16, 26, "start", 18, "Indirect light: time against error (left and low is better)");
    out += svgText(16, 46, "start", 12,
                   fmt::format("{}, {}; {}x{}", report.device, report.driver,
                               report.rows.empty() ? 0 : report.rows[0].size.x,
                               report.rows.empty() ? 0 : report.rows[0].size.y),
                   "#666");
    out += svgText(
        16, 62, "start", 12,
        "Ringed points and the gray staircase: nothing measured is both faster and nearer to the truth.",
        "#666");
    for (size_t i = 0; i < scenes.size(); ++i) {
        const double left = double(i % 2) * kPanelWidth, top = kHeader + double(i / 2) * kPanelHeight;
        const std::vector<Series> all = seriesOf(report, scenes[i]);
        const Axis x = axisOver(all, &Point::ms, left + kLeft, left + kPanelWidth - kRight);
        const Axis y = axisOver(all, &Point::error, top + kPanelHeight - kBottom, top + kTop - 24);
        out += frameOf(x, y, scenes[i]) + drawFront(all, x, y);
        for (const Series& series : all)
            out += drawSeries(series, x, y, colorOf(series.name));
    }
    for (size_t i = 0; i < names.size(); ++i) {
        const double x = 24 + double(i % 4) * (width - 40) / 4,
                     y = kHeader + double(rows) * kPanelHeight + 10 + kLegendRow * double(i / 4);
        out +=
            fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='5' fill='{}'/>\n", x, y - 4, colorOf(names[i]));
        out += svgText(x + 12, y, "start", 13, names[i]);
    }
    return out + "</svg>\n";
}

}  // namespace ag::bench
