// What a capture of real frames says: trace, table, pictures, graphs, report.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "engine/capture/display.h"
#include "engine/capture/graph_picture.h"
#include "engine/capture/pass_table.h"
#include "engine/capture/report.h"
#include "engine/capture/trace.h"
#include "tests/capture/seen.h"
#include "tests/support/own_folder.h"

namespace ag::capture {
namespace {

using Json = nlohmann::json;

struct Slice {
    double begin, end;
    std::string name, category;
};

std::map<std::pair<int, int>, std::vector<Slice>> tracksOf(const Json& trace) {
    std::map<std::pair<int, int>, std::vector<Slice>> tracks;
    for (const Json& e : trace.at("traceEvents"))
        if (e.at("ph") == "X")
            tracks[{e.at("pid"), e.at("tid")}].push_back(
                {e.at("ts"), double(e.at("ts")) + double(e.at("dur")), e.at("name"), e.at("cat")});
    return tracks;
}

TEST(Trace, SlicesOfATrackNestAndPassesFitTheirFrame) {
    const auto tracks = tracksOf(Json::parse(traceJson(seen())));
    ASSERT_GE(tracks.size(), 3u) << "frame loop, systems, queue";
    for (auto [track, slices] : tracks) {
        std::ranges::stable_sort(slices, [](const Slice& a, const Slice& b) {
            return a.begin < b.begin || (a.begin == b.begin && a.end > b.end);
        });
        std::vector<Slice> open;
        for (const Slice& s : slices) {
            constexpr double kRounding = 1e-6;  // µs, of doubles
            EXPECT_LE(s.begin, s.end) << s.name;
            while (!open.empty() && open.back().end <= s.begin + kRounding)
                open.pop_back();
            if (!open.empty()) {
                EXPECT_LE(s.end, open.back().end + kRounding) << s.name << " in " << open.back().name;
            }
            open.push_back(s);
        }
        double frame = 0, passes = 0;
        for (const Slice& s : slices) {
            if (s.category == "frame") frame += s.end - s.begin;
            if (s.category == "pass") passes += s.end - s.begin;
        }
        if (passes > 0) {
            EXPECT_LE(passes, frame * (1 + 1e-9));
        }
    }
}

TEST(Trace, GpuFramesBeginAfterTheyWereRecorded) {
    ASSERT_EQ(seen().clock, "VK_EXT_calibrated_timestamps");
    for (const Frame& frame : seen().frames) {
        ASSERT_FALSE(frame.gpu.empty());
        EXPECT_GE(frame.gpu.front().beginNs + 20000, frame.cpu.recorded)
            << "20 us for the reading of two clocks";
    }
}

TEST(Trace, HasReasonsCountersAndArrows) {
    const Json trace = Json::parse(traceJson(seen()));
    std::set<std::string> counters;
    std::map<uint64_t, int> arrows;
    bool fromSystem = false;
    int leftOut = 0;
    for (const Json& e : trace.at("traceEvents")) {
        if (e.at("ph") == "C") counters.insert(e.at("name"));
        if (e.at("ph") == "s" || e.at("ph") == "f") arrows[e.at("id")] += e.at("ph") == "s" ? 1 : -1;
        fromSystem = fromSystem || (e.at("ph") == "s" && e.at("name") == "scene");
        if (e.at("ph") != "i") continue;
        ++leftOut;
        EXPECT_FALSE(std::string(e.at("args").at("reason")).empty()) << e.at("name");
    }
    EXPECT_GT(leftOut, 0);
    for (const char* name : {"area lights", "shadow map tiles splatted",
                             "punctual light shadow faces redrawn", "entities changed", "bytes uploaded"})
        EXPECT_TRUE(counters.contains(name)) << name;
    EXPECT_TRUE(fromSystem);
    for (const auto& [id, balance] : arrows)
        EXPECT_EQ(balance, 0) << "arrow " << id << " has one end";
}

TEST(PassTable, HasEveryPassOfTheFrameAndComesBackFromItsFile) {
    const std::vector<PassRow> table = makeTable(seen());
    for (const Frame& frame : seen().frames)
        for (const PassDescription& pass : frame.passes)
            EXPECT_EQ(std::ranges::count(table, pass.name, &PassRow::name), 1) << pass.name;
    const auto row = [&](std::string_view name) { return *std::ranges::find(table, name, &PassRow::name); };
    EXPECT_EQ(row("gbuffer.fill").ran, 8u) << "the camera walks";
    EXPECT_EQ(row("rsm.render").skipped, 8u) << "the light does not";
    EXPECT_EQ(row("rsm.render").reason, "nothing it reads changed");
    EXPECT_GT(row("rsm.render").forced.median, 0) << "the warm-up ran it";
    EXPECT_EQ(row("composite.tonemap").work, 96u * 64u);
    EXPECT_EQ(row("composite.tonemap").writes, "composite.display");

    const std::string path = test::ownFile("passes.csv");
    std::FILE* file = std::fopen(path.c_str(), "wb");
    const std::string csv = tableCsv(table);
    std::fwrite(csv.data(), 1, csv.size(), file);
    std::fclose(file);
    const auto again = readTable(path);
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(tableCsv(*again), csv);
}

TEST(PassTable, HasWhatTheDeviceCounted) {
    if (!test::device().info().counts) GTEST_SKIP() << "no pipeline statistics";
    const std::vector<PassRow> table = makeTable(seen());
    const auto row = [&](std::string_view name) { return *std::ranges::find(table, name, &PassRow::name); };
    const PassRow assign = row("val_clustering.assign"), fill = row("gbuffer.fill"),
                  tonemap = row("composite.tonemap"), camera = row("scene.camera");
    EXPECT_EQ(assign.invocations, assign.work) << "threads of whole workgroups";
    EXPECT_EQ(assign.vertices + assign.fragments + assign.triangles, 0u);
    EXPECT_GT(fill.vertices, 0u);
    EXPECT_GT(fill.triangles, 0u);
    EXPECT_GT(fill.fragments, 96u * 64u / 2) << "most of the picture shows the box";
    EXPECT_GE(tonemap.fragments, 96u * 64u);
    EXPECT_LE(tonemap.fragments, 96u * 64u * 5 / 4) << "whole blocks at the edges";
    EXPECT_TRUE(camera.counted);
    EXPECT_EQ(camera.invocations, 0u) << "a copy";
}

TEST(Counters, SayWhatChanged) {
    const auto value = [](const Frame& frame, std::string_view name) {
        const auto counter = std::ranges::find(frame.counters, name, &Counter::name);
        return counter == frame.counters.end() ? -1 : counter->value;
    };
    const std::vector<Frame>& frames = seen().frames;
    EXPECT_GT(value(frames.front(), "entities changed"), 0) << "all are new";
    EXPECT_EQ(value(frames.back(), "entities changed"), 0) << "only the camera walks";
    EXPECT_GT(value(frames.back(), "area lights"), 0);
    EXPECT_LE(value(frames.back(), "area lights"), value(frames.back(), "shadow map tiles of area lights"));
    EXPECT_GE(value(frames.back(), "shadow map tiles splatted"), 0);
}

TEST(Resources, HaveSizesAndUsers) {
    const std::vector<ResourceRow> rows = resourceRows(seen());
    const auto found = std::ranges::find(rows, "composite.display", &ResourceRow::name);
    ASSERT_NE(found, rows.end());
    EXPECT_EQ(found->sizeBytes, 96u * 64u * 4u);
    EXPECT_EQ(found->writtenBy, "composite.tonemap");
    EXPECT_EQ(found->kind, "image");
    for (const ResourceRow& row : rows)
        EXPECT_FALSE(row.name.starts_with("capture.")) << row.name << " is not the frame's";
}

TEST(Pictures, AreThereAndNotBlack) {
    std::set<std::string> names;
    for (const Picture& picture : seen().pictures) {
        names.insert(picture.name);
        const Statistics s = statisticsOf(picture.pixels);
        EXPECT_EQ(s.notFinite, 0u) << picture.name;
        EXPECT_GT(s.greatest, s.least) << picture.name;
        EXPECT_FALSE(picture.pass.empty()) << picture.name;
        const Statistics shown = statisticsOf(displayOf(picture, seen().look));
        EXPECT_GT(shown.mean, 0.01) << picture.name;
        EXPECT_LE(shown.greatest, 1.0) << picture.name;
    }
    for (const char* name : {"gbuffer.depth", "gbuffer.normal", "rsm.albedo", "val_shading.irradiance",
                             "composite.display", "view.clusters", "view.ism", "view.rsm"})
        EXPECT_TRUE(names.contains(name)) << name;
}

TEST(Pictures, AreTheSameWhateverWasSkipped) {
    const Capture again = record([](RecordSettings& s) { s.graph.skip = false; });
    ASSERT_EQ(again.pictures.size(), seen().pictures.size());
    for (size_t i = 0; i < again.pictures.size(); ++i)
        EXPECT_EQ(statisticsOf(again.pictures[i].pixels).hash, statisticsOf(seen().pictures[i].pixels).hash)
            << again.pictures[i].name;
}

TEST(Graphs, NameEveryStep) {
    const std::string frame = frameGraphSvg(seen()), schedule = scheduleSvg(seen());
    for (const PassDescription& pass : seen().frames.back().passes)
        EXPECT_NE(frame.find("<title>" + pass.name + ":"), std::string::npos) << pass.name;
    for (const char* system : {"walkCamera", "extractScene"})
        EXPECT_NE(schedule.find(std::string(">") + system + "<"), std::string::npos);
    EXPECT_NE(seen().frameDot.find("digraph"), std::string::npos);
    EXPECT_NE(schedule.find("updateChildTransforms before extractScene"), std::string::npos);
}

TEST(Report, NeedsNothingFromOutside) {
    Capture odd = seen();
    odd.scene = "a</script><b>.glb";
    const std::string html =
        reportHtml(odd, makeTable(odd), {{"composite.display", "composite.tonemap", "\x89PNG"}});
    EXPECT_EQ(html.find("http://"), html.find("http://www.w3.org/2000/svg")) << "a name, not an address";
    EXPECT_EQ(html.find("https://"), std::string::npos);
    EXPECT_EQ(html.find("a</script>"), std::string::npos);
    EXPECT_NE(html.find("data:image/png;base64,iVBORw=="), std::string::npos);
    size_t ends = 0;
    for (size_t at = 0; (at = html.find("</script>", at)) != std::string::npos; ++at)
        ++ends;
    EXPECT_EQ(ends, 1u);
}

}  // namespace
}  // namespace ag::capture
