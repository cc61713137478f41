// Lit surface points found from the lights: a second way to sample bounced light beside looking for it from
// the camera. Where little of what a camera's path meets is lit (a room that the sun enters through a
// window), the first way finds light that the other hardly ever meets; both are weighted by the balance
// heuristic (Veach and Guibas 1995), so that each counts where it is the better one. A point is one texel of
// a light's map, drawn by a chance that is learned from what earlier points brought to the picture.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "engine/jobs/job_graph.h"
#include "tools/reference/light_beams.h"

namespace ag::reference {

// What is asked of every candidate, half a cache line: the rest is LitPoints::source.
struct alignas(32) LitPoint {
    glm::vec3 position{0};
    float density = 0;     // of points on the surface, 1/m²
    glm::vec3 normal{0};   // geometric, on the light's side
    float brightness = 0;  // about what it sends, W/sr over the density; 0: the ray met nothing that reflects
};

// What is asked of those that are taken.
struct LitPointSource {
    Surface surface;        // resolved
    glm::vec3 toLight{0};   // unit
    glm::vec3 arriving{0};  // irradiance over the density, W: the mean of all draws is the lights' power
    uint32_t texel = 0;     // of all maps
};

// About how much a surface gets from a point a unit of its brightness, before anything hides it; never 0 in
// front of it. `spread`: m, over how much space surfaces are taken to be alike.
inline float roughGeometry(const LitPoint& p, glm::vec3 position, glm::vec3 normal, float spread) {
    constexpr float kLeastCosine = 0.2f;  // of surfaces turned otherwise nearby
    const glm::vec3 d = p.position - position;
    const float square = glm::dot(d, d), scale = 1 / std::sqrt(std::max(square, 1e-20f));
    const float sent = -glm::dot(p.normal, d) * scale, received = glm::dot(normal, d) * scale;
    return std::max(sent, 0.0f) * (kLeastCosine + std::max(received, 0.0f)) / (square + spread * spread);
}

// A place that a light lights, as if it were a point.
struct LitPlace : LitPoint {
    uint32_t cell = 0;
};

// How often points of a cell were looked for from a tile of the picture, and how often they were seen.
struct Sight {
    uint16_t tried = 0, seen = 0;
    void note(bool sees) {
        if (tried == UINT16_MAX) return;
        tried += 1, seen += sees;
    }
    // The next one is seen by a chance of about this; never 0.
    float chance() const { return (float(seen) + 2) / (float(tried) + 2); }
};

// What a point brought to the picture: for learning.
struct LitPointWorth {
    uint32_t texel = 0;
    float worth = 0;
};

class LitPoints {
  public:
    // Lights that cast no shadow are left out: their rays do not end at the first surface.
    explicit LitPoints(const RayScene& scene);

    bool empty() const { return total_ <= 0; }
    // What a place lit by a light would be if it were drawn; density 0: it cannot be. `irradiance` is the
    // light's there.
    LitPlace pointOn(uint32_t light, const Surface& at, glm::vec3 irradiance) const;
    // Draws `count` points, evenly over their chances. `rays` counts theirs.
    void draw(uint32_t count, uint32_t seed, JobRunner& runner, uint64_t& rays);
    std::span<const LitPoint> points() const { return points_; }
    const LitPointSource& source(uint32_t point) const { return sources_[point]; }
    // Squares of texels of the maps: those of neighbours are seen alike.
    uint32_t cell(uint32_t point) const { return cellOfTexel_[sources_[point].texel]; }

    // Whether points' worths are still asked for.
    bool learns() const { return learns_ && !empty(); }
    void stopLearning() { learns_ = false; }
    // Notes how often texels were drawn and what that brought, in the order given: the sums do not depend on
    // threads.
    void note(std::span<const LitPointWorth> worths);
    // Chances anew from what was noted.
    void learn();

