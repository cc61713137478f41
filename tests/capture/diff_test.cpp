// Two captures compared: what was made worse on purpose is found, and nothing else.
#include "engine/capture/diff.h"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <csignal>
#include <filesystem>

#include "engine/capture/display.h"
#include "engine/capture/folder.h"
#include "engine/core/safe_file.h"
#include "tests/capture/seen.h"
#include "tests/support/own_folder.h"

namespace ag::capture {
namespace {

namespace fs = std::filesystem;

Saved save(const Capture& capture, const std::string& name) {
    const std::string path = test::ownFile(name);
    auto folder = Folder::open(path);
    EXPECT_TRUE(folder);
    EXPECT_TRUE(folder->writeText("passes.csv", tableCsv(makeTable(capture))));
    EXPECT_TRUE(folder->writeText("pictures.csv", picturesCsv(capture.pictures)));
    EXPECT_TRUE(folder->commit());
    const auto saved = readCapture(path);
    EXPECT_TRUE(saved);
    return *saved;
}

// Noise as on a machine that others use too: every time up to a tenth longer, in steps that repeat.
Saved made(double slower, const std::string& changed) {
    Saved saved;
    const char* names[] = {"a.first", "b.second", "c.third", "d.fourth"};
    for (int p = 0; p < 4; ++p) {
        std::vector<double> ms;
        for (int i = 0; i < 32; ++i)
            ms.push_back((p == 1 ? slower : 1) * (p + 1) * (1 + 0.01 * ((i * 7 + p * 3) % 11)));
        saved.passes.push_back({.name = names[p], .ms = spreadOf(ms)});
        saved.passes.back().writes = std::string("r") + char('0' + p);
        if (p > 0) saved.passes.back().reads = std::string("r") + char('0' + p - 1);
        saved.pictures.push_back(
            {saved.passes.back().writes, names[p], names[p] == changed ? "1" : "0", 0.5});
    }
    return saved;
}

TEST(Diff, FindsOnePassSlowerAndNotTheOthers) {
    const Diff diff = compareCaptures(made(1, ""), made(2, ""), {});
    ASSERT_EQ(diff.slower.size(), 1u);
    EXPECT_EQ(diff.slower[0].pass, "b.second");
    EXPECT_NEAR(diff.slower[0].ratio, 2, 0.1);
    EXPECT_TRUE(diff.changed.empty() && diff.faster.empty());
    const Diff back = compareCaptures(made(2, ""), made(1, ""), {});
    ASSERT_EQ(back.faster.size(), 1u);
    EXPECT_TRUE(back.slower.empty());
    EXPECT_NE(diffText(compareCaptures(made(1, ""), made(1, ""), {})).find("no picture changed"),
              std::string::npos);
}

TEST(Diff, SaysWhereAChangeBegan) {
    Saved b = made(1, "b.second");
    b.pictures[2].hash = b.pictures[3].hash = "1";
    const Diff diff = compareCaptures(made(1, ""), b, {});
    ASSERT_EQ(diff.changed.size(), 3u);
    EXPECT_EQ(diff.changed[0].pass, "b.second");
    EXPECT_TRUE(diff.changed[0].first);
    EXPECT_FALSE(diff.changed[1].first);
    EXPECT_FALSE(diff.changed[2].first);
}

TEST(Diff, FindsWhatWasDoneToRealFrames) {
    const Saved plain = save(seen(), "plain");
    const Capture slowed = record([](RecordSettings& s) {
        s.graph.repeatPass = "val_clustering.assign";
        s.graph.repeats = 30;
    });
    const Diff slow = compareCaptures(plain, save(slowed, "slowed"), {.leastRatio = 5});
    ASSERT_FALSE(slow.slower.empty()) << diffText(slow);  // a busy machine may have slowed others, by less
    EXPECT_EQ(slow.slower[0].pass, "val_clustering.assign");
    EXPECT_TRUE(slow.changed.empty()) << diffText(slow);

    const Capture brighter = record([](RecordSettings& s) { s.gi.composite.exposure = 1; });
    const Diff bright = compareCaptures(plain, save(brighter, "brighter"), {});
    ASSERT_EQ(bright.changed.size(), 1u) << diffText(bright);
    EXPECT_EQ(bright.changed[0].pass, "composite.tonemap");
    EXPECT_GT(bright.changed[0].meanB, bright.changed[0].meanA);
}

TEST(Diff, RefusesWhatIsNoCapture) {
    const auto none = readCapture(test::ownFile("nowhere"));
    ASSERT_FALSE(none);
    EXPECT_NE(none.error().message.find("nowhere/passes.csv"), std::string::npos);
    const std::string path = test::ownFile("capture_text");
    fs::create_directories(path);
    ASSERT_TRUE(writeFileSafely(path + "/passes.csv", "a,b\n1,2\n"));
    EXPECT_FALSE(readCapture(path));
    ASSERT_TRUE(writeFileSafely(path + "/passes.csv", "a,b\n1\n"));
    const auto cut = readCapture(path);
    ASSERT_FALSE(cut);
    EXPECT_NE(cut.error().message.find("line 2 has 1 cells"), std::string::npos) << cut.error().message;
}

TEST(Folder, LeavesNothingHalfWhenTheDiskIsFull) {
    const std::string path = test::ownFile("full");
    fs::create_directories(path);
    ASSERT_TRUE(writeFileSafely(path + "/passes.csv", "old\n"));
    // No file may grow beyond 4 KiB: writing fails as on a full disk.
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, SIG_IGN);
    {
        auto folder = Folder::open(path);
        ASSERT_TRUE(folder);
        EXPECT_TRUE(folder->writeText("passes.csv", "new\n"));
        const rlimit small{4096, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &small);
        const Status written = folder->writeText("trace.json", std::string(100000, 'x'));

        setrlimit(RLIMIT_FSIZE, &before);
        ASSERT_FALSE(written);
        EXPECT_EQ(written.error().message, "cannot write " + path + "/trace.json: File too large");
    }
    size_t files = 0;
    for (const auto& entry : fs::directory_iterator(path)) {
        EXPECT_EQ(entry.path().filename(), "passes.csv");
        ++files;
    }
    EXPECT_EQ(files, 1u);
    EXPECT_EQ(*readFile(path + "/passes.csv"), "old\n");
}

TEST(Folder, IsNotMadeWhereNothingCanBeWritten) {
    const auto folder = Folder::open("/proc/none/capture");
    ASSERT_FALSE(folder);
    EXPECT_NE(folder.error().message.find("/proc/none/capture"), std::string::npos);
    const std::string path = test::ownFile("unused");
    {
        const auto unused = Folder::open(path);
        EXPECT_TRUE(unused);
    }
    EXPECT_FALSE(fs::exists(path)) << "it was not there before, and nothing was committed";
}

}  // namespace
}  // namespace ag::capture
