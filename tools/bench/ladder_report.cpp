#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/bench/ladder.h"

namespace ag::bench {

std::string ladderToMarkdown(const Ladder& ladder, std::string_view device) {
    std::string out = fmt::format(
        "## {}\n\n{}, {}x{}, noise of the references {:.1f} %, {:.0f} texels of lights near to a pixel, "
        "{:.0f} rays to those.\n\n"
        "| | relative RMSE | without the worst 1 % | tone RMSE | median error | mean ratio | leak pixels |\n"
        "|---|---|---|---|---|---|---|\n",
        ladder.scene, device, ladder.size.x, ladder.size.y, ladder.noise * 100, ladder.nearTexels,
        ladder.nearRays);
    for (size_t s = 0; s < kStages; ++s) {
        const ImageDifference& e = ladder.errors[s];
        out += fmt::format("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {:.1f} |\n", kStageNames[s],
                           e.relativeRmse, e.trimmedRelativeRmse, e.toneRmse, e.medianRelative, e.meanRatio,
                           e.leakPixels);
    }
    return out;
}

std::string laddersToJson(const std::vector<Ladder>& ladders, std::string_view device) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const Ladder& ladder : ladders)
        for (size_t s = 0; s < kStages; ++s) {
            nlohmann::ordered_json row = {{"scene", ladder.scene},
                                          {"stage", kStageNames[s]},
                                          {"size", {ladder.size.x, ladder.size.y}},
                                          {"noise_floor", ladder.noise},
                                          {"near_texels", ladder.nearTexels},
                                          {"near_rays", ladder.nearRays}};
            for (const DifferenceField& field : differenceFields())
                row[field.name] = ladder.errors[s].*field.member;
            rows.push_back(std::move(row));
        }
    return nlohmann::ordered_json{{"device", device}, {"rows", rows}}.dump(1) + "\n";
}

}  // namespace ag::bench
