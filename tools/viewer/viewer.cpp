#define GLFW_INCLUDE_NONE
#include "tools/viewer/viewer.h"

#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "engine/app/debug_ui.h"
#include "engine/app/imgui_pass.h"
#include "engine/app/present.h"
#include "engine/app/window.h"
#include "engine/capture/live_capture.h"
#include "engine/core/image.h"
#include "engine/core/log.h"
#include "engine/core/safe_file.h"
#include "engine/gpu/swapchain.h"
#include "tools/viewer/edit_history.h"
#include "tools/viewer/light_dragging.h"
#include "tools/viewer/preset_view.h"
#include "tools/viewer/selection.h"
#include "tools/viewer/viewer_memory.h"

namespace ag::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kShortestFrame = 1.0 / 144;  // s
constexpr float kScriptStep = 1.0f / 60;      // s: what a frame of a script stands for
constexpr uint32_t kCaptureFrames = 16;       // of F10
constexpr float kLongestStep = 0.25f;         // s: a slower frame slows the camera

class ViewerRun {
  public:
    ViewerRun(Viewing& viewing, const ViewerOptions& options, SaveViewing session, SaveViewing scene,
              Window& window, gpu::Device& device)
        : viewing_(viewing),
          options_(options),
          saveSession_(session),
          saveScene_(scene),
          window_(window),
          device_(device),
          swapchain_(device, window.framebufferSize()),
          renderer_(device),
          ui_(window.handle()),
          imgui_(device),
          camera_(freeCameraAt(viewing.pose, viewing.scene.bounds)),
          edited_(viewing.asset, viewing.scene, viewing.edits),
          capture_(renderer_, {}) {
        renderer_.load(*viewing.scene.geometry);
        if (remembers())
            if (const auto text = readFile(memoryPath())) useMemory(memoryFrom(*text), panels_, panel_);
        if (!options.truthStem.empty()) panel_.beside = Beside::kTruth;
    }