    // What is known of the picture's tiles, see TilePoints: usual sums, and what each sees, by cell.
    void setTileCount(uint32_t count);
    std::span<Sight> sights(uint32_t tile) { return tiles_[tile].sights; }
    double usualSum(uint32_t tile) const {
        return tiles_[tile].draws ? tiles_[tile].sum / tiles_[tile].draws : 0;
    }
    void addTileSum(uint32_t tile, double sum) { tiles_[tile].sum += sum, tiles_[tile].draws += 1; }

  private:
    struct Tile {
        double sum = 0;
        uint32_t draws = 0;
        std::vector<Sight> sights;
    };
    struct Map {
        BeamMap shape;
        uint32_t firstTexel = 0;
        bool used = false;
    };
    void setChances(std::span<const double> weights);
    void placePoint(uint32_t index, uint32_t texel, glm::vec2 inTexel, uint64_t& rays);
    void addMap(uint32_t light, uint32_t resolution);
    double chanceOf(uint32_t texel) const {
        return cumulative_[texel] - (texel ? cumulative_[texel - 1] : 0);
    }
    double smoothed(const std::vector<double>& values, uint32_t texel) const;

    const RayScene& scene_;
    std::vector<Map> maps_;  // by light
    std::vector<uint32_t> lightOfTexel_, cellOfTexel_;
    uint32_t cellCount_ = 0;
    std::vector<double> power_;       // W, of each texel's rays: the chances before anything is learned
    std::vector<double> cumulative_;  // of the chances
    std::vector<double> worth_;
    double noted_ = 0;
    double total_ = 0;  // W
    bool learns_ = true;
    std::vector<Tile> tiles_;
    std::vector<LitPoint> points_;
    std::vector<LitPointSource> sources_;  // of the points
};

// Surfaces of a tile of the picture.
struct TileSurfaces {
    static constexpr uint32_t kMost = 4;
    const Surface* at[kMost] = {};
    uint32_t count = 0;
    float spread = 0;  // about how large a piece each stands for, m
};

// The points that matter to one tile of the picture come oftener among its candidates than others.
class TilePoints {
  public:
    // No surfaces: all points alike. `usualSum`: of what points matter, the mean of earlier draws, so that
    // weights do not depend on this draw; 0: none yet. `sights`: of the tile, by cell; stays.
    void choose(const LitPoints& lit, const TileSurfaces& surfaces, double usualSum, std::span<Sight> sights,
                uint32_t seed);
    double sum() const { return sum_; }  // of this draw, a point
    // Whether a point was seen from the tile, once it is known.
    void note(uint32_t point, bool seen);

    // A point by a number in [0, 1): of those that matter here, or of all.
    uint32_t candidate(bool matters, float place) const;
    // How much oftener than by chance the point is drawn when every other candidate is one that matters.
    float oftener(uint32_t point) const { return table_.empty() ? 1 : 0.5f + 0.5f * shares_[point]; }
    // About the same, the same function of the lit place in every draw: for weights.
    float usuallyOftener(uint32_t point) const {
        return usualSum_ > 0 ? usuallyOftenerBy(float(sum_) * shares_[point]) : 1;
    }
    float usuallyOftener(const LitPlace& place) const {
        return usualSum_ > 0 ? usuallyOftenerBy(matters(place, place.cell)) : 1;
    }

  private:
    // A draw that holds a point that matters so much has it in its sum.
    float usuallyOftenerBy(float matters) const {
        return 0.5f + 0.5f * matters / (float(usualSum_) + matters / float(shares_.size()));
    }
    // About what a point sends to the tile's surfaces and how likely they see it.
    float matters(const LitPoint& point, uint32_t cell) const;

    const LitPoints* lit_ = nullptr;
    TileSurfaces surfaces_;
    std::span<Sight> sights_;
    std::vector<float> chances_;  // that a cell is seen, as this draw began
    double sum_ = 0, usualSum_ = 0;
    std::vector<float> shares_;    // by point; mean 1
    std::vector<uint32_t> table_;  // points as often as their shares ask
};

}  // namespace ag::reference
