#include "tools/bench/report.h"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace ag::bench {
namespace {

std::string settingsText(const Row& row) {
    std::string text;
    for (const auto& [name, value] : row.settings)
        text += (text.empty() ? "" : " ") + name + "=" + value;
    return text;
}

bool beats(const Row& a, const Row& b) {
    return a.indirectMs() <= b.indirectMs() && a.error.relativeRmse <= b.error.relativeRmse &&
           (a.indirectMs() < b.indirectMs() || a.error.relativeRmse < b.error.relativeRmse);
}

std::vector<std::string> scenesOf(const Report& report) {
    std::vector<std::string> scenes;
    for (const Row& row : report.rows)
        if (std::find(scenes.begin(), scenes.end(), row.scene) == scenes.end()) scenes.push_back(row.scene);
    return scenes;
}

nlohmann::ordered_json orNull(std::optional<double> value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

std::string orBlank(std::optional<double> value, int digits) {
    return value ? fmt::format("{:.{}f}", *value, digits) : "";
}

}  // namespace

void markPareto(Report& report) {
    for (Row& row : report.rows) {
        row.pareto = !row.isPathTracing();
        for (const Row& other : report.rows)
            if (!other.isPathTracing() && other.scene == row.scene && other.term == row.term &&
                beats(other, row))
                row.pareto = false;
    }
}

nlohmann::ordered_json rowToJson(const Row& r) {
    nlohmann::ordered_json out = {{"scene", r.scene},
                                  {"technique", r.technique},
                                  {"variant", r.variant},
                                  {"settings", r.settings},
                                  {"size", {r.size.x, r.size.y}},
                                  {"vals", r.vals},
                                  {"frames", r.frames},
                                  {"gpu_ms_median", r.gpuMsMedian},
                                  {"gpu_ms_p99", r.gpuMsP99},
                                  {"gbuffer_ms_median", r.gbufferMs},
                                  {"indirect_ms_median", r.indirectMs()},
                                  {"cpu_ms_median", r.cpuMsMedian},
                                  {"passes", r.passes},
                                  {"skipped", r.skipped},
                                  {"gpu_bytes", r.gpuBytes},
                                  {"term", r.term},
                                  {"flip", r.flip},
                                  {"noise_floor", r.noiseFloor},
                                  {"flicker_still", orNull(r.flickerStill)},
                                  {"flicker_moving", orNull(r.flickerMoving)},
                                  {"flicker_walking", orNull(r.flickerWalking)},
                                  {"ghosting", orNull(r.ghosting)},
                                  {"equal_time_path_tracing_rel_rmse", r.pathTracingRelRmse},
                                  {"pareto", r.pareto},
                                  {"clusterings", r.clusterings},
                                  {"rel_rmse_spread", r.relRmseSpread}};
    for (const DifferenceField& field : differenceFields())
        out[field.name] = r.error.*field.member;
    return out;
}

namespace {

// Numbers of a file may be any: what is no count fails like what is not there.
template <class T>
void readCount(const nlohmann::json& json, T& count) {
    if (!json.is_number_unsigned() || json.get<uint64_t>() > std::numeric_limits<T>::max())
        throw nlohmann::json::other_error::create(501, json.dump() + " is not a count", &json);
    count = json.get<T>();
}

}  // namespace

Result<Row> rowFromJson(const nlohmann::json& j) {
    const auto optional = [&](const char* name) {
        return j.at(name).is_null() ? std::optional<double>() : std::optional(j.at(name).get<double>());
    };
    try {
        Row r;
        j.at("scene").get_to(r.scene), j.at("technique").get_to(r.technique),
            j.at("variant").get_to(r.variant);
        j.at("settings").get_to(r.settings);
        readCount(j.at("size").at(0), r.size.x), readCount(j.at("size").at(1), r.size.y);
        readCount(j.at("vals"), r.vals), readCount(j.at("frames"), r.frames);
        j.at("gpu_ms_median").get_to(r.gpuMsMedian), j.at("gpu_ms_p99").get_to(r.gpuMsP99);
        j.at("gbuffer_ms_median").get_to(r.gbufferMs), j.at("cpu_ms_median").get_to(r.cpuMsMedian);
        j.at("passes").get_to(r.passes), j.at("skipped").get_to(r.skipped);
        readCount(j.at("gpu_bytes"), r.gpuBytes);
        j.at("term").get_to(r.term);
        for (const DifferenceField& field : differenceFields())
            j.at(field.name).get_to(r.error.*field.member);
        j.at("flip").get_to(r.flip), j.at("noise_floor").get_to(r.noiseFloor);
        r.flickerStill = optional("flicker_still"), r.flickerMoving = optional("flicker_moving");
        r.flickerWalking = optional("flicker_walking"), r.ghosting = optional("ghosting");
        j.at("equal_time_path_tracing_rel_rmse").get_to(r.pathTracingRelRmse);
        j.at("pareto").get_to(r.pareto);
        readCount(j.at("clusterings"), r.clusterings), j.at("rel_rmse_spread").get_to(r.relRmseSpread);
        return r;
    } catch (const nlohmann::json::exception& e) {
        return Error{std::string("a row of the benchmark cannot be read: ") + e.what()};
    }
}

std::string toJson(const Report& report) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Row& row : report.rows)
        rows.push_back(rowToJson(row));
    const nlohmann::ordered_json out = {
        {"device", report.device}, {"driver", report.driver}, {"commit", report.commit}, {"rows", rows}};
    return out.dump(1) + "\n";
}

