// Irradiance at points of the game, for rules and for things that are lit as a whole: bounced light from the
// same area lights and shadow maps as on screen, direct light from the lights that bounce (those with an
// RSM, by its depth; others do not count). Read back without a stall: what is known is kFramesInFlight frames
// old.
#pragma once

#include <optional>
#include <vector>

#include "engine/core/render_probe.h"
#include "engine/core/setting_fields.h"
#include "gi/ism_atlas.h"
#include "gi/probe_rays.h"
#include "gi/val_shading.h"
#include "shaders/probes/probes_io.h"

namespace ag::gi {

constexpr uint32_t kMostProbes = 4096;  // further ones are left out

struct ProbeSettings {
    ValShape shape = ValShape::kPolygon;
    uint32_t taps = 4;            // of an area light's soft shadow
    uint32_t rays = 32;           // of a probe, a frame; four times as many once nothing changes; 0: none
    uint32_t settleFrames = 256;  // with new rays after anything last changed

    static constexpr auto fields() {
        return std::tuple{
            SettingField{"shape", &ProbeSettings::shape}.unlisted(),
            SettingField{"taps", &ProbeSettings::taps, 1, 32, "", "of area lights' soft shadows at probes"},
            SettingField{"rays", &ProbeSettings::rays, 0, 256, "",
                         "from each probe a frame, four times as many once nothing changes; 0: none"},
            SettingField{"settle_frames", &ProbeSettings::settleFrames, 0, 1000000, "frames",
                         "with new rays after anything last changed"}};
    }

    bool operator==(const ProbeSettings&) const = default;
};

struct ProbeReading {
    glm::vec3 direct{0}, bounced{0};  // W/m²
    bool operator==(const ProbeReading&) const = default;
};

// What was read back last, by the probes' ids.
class ProbeReadings {
  public:
    // None: it was not measured yet.
    std::optional<ProbeReading> of(uint64_t id) const;
    size_t count() const { return rows_.size(); }

    // `lightUnit`: W/m² in one of the rows' numbers.
    void set(std::span<const std::byte> rows, float lightUnit);
    // Without light there is nothing to measure.
    void setDark(std::span<const RenderProbe> probes);
    void clear() { rows_.clear(); }

  private:
    struct Row {
        uint64_t id = 0;
        ProbeReading reading;
    };
    std::vector<Row> rows_;  // sorted by id
};

struct ProbeHistory {
    ProbeReadings readings;
    ProbeRaysHistory rays;
};

// Names of the copies that are read back.
constexpr std::array<std::string_view, kFramesInFlight> kProbeCopies = {"probes.read0", "probes.read1"};

struct ProbePoints {
    std::span<const RenderProbe> probes;
    float lightUnit = 1;  // see ProbeReadings::set
};

// Measures the probes and updates the readings. Without probes nothing is declared. `rays`: what they go to;
// none: no rays.
void addProbes(GraphScope scope, const ProbePoints& at, const RsmSet& rsm, const ShadowedVals& lights,
               const ProbeSettings& settings, ProbeHistory& history, const ProbeRaysInputs* rays = nullptr);

}  // namespace ag::gi
