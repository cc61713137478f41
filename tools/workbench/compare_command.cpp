#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/core/flip.h"
#include "engine/core/image_difference.h"
#include "engine/core/number_option.h"
#include "engine/core/safe_file.h"
#include "tools/reference/reference.h"
#include "tools/workbench/commands.h"

namespace ag::workbench {
namespace {

struct CompareOptions {
    std::vector<std::string> images;  // the truth once or twice, then the one that is compared
    std::string heatmap;
    double most = std::numeric_limits<double>::infinity();
};

// Where and which way B is off: red too bright, blue too dark, full at the truth's mean, black none.
Image heatmapOf(const Image& truth, const Image& test) {
    double mean = 0;
    for (const glm::vec3& p : truth.pixels)
        mean += double(p.x + p.y + p.z) / (3.0 * double(truth.pixels.size()));
    Image out(truth.width, truth.height);
    for (size_t i = 0; i < out.pixels.size(); ++i) {
        const glm::vec3 d = test.pixels[i] - truth.pixels[i];
        const float share = std::clamp((d.x + d.y + d.z) / 3 / float(std::max(mean, 1e-30)), -1.0f, 1.0f);
        const float strength = std::sqrt(std::abs(share));  // small errors shall be seen
        out.pixels[i] = (share > 0 ? glm::vec3(1, 0.25f, 0.1f) : glm::vec3(0.15f, 0.4f, 1)) * strength;
    }
    return out;
}

Result<std::vector<Image>> loadAll(const std::vector<std::string>& paths) {
    std::vector<Image> images;
    for (const std::string& path : paths) {
        auto image = loadImage(path);
        if (!image) return image.error();
        images.push_back(std::move(*image));
    }
    return images;
}

nlohmann::ordered_json numbersOf(const ImageDifference& d) {
    nlohmann::ordered_json out;
    for (const DifferenceField& field : differenceFields())
        out[field.name] = d.*field.member;
    return out;
}

int runCompare(const CompareOptions& o) {
    if (const Status writable = checkWritable({o.heatmap}); !writable)
        return refuse(writable.error().message);
    const auto images = loadAll(o.images);
    if (!images) return refuse(images.error().message);
    const Image &first = images->front(), &test = images->back();
    const bool twoTruths = images->size() == 3;
    const TwoEstimates truths(first, twoTruths ? (*images)[1] : first);
    const auto difference = compareImages(truths, test);
    if (!difference) {
        std::cerr << "afterglow: " << difference.error().message << '\n';
        return 1;
    }
    const Image truth = meanOf(truths);
    nlohmann::ordered_json out = numbersOf(*difference);
    out["flip"] = meanFlip(truth, test);
    if (twoTruths)
        out["noise_floor"] = reference::noiseOf(truths.a, truths.b);
    else if (const auto noise = first.attributes.find("noise"); noise != first.attributes.end())
        out["noise_floor"] = parseNumber(noise->second).value_or(0);
    for (const auto& [name, image] : {std::pair("filter_a", &first), {"filter_b", &test}})
        if (const auto filter = image->attributes.find("filter"); filter != image->attributes.end())
            out[name] = filter->second;
    std::cout << out.dump(2) << '\n';
    if (!o.heatmap.empty())
        if (const Status saved = saveImage(heatmapOf(truth, test), o.heatmap); !saved)
            return refuse(saved.error().message);
    return difference->relativeRmse <= o.most ? 0 : 1;
}

}  // namespace

void addCompareCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<CompareOptions>();
    CLI::App* command = program.add_subcommand("compare", "differences of image B from image A as JSON");
    command
        ->add_option("images", o->images,
                     "A B, or A1 A2 B: EXR or PFM, A the truth; of two seeds its noise does not count")
        ->required()
        ->expected(2, 3);
    command->add_option("--max-rel-rmse", o->most, "exit with 1 above this relative RMSE")
        ->check(numberFrom(0, 1e30));
    command->add_option("--heatmap", o->heatmap,
                        "FILE.png: red where B is too bright, blue where too dark, full at the mean of A");
    command->callback([o, &exitCode] { exitCode = runCompare(*o); });
}

}  // namespace ag::workbench