std::string toCsv(const Report& report) {
    std::string out =
        "scene,technique,variant,settings,width,height,vals,frames,gpu_ms_median,gpu_ms_p99,"
        "indirect_ms_median,cpu_ms_median,gpu_bytes,term,mean_ratio,rel_rmse,rel_mse,p99,flip,noise_floor,"
        "flicker_still,flicker_moving,flicker_walking,ghosting,equal_time_path_tracing_rel_rmse,pareto,"
        "device,tone_rmse,rel_rmse_trimmed,median_rel,leak_pixels,clusterings,rel_rmse_spread\n";
    for (const Row& r : report.rows)
        out += fmt::format(
            "{},{},{},{},{},{},{},{},{:.4f},{:.4f},{:.4f},{:.4f},{},{},{:.5f},{:.5f},{:.6f},{:.5f},{:.5f},"
            "{:.5f},{},{},{},{},{:.5f},{},\"{}\",{:.5f},{:.5f},{:.5f},{:.1f},{},{:.5f}\n",
            r.scene, r.technique, r.variant, settingsText(r), r.size.x, r.size.y, r.vals, r.frames,
            r.gpuMsMedian, r.gpuMsP99, r.indirectMs(), r.cpuMsMedian, r.gpuBytes, r.term, r.error.meanRatio,
            r.error.relativeRmse, r.error.relMse, r.error.p99, r.flip, r.noiseFloor,
            orBlank(r.flickerStill, 6), orBlank(r.flickerMoving, 6), orBlank(r.flickerWalking, 6),
            orBlank(r.ghosting, 6), r.pathTracingRelRmse, r.pareto ? 1 : 0, report.device, r.error.toneRmse,
            r.error.trimmedRelativeRmse, r.error.medianRelative, r.error.leakPixels, r.clusterings,
            r.relRmseSpread);
    return out;
}

std::string toMarkdown(const Report& report) {
    std::string out =
        fmt::format("Device: {}, {}. Commit {}.\n", report.device, report.driver, report.commit);
    for (const std::string& scene : scenesOf(report)) {
        const auto first = std::find_if(report.rows.begin(), report.rows.end(),
                                        [&](const Row& r) { return r.scene == scene; });
        const auto most = std::ranges::max_element(
            report.rows, {}, [&](const Row& r) { return r.scene == scene ? r.clusterings : 0; });
        out += fmt::format(
            "\n## {}\n\n{}x{}, {} against path tracing (noise {:.2f} %). ★: nothing is both faster and "
            "nearer "
            "to the truth. Of what has clusters, errors are means over {} clusterings, of one where rays "
            "rest at other settings than the preset's.\n\n| technique | "
            "setting | indirect ms | relative RMSE | mean ratio | FLIP | p99 "
            "| "
            "flicker still | light moves | camera moves | ghosting | path tracing in the same time | MiB | "
            "tone RMSE | without the worst 1 % | median error | leak pixels |\n"
            "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
            scene, first->size.x, first->size.y, first->term, first->noiseFloor * 100, most->clusterings);
        for (const Row& r : report.rows) {
            if (r.scene != scene || r.isPathTracing()) continue;
            const std::string paths =
                r.pathTracingRelRmse > 0 ? fmt::format("{:.2f}", r.pathTracingRelRmse) : "";
            out += fmt::format(
                "| {}{} | {} | {:.2f} | {:.3f} | {:.3f} | {:.3f} | {:.2f} | {} | {} | "
                "{} | {} | {} | {:.1f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n",
                r.technique, r.pareto ? " ★" : "", r.variant, r.indirectMs(), r.error.relativeRmse,
                r.error.meanRatio, r.flip, r.error.p99, orBlank(r.flickerStill, 4),
                orBlank(r.flickerMoving, 4), orBlank(r.flickerWalking, 4), orBlank(r.ghosting, 4), paths,
                double(r.gpuBytes) / 1048576.0, r.error.toneRmse, r.error.trimmedRelativeRmse,
                r.error.medianRelative, r.error.leakPixels);
        }
    }
    return out;
}

}  // namespace ag::bench
