#include "engine/capture/save_capture.h"

#include "engine/capture/display.h"
#include "engine/capture/graph_picture.h"
#include "engine/capture/report.h"
#include "engine/capture/trace.h"

namespace ag::capture {
namespace {

constexpr int kReportPixels = 1024;  // along a picture's side in the report; its file has all

Result<std::vector<ReportPicture>> writePictures(Folder& folder, const Capture& capture, bool exr) {
    std::vector<ReportPicture> written;
    for (const Picture& picture : capture.pictures) {
        const Image shown = displayOf(picture, capture.look);
        const std::string name = picture.name + ".png";
        // First as the report has it, then over that as a file of its own.
        if (const Status s = folder.writeImage(name, shrunk(shown, kReportPixels)); !s) return s.error();
        auto png = folder.readBack(name);
        if (!png) return png.error();
        written.push_back({picture.name, picture.pass, std::move(*png)});
        if (const Status s = folder.writeImage(name, shown); !s) return s.error();
        if (!exr) continue;
        if (const Status s = folder.writeImage(picture.name + ".exr", picture.pixels); !s) return s.error();
    }
    if (const Status s = folder.writeText("pictures.csv", picturesCsv(capture.pictures)); !s)
        return s.error();
    return written;
}

}  // namespace

Status saveCapture(Folder& folder, const Capture& capture, const std::vector<PassRow>& table, bool exr) {
    const auto pictures = writePictures(folder, capture, exr);
    if (!pictures) return pictures.error();
    std::vector<std::pair<std::string, std::string>> files = {
        {"passes.csv", tableCsv(table)},
        {"resources.csv", resourcesCsv(capture)},
        {"trace.json", traceJson(capture)},
        {"frame_graph.dot", capture.frameDot},
        {"frame_graph.svg", frameGraphSvg(capture)},
        {"report.html", reportHtml(capture, table, *pictures)}};
    if (!capture.systems.empty()) {
        files.push_back({"schedule.dot", capture.scheduleDot});
        files.push_back({"schedule.svg", scheduleSvg(capture)});
    }
    for (const auto& [name, text] : files)
        if (const Status s = folder.writeText(name, text); !s) return s;
    return folder.commit();
}

}  // namespace ag::capture
