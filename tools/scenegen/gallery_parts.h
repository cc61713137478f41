// What the gallery is furnished with. Everything stands at `at` on the floor unless it says otherwise.
#pragma once

#include "tools/scenegen/builder.h"

namespace ag::scenegen {

// A colour of paint: the flower that wants its light wears it, too.
struct Paint {
    const char* name;
    glm::vec3 albedo;
};
inline constexpr Paint kWhitePaint{"white", {0.75f, 0.74f, 0.72f}}, kRedPaint{"red", {0.70f, 0.07f, 0.05f}},
    kGreenPaint{"green", {0.09f, 0.52f, 0.10f}}, kBluePaint{"blue", {0.11f, 0.20f, 0.70f}},
    kYellowPaint{"yellow", {0.74f, 0.58f, 0.04f}}, kMagentaPaint{"magenta", {0.66f, 0.06f, 0.52f}},
    kCyanPaint{"cyan", {0.05f, 0.52f, 0.60f}};

constexpr glm::vec3 kLampColor(62, 58, 50);  // W/sr, of the lamp in the hand

struct Tiles {  // materials of a chequered floor
    uint32_t light, dark;
};

class Furnisher {
  public:
    explicit Furnisher(SceneBuilder& b);

    uint32_t paint(const Paint& paint);  // its material
    uint32_t stone, plaster, wood, darkWood, brass, iron, leaf, charcoal, tileLight, tileDark, linen, clay;

    // A material by name, made once; one that ends in a substance is drawn as that (game/substances).
    uint32_t substance(const char* name, glm::vec3 albedo);
    void floor(const char* name, glm::vec2 min, glm::vec2 max, Tiles tiles);
    void ceiling(const char* name, glm::vec2 min, glm::vec2 max, float height, uint32_t material);
    // Beams under the open sky.
    void pergola(glm::vec2 min, glm::vec2 max, float height, uint32_t material, float apart);
    // A solid box, named, that nobody passes.
    uint32_t solid(const char* name, glm::vec3 center, glm::vec3 size, uint32_t material, float yaw = 0);
    void column(glm::vec3 at, float height);
    void bench(glm::vec3 at, float yaw);
    // Hangs on a wall, its middle at `at`, looking along yaw's +Z.
    void painting(glm::vec3 at, float yaw, glm::vec2 size, uint32_t seed);
    void tapestry(const Paint& paint, glm::vec3 at, float yaw, glm::vec2 size);
    void plinth(glm::vec3 at, float height);
    // Stands on `at`; what it wants is the hand lamp's light off its paint.
    void flower(int room, const Paint& paint, float amount, glm::vec3 at, float yaw, bool shy = false);
    void lantern(int room, glm::vec3 hangsFrom, float chain);
    void sconce(glm::vec3 at, glm::vec3 off, glm::vec3 intensity);
    // It shines, and can be carried.
    void sign(const Paint& paint, glm::vec3 radiance, glm::vec3 center);
    void hedge(glm::vec3 center, glm::vec3 size);
    void tree(glm::vec3 at, float height);
    void crate(const Paint* paint, glm::vec3 center, float size, float mass);
    void curtain(glm::vec3 from, glm::vec3 to, float low, float high);
    void door(int room, glm::vec3 at, glm::vec2 size);
    void hint(int room, glm::vec3 at, const char* text);

  private:
    uint32_t heartOf(const Paint& paint);

    SceneBuilder& b_;
    std::vector<std::pair<std::string, uint32_t>> paints_, glows_, hearts_;
    uint32_t column_ = ~0u, bench_ = ~0u, lantern_ = ~0u, glow_ = ~0u, pot_ = ~0u, crate_ = ~0u;
    float columnHeight_ = 0;
    uint32_t lanterns_ = 0, flowers_ = 0;
};

}  // namespace ag::scenegen
