#include "tools/workbench/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "engine/core/safe_file.h"
#include "tools/workbench/session_edits.h"

namespace ag::workbench {
namespace {

using nlohmann::json;

constexpr uint64_t kMostBytes = 1 << 20;

constexpr std::array kKinds = {"sun", "point", "spot"};  // as LightKind counts them

template <class V>
json listOf(const V& v) {
    return {v.x, v.y, v.z};
}

double numberIn(const json& value) {
    return std::clamp(value.get<double>(), -kMostNumber, kMostNumber);
}

glm::dvec3 vectorIn(const json& list) {
    return {numberIn(list.at(0)), numberIn(list.at(1)), numberIn(list.at(2))};
}

json lightOf(const PlacedLight& placed) {
    const RenderLight& l = placed.light;
    return {{"kind", kKinds[size_t(l.kind)]},
            {"position", listOf(placed.position)},
            {"direction", listOf(l.direction)},
            {"intensity", listOf(l.intensity)},
            {"range", l.range},
            {"inner_cone", l.innerConeAngle},
            {"outer_cone", l.outerConeAngle},
            {"bounces", l.bounces},
            {"casts_shadow", l.castsShadow}};
}

PlacedLight lightIn(const json& file) {
    const auto kind = std::ranges::find(kKinds, file.at("kind").get<std::string>());
    if (kind == kKinds.end()) throw json::other_error::create(501, "no kind of light", &file);
    return {.light = {.kind = LightKind(kind - kKinds.begin()),
                      .direction = glm::vec3(vectorIn(file.at("direction"))),
                      .intensity = glm::vec3(vectorIn(file.at("intensity"))),
                      .range = float(numberIn(file.at("range"))),
                      .innerConeAngle = float(numberIn(file.at("inner_cone"))),
                      .outerConeAngle = float(numberIn(file.at("outer_cone"))),
                      .bounces = file.at("bounces"),
                      .castsShadow = file.at("casts_shadow")},
            .position = vectorIn(file.at("position"))};
}

json poseAsJson(const CameraPose& p) {
    return {{"position", listOf(p.position)},
            {"forward", listOf(p.forward)},
            {"up", listOf(p.up)},
            {"vertical_fov", p.verticalFov},
            {"near", p.near}};
}

// As the viewer's fields bound it.
CameraPose poseIn(const json& file) {
    CameraPose p{.position = vectorIn(file.at("position")),
                 .forward = glm::vec3(vectorIn(file.at("forward"))),
                 .up = glm::vec3(vectorIn(file.at("up"))),
                 .verticalFov = float(std::clamp(numberIn(file.at("vertical_fov")), 1e-3, 3.1)),
                 .near = float(std::clamp(numberIn(file.at("near")), 1e-9, kMostNumber))};
    const bool looks = glm::length(p.forward) > 1e-6f && glm::length(p.up) > 1e-6f;
    if (!looks) throw json::other_error::create(501, "looks nowhere", &file);
    p.forward = glm::normalize(p.forward);
    return p;
}

template <class T>
void read(const json& file, const char* key, T& into) {
    if (file.contains(key)) into = file.at(key).get<T>();
}

// Throws where a value is of another type or makes no sense.
Session sessionOf(const json& file) {
    Session s;
    read(file, "scene", s.scene.scene);
    read(file, "param", s.scene.param);
    read(file, "clip", s.scene.clip);
    read(file, "view", s.scene.view);
    read(file, "suns", s.scene.suns);
    read(file, "points", s.scene.points);
    read(file, "spots", s.scene.spots);
    read(file, "sky", s.scene.sky);
    read(file, "lamps", s.scene.hungLamps);
    read(file, "no_scene_lights", s.scene.noSceneLights);
    if (file.contains("camera")) s.scene.pose = poseIn(file.at("camera"));
    if (file.contains("lights")) {
        s.scene.lights.emplace();
        for (const json& light : file.at("lights"))
            s.scene.lights->push_back(lightIn(light));
    }
    s.scene.edits = readEdits(file);
    read(file, "preset", s.preset);
    read(file, "set", s.assignments);
    return s;
}

}  // namespace

Status saveSession(const Session& s, const std::string& path) {
    json file = {{"scene", s.scene.scene},     {"param", s.scene.param},
                 {"clip", s.scene.clip},       {"view", s.scene.view},
                 {"suns", s.scene.suns},       {"points", s.scene.points},
                 {"spots", s.scene.spots},     {"sky", s.scene.sky},
                 {"lamps", s.scene.hungLamps}, {"no_scene_lights", s.scene.noSceneLights},
                 {"preset", s.preset},         {"set", s.assignments}};
    if (s.scene.pose) file["camera"] = poseAsJson(*s.scene.pose);
    if (s.scene.lights) {
        file["lights"] = json::array();
        for (const PlacedLight& light : *s.scene.lights)
            file["lights"].push_back(lightOf(light));
    }
    writeEdits(s.scene.edits, file);
    return writeFileSafely(path, file.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

Result<Session> loadSession(const std::string& path) {
    const auto text = readFile(path, kMostBytes);
    if (!text) return text.error();
    const json file = json::parse(*text, nullptr, false);
    if (!file.is_object() || !file.contains("scene")) return Error{path + ": it is no session of the viewer"};
    try {
        Session session = sessionOf(file);
        const Status edits = checkEdits(session.scene.edits);
        if (!edits) return Error{path + ": " + edits.error().message};
        return session;
    } catch (const json::exception&) {
        return Error{path + ": one of its values is of the wrong type or makes no sense"};
    }
}

Result<Session> withSession(const std::string& path, Session given) {
    if (path.empty()) {
        if (given.preset.empty()) given.preset = Session{}.preset;
        return given;
    }
    auto session = loadSession(path);
    if (!session) return session.error();
    const SceneOptions& o = given.scene;
    SceneOptions& s = session->scene;
    s.size = o.size;
    s.camera = o.camera;
    for (const auto& [from, to] :
         {std::pair(&o.scene, &s.scene), {&o.clip, &s.clip}, {&o.view, &s.view}, {&o.sky, &s.sky}})
        if (!from->empty()) *to = *from;
    if (o.param != 0) s.param = o.param;
    if (!o.camera.empty()) s.view.clear();
    if (!o.camera.empty() || !o.view.empty()) s.pose.reset();
    for (const auto& [from, to] : {std::pair(&o.suns, &s.suns),
                                   {&o.points, &s.points},
                                   {&o.spots, &s.spots},
                                   {&given.assignments, &session->assignments}})
        to->insert(to->end(), from->begin(), from->end());
    s.hungLamps += o.hungLamps;
    s.noSceneLights |= o.noSceneLights;
    if (!given.preset.empty()) session->preset = given.preset;
    return session;
}

Status useSession(const std::string& path, SceneOptions& scene, std::string& preset,
                  std::vector<std::string>& assignments) {
    auto session = withSession(path, {scene, preset, assignments});
    if (!session) return session.error();
    scene = session->scene;
    preset = session->preset;
    assignments = session->assignments;
    return Ok{};
}

void describeLights(const RenderScene& scene, SceneOptions& options) {
    options.hungLamps = 0;
    options.suns.clear(), options.points.clear(), options.spots.clear();
    options.lights.emplace();
    for (const RenderLight& light : scene.lights)
        options.lights->push_back({light, scene.originWorld + glm::dvec3(light.position)});
}

std::string describeSky(const Sky& clear) {
    const glm::vec3 d = clear.sunDirection;
    return fmt::format("{:.9g},{:.9g},{:.9g},{:.9g}", d.x, d.y, d.z, clear.turbidity);
}

}  // namespace ag::workbench
