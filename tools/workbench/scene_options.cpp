#include "tools/workbench/scene_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "engine/core/log.h"
#include "engine/scene/animation.h"
#include "engine/scene/light_check.h"
#include "tools/scenegen/scenes.h"
#include "tools/workbench/first_sight.h"
#include "tools/workbench/hang_lamps.h"
#include "tools/workbench/scene_library.h"

namespace ag::workbench {
namespace {

// Comma-separated numbers, `least` to `most` of them.
std::optional<std::vector<double>> parseNumbers(std::string_view text, size_t least, size_t most) {
    std::vector<double> numbers;
    for (size_t end = 0; end != std::string_view::npos;
         text.remove_prefix(std::min(end, text.size() - 1) + 1)) {
        end = text.find(',');
        const auto value = parseNumber(text.substr(0, end), -kMostNumber, kMostNumber);
        if (!value) return std::nullopt;
        numbers.push_back(*value);
        if (end == std::string_view::npos) break;
    }
    if (numbers.size() < least || numbers.size() > most) return std::nullopt;
    return numbers;
}

glm::dvec3 vec3At(const std::vector<double>& numbers, size_t first) {
    return {numbers[first], numbers[first + 1], numbers[first + 2]};
}

// A strength for all channels, or one for each.
glm::vec3 colorAt(const std::vector<double>& numbers, size_t first, size_t most) {
    const bool channels = numbers.size() >= first + 3 && most >= 3;
    return channels ? glm::vec3(vec3At(numbers, first)) : glm::vec3(float(numbers[first]));
}

void addLights(const SceneOptions& options, RenderScene& scene) {
    if (!options.lights) return;
    for (const PlacedLight& placed : *options.lights) {
        scene.lights.push_back(placed.light);
        scene.lights.back().position = glm::vec3(placed.position - scene.originWorld);
        scene.lights.back().id = 1 + scene.lights.size();
    }
}

Status addSuns(const SceneOptions& options, RenderScene& scene) {
    for (const std::string& text : options.suns) {
        const auto n = parseNumbers(text, 3, 6);
        if (!n || n->size() == 5 || glm::length(vec3At(*n, 0)) < 1e-6)
            return Error{fmt::format("--sun takes DX,DY,DZ[,E] or DX,DY,DZ,R,G,B, not '{}'", text)};
        scene.lights.push_back({.kind = LightKind::kDirectional,
                                .direction = glm::vec3(glm::normalize(vec3At(*n, 0))),
                                .intensity = n->size() > 3 ? colorAt(*n, 3, 3) : glm::vec3(10),
                                .bounces = true,
                                .id = 1000 + scene.lights.size()});
    }
    return Ok{};
}

Status addPoints(const SceneOptions& options, RenderScene& scene) {
    for (const std::string& text : options.points) {
        const auto n = parseNumbers(text, 4, 6);
        if (!n || n->size() == 5)
            return Error{fmt::format("--point takes X,Y,Z,I or X,Y,Z,R,G,B, not '{}'", text)};
        scene.lights.push_back({.kind = LightKind::kPoint,
                                .position = glm::vec3(vec3At(*n, 0) - scene.originWorld),
                                .intensity = colorAt(*n, 3, 3),
                                .bounces = true,
                                .id = 1000 + scene.lights.size()});
    }
    return Ok{};
}

Status addSpots(const SceneOptions& options, RenderScene& scene) {
    for (const std::string& text : options.spots) {
        const auto n = parseNumbers(text, 9, 11);
        const size_t cones = n ? n->size() - 2 : 0;  // where the two angles stand
        const bool fits = n && n->size() != 10 && glm::length(vec3At(*n, 3)) > 1e-6 && (*n)[cones] >= 0 &&
                          (*n)[cones] <= (*n)[cones + 1] && (*n)[cones + 1] > 0 && (*n)[cones + 1] < 90;
        if (!fits)
            return Error{fmt::format(
                "--spot takes X,Y,Z,DX,DY,DZ,I,INNER_DEG,OUTER_DEG or R,G,B for I, not '{}'", text)};
        scene.lights.push_back({.kind = LightKind::kSpot,
                                .position = glm::vec3(vec3At(*n, 0) - scene.originWorld),
                                .direction = glm::vec3(glm::normalize(vec3At(*n, 3))),
                                .intensity = colorAt(*n, 6, cones - 6),
                                .innerConeAngle = float(glm::radians((*n)[cones])),
                                .outerConeAngle = float(glm::radians((*n)[cones + 1])),
                                .bounces = true,
                                .id = 1000 + scene.lights.size()});
    }
    return Ok{};
}

// Directions that light travels point downwards, so that three numbers are either a colour or a direction.
Result<Sky> parseSky(const std::string& text) {
    const auto n = parseNumbers(text, 1, 4);
    if (!n) {
        auto picture = loadImage(text);
        if (!picture)
            return Error{fmt::format("--sky takes COLOUR, FILE.exr, FILE.hdr or DX,DY,DZ[,TURBIDITY]: {}",
                                     picture.error().message)};
        if (const char* wrong = whyNoSky(*picture)) return Error{fmt::format("--sky: {} {}", text, wrong)};
        return Sky{.radiance = std::move(*picture)};
    }
    if (n->size() == 1 && (*n)[0] >= 0) return constantSky(glm::vec3(float((*n)[0])));
    if (n->size() == 3 && (*n)[0] >= 0 && (*n)[1] >= 0 && (*n)[2] >= 0)
        return constantSky(glm::vec3(vec3At(*n, 0)));
    const double turbidity = n->size() == 4 ? (*n)[3] : 3;
    if (n->size() < 3 || !((*n)[1] < 0) || turbidity < kLeastTurbidity || turbidity > kMostTurbidity)
        return Error{fmt::format(
            "--sky takes a colour of 1 or 3 numbers from 0 on, or DX,DY,DZ[,TURBIDITY]: the way the "
            "sun's light travels, downwards, turbidity {} to {}; not '{}'",
            kLeastTurbidity, kMostTurbidity, text)};
    return analyticSky(glm::vec3(glm::normalize(vec3At(*n, 0))), float(turbidity));
}

Status choosePose(const SceneOptions& options, SceneAsset& asset) {
    if (options.clip.empty()) return Ok{};
    const auto n = parseNumbers(options.clip, 2, 2);
    if (!n || (*n)[0] < 0 || (*n)[0] >= double(asset.animations.size()) || std::abs((*n)[1]) > 1e6)
        return Error{fmt::format("--clip takes INDEX,SECONDS, not '{}' ({} has {} animations)", options.clip,
                                 options.scene, asset.animations.size())};
    poseAsset(asset, uint32_t((*n)[0]), float((*n)[1]));
    return Ok{};
}

bool hasCamera(const SceneAsset& asset) {
    return std::ranges::any_of(asset.nodes, [](const SceneNode& n) { return n.camera >= 0; });
}

// Nothing: neither the options nor the scene say where from.
Result<std::optional<CameraPose>> chooseCamera(const SceneOptions& options, const SceneAsset& asset) {
    if (!options.view.empty()) {
        const auto n = parseNumbers(options.view, 6, 7);
        if (!n)
            return Error{fmt::format("--view takes PX,PY,PZ,TX,TY,TZ[,VFOV_DEG], not '{}'", options.view)};
        const glm::dvec3 position = vec3At(*n, 0), target = vec3At(*n, 3);
        const double fov = n->size() > 6 ? (*n)[6] : 55.0;
        if (glm::length(target - position) < 1e-6 || fov <= 0 || fov >= 170)
            return Error{fmt::format("--view looks nowhere: '{}'", options.view)};
        CameraPose pose;
        pose.position = position;
        pose.forward = glm::vec3(glm::normalize(target - position));
        pose.verticalFov = float(glm::radians(fov));
        return std::optional(pose);
    }
    if (options.camera.empty() && options.pose) return options.pose;
    if (options.camera.empty()) return hasCamera(asset) ? std::optional(cameraOf(asset, 0)) : std::nullopt;
    for (size_t i = 0; i < asset.cameras.size(); ++i)
        if (asset.cameras[i].name == options.camera || std::to_string(i) == options.camera)
            return std::optional(cameraOf(asset, i));
    return Error{fmt::format("{} has no camera '{}' (it has {})", options.scene, options.camera,
                             asset.cameras.size())};
}

// What of a file is shown otherwise than it asks for, in one line; empty: nothing.
std::string shortcomingsOf(const SceneAsset& asset) {
    std::string approximated, missing;
    for (const SceneFeature& f : asset.features) {
        if (f.support == FeatureSupport::kUsed) continue;
        std::string& list = f.support == FeatureSupport::kApproximated ? approximated : missing;
        list += (list.empty() ? "" : ", ") + f.name;
    }
    std::string line = approximated.empty() ? "" : "approximated: " + approximated;
    if (!missing.empty()) line += (line.empty() ? "" : "; ") + std::string("not supported: ") + missing;
    return line;
}

bool hasMaterial(const RenderScene& scene, bool (*is)(const Material&)) {
    const GeometryArrays& g = *scene.geometry;
    return std::ranges::any_of(scene.instances, [&](const RenderInstance& i) {
        return i.isPresent() && is(g.materials[g.primitives[i.primitive].material]);
    });
}

// What is unlit shows its colour and is not meant to light anything.
bool hasOwnLight(const RenderScene& scene) {
    return !scene.lights.empty() || scene.sky ||
           hasMaterial(scene, [](const Material& m) { return !m.unlit && m.emissive != glm::vec3(0); });
}

// A sky beside an added sun. Unlit colours are radiances of 1 at most in any light: beside them white
// surfaces get to be as bright.
void addMissingSky(const SceneOptions& options, LoadedScene& loaded) {
    constexpr float kSunOfClearSky = 100, kSunBesideUnlit = 2.5f;  // W/m²
    constexpr float kSkyBesideUnlit = 0.25f;                       // W/(m² sr)
    RenderLight& sun = loaded.scene.lights.front();
    const bool unlit = hasMaterial(loaded.scene, [](const Material& m) { return m.unlit; });
    sun.intensity = glm::vec3(unlit ? kSunBesideUnlit : kSunOfClearSky);
    const glm::vec3 d = sun.direction;
    loaded.skyAdded =
        unlit ? fmt::format("{:g}", kSkyBesideUnlit) : fmt::format("{:.9g},{:.9g},{:.9g}", d.x, d.y, d.z);
    loaded.scene.sky =
        std::make_shared<const Sky>(unlit ? constantSky(glm::vec3(kSkyBesideUnlit)) : analyticSky(d, 3));
    spdlog::warn("{} has no sky: a {} one is added", options.scene, unlit ? "plain" : "clear");
}

// A sun where there is no light at all; where none would reach what is seen, lamps beside it.
void addMissingLight(const SceneOptions& options, const FirstSight& sight, RenderScene& scene) {
    constexpr float kLeastLit = 0.01f;
    constexpr uint32_t kLamps = 6;
    spdlog::warn("{} has no light: a sun is added", options.scene);
    scene.lights.push_back(sight.sun);
    if (sight.litShare >= kLeastLit) return;
    const uint32_t hung = hangLamps(scene, kLamps);
    for (RenderLight& light : scene.lights)
        light.bounces = true;
    if (hung > 0) spdlog::warn("{} is closed to the sun: {} lamps hang in it", options.scene, hung);
}

CameraPose poseAndLight(const SceneOptions& options, const std::optional<CameraPose>& given,
                        MissingLight missing, LoadedScene& loaded) {
    RenderScene& scene = loaded.scene;
    const bool wanted = options.noSceneLights || options.lights;
    const bool dark = !hasOwnLight(scene) && !wanted;
    loaded.lightAdded = dark;
    if (given && !dark) return *given;
    const FirstSight sight = chooseFirstSight(scene, given, dark);
    if (dark) addMissingLight(options, sight, scene);
    if (dark && missing == MissingLight::kSunAndSky) addMissingSky(options, loaded);
    return sight.pose;
}

}  // namespace

void addSceneOptions(CLI::App& command, SceneOptions& o) {
    command
        .add_option("scene", o.scene,
                    "glTF or GLB file, or a built-in name, or one of the scene library (see README)")
        ->required();
    command.add_option("--param", o.param, "number of a built-in scene that takes one");
    command.add_option("--clip", o.clip, "as an animation of it has it: INDEX,SECONDS");
    command.add_option("--size", o.size, "pixels, WxH")->capture_default_str();
    command.add_option("--camera", o.camera, "index or name of one of the scene's cameras");
    command.add_option("--view", o.view, "camera: PX,PY,PZ,TX,TY,TZ[,VFOV_DEG]");
    command
        .add_option("--sun", o.suns,
                    "add a sun: DX,DY,DZ[,E] or DX,DY,DZ,R,G,B: the way its light travels, W/m2")
        ->allow_extra_args(false);
    command.add_option("--point", o.points, "add a point light: X,Y,Z,I or X,Y,Z,R,G,B in m and W/sr")
        ->allow_extra_args(false);
    command
        .add_option("--spot", o.spots,
                    "add a spot: X,Y,Z,DX,DY,DZ,I,INNER_DEG,OUTER_DEG, or R,G,B in place of I")
        ->allow_extra_args(false);
    command.add_option(
        "--sky", o.sky,
        "COLOUR (radiance of a constant sky, 1 or 3 numbers), FILE.exr or FILE.hdr (equirectangular), or "
        "DX,DY,DZ[,TURBIDITY] (clear sky of a sun whose light travels so; its disc is --sun)");
    command.add_option("--lamps", o.hungLamps, "hang so many points of light in the scene's free space")
        ->check(numberFrom(0, kMostHungLamps));
    command.add_flag("--no-scene-lights", o.noSceneLights, "drop the file's own lights");
}

Result<glm::vec3> parseStep(const std::string& text) {
    if (text.empty()) return glm::vec3(0);
    const auto n = parseNumbers(text, 3, 3);
    if (!n) return Error{fmt::format("--walk takes DX,DY,DZ, not '{}'", text)};
    return glm::vec3(vec3At(*n, 0));
}

Result<SceneOptions> withLibraryScene(SceneOptions options) {
    std::error_code ignored;
    if (scenegen::isBuiltIn(options.scene) || std::filesystem::exists(options.scene, ignored)) return options;
    const auto found = findInLibrary(options.scene);
    if (!found) return found.error();
    if (!found->has_value()) return options;
    const LibraryScene& scene = **found;
    options.scene = scene.file;
    if (options.view.empty() && options.camera.empty()) options.view = scene.view;
    const bool lit =
        !options.suns.empty() || !options.points.empty() || !options.spots.empty() || options.hungLamps > 0;
    if (!lit && !scene.sun.empty()) options.suns = {scene.sun};
    return options;
}

Result<LoadedScene> loadScene(const SceneOptions& given, MissingLight missing) {
    const auto resolved = withLibraryScene(given);
    if (!resolved) return resolved.error();
    const SceneOptions& options = *resolved;
    auto asset = scenegen::resolveScene(options.scene, options.param);
    if (!asset) return asset.error();
    const auto size = parseSize(options.size);
    if (!size) return size.error();
    LoadedScene loaded{.asset = std::make_unique<SceneAsset>(std::move(*asset)), .size = *size};
    for (const std::string& warning : loaded.asset->warnings)
        spdlog::warn("{}: {}", options.scene, warning);
    if (const std::string lost = shortcomingsOf(*loaded.asset); !lost.empty())
        spdlog::warn("{}: {} (afterglow info says more)", options.scene, lost);
    if (const Status posed = choosePose(options, *loaded.asset); !posed) return posed.error();
    if (const Status edited = applyEdits(options.edits, *loaded.asset); !edited) return edited.error();
    const auto camera = chooseCamera(options, *loaded.asset);
    if (!camera) return camera.error();
    loaded.scene =
        staticScene(*loaded.asset, camera->has_value() ? (*camera)->position : likelyView(*loaded.asset));
    if (options.noSceneLights || options.lights) loaded.scene.lights.clear();
    addLights(options, loaded.scene);
    if (options.noSceneLights) loaded.scene.sky = nullptr;
    for (const Status& added :
         {addSuns(options, loaded.scene), addPoints(options, loaded.scene), addSpots(options, loaded.scene)})
        if (!added) return added.error();
    if (!options.sky.empty()) {
        auto sky = parseSky(options.sky);
        if (!sky) return sky.error();
        loaded.scene.sky = std::make_shared<const Sky>(std::move(*sky));
    }
    for (RenderLight& light : loaded.scene.lights)
        if (const char* wrong = mendLight(light))
            return Error{fmt::format("a light of {} {}", options.scene, wrong)};
    if (const uint32_t hung = hangLamps(loaded.scene, options.hungLamps); hung < options.hungLamps)
        spdlog::warn("{} has free space for {} of {} punctual lights", options.scene, hung,
                     options.hungLamps);
    setCamera(loaded.scene, poseAndLight(options, *camera, missing, loaded), *size);
    return loaded;
}

}  // namespace ag::workbench
