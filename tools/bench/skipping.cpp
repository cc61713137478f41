#include "tools/bench/skipping.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/renderer/renderer.h"
#include "tools/bench/moving_light.h"
#include "tools/bench/svg.h"
#include "tools/reference/ray_scene.h"

namespace ag::bench {
namespace {

constexpr std::array<std::string_view, size_t(Change::kCount)> kNames = {"all passes run",
                                                                         "nothing",
                                                                         "the camera",
                                                                         "the camera, clusters by flux alone",
                                                                         "a small thing in view",
                                                                         "a small thing out of view",
                                                                         "a light",
                                                                         "the camera, all lights off"};
constexpr uint32_t kSettlingFrames = 48;  // for what settles
constexpr uint32_t kLateFrames = 4;       // times arrive some frames late
constexpr uint32_t kRounds = 2;           // of what comes up every so many frames
// At most, of the scene's diagonal and of its distance from the camera when it is in view.
constexpr float kThingOfScene = 1.0f / 40, kThingOfDistance = 1.0f / 20;

float diagonalOf(const RenderScene& scene) {
    return glm::length(scene.bounds.max - scene.bounds.min);
}

// A box about the origin with sides of 1.
uint32_t addBox(GeometryArrays& g) {
    Primitive box{.firstIndex = uint32_t(g.indices.size()),
                  .indexCount = 36,
                  .vertexOffset = int32_t(g.positions.size()),
                  .material = uint32_t(g.materials.size()),
                  .boundsLocal = {glm::vec3(-0.5f), glm::vec3(0.5f)}};
    g.materials.push_back({.name = "small thing", .baseColor = {0.7f, 0.6f, 0.2f, 1}, .metallic = 0});
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const float side = face % 2 ? 0.5f : -0.5f;
        glm::vec3 normal(0), u(0), v(0);
        normal[axis] = 2 * side;
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 2 * side;
        const uint32_t first = uint32_t(g.positions.size()) - uint32_t(box.vertexOffset);
        for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(1, 1), glm::vec2(0, 1)}) {
            g.positions.push_back(0.5f * normal + (corner.x - 0.5f) * u + (corner.y - 0.5f) * v);
            g.attributes.push_back({.normal = normal, .tangent = glm::vec4(u, 1), .uv = corner});
        }
        for (const uint32_t i : {0, 1, 2, 0, 2, 3})
            g.indices.push_back(first + i);
    }
    g.primitives.push_back(box);
    ++g.version;
    return uint32_t(g.primitives.size() - 1);
}

class Walkthrough {
  public:
    Walkthrough(gpu::Device& device, SceneAsset& asset, RenderScene& scene, glm::uvec2 size,
                const render::RenderSettings& settings)
        : renderer_(device), scene_(scene), size_(size), settings_(settings) {
        const reference::RayScene rays(scene);
        const glm::vec3 corner = cornerSeen(rays);
        thingSize_ = std::min(kThingOfScene * diagonalOf(scene),
                              kThingOfDistance * glm::distance(corner, scene.camera.position));
        const glm::vec3 toCorner = glm::normalize(corner - scene.camera.position);
        const glm::vec3 seen = hit(rays, toCorner);
        const glm::vec3 behind = glm::normalize(-scene.camera.forward + glm::vec3(0, -0.3f, 0));
        places_ = {seen, hit(rays, behind)};
        scene.instances.push_back({.primitive = addBox(asset.geometry), .movable = true});
        scene.geometry = &asset.geometry;
        placeThing(seen, 0);
        scene.changedInstances.clear();
        scene.allInstancesChanged = true;
        renderer_.load(asset.geometry);
        start_ = scene;
    }

