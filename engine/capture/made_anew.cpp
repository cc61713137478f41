#include "engine/capture/made_anew.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

namespace ag::capture {
namespace {

// What it means that one of these changed, by name.
struct Meaning {
    std::string_view name, words;
};
constexpr std::array kMeanings = {
    Meaning{"scene.camera", "the camera moved"},
    Meaning{"gbuffer.downsample_camera", "the camera moved"},
    Meaning{"texel_rays.cameras", "the camera moved"},
    Meaning{"gloss_rays.cameras", "the camera moved"},
    Meaning{"gloss_rays.all_cameras", "the camera moved"},
    Meaning{"scene.materials", "materials changed"},
    Meaning{"scene.surface_samples", "surfaces were sampled anew"},
    Meaning{"scene.tree_nodes", "what rays meet was built anew"},
    Meaning{"scene.tree_places", "things that rays meet moved"},
    Meaning{"scene.mover_nodes", "things that rays meet moved"},
    Meaning{"scene.sky_texels", "the sky changed"},
    Meaning{"skinning.joints", "skinned meshes moved"},
    Meaning{"rsm.faces", "a light that bounces, or what it shines on, changed"},
    Meaning{"rsm.render", "a light that bounces, or what it shines on, changed"},
    Meaning{"gbuffer.fill", "what is drawn for the camera changed"},
    Meaning{"shadow_maps.views", "a sun or what its shadow maps cover changed"},
    Meaning{"punctual_lists.lights", "lamps in view changed"},
    Meaning{"exposure.adapt", "the exposure is still settling"}};

std::string meaningOf(std::string_view name, std::string_view otherwise) {
    const auto known = std::ranges::find(kMeanings, name, &Meaning::name);
    return known == kMeanings.end() ? fmt::format("{} {}", name, otherwise) : std::string(known->words);
}

std::string_view techniqueOf(std::string_view pass) {
    return pass.substr(0, pass.find('.'));
}

class Causes {
  public:
    explicit Causes(const FrameDescription& frame) : frame_(frame) {}

    std::string of(size_t pass) const {
        const PassDescription& p = frame_.passes[pass];
        switch (p.cause) {
            case PassReason::kFirst:
                return "it was never made before";
            case PassReason::kParameters:
                return ofParameters(pass);
            case PassReason::kHistory:
                return "it goes on from the frame before";
            case PassReason::kLost:
                return std::string(kLost);
            case PassReason::kInput:
                return ofInput(pass);
            default:
                return std::string(kAll);
        }
    }

    // They say nothing where there is another cause.
    static constexpr std::string_view kLost = "what it had made was needed and no longer kept",
                                      kAll = "nothing is skipped in this frame";

  private:
    bool ran(std::string_view name) const {
        return std::ranges::any_of(frame_.passes, [&](const PassDescription& p) {
            return p.name == name && p.outcome == PassOutcome::kRan;
        });
    }

    // The last pass before that made a resource in this frame; none: it is from outside or as it was.
    std::optional<size_t> writerOf(uint32_t resource, size_t pass) const {
        for (size_t before = pass; before-- > 0;) {
            const PassDescription& w = frame_.passes[before];
            if (w.outcome == PassOutcome::kRan && std::ranges::count(w.writes, resource) > 0) return before;
        }
        return std::nullopt;
    }

    std::string ofInput(size_t pass) const {
        const uint32_t changed = frame_.passes[pass].changed;
        if (changed >= frame_.resources.size()) return "something it reads changed";
        if (const auto writer = writerOf(changed, pass)) return of(*writer);
        return meaningOf(frame_.resources[changed].name, "changed");
    }

    // Constants and draws often change with what is read: that says more.
    std::string ofParameters(size_t pass) const {
        const PassDescription& p = frame_.passes[pass];
        if (p.uploads) return meaningOf(p.name, "was given other values");
        for (const uint32_t read : p.reads) {
            const auto writer = writerOf(read, pass);
            if (!writer) continue;
            const std::string cause = of(*writer);
            if (cause != kLost && cause != kAll) return cause;
        }
        // The camera's matrix goes with the draws.
        if (p.name == "gbuffer.fill" && ran("scene.camera")) return meaningOf("scene.camera", "");
        return meaningOf(p.name, "has other settings, takes another step or draws other things");
    }

    const FrameDescription& frame_;
};

struct Anew {
    std::string_view technique;
    uint32_t passes = 0;
    std::vector<std::string> causes;
};

std::string sentenceOf(const Anew& anew) {
    return fmt::format("{} ({} pass{}): {}.", anew.technique, anew.passes, anew.passes == 1 ? "" : "es",
                       fmt::join(anew.causes, "; "));
}

}  // namespace

std::vector<std::string> madeAnew(const FrameDescription& frame) {
    const Causes causes(frame);
    std::vector<Anew> made;
    for (size_t p = 0; p < frame.passes.size(); ++p) {
        if (frame.passes[p].outcome != PassOutcome::kRan) continue;
        const std::string_view technique = techniqueOf(frame.passes[p].name);
        auto known = std::ranges::find(made, technique, &Anew::technique);
        if (known == made.end()) known = made.insert(made.end(), {.technique = technique});
        ++known->passes;
        const std::string cause = causes.of(p);
        if (std::ranges::count(known->causes, cause) == 0) known->causes.push_back(cause);
    }
    std::vector<std::string> sentences;
    for (Anew& anew : made) {
        const auto dull = [](const std::string& c) { return c == Causes::kLost || c == Causes::kAll; };
        if (!std::ranges::all_of(anew.causes, dull)) std::erase_if(anew.causes, dull);
        sentences.push_back(sentenceOf(anew));
    }
    return sentences;
}

}  // namespace ag::capture
