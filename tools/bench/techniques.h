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
    std::string_view term = "bounce1";  // of light, that its error is measured on; "all": both of two bounces
    bool onlyByName = false;            // left out where no techniques are named
    std::vector<Variant> variants;
};

// The layer, of renderer and reference, that holds a term.
std::string_view layerOfTerm(std::string_view term);
std::span<const Technique> techniques();
const Technique* findTechnique(std::string_view name);
// Ours with the quality that each time of a frame's passes allows.
Technique budgetTechnique(const std::vector<double>& budgetsMs);

}  // namespace ag::bench
