#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <iostream>
#include <optional>

#include "engine/core/hash.h"
#include "engine/core/log.h"
#include "engine/core/near_name.h"
#include "tools/bench/ladder.h"
#include "tools/bench/measure.h"
#include "tools/bench/path_tracing.h"
#include "tools/bench/row_cache.h"
#include "tools/scenegen/scenes.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/progress_line.h"
#include "tools/workbench/scene_options.h"
#include "tools/workbench/session.h"
#include "tools/workbench/text_file.h"

namespace ag::workbench {
namespace {

struct BenchOptions {
    std::vector<double> budgets;  // ms
    std::vector<std::string> scenes = {"cornell", "occluder", "corridor"};
    std::vector<std::string> techniques, ladders;
    std::string size = "640x360", flickerSize = "160x90";
    std::string json, csv, plot, markdown;
    std::string term;  // empty: each technique's own
    std::string sessionFile;
    std::optional<Session> session;  // in place of scenes
    std::string cache = bench::defaultCacheFolder();
    uint32_t param = 0;
    bool plain = false, noFlicker = false, noPathTracing = false, again = false;
    bench::MeasureOptions measure;
};

std::string commitOfSource() {
    const std::string command =
        fmt::format("git -C '{}' rev-parse --short HEAD 2>/dev/null", AFTERGLOW_SOURCE_DIR);
    FILE* pipe = popen(command.c_str(), "r");
    char line[64] = {};
    if (!pipe) return "unknown";
    const bool read = std::fgets(line, sizeof line, pipe) != nullptr;
    pclose(pipe);
    std::string commit = line;
    while (!commit.empty() && commit.back() == '\n')
        commit.pop_back();
    return read && !commit.empty() ? commit : "unknown";
}

Result<std::vector<const bench::Technique*>> chosenTechniques(const std::vector<std::string>& names) {
    std::vector<const bench::Technique*> chosen;
    if (names.empty())
        for (const bench::Technique& t : bench::techniques())
            if (t.term == "bounce1" && !t.onlyByName) chosen.push_back(&t);
    for (const std::string& name : names) {
        chosen.push_back(bench::findTechnique(name));
        if (chosen.back()) continue;
        std::vector<std::string_view> known;
        for (const bench::Technique& t : bench::techniques())
            known.push_back(t.name);
        return Error{missingName("technique", name, known)};
    }
    return chosen;
}

// After every row, so that a long run cut short leaves what it measured.
Status writeAll(const BenchOptions& o, bench::Report report) {
    bench::markPareto(report);
    for (const Status& written :
         {writeTextFile(o.json, toJson(report)), writeTextFile(o.csv, toCsv(report)),
          writeTextFile(o.plot, toSvg(report)), writeTextFile(o.markdown, toMarkdown(report))})
        if (!written) return written;
    return Ok{};
}

// How many rows there are, and how long those that are left will take if they are like the ones before.
class Pace {
  public:
    explicit Pace(size_t rows) : rows_(rows) {
        std::cout << fmt::format("{} rows; how long they take is said from the first on\n", rows);
    }
    std::string rowDone() {
        ++done_;
        const double spent = std::chrono::duration<double>(Clock::now() - start_).count();
        const double left = spent / double(done_) * double(rows_ - std::min(done_, rows_));
        return fmt::format("{} of {}, about {:.0f} s left", done_, rows_, left);
    }

