#include "tools/scenegen/gallery_parts.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "common/sampling.h"

namespace ag::scenegen {
namespace {

constexpr float kTau = 6.2831853f;
constexpr float kHeartRadius = 0.045f;  // m

glm::vec3 turned(glm::vec3 v, float yaw) {
    return glm::angleAxis(yaw, glm::vec3(0, 1, 0)) * v;
}

// A petal that stands upright, its inside looking at the middle: v along it, u across.
glm::vec3 petalPoint(float u, float v) {
    const float width = 0.075f * std::sin(3.0f * std::pow(v, 0.7f)) + 0.012f, across = (u - 0.5f) * 2;
    const float bulge = 0.05f * std::sin(3.1415927f * v) * (1 - 0.35f * across * across);
    return {-across * width, 0.20f * v, bulge - 0.02f * v * v};
}

}  // namespace

Furnisher::Furnisher(SceneBuilder& b) : b_(b) {
    stone = b.material("stone", {0.55f, 0.52f, 0.48f});
    plaster = b.material("plaster", {0.70f, 0.67f, 0.62f});
    wood = b.material("wood", {0.36f, 0.21f, 0.11f});
    darkWood = b.material("dark wood", {0.14f, 0.08f, 0.05f});
    brass = b.material("brass", {0.62f, 0.46f, 0.18f});
    iron = b.material("iron", {0.08f, 0.08f, 0.09f});
    leaf = b.material("leaf", {0.10f, 0.30f, 0.07f});
    clay = b.material("clay stone", {0.45f, 0.22f, 0.13f});
    charcoal = b.material("charcoal", {0.075f, 0.075f, 0.082f});
    tileLight = b.material("light tile", {0.40f, 0.36f, 0.31f});
    tileDark = b.material("dark tile", {0.20f, 0.16f, 0.13f});
    linen = b.material("linen", {0.58f, 0.50f, 0.40f});
    b.materialAt(linen).doubleSided = true;
}

uint32_t Furnisher::paint(const Paint& p) {
    for (const auto& [name, material] : paints_)
        if (name == p.name) return material;
    paints_.push_back({p.name, b_.material(fmt::format("{} cloth", p.name), p.albedo)});
    return paints_.back().second;
}

uint32_t Furnisher::substance(const char* name, glm::vec3 albedo) {
    for (const auto& [known, material] : paints_)
        if (known == name) return material;
    paints_.push_back({name, b_.material(name, albedo)});
    return paints_.back().second;
}

void Furnisher::floor(const char* name, glm::vec2 min, glm::vec2 max, Tiles tiles) {
    MeshParts parts;
    const glm::uvec2 count = glm::max(glm::uvec2(glm::round(max - min)), glm::uvec2(1));
    const glm::vec2 step = (max - min) / glm::vec2(count);
    for (uint32_t z = 0; z < count.y; ++z)
        for (uint32_t x = 0; x < count.x; ++x) {
            const glm::vec2 a = min + step * glm::vec2(x, z);
            addSheet(
                parts, (x + z) % 2 ? tiles.dark : tiles.light,
                [&](float u, float v) { return glm::vec3(a.x + u * step.x, 0, a.y + (1 - v) * step.y); }, 1,
                1);
        }
    b_.model(name, parts, glm::vec3(0));
    const glm::vec2 middle = (min + max) / 2.0f, size = max - min;
    solid("ground", {middle.x, -0.16f, middle.y}, {size.x, 0.3f, size.y}, tiles.dark);
}

void Furnisher::ceiling(const char* name, glm::vec2 min, glm::vec2 max, float height, uint32_t material) {
    const glm::vec2 middle = (min + max) / 2.0f, size = max - min;
    MeshParts parts;
    addBox(parts, material, {0, 0.1f, 0}, {size.x, 0.2f, size.y});
    for (float z = -size.y / 2 + 1; z < size.y / 2 - 0.2f; z += 2)  // beams
        addBox(parts, wood, {0, -0.08f, z}, {size.x, 0.16f, 0.2f});
    b_.model(name, parts, {middle.x, height, middle.y});
}

uint32_t Furnisher::solid(const char* name, glm::vec3 center, glm::vec3 size, uint32_t material, float yaw) {
    const uint32_t node = b_.box(name, center, size, material, yaw);
    b_.node(node).extras.collider = true;
    return node;
}

void Furnisher::pergola(glm::vec2 min, glm::vec2 max, float height, uint32_t material, float apart) {
    const glm::vec2 middle = (min + max) / 2.0f, size = max - min;
    MeshParts parts;
    for (float z = -size.y / 2 + apart / 2; z < size.y / 2; z += apart)
        addBox(parts, material, {0, -0.08f, z}, {size.x, 0.16f, 0.12f});
    for (float x = -size.x / 2 + apart; x < size.x / 2 - 0.1f; x += 2 * apart)
        addBox(parts, material, {x, 0.04f, 0}, {0.12f, 0.10f, size.y});
    b_.model("pergola", parts, {middle.x, height, middle.y});
}

void Furnisher::column(glm::vec3 at, float height) {
    if (column_ == ~0u || columnHeight_ != height) {
        columnHeight_ = height;
        MeshParts parts;
        const float h = height;
        const glm::vec2 profile[] = {{0.34f, 0},         {0.34f, 0.12f},     {0.28f, 0.14f},
                                     {0.30f, 0.20f},     {0.26f, 0.26f},     {0.24f, 0.32f},
                                     {0.235f, h * 0.5f}, {0.20f, h - 0.42f}, {0.23f, h - 0.40f},
                                     {0.20f, h - 0.36f}, {0.30f, h - 0.16f}, {0.34f, h - 0.14f},
                                     {0.34f, h}};
        addLathe(parts, stone, profile, 14, glm::vec3(0));
        column_ = b_.model("column", parts, at);
    } else {
        const uint32_t node = b_.copy(column_, "column", at);
        b_.node(node).extras.collider = true;
        return;
    }
    b_.node(column_).extras.collider = true;
}

void Furnisher::bench(glm::vec3 at, float yaw) {
    if (bench_ == ~0u) {
        MeshParts parts;
        for (int i = 0; i < 4; ++i)  // slats
            addBox(parts, wood, {0, 0.44f, -0.18f + 0.12f * float(i)}, {1.5f, 0.05f, 0.1f});
        for (const float x : {-0.62f, 0.62f}) {
            addBox(parts, iron, {x, 0.21f, 0.16f}, {0.06f, 0.42f, 0.06f});
            addBox(parts, iron, {x, 0.21f, -0.16f}, {0.06f, 0.42f, 0.06f});
            addBox(parts, iron, {x, 0.39f, 0}, {0.06f, 0.05f, 0.4f});
        }
        bench_ = b_.model("bench", parts, at, yaw);
        b_.node(bench_).extras.collider = true;
        return;
    }
    b_.node(b_.copy(bench_, "bench", at, yaw)).extras.collider = true;
}

void Furnisher::painting(glm::vec3 at, float yaw, glm::vec2 size, uint32_t seed) {
    MeshParts parts;
    const float bar = 0.07f;
    addBox(parts, brass, {0, size.y / 2, 0.03f}, {size.x + bar, bar, 0.06f});
    addBox(parts, brass, {0, -size.y / 2, 0.03f}, {size.x + bar, bar, 0.06f});
    addBox(parts, brass, {-size.x / 2, 0, 0.03f}, {bar, size.y, 0.06f});
    addBox(parts, brass, {size.x / 2, 0, 0.03f}, {bar, size.y, 0.06f});
    addBox(parts, linen, {0, 0, 0.01f}, {size.x, size.y, 0.02f});
    const uint32_t palette[] = {darkWood, stone, tileDark, wood, leaf, iron};
    for (uint32_t i = 0; i < 5; ++i) {  // patches of colour
        const auto r = [&](uint32_t k) { return io::hashToUnit(seed * 64 + i * 8 + k); };
        const glm::vec2 patch = size * glm::vec2(0.2f + 0.4f * r(0), 0.15f + 0.35f * r(1));
        const glm::vec2 place = (size - patch) * (glm::vec2(r(2), r(3)) - 0.5f) * 0.92f;
        addBox(parts, palette[(seed + i) % 6], {place.x, place.y, 0.021f + 0.002f * float(i)},
               {patch.x, patch.y, 0.004f});
    }
    b_.model("painting", parts, at, yaw);
}

void Furnisher::tapestry(const Paint& p, glm::vec3 at, float yaw, glm::vec2 size) {
    MeshParts parts;
    const uint32_t material = paint(p);
    addSheet(
        parts, material,
        [&](float u, float v) {
            const float wave = 0.03f * std::sin(kTau * 5 * u) * (1.2f - v);
            return glm::vec3((u - 0.5f) * size.x, (v - 0.5f) * size.y, 0.06f + wave);
        },
        30, 2);
    addBox(parts, brass, {0, size.y / 2 + 0.03f, 0.06f}, {size.x + 0.3f, 0.05f, 0.05f});
    b_.materialAt(material).doubleSided = true;
    b_.model("tapestry", parts, at, yaw);
}

void Furnisher::plinth(glm::vec3 at, float height) {
    MeshParts parts;
    addBox(parts, stone, {0, 0.04f, 0}, {0.56f, 0.08f, 0.56f});
    addBox(parts, stone, {0, height / 2, 0}, {0.44f, height - 0.08f, 0.44f});
    addBox(parts, stone, {0, height - 0.03f, 0}, {0.54f, 0.06f, 0.54f});
    b_.node(b_.model("plinth", parts, at)).extras.collider = true;
}

// Dim beside a lit wall, bright beside a dark one: it lights no probe by itself.
uint32_t Furnisher::heartOf(const Paint& p) {
    for (const auto& [name, material] : hearts_)
        if (name == p.name) return material;
    hearts_.push_back({p.name, b_.emissive(fmt::format("{} heart", p.name), p.albedo, p.albedo * 0.03f)});
    return hearts_.back().second;
}

void Furnisher::flower(int room, const Paint& p, float amount, glm::vec3 at, float yaw, bool shy) {
    uint32_t petal = ~0u;
    for (const auto& [name, material] : glows_)
        if (name == p.name) petal = material;
    if (petal == ~0u) {  // a trace of light of its own: it is found in the dark
        petal = b_.emissive(fmt::format("{} petal", p.name), p.albedo, p.albedo * 0.05f);
        b_.materialAt(petal).doubleSided = true;
        glows_.push_back({p.name, petal});
    }
    MeshParts parts;
    const glm::vec2 pot[] = {{0.09f, 0},      {0.13f, 0.13f}, {0.155f, 0.15f},
                             {0.155f, 0.18f}, {0.12f, 0.18f}, {0, 0.165f}};
    addLathe(parts, clay, pot, 14, glm::vec3(0));
    const glm::vec2 stem[] = {{0.016f, 0.16f}, {0.012f, 0.40f}, {0.03f, 0.43f}, {0.0f, 0.45f}};
    addLathe(parts, leaf, stem, 7, glm::vec3(0));
    for (const float side : {1.0f, -1.0f})
        addSheet(
            parts, leaf,
            [&](float u, float v) {
                const float w = 0.05f * std::sin(3.1415927f * v) * (u - 0.5f);
                return glm::vec3(side * 0.17f * v, 0.20f + 0.13f * v - 0.09f * v * v, w);
            },
            2, 5);
    const uint32_t root = b_.model(fmt::format("flower {} {}", flowers_++, p.name), parts, at, yaw);
    glm::vec3 wants = p.albedo * kLampColor;
    wants /= std::max({wants.x, wants.y, wants.z});
    b_.node(root).extras.tag = "flower";
    b_.node(root).extras.room = room;
    b_.node(root).extras.wants = wants;
    b_.node(root).extras.amount = amount;
    b_.node(root).extras.shy = shy;
    b_.materialAt(leaf).doubleSided = true;
    // Between them a glow that is as large as its light is good.
    MeshParts heart;
    constexpr int kRings = 6;
    std::array<glm::vec2, kRings + 1> ball;
    for (int i = 0; i <= kRings; ++i) {
        const float angle = (float(i) / kRings - 0.5f) * kTau / 2;
        ball[size_t(i)] = {kHeartRadius * std::cos(angle), kHeartRadius * std::sin(angle)};
    }
    ball.front().x = ball.back().x = 0;
    addLathe(heart, heartOf(p), ball, 10, glm::vec3(0));
    const uint32_t core = b_.model("heart", heart, {0, 0.49f, 0});
    b_.node(core).extras.tag = "heart";
    b_.attach(core, root);
    MeshParts petalParts;
    addSheet(petalParts, petal, petalPoint, 4, 6);
    uint32_t first = ~0u;
    constexpr int kPetals = 7;
    for (int i = 0; i < kPetals; ++i) {
        const float turn = kTau * float(i) / kPetals;
        const glm::vec3 foot = turned({0, 0.44f, 0.018f}, turn);
        const uint32_t node =
            first == ~0u ? b_.model("petal", petalParts, foot, turn) : b_.copy(first, "petal", foot, turn);
        if (first == ~0u) first = node;
        b_.node(node).extras.tag = "petal";
        b_.attach(node, root);
    }
}

void Furnisher::lantern(int room, glm::vec3 from, float chain) {
    const glm::vec3 at = from - glm::vec3(0, chain, 0);
    if (lantern_ == ~0u) {
        MeshParts parts;
        addBox(parts, iron, {0, 0.10f + 0.3f, 0}, {0.012f, 0.6f, 0.012f});
        const glm::vec2 roof[] = {{0.13f, 0.05f}, {0.02f, 0.13f}, {0, 0.13f}};
        addLathe(parts, iron, roof, 8, glm::vec3(0));
        const glm::vec2 base[] = {{0, -0.15f}, {0.09f, -0.14f}, {0.10f, -0.11f}, {0, -0.11f}};
        addLathe(parts, iron, base, 8, glm::vec3(0));
        for (int i = 0; i < 4; ++i)
            addBox(parts, iron, turned({0.095f, -0.03f, 0}, kTau * float(i) / 4), {0.012f, 0.17f, 0.012f});
        lantern_ = b_.model("lantern", parts, at);
    } else {
        b_.copy(lantern_, "lantern", at);
    }
    MeshParts glow;
    if (glow_ == ~0u) {
        const glm::vec2 flame[] = {
            {0, -0.10f}, {0.045f, -0.07f}, {0.055f, -0.03f}, {0.035f, 0.03f}, {0, 0.05f}};
        addLathe(glow, b_.emissive("flame", {0.8f, 0.6f, 0.3f}, {9, 5.2f, 2.0f}), flame, 8, glm::vec3(0));
        glow_ = b_.model("flame", glow, at);
    }
    const uint32_t flame = lanterns_ == 0 ? glow_ : b_.copy(glow_, "flame", at);
    b_.node(flame).extras.tag = "flame";
    b_.node(flame).extras.room = room;
    // Downwards, from under its own iron: one shadow map each, and the ceiling stays dark.
    const uint32_t light = b_.spot(fmt::format("lantern light {}", lanterns_++), at - glm::vec3(0, 0.2f, 0),
                                   {0, -1, 0}, glm::vec3(5.0f, 3.5f, 1.9f), {30, 72}, 6);
    NodeExtras& extras = b_.node(light).extras;
    extras.tag = "lantern";
    extras.room = room;
    extras.bounces = false;
}

void Furnisher::sconce(glm::vec3 at, glm::vec3 off, glm::vec3 intensity) {
    MeshParts parts;
    addBox(parts, brass, glm::vec3(0), {0.08f, 0.22f, 0.08f});
    const glm::vec2 bowl[] = {{0, 0.06f}, {0.08f, 0.10f}, {0.11f, 0.16f}};
    addLathe(parts, brass, bowl, 10, off * 0.14f);
    b_.model("sconce", parts, at);
    const uint32_t light = b_.point("sconce light", at + off * 0.35f + glm::vec3(0, 0.35f, 0), intensity, 9);
    b_.node(light).extras.bounces = b_.node(light).extras.castsShadow = false;
    b_.node(light).extras.tag = "sconce";
}

void Furnisher::crate(const Paint* p, glm::vec3 center, float size, float mass) {
    MeshParts parts;
    const uint32_t face = p ? paint(*p) : wood, edge = p ? face : darkWood;
    const float s = size, e = 0.09f * size, h = s / 2 - e / 2;
    addBox(parts, face, glm::vec3(0), glm::vec3(s - 0.6f * e));
    for (const float i : {-1.0f, 1.0f})
        for (const float j : {-1.0f, 1.0f}) {
            addBox(parts, edge, {i * h, 0, j * h}, {e, s, e});
            addBox(parts, edge, {0, i * h, j * h}, {s, e, e});
            addBox(parts, edge, {i * h, j * h, 0}, {e, e, s});
        }
    const uint32_t node = b_.model(p ? fmt::format("{} crate", p->name) : "crate", parts, center);
    b_.node(node).extras.tag = "crate";
    b_.node(node).extras.mass = mass;
}

void Furnisher::sign(const Paint& p, glm::vec3 radiance, glm::vec3 center) {
    MeshParts parts;
    const uint32_t glow = b_.emissive(fmt::format("{} sign", p.name), p.albedo, radiance);
    addBox(parts, iron, glm::vec3(0), {0.46f, 0.26f, 0.08f});
    for (const float side : {1.0f, -1.0f})  // a pane on either face
        addSheet(
            parts, glow,
            [&](float u, float v) {
                return glm::vec3(side * (u - 0.5f) * 0.44f, (v - 0.5f) * 0.24f, side * 0.045f);
            },
            4, 2);
    for (const float y : {-0.15f, 0.15f})
        addBox(parts, iron, {0, y, 0}, {0.54f, 0.04f, 0.14f});
    for (const float x : {-0.25f, 0.25f})
        addBox(parts, iron, {x, 0, 0}, {0.04f, 0.30f, 0.14f});
    const uint32_t node = b_.model(fmt::format("{} sign", p.name), parts, center);
    b_.node(node).extras.tag = "crate";
    b_.node(node).extras.mass = 8;
}

void Furnisher::hedge(glm::vec3 center, glm::vec3 size) {
    solid("hedge", center, size, leaf);
}

void Furnisher::tree(glm::vec3 at, float height) {
    MeshParts parts;
    const glm::vec2 trunk[] = {{0.16f, 0}, {0.10f, 0.4f}, {0.08f, height * 0.6f}};
    addLathe(parts, darkWood, trunk, 8, glm::vec3(0));
    for (int i = 0; i < 5; ++i) {
        const float r = 0.30f * height * (1 - 0.09f * float(i)), turn = 2.4f * float(i);
        const glm::vec2 crown[] = {
            {0, -r * 0.6f}, {r * 0.6f, -r * 0.5f}, {r * 0.8f, 0}, {r * 0.5f, r * 0.5f}, {0, r * 0.6f}};
        addLathe(
            parts, leaf, crown, 9,
            {0.35f * r * std::cos(turn), height * (0.6f + 0.07f * float(i)), 0.35f * r * std::sin(turn)});
    }
    b_.node(b_.model("tree", parts, at)).extras.collider = false;
    solid("trunk", at + glm::vec3(0, 0.5f, 0), {0.2f, 1, 0.2f}, darkWood);
}

void Furnisher::curtain(glm::vec3 from, glm::vec3 to, float low, float high) {
    MeshParts parts;
    const glm::vec3 along = to - from, side = glm::normalize(glm::cross(along, glm::vec3(0, 1, 0)));
    addSheet(
        parts, linen,
        [&](float u, float v) {
            const float wave = 0.09f * std::sin(kTau * 9 * u) * (1.1f - 0.5f * v);
            return along * (u - 0.5f) + side * wave + glm::vec3(0, low + (high - low) * v, 0);
        },
        54, 2);
    addBox(parts, brass, {0, high + 0.03f, 0}, glm::max(glm::abs(along), glm::vec3(0.05f)));
    const uint32_t node = b_.model("curtain", parts, (from + to) / 2.0f);
    b_.node(node).extras.collider = true;
}

void Furnisher::door(int room, glm::vec3 at, glm::vec2 size) {
    MeshParts parts;
    addBox(parts, wood, {0, size.y / 2, 0}, {size.x, size.y, 0.10f});
    for (const float z : {-0.065f, 0.065f}) {
        for (const float x : {-0.25f, 0.25f})
            for (const float y : {0.28f, 0.72f})
                addBox(parts, darkWood, {x * size.x, y * size.y, z}, {0.36f * size.x, 0.34f * size.y, 0.03f});
        addBox(parts, brass, {0.02f, size.y * 0.5f, z * 1.5f}, {0.05f, 0.22f, 0.04f});
    }
    const uint32_t node = b_.model(fmt::format("door {}", room), parts, at);
    b_.node(node).extras.tag = "door";
    b_.node(node).extras.room = room;
}

void Furnisher::hint(int room, glm::vec3 at, const char* text) {
    const uint32_t node = b_.place("hint", at);
    b_.node(node).extras.tag = "hint";
    b_.node(node).extras.room = room;
    b_.node(node).extras.text = text;
}

}  // namespace ag::scenegen