    ChangeCost measure(Change change) {
        settings_.bounce.importance.viewWeight =
            change == Change::kCameraByFlux ? 0 : gi::ImportanceSettings{}.viewWeight;
        restart(change);
        ChangeCost cost;
        const uint32_t cpuFrames = kRounds * settings_.bounce.refresh.lightFrames;
        const uint32_t timedFrames = kLateFrames + cpuFrames;
        const double part = 1.0 / cpuFrames;
        for (uint32_t i = 0; i < kSettlingFrames; ++i)
            frame(change, {.timing = TimingMode::kBracketed});
        for (uint32_t i = 0; i < timedFrames; ++i) {
            frame(change, {.skip = change != Change::kEverything, .timing = TimingMode::kBracketed});
            if (i < kLateFrames) continue;
            for (const PassReport& pass : renderer_.graph().report()) {
                if (pass.outcome != PassOutcome::kRan) continue;
                cost.gpuMs += pass.gpuMs * part;
                cost.passes[std::string(pass.name)].ranIn += part;
            }
        }
        for (uint32_t i = 0; i < cpuFrames; ++i) {
            frame(change, {.skip = change != Change::kEverything, .timing = TimingMode::kProcessCpu});
            for (const PassReport& pass : renderer_.graph().report()) {
                if (pass.outcome != PassOutcome::kRan) continue;
                cost.cpuMs += pass.cpuMs * part;
                cost.passes[std::string(pass.name)].cpuMs += pass.cpuMs * part;
            }
        }
        return cost;
    }

  private:
    // What is seen in the picture's lower right corner; where the sky is there, nearer to the middle.
    glm::vec3 cornerSeen(const reference::RayScene& rays) const {
        const RenderCamera& c = scene_.camera;
        glm::vec3 direction(0);
        for (float at = 0.6f; at > 0; at -= 0.05f) {  // of the way from the middle to the corner
            const glm::vec4 h = c.worldFromClip * glm::vec4(at, at, 1, 1);
            direction = glm::normalize(glm::vec3(h) / h.w - c.position);
            reference::Surface surface;
            if (rays.intersect(c.position, direction, surface)) return surface.position;
        }
        return c.position + direction * 0.1f * diagonalOf(scene_);
    }
    // A little off what is there.
    glm::vec3 hit(const reference::RayScene& rays, glm::vec3 direction) const {
        reference::Surface surface;
        const float size = thingSize_;
        if (!rays.intersect(scene_.camera.position, direction, surface))
            return scene_.camera.position + direction * 4.0f * size;
        return surface.position + surface.geometricNormal * size - direction * size;
    }
    void placeThing(glm::vec3 place, uint32_t frame) {
        const float size = thingSize_;
        const float slide = 0.2f * size * std::sin(float(frame) * 0.5f);
        scene_.instances.back().worldFromLocal =
            glm::mat4x3(size, 0, 0, 0, size, 0, 0, 0, size, place.x + slide, place.y, place.z);
        const uint32_t row = uint32_t(scene_.instances.size() - 1);
        scene_.changedInstances = {{row, row + 1}};
        scene_.allInstancesChanged = false;
        ++scene_.instancesVersion;
    }
    void restart(Change change) {
        scene_.camera = start_.camera;
        scene_.lights = start_.lights;
        ++scene_.cameraVersion;
        ++scene_.lightsVersion;
        if (change == Change::kDark)
            for (RenderLight& light : scene_.lights)
                light.intensity = glm::vec3(0);
        frame_ = 0;
    }
    void apply(Change change) {
        const bool walks =
            change == Change::kCamera || change == Change::kCameraByFlux || change == Change::kDark;
        scene_.changedInstances.clear();
        if (walks) {
            const glm::vec3 step(0.0005f * diagonalOf(scene_) * std::sin(float(frame_) * 0.3f + 1), 0, 0);
            shiftCamera(scene_, step);
        }
        if (change == Change::kSmallThing) placeThing(places_[0], frame_);
        if (change == Change::kUnseenThing) placeThing(places_[1], frame_);
        if (change == Change::kLight) {
            scene_.lights = movedLights(start_, 0.5 + 0.5 * std::sin(frame_ * 0.1));
            ++scene_.lightsVersion;
        }
        ++frame_;
    }
    void frame(Change change, const FrameGraphOptions& options) {
        apply(change);
        renderer_.render(scene_, size_, settings_, options,
                         [](GraphScope scope, const render::SceneView&, const render::RenderFrame& declared) {
                             scope.output(declared.outputs.display);
                         });
        scene_.allInstancesChanged = false;
    }

    render::Renderer renderer_;
    RenderScene& scene_;
    RenderScene start_;
    glm::uvec2 size_;
    render::RenderSettings settings_;
    float thingSize_ = 0;  // m
    std::array<glm::vec3, 2> places_{};
    uint32_t frame_ = 0;
};

