// How much each punctual light matters to what is seen, measured on the device at points of the view and read
// a few frames later, without waiting: a light beyond a wall, however strong and near, needs no shadow map of
// its own.
#pragma once

#include <optional>
#include <vector>

#include "engine/frame/frame_graph.h"
#include "shaders/direct_lighting/direct_lighting_io.h"

namespace ag::render {

struct PunctualLists;

// Names of the copies that are read back.
constexpr std::array<std::string_view, kFramesInFlight> kPunctualRelevanceCopies = {
    "punctual_relevance.read0", "punctual_relevance.read1"};

class PunctualRelevance {
  public:
    // Of a light by its id; none: it was not measured yet.
    std::optional<float> of(uint64_t id) const;
    float mean() const { return mean_; }
    bool operator==(const PunctualRelevance&) const = default;

    // What was read back; rows that are no lights are left out.
    void set(std::span<const std::byte> rows);

  private:
    struct Entry {
        uint64_t id = 0;
        float relevance = 0;
        bool operator==(const Entry&) const = default;
    };
    std::vector<Entry> entries_;  // sorted by id
    float mean_ = 0;
};

// Measures the lights and updates `known` with what was measured two frames ago.
void addPunctualRelevance(GraphScope scope, BufferHandle viewPoints, const PunctualLists& lights,
                          PunctualRelevance& known);

}  // namespace ag::render