  private:
    using Clock = std::chrono::steady_clock;
    const size_t rows_;
    const Clock::time_point start_ = Clock::now();
    size_t done_ = 0;
};

void printRow(const bench::Row& row, Pace& pace) {
    std::cout << fmt::format(
                     "{:<12} {:<18} {:<14} {:9.2f} ms  relative RMSE {:.4f}  mean ratio {:.3f}  ({})\n",
                     row.scene, row.technique, row.variant, row.indirectMs(), row.error.relativeRmse,
                     row.error.meanRatio, pace.rowDone())
              << std::flush;
}

// The number after the last of a mark in a name; none: the mark is part of the name.
std::optional<uint32_t> takeNumber(std::string& name, char mark) {
    const size_t at = name.rfind(mark);
    const std::string number = at == std::string::npos ? "" : name.substr(at + 1);
    const bool isNumber =
        !number.empty() && number.size() < 8 && number.find_first_not_of("0123456789") == std::string::npos;
    if (!isNumber) return std::nullopt;
    name.resize(at);
    return uint32_t(std::stoul(number));
}

// "lamps:80" is lamps with 80 for its number, "sponza+80" is sponza with 80 lamps hung in it.
SceneOptions sceneArguments(const BenchOptions& o, std::string name) {
    if (o.session) {
        SceneOptions arguments = o.session->scene;
        arguments.size = o.size;
        return arguments;
    }
    SceneOptions arguments{.param = o.param, .size = o.size};
    arguments.hungLamps = takeNumber(name, '+').value_or(0);
    const std::string whole = name;
    const std::optional<uint32_t> number = takeNumber(name, ':');
    const bool takesIt = number && scenegen::isBuiltIn(name);  // else it is a view of the scene library's
    if (takesIt) arguments.param = *number;
    arguments.scene = takesIt ? name : whole;
    return arguments;
}

// Of everything that a row depends on but its scene and technique.
uint64_t hashRun(const BenchOptions& o, const bench::Report& report) {
    uint64_t h = hashText(report.driver, hashText(report.device, bench::RowCache::programHash()));
    const bench::MeasureOptions& m = o.measure;
    h = hashValue(m.flickerSize, hashValue(m.size, h));
    for (const uint32_t v : {m.frames, m.referenceSamples, uint32_t(m.flicker), m.clusterings})
        h = combineHash(h, v);
    return hashValue(m.referenceError, hashValue(m.secondsPerTiming, h));
}

uint64_t hashRow(uint64_t run, uint64_t scene, const std::string& name, const bench::Technique& t,
                 const bench::Variant& v) {
    uint64_t h = hashText(name, combineHash(run, scene));
    for (const std::string_view text :
         {std::string_view(t.name), t.preset, t.term, std::string_view(v.label)})
        h = hashText(text, h);
    for (const std::string& assignment : v.settings)
        h = hashText(assignment, h);
    return hashValue(v.budgetMs, h);
}

Result<std::vector<bench::Row>> oneRow(Result<bench::Row> row) {
    if (!row) return row.error();
    return std::vector<bench::Row>{std::move(*row)};
}

// Those kept, else measured and kept.
template <class F>
Result<std::vector<bench::Row>> rowsOf(const bench::RowCache& kept, uint64_t key, F&& measure) {
    if (auto found = kept.find(key)) return std::move(*found);
    Result<std::vector<bench::Row>> rows = measure();
    if (rows) kept.keep(key, *rows);
    return rows;
}

// Its scene in place of those named.
Status openSession(BenchOptions& o) {
    if (o.sessionFile.empty()) return Ok{};
    auto session = loadSession(o.sessionFile);
    if (!session) return session.error();
    o.scenes = {o.sessionFile};
    o.session = std::move(*session);
    return Ok{};
}

// Its preset and settings, on everything that is seen.
bench::Technique sessionTechnique(const Session& session) {
    return {.name = "session",
            .preset = session.preset,
            .description = "what the viewer saved",
            .term = "all",
            .variants = {{"", session.assignments}}};
}

// What all scenes of a run share.
struct BenchRun {
    const BenchOptions& options;
    gpu::Device& device;
    std::span<const bench::Technique> techniques;
    bench::ReferenceSource references;
    bench::Report& report;
    Pace pace;
};

Status benchScene(BenchRun& all, const std::string& name) {
    const BenchOptions& o = all.options;
    bench::Report& report = all.report;
    auto loaded = loadScene(sceneArguments(o, name));
    if (!loaded) return loaded.error();
    ProgressLine line(name + ", reference: ");
    const auto progress = [&](double share) { line(share); };
    bench::SceneBench scene(all.device, loaded->scene, name, all.references, o.measure, progress);
    const bench::RowCache kept(o.again ? "" : o.cache + "/rows");
    const uint64_t run = hashRun(o, report), sceneHash = bench::sceneHash(loaded->scene);
    std::map<std::string, std::vector<bench::Row>, std::less<>> pathCurves;  // by term
    for (const bench::Technique& technique : all.techniques) {
        const bool timed = technique.runner == bench::Runner::kGpu && !o.noPathTracing;
        if (timed && !pathCurves.contains(technique.term)) {
            auto curve = rowsOf(kept, scene.hashPathTracing(technique.term),
                                [&] { return scene.measurePathTracing(technique.term); });
            if (!curve) return curve.error();
            report.rows.insert(report.rows.end(), curve->begin(), curve->end());
            pathCurves[std::string(technique.term)] = std::move(*curve);
        }
        for (const bench::Variant& variant : technique.variants) {
            auto rows = rowsOf(kept, hashRow(run, sceneHash, name, technique, variant),
                               [&] { return oneRow(scene.measure(technique, variant)); });
            if (!rows) return rows.error();
            bench::Row& row = rows->front();
            if (timed && row.gpuMsMedian > 0)
                row.pathTracingRelRmse = errorAfter(pathCurves[std::string(technique.term)], row.gpuMsMedian);
            printRow(row, all.pace);
            report.rows.push_back(row);
            if (const Status written = writeAll(o, report); !written) return written;
        }
    }
    return Ok{};
}

// What the first bounce's error is made of, scene by scene; tables are written after each.
int runLadders(const BenchOptions& o, glm::uvec2 size) {
    if (const Status ready = prepareTextFiles({o.json, o.markdown}); !ready)
        return refuse(ready.error().message);
    auto device = gpu::Device::create({});
    if (!device) return refuse(device.error().message);
    const std::string name = fmt::format("{}, {}", (*device)->info().name, (*device)->info().driver);
    bench::ReferenceCache cache(o.cache);
    JobRunner runner;
    std::vector<bench::Ladder> ladders;
    std::string tables;
    for (const std::string& scene : o.ladders) {
        auto loaded = loadScene(sceneArguments(o, scene));
        if (!loaded) return refuse(loaded.error().message);
        ProgressLine line(scene + ", reference: ");
        const bench::LadderOptions options{.size = size,
                                           .clusterings = o.measure.clusterings,
                                           .reference = {.samplesPerPixel = o.measure.referenceSamples,
                                                         .maxError = o.measure.referenceError,
                                                         .layer = "bounce1"}};
        auto ladder = bench::measureLadder(**device, loaded->scene, options, cache, runner,
                                           [&](double share) { line(share); });
        if (!ladder) return refuse(scene + ": " + ladder.error().message);
        ladder->scene = scene;
        const std::string table = ladderToMarkdown(*ladder, name);
        std::cout << table << '\n' << std::flush;
        tables += (tables.empty() ? "" : "\n") + table;
        ladders.push_back(std::move(*ladder));
        for (const Status& written :
             {writeTextFile(o.markdown, tables), writeTextFile(o.json, laddersToJson(ladders, name))})
            if (!written) return refuse(written.error().message);
    }
    return 0;
}

int runBench(BenchOptions o) {
    const auto size = parseSize(o.size), flickerSize = parseSize(o.flickerSize);
    if (!size) return refuse(size.error().message);
    if (!flickerSize) return refuse(flickerSize.error().message);
    if (!o.ladders.empty()) return runLadders(o, *size);
    if (const Status opened = openSession(o); !opened) return refuse(opened.error().message);
    std::vector<const bench::Technique*> techniques;
    const bench::Technique ofSession = o.session ? sessionTechnique(*o.session) : bench::Technique{};
    if (o.session) techniques.push_back(&ofSession);
    if (!o.session || !o.techniques.empty()) {
        const auto chosen = chosenTechniques(o.techniques);
        if (!chosen) return refuse(chosen.error().message);
        techniques.insert(techniques.end(), chosen->begin(), chosen->end());
    }
    const bench::Technique budget = bench::budgetTechnique(o.budgets);
    if (!o.budgets.empty()) techniques.push_back(&budget);
    if (!o.term.empty() && !bench::isTerm(o.term))
        return refuse(
            fmt::format("there is no term '{}' (there are: {})", o.term, fmt::join(bench::terms(), ", ")));
    std::vector<bench::Technique> ofTerm;
    for (const bench::Technique* t : techniques)
        ofTerm.push_back(*t);
    for (bench::Technique& t : ofTerm) {
        if (!o.term.empty()) t.term = o.term;
        if (o.plain && t.name != "session" && t.variants.front().budgetMs == 0)
            t.variants = {bench::Variant{}};
    }
    if (const Status ready = prepareTextFiles({o.json, o.csv, o.plot, o.markdown}); !ready)
        return refuse(ready.error().message);
    auto device = gpu::Device::create({});
    if (!device) return refuse(device.error().message);
    o.measure.size = *size;
    o.measure.flickerSize = *flickerSize;
    o.measure.flicker = !o.noFlicker;
    bench::ReferenceCache cache(o.cache);
    JobRunner runner;
    bench::Report report{
        .device = (*device)->info().name, .driver = (*device)->info().driver, .commit = commitOfSource()};
    std::cout << fmt::format("{}, {}\n", report.device, report.driver);
    size_t variants = 0;
    for (const bench::Technique& t : ofTerm)
        variants += t.variants.size();
    BenchRun all{o, **device, ofTerm, {cache, runner}, report, Pace(variants * o.scenes.size())};
    for (const std::string& scene : o.scenes)
        if (const Status done = benchScene(all, scene); !done) return refuse(done.error().message);
    return 0;
}

}  // namespace

void addBenchCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<BenchOptions>();
    CLI::App* command = program.add_subcommand("bench", "run time against error, technique by technique");
    command
        ->add_option(
            "--scenes", o->scenes,
            "comma-separated; NAME:NUMBER where one takes a number, NAME+LAMPS with lamps hung in it")
        ->delimiter(',')
        ->capture_default_str();
    command
        ->add_option("--session", o->sessionFile,
                     "what the viewer saved: its scene, and a row with its preset and settings on all light")
        ->excludes("--scenes");
    command->add_option("--techniques", o->techniques, "comma-separated; by default all of indirect light")
        ->delimiter(',');
    command
        ->add_option("--budget-ms", o->budgets,
                     "ms of a frame's passes, comma-separated: ours with the quality each allows")
        ->delimiter(',')
        ->check(numberFrom(0.1, 100000));
    command
        ->add_option("--ladder", o->ladders,
                     "comma-separated scenes: instead, what the first bounce's error is made of, with lights "
                     "and maps replaced by traced rays one after another")
        ->delimiter(',')
        ->excludes("--scenes", "--techniques", "--budget-ms", "--session");
    command
        ->add_option("--clusterings", o->measure.clusterings,
                     "errors are means over so many, of what has clusters")
        ->check(numberFrom(1, 100))
        ->capture_default_str();
    command->add_option(
        "--term", o->term,
        "of light that errors are measured on: all (radiance with every light, gloss and 16 bounces), "
        "direct, emissive, sky, bounces or bounce1; by default each technique's own");
    command->add_option("--param", o->param, "number of the built-in scenes that take one");
    command->add_option("--size", o->size, "pixels, WxH")->capture_default_str();
    command->add_option("--frames", o->measure.frames, "to time")
        ->check(numberFrom(1, 10000))
        ->capture_default_str();
    command->add_option("--json", o->json, "FILE");
    command->add_option("--csv", o->csv, "FILE");
    command->add_option("--plot", o->plot, "FILE.svg");
    command->add_option("--markdown", o->markdown, "FILE.md");
    command->add_option("--cache", o->cache, "folder that keeps references")->capture_default_str();
    command
        ->add_option("--reference-error", o->measure.referenceError, "relative RMSE to trace references to")
        ->check(numberFrom(1e-6, 1000))
        ->capture_default_str();
    command->add_option("--reference-spp", o->measure.referenceSamples, "paths a pixel, at most")
        ->check(numberFrom(2, 1e7))
        ->capture_default_str();
    command->add_option("--flicker-size", o->flickerSize, "pixels of the flicker sequences")
        ->capture_default_str();
    command->add_flag("--again", o->again,
                      "measure rows anew that were measured by this very program before");
    command->add_flag("--plain", o->plain, "one row a technique, with its own settings");
    command->add_flag("--no-flicker", o->noFlicker, "leave the flicker sequences out");
    command->add_flag("--no-path-tracing", o->noPathTracing, "leave path tracing for the same time out");
    command->callback([o, &exitCode] { exitCode = runBench(*o); });
}

}  // namespace ag::workbench