    // 0, or 2 after a sentence.
    int loop() {
        auto last = Clock::now();
        for (uint64_t frame = 0; !window_.wantsToClose(); ++frame) {
            window_.poll();
            handleKeys();
            window_.setFullscreen(panel_.window.fullscreen);
            swapchain_.setVsync(panel_.window.vsync);
            const auto now = Clock::now();
            const float elapsed = std::chrono::duration<float>(now - last).count();
            last = now;
            frameMs_ += (double(elapsed) * 1e3 - frameMs_) * 0.05;
            moveCamera(frame, std::min(elapsed, kLongestStep));
            if (!show()) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            obey(std::exchange(chosen_, PanelEvent::kNone));
            if (options_.frames && frame + 1 >= options_.frames && truthIsDone()) break;
            const double shortest = options_.record.empty() ? kShortestFrame : double(kScriptStep);
            std::this_thread::sleep_until(
                now + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(shortest)));
        }
        renderer_.waitIdle();
        return finish();
    }

  private:
    void handleKeys() {
        for (const auto& [key, control, pad] : window_.takePressedKeys()) {
            if (ui_.takesText()) continue;  // it is typed into a field
            if (key == GLFW_KEY_TAB) window_.captureCursor(!window_.cursorCaptured());
            if (key == GLFW_KEY_ESCAPE) leaveOrClose();
            if (key == GLFW_KEY_Z && control) stepThroughEdits(&EditHistory::undo);
            if (key == GLFW_KEY_Y && control) stepThroughEdits(&EditHistory::redo);
            if (key == GLFW_KEY_T) turnTruth();
            if (key == GLFW_KEY_B)
                panel_.beside = panel_.beside == Beside::kPreset ? Beside::kNothing : Beside::kPreset;
            if (key == GLFW_KEY_V) turnOverlay();
            if (key == GLFW_KEY_P) panel_.open = !panel_.open;
            if (key == GLFW_KEY_O) camera_.orbits = !camera_.orbits;
            if (key == GLFW_KEY_F) obey(PanelEvent::kFrameScene);
            if (key == GLFW_KEY_F1) panels_.showSettings = !panels_.showSettings;
            if (key == GLFW_KEY_F2) panels_.showPasses = !panels_.showPasses;
            if (key == GLFW_KEY_F3) panels_.showStatus = !panels_.showStatus;
            if (key == GLFW_KEY_F5) obey(PanelEvent::kSaveSession);
            if (key == GLFW_KEY_F6) obey(PanelEvent::kSaveScene);
            if (key == GLFW_KEY_F10) obey(PanelEvent::kCapture);
            if (key == GLFW_KEY_F11) panel_.window.fullscreen = !panel_.window.fullscreen;
            if (key == GLFW_KEY_F9) panels_.showProfiler = !panels_.showProfiler;
            if (key == GLFW_KEY_F12) obey(PanelEvent::kScreenshot);
            if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) panel_.layer = render::layerOfKey(key - GLFW_KEY_0);
        }
    }
    EditState editState() const { return {viewing_.scene.lights, viewing_.scene.sky, viewing_.edits}; }
    void stepThroughEdits(bool (EditHistory::*way)(EditState&)) {
        EditState state = editState();
        if (!(edits_.*way)(state)) return;
        if (state.lights != viewing_.scene.lights)
            ++viewing_.scene.lightsVersion, viewing_.lightsEdited = true;
        viewing_.skyEdited |= state.sky != viewing_.scene.sky;
        viewing_.scene.lights = std::move(state.lights);
        viewing_.scene.sky = std::move(state.sky);
        viewing_.edits = std::move(state.assets);
    }
    // The path tracer reads materials as they are.
    void followEdits() {
        if (edited_.changesMaterials(viewing_.edits)) truth_.pause();
        const EditedScene::Changes changes = edited_.follow(viewing_.edits);
        viewing_.lightsEdited |= changes.lights;
        if (!changes.materials) return;
        renderer_.loadMaterials(viewing_.asset.geometry);
        other_.loadMaterials(viewing_.asset.geometry);
    }
    // Off, beside ours, the error.
    void turnTruth() {
        const bool on = panel_.beside == Beside::kTruth, error = showsError();
        panel_.beside = on && error ? Beside::kNothing : Beside::kTruth;
        panel_.besideSettings.show = on && !error ? BesideShown::kError : BesideShown::kPicture;
    }
    // All of it, or nothing.
    void turnOverlay() {
        const bool show = !panel_.overlay.any();
        panel_.overlay = {show, show, show};
    }
    bool showsError() const { return panel_.besideSettings.show == BesideShown::kError; }
    void leaveOrClose() {
        if (window_.cursorCaptured())
            window_.captureCursor(false);
        else
            window_.close();
    }

    // What is recorded plays the same again.
    bool keepsTime() const { return !options_.script.empty() || !options_.record.empty(); }
    void moveCamera(uint64_t frame, float elapsed) {
        const Input held = window_.takeInput(bindings_, double(elapsed));
        const bool played = !options_.script.empty();
        const Input input = !played                          ? held
                            : frame < options_.script.size() ? options_.script[frame]
                                                             : Input{};
        moveFreely(camera_, input, keepsTime() ? kScriptStep : elapsed);
        if (!options_.record.empty()) recorded_.push_back(input);
    }

    void obey(PanelEvent event) {
        if (event == PanelEvent::kFrameScene) frameScene();
        if (event == PanelEvent::kSaveSession) say(saveSession_(viewing_));
        if (event == PanelEvent::kSaveScene) say(saveScene_(viewing_));
        if (event == PanelEvent::kScreenshot) savePicture();
        if (event == PanelEvent::kCapture) capture_.start("captures", kCaptureFrames);
    }
    void frameScene() {
        CameraPose pose = framingCamera(viewing_.scene.bounds);
        pose.position += viewing_.scene.originWorld;
        camera_ = freeCameraAt(pose, viewing_.scene.bounds);
    }
    void say(const Result<std::string>& saved) {
        panel_.message = saved ? "saved " + *saved : saved.error().message;
    }
    void savePicture() {
        if (!shown_) return;
        std::string path;
        for (int i = 1; path.empty() || fileExists(path); ++i)
            path = fmt::format("view-{:03}.png", i);
        renderer_.waitIdle();
        const Status saved = saveImage(render::readImage(renderer_, shown_), path);
        panel_.message = saved ? "saved " + path : saved.error().message;
    }

    // False while there is nothing to show on (minimised).
    bool show() {
        const glm::uvec2 size = glm::max(window_.framebufferSize(), glm::uvec2(16));
        drawUi(size);
        followEdits();
        edits_.note(editState(), ui_.holdsMouse());
        viewing_.pose = poseOf(camera_);
        setCamera(viewing_.scene, viewing_.pose, size);
        const bool fresh = truth_.follow(viewing_.scene, size, filterOf(viewing_.gi.antialiasing),
                                         panel_.beside == Beside::kTruth, device_);
        renderOther(size);
        // What waits for the device is done: between an image's acquisition and its submission nothing may.
        const auto image = swapchain_.acquire(window_.framebufferSize());
        if (!image) return false;
        const render::RenderSettings gi = panel_.layer ? settingsOf(*panel_.layer, viewing_.gi) : viewing_.gi;
        renderer_.render(
            viewing_.scene, size, gi, capture_.options(viewing_.graph),
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                missing_ = panel_.layer && !render::hasLayer(frame, *panel_.layer);
                shown_ = addShown(scope, view, frame, size);
                scope.output(shown_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
                overlay_.read(scope, view, frame, panel_.overlay);
                capture_.declare(scope, frame);
            },
            {.record =
                 [&](VkCommandBuffer commands) {
                     presentWithPanels(device_, commands, renderer_.graph().physical(shown_), swapchain_,
                                       *image, imgui_, drawn_++);
                 },
             .wait = image->acquired,
             .signal = image->rendered});
        swapchain_.present(*image);
        edited_.rendered();
        if (fresh) truth_.compare(renderer_);
        if (panel_.beside == Beside::kTruth) panel_.besideNumbers = truth_.numbers();
        if (capture_.recording() && capture_.note(subject(gi, size))) forgetImages();
        return true;
    }
    // The renderer made another frame since, so there is nothing to read of this one.
    void forgetImages() {
        shown_ = {};
        truth_.forgetFrame();
    }
    capture::Subject subject(const render::RenderSettings& gi, glm::uvec2 size) const {
        return {.scene = viewing_.scene,
                .name = options_.title,
                .settings = fmt::format("the viewer, preset {}", viewing_.preset),
                .gi = gi,
                .graph = viewing_.graph,
                .size = size,
                .schedules = {}};
    }
    ImageHandle addShown(GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame,
                         glm::uvec2 size) {
        if (panel_.layer)
            return render::addLayerView(scope, view, frame, *panel_.layer, size, viewing_.gi.composite);
        if (other_.isOn())
            return other_.add(scope, view, frame, viewing_.gi.composite, panel_.besideSettings);
        return truth_.add(scope, view, frame, viewing_.gi.composite, panel_.besideSettings);
    }
    void renderOther(glm::uvec2 size) {
        if (panel_.beside != Beside::kPreset) return other_.forget();
        other_.render(viewing_.scene, size, panel_.otherPreset, viewing_.gi.antialiasing, viewing_.graph,
                      device_);
        panel_.besideNumbers =
            fmt::format("passes: {:.1f} ms, its {:.1f} ms", passesMs(renderer_.graph()), other_.gpuMs());
    }

    bool truthIsDone() const {
        const TruthPicture* picture = truth_.picture();
        return options_.truthStem.empty() || (picture && picture->samples >= options_.truthSamples);
    }
    void drawUi(glm::uvec2 size) {
        capturing_ = capture_.message();
        ui_.build(panels_, window_.pointer(), viewing_.settings, renderer_.graph(), world_, statusLine(size),
                  [&] {
                      overlay_.draw({poseOf(camera_), glm::vec2(size)});
                      if (!panel_.open) return;
                      chosen_ = drawPanel(panel_, panelLayout(panels_), viewing_, camera_, edited_);
                      if (!window_.cursorCaptured()) dragHandles(glm::vec2(size));
                  });
    }
    void dragHandles(glm::vec2 size) {
        if (!dragLights(dragging_, viewing_, camera_, size))
            dragThing(panel_.selection, viewing_, edited_, {poseOf(camera_), size});
    }
    std::string statusLine(glm::uvec2 size) const {
        const glm::dvec3 p = camera_.position;
        return fmt::format("{:.1f} ms  {:.1f}/s  {}x{}  {}  at {:.2f} {:.2f} {:.2f}{}{}{}", frameMs_,
                           1000 / std::max(frameMs_, 1e-3), size.x, size.y, viewing_.preset, p.x, p.y, p.z,
                           missing_ ? "\nthis preset or scene has no such layer" : "",
                           capturing_.empty() ? "" : "\n", capturing_);
    }

    // What plays a script or leaves by itself is the same whoever starts it.
    bool remembers() const { return options_.frames == 0 && options_.script.empty(); }

    int finish() {
        if (remembers()) remember();
        if (!options_.record.empty())
            if (const Status kept = saveReplay({recorded_, {}}, options_.record); !kept) return refuse(kept);
        if (!options_.truthStem.empty() && truth_.picture()) {
            const auto said = truth_.save(renderer_, options_.truthStem);
            if (!said) return refuse(said.error());
            fmt::print("{}", *said);
        }
        if (options_.screenshot.empty() || !shown_) return 0;
        const Status saved = saveImage(render::readImage(renderer_, shown_), options_.screenshot);
        return saved ? 0 : refuse(saved);
    }
    void remember() const {
        const std::string path = memoryPath();
        Status kept = makeFolderOf(path);
        if (kept) kept = writeFileSafely(path, memoryText(memoryOf(panels_, panel_)));
        if (!kept) spdlog::warn("{}", kept.error().message);
    }
    static int refuse(const Status& status) {
        spdlog::error("{}", status.error().message);
        return 2;
    }

    Viewing& viewing_;
    const ViewerOptions& options_;
    SaveViewing saveSession_, saveScene_;
    Window& window_;
    gpu::Device& device_;
    gpu::Swapchain swapchain_;
    render::Renderer renderer_;
    DebugUi ui_;
    ImGuiPass imgui_;
    FreeCamera camera_;
    const Bindings bindings_;
    const World world_;  // of the panels: there is none
    DebugUiState panels_{.showStatus = true};
    PanelState panel_;
    PanelEvent chosen_ = PanelEvent::kNone;
    ImageHandle shown_;
    TruthView truth_;
    PresetView other_;
    LightDragging dragging_;
    LightOverlay overlay_;
    EditedScene edited_;
    EditHistory edits_;
    capture::LiveCapture capture_;
    std::string capturing_;  // what it says
    std::vector<Input> recorded_;
    double frameMs_ = 16;
    bool missing_ = false;  // the layer that was asked for
    uint64_t drawn_ = 0;
};

}  // namespace

int runViewer(Viewing& viewing, const ViewerOptions& options, SaveViewing session, SaveViewing scene) {
    const auto say = [](const Error& error) { return spdlog::error("{}", error.message), 2; };
    auto window = Window::open(options.title, options.size);
    if (!window) return say(window.error());
    auto surface = (*window)->surface();
    if (!surface) return say(surface.error());
    auto device = gpu::Device::create({.validation = options.validate, .window = *std::move(surface)});
    if (!device) return say(device.error());
    const int exitCode = ViewerRun(viewing, options, session, scene, **window, **device).loop();
    const int messages = (*device)->validationMessageCount();
    device->reset();  // before the window whose surface it holds
    return exitCode == 0 && messages > 0 ? 1 : exitCode;
}

}  // namespace ag::viewer