double share(double part, double whole) {
    return whole > 0 ? part / whole : 0;
}

// "rsm.render, rsm.build_texels, ..." as "rsm", once each.
std::string techniquesOf(const ChangeCost& cost, double atLeast) {
    std::vector<std::string> names;
    for (const auto& [pass, of] : cost.passes) {
        const std::string technique = pass.substr(0, pass.find('.'));
        if (of.ranIn >= atLeast && std::ranges::find(names, technique) == names.end())
            names.push_back(technique);
    }
    std::string out;
    for (const std::string& name : names)
        (out += out.empty() ? "" : ", ") += name;
    return out.empty() ? "none" : out;
}

}  // namespace

std::string_view changeName(Change change) {
    return kNames[size_t(change)];
}

SceneCosts measureChanges(gpu::Device& device, SceneAsset& asset, RenderScene scene, glm::uvec2 size,
                          const render::RenderSettings& settings, FunctionRef<void(double)> progress) {
    SceneCosts costs{.size = size};
    Walkthrough walk(device, asset, scene, size, settings);
    for (size_t i = 0; i < costs.changes.size(); ++i) {
        costs.changes[i] = walk.measure(Change(i));
        progress(double(i + 1) / double(costs.changes.size()));
    }
    return costs;
}

std::string changesToSvg(const std::vector<SceneCosts>& scenes, std::string_view device) {
    constexpr double kWidth = 760, kLeft = 240, kRight = 120, kBar = 16, kRow = 26, kTop = 72, kTitle = 26;
    const double panel = kTitle + kRow * double(Change::kCount) + 16, width = kWidth - kLeft - kRight;
    std::string out = svgBegin(kWidth, kTop + panel * double(scenes.size()));
    out += svgText(16, 26, "start", 18, "Work against change");
    out +=
        svgText(16, 46, "start", 12,
                fmt::format("{}; process CPU time of a frame's passes beside all of them", device), "#666");
    for (size_t s = 0; s < scenes.size(); ++s) {
        const SceneCosts& scene = scenes[s];
        const double whole = scene.of(Change::kEverything).cpuMs;
        double y = kTop + panel * double(s);
        out += svgText(16, y + 14, "start", 15,
                       fmt::format("{}, {}x{}: what changes", scene.scene, scene.size.x, scene.size.y));
        y += kTitle;
        for (size_t i = 0; i < scene.changes.size(); ++i, y += kRow) {
            const double ms = scene.changes[i].cpuMs, part = share(ms, whole);
            const double length = std::max(width * std::min(part, 1.1), 1.0);
            out += svgText(kLeft - 8, y + kBar - 4, "end", 12, kNames[i]);
            out +=
                fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{:.1f}' height='{:.1f}' fill='#2e6f95'/>\n",
                            kLeft, y, length, kBar);
            out += svgText(kLeft + length + 5, y + kBar - 4, "start", 11,
                           fmt::format("{:.0f} % ({:.0f} ms)", 100 * part, ms));
        }
    }
    return out + "</svg>\n";
}

std::string changesToMarkdown(const std::vector<SceneCosts>& scenes, std::string_view device) {
    std::string out = fmt::format("Device: {}.\n", device);
    for (const SceneCosts& scene : scenes) {
        out += fmt::format(
            "\n## {}, {}x{}\n\n| what changes | GPU ms | of all | CPU ms | of all | techniques that ran in "
            "most "
            "frames |\n|---|---|---|---|---|---|\n",
            scene.scene, scene.size.x, scene.size.y);
        const ChangeCost& whole = scene.of(Change::kEverything);
        for (size_t i = 0; i < scene.changes.size(); ++i) {
            const ChangeCost& cost = scene.changes[i];
            out += fmt::format("| {} | {:.1f} | {:.1f} % | {:.1f} | {:.1f} % | {} |\n", kNames[i], cost.gpuMs,
                               100 * share(cost.gpuMs, whole.gpuMs), cost.cpuMs,
                               100 * share(cost.cpuMs, whole.cpuMs), techniquesOf(cost, 0.5));
        }
    }
    return out;
}

}  // namespace ag::bench
