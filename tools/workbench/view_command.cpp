#include <fmt/format.h>
#include <fmt/ranges.h>

#include "engine/app/input.h"
#include "engine/core/number_option.h"
#include "engine/core/safe_file.h"
#include "tools/viewer/edited_gltf.h"
#include "tools/viewer/viewer.h"
#include "tools/workbench/commands.h"
#include "tools/workbench/render_setup.h"
#include "tools/workbench/session.h"

namespace ag::workbench {
namespace {

struct ViewOptions {
    Session given{.preset = ""};
    std::string session, script;
    viewer::ViewerOptions viewer;
};

// What differs from the preset as assignments.
std::vector<std::string> changesFrom(const std::string& preset, const Settings& settings) {
    RenderSetup plain;
    render::applyPreset(preset, plain.gi);
    std::vector<std::string> changes;
    for (size_t i = 0; i < settings.all().size(); ++i) {
        const Setting& now = settings.all()[i];
        const double value = settingValue(now);
        if (value != settingValue(plain.registry.all()[i]))
            changes.push_back(
                fmt::format("{}.{}={}", now.info.group, now.info.name, settingText(now, value)));
    }
    return changes;
}

Result<std::string> saveAs(const std::string& path, Session session, const viewer::Viewing& viewing) {
    session.scene.pose = viewing.pose;
    session.scene.view.clear(), session.scene.camera.clear();
    if (viewing.lightsEdited) describeLights(viewing.scene, session.scene);
    if (viewing.skyEdited) session.scene.sky = describeSky(*viewing.scene.sky);
    session.scene.edits = viewing.edits;
    session.preset = viewing.preset;
    session.assignments = changesFrom(viewing.preset, viewing.settings);
    if (const Status saved = saveSession(session, path); !saved) return saved.error();
    return path;
}

Result<std::string> saveAsGltf(const SceneOptions& options, const viewer::Viewing& viewing) {
    const auto source = withLibraryScene(options);
    if (!source) return source.error();
    const std::string path = viewer::editedPath(source->scene);
    const viewer::SceneEdits edits{viewing.scene.lights, viewing.scene.originWorld, viewing.pose,
                                   viewer::movesInFile(viewing.asset, viewing.edits), viewing.edits.looks};
    if (const Status saved = viewer::saveEdited(source->scene, source->param, edits, path); !saved)
        return saved.error();
    return path;
}

// Until the user says otherwise.
void showAtItsBest(render::RenderSettings& gi) {
    gi.exposure.automatic = true;
    gi.composite.tonemap = render::Tonemap::kAgx;
    gi.antialiasing.mode = render::Antialiasing::kTemporal;
}

int runView(ViewOptions& o) {
    const bool saved = fileExists(o.session);
    if (!saved && o.given.preset.empty()) o.given.preset = "afterglow-bounces";
    auto session = withSession(saved ? o.session : "", o.given);
    if (!session) return refuse(session.error().message);
    if (session->scene.scene.empty())
        return refuse("view needs a SCENE, or a --session that was saved before");
    RenderSetup setup;
    if (!saved) showAtItsBest(setup.gi);
    if (const Status set = setup.apply(session->preset, session->assignments); !set)
        return refuse(set.error().message);
    const std::string truthFile = o.viewer.truthStem.empty() ? "" : o.viewer.truthStem + "_1.exr";
    if (const Status good = checkWritable({o.viewer.screenshot, o.viewer.record, truthFile}); !good)
        return refuse(good.error().message);
    if (!o.script.empty()) {
        auto script = loadReplay(o.script);
        if (!script) return refuse(script.error().message);
        o.viewer.script = std::move(script->ticks);
    }
    auto loaded = loadScene(session->scene, MissingLight::kSunAndSky);
    if (!loaded) return refuse(loaded.error().message);
    if (loaded->lightAdded) session->scene.sky = loaded->skyAdded;
    if (o.session.empty()) o.session = "view-session.json";
    o.viewer.title = fmt::format("Afterglow: {}", session->scene.scene);
    o.viewer.size = loaded->size;
    viewer::Viewing viewing{.scene = loaded->scene,
                            .asset = *loaded->asset,
                            .edits = session->scene.edits,
                            .pose = poseOf(loaded->scene),
                            .gi = setup.gi,
                            .settings = setup.registry,
                            .graph = setup.graph,
                            .preset = session->preset,
                            .lightsEdited = loaded->lightAdded};
    return viewer::runViewer(
        viewing, o.viewer, [&](const viewer::Viewing& now) { return saveAs(o.session, *session, now); },
        [&](const viewer::Viewing& now) { return saveAsGltf(session->scene, now); });
}

}  // namespace

void addViewCommand(CLI::App& program, int& exitCode) {
    const auto o = std::make_shared<ViewOptions>();
    CLI::App* command = program.add_subcommand(
        "view", "a scene in a window: fly, edit its lights, things and materials, see every layer");
    addSceneOptions(*command, o->given.scene);
    command->get_option("scene")->required(false);
    command->add_option("--preset", o->given.preset,
                        fmt::format("{}", fmt::join(render::presetNames(), ", ")));
    command->add_option("--set", o->given.assignments, "group.name=value")->allow_extra_args(false);
    command->add_option("--session", o->session, "begin with this session, if it is there; F5 saves it");
    command->add_option("--frames", o->viewer.frames, "leave after so many")->check(numberFrom(1, 1000000));
    command->add_option("--screenshot", o->viewer.screenshot, "save the last frame as PNG");
    command->add_option("--script", o->script, "play these inputs, one a frame, in place of keys and mouse");
    command->add_option("--record", o->viewer.record, "keep the inputs as such a script");
    command->add_option(
        "--truth", o->viewer.truthStem,
        "with path tracing from the start; on leaving STEM_1.exr, STEM_2.exr (its halves) and STEM_ours.exr "
        "(radiance) are saved, as compare takes them, and the error is printed");
    command
        ->add_option("--truth-samples", o->viewer.truthSamples,
                     "paths a pixel before it leaves by --frames, with --truth")
        ->check(numberFrom(2, 4096))
        ->capture_default_str();
    command->add_flag("--validate", o->viewer.validate, "with Vulkan validation; any message exits with 1");
    command->footer(
        "Keys: Tab flies (WASD, Space, Shift, mouse) or frees the mouse for the panels and for things, "
        "lights and "
        "the sky's sun, which are dragged; O circles about what is ahead, F shows the whole scene, T traces "
        "paths "
        "beside it, B renders another preset beside it, V draws lights and their maps in the world, 1-9 "
        "layers, P "
        "panel, F1 settings, F2 passes, F3 times, F5 saves the session, F6 the scene as glTF, Ctrl+Z and "
        "Ctrl+Y "
        "undo and redo, F9 profiler, F10 captures frames, F11 fullscreen, F12 saves a picture, Esc frees the "
        "mouse, then closes.");
    command->callback([o, &exitCode] { exitCode = runView(*o); });
}

}  // namespace ag::workbench
