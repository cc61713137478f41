// What `afterglow bench` can measure: presets, each at a few settings.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ag::bench {

struct Variant {
    std::string label;                  // short, for tables and charts: "256"
    std::vector<std::string> settings;  // on top of the preset, as --set takes them
    double budgetMs = 0;                // the quality is chosen for this time of a frame's passes; 0: fixed
};

enum class Runner {
    kGpu,       // a preset of the renderer
    kEmitters,  // RSM texels with ray-traced visibility, on the CPU
};

struct Technique {
    std::string_view name;
    std::string_view preset;  // empty: called as the technique
    std::string_view description;
    Runner runner = Runner::kGpu;
    std::string_view term = "bounce1";  // of light, that its error is measured on (isTerm)
    bool onlyByName = false;            // left out where no techniques are named
    std::vector<Variant> variants;
};

// "all": radiance with every light, gloss and all bounces; "direct", "emissive", "sky": light straight from
// there; "bounces": all that bounced; "bounce1", "two_bounces": of suns and lamps alone.
bool isTerm(std::string_view term);
std::span<const std::string_view> terms();
// The layer, of renderer and reference, that holds a term; and how many bounces that has.
std::string_view layerOfTerm(std::string_view term);
uint32_t bouncesOfTerm(std::string_view term);
std::span<const Technique> techniques();
const Technique* findTechnique(std::string_view name);
// Ours with the quality that each time of a frame's passes allows.
Technique budgetTechnique(const std::vector<double>& budgetsMs);

}  // namespace ag::bench
