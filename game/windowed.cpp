// The demo in a window: fixed ticks, frames as fast as they come, the menu, the HUD and the debug panels.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "engine/app/debug_ui.h"
#include "engine/app/imgui_pass.h"
#include "engine/app/present.h"
#include "engine/app/window.h"
#include "engine/capture/live_capture.h"
#include "engine/core/image.h"
#include "engine/core/log.h"
#include "engine/core/program.h"
#include "engine/core/safe_file.h"
#include "engine/scene/describe_components.h"
#include "game/automatic_quality.h"
#include "game/demo_options.h"
#include "game/hud.h"
#include "game/menu.h"
#include "game/photo_album.h"
#include "game/photo_mode.h"
#include "game/playthrough.h"
#include "game/speaker.h"

namespace ag::game {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kTick = 1.0 / 60;            // s
constexpr int kMostTicksPerFrame = 12;        // a slower frame slows the world rather than piling up
constexpr double kShortestFrame = 1.0 / 144;  // s: nothing here is worth more frames
constexpr double kCpuBudgetMs = 80, kGpuBudgetMs = 13;  // of a frame's passes, where none is given
constexpr const char* kGoal = "Flowers open in light that has bounced.\nLight the walls, not the flowers.";
constexpr double kLongestStep = 0.1;  // s
constexpr auto kMessage = std::chrono::seconds(4);
constexpr uint32_t kFramesOfPhoto = kFramesInFlight + 8;  // until light has come back that was forgotten
constexpr float kRestSeconds = 0.5f;  // of the photo mode's camera, before all pixels are rendered
constexpr const char* kPhotoKeys =
    "arrows: view, time of day   1-9: layers   Enter: save   H: hide   Esc: back";

class WindowedRun {
  public:
    WindowedRun(Demo& demo, Window& window, gpu::Device& device, gpu::RenderDoc renderDoc)
        : demo_(demo),
          window_(window),
          device_(device),
          swapchain_(device, window.framebufferSize()),
          renderer_(device, demo.options.serial ? 1 : 0),
          ui_(window.handle()),
          imgui_(device),
          quality_(demo.options.budgetMs > 0 ? demo.options.budgetMs
                   : device.info().isCpu     ? kCpuBudgetMs
                                             : kGpuBudgetMs),
          capture_(renderer_, renderDoc),
          playing_(demo, renderer_) {
        describeSceneComponents();
        report(playing_.openTimes());
        menu_.hasSave = playing_.hasSave();
        menu_.roomNotes = playing_.roomNotes();
        if (!demo.replay.ticks.empty() || demo.options.resume) play();
        usePlayerSettings();
        onProgramEnd([this] {
            playing_.autosave();
            if (const Status kept = finishRecording(demo_); !kept) spdlog::error("{}", kept.error().message);
        });
    }
    ~WindowedRun() { onProgramEnd({}); }

    int loop() {
        auto last = Clock::now();
        for (uint64_t frame = 0; !window_.wantsToClose() && !quit_; ++frame) {
            window_.poll();
            handleKeys();
            if (window_.takeFocusLost()) openMenu();
            const auto now = Clock::now();
            const double elapsed = std::chrono::duration<double>(now - last).count();
            last = now;
            frameMs_ += (elapsed * 1e3 - frameMs_) * 0.05;
            speaker_.setVolume(demo_.sound.volume);
            speaker_.standIn(menu_.started ? demo_.game->progress().room : -1, float(elapsed));
            advance(elapsed);
            if (show())
                adapt();
            else
                std::this_thread::sleep_for(std::chrono::milliseconds(20));
            if (demo_.options.frames && frame + 1 >= demo_.options.frames) break;
            std::this_thread::sleep_until(now + std::chrono::duration_cast<Clock::duration>(
                                                    std::chrono::duration<double>(kShortestFrame)));
        }
        renderer_.waitIdle();
        playing_.autosave();
        return saveScreenshot();
    }

  private:
    // --- The menu and the keys ---
    void play() {
        menu_.open = false;
        menu_.started = true;
        playing_.begin();
        window_.captureCursor(true);
    }
    void openMenu() {
        if (menu_.open) return;
        playing_.autosave();
        menu_ = {.open = true,
                 .started = menu_.started,
                 .hasSave = playing_.hasSave(),
                 .roomNotes = playing_.roomNotes()};
        window_.captureCursor(false);
    }
    void handleKeys() {
        obey(std::exchange(chosen_, MenuEvent::kNone));
        for (const auto& [code, control, pad] : window_.takePressedKeys()) {
            const int key = pad && menu_.open && menu_.waitsForPad() ? pad : code;
            if (menu_.open) {
                // The mouse chooses by clicking; as a key it only counts where one is asked for.
                if (key && (key < kMouseCode || menu_.waitsForKey)) {
                    const Menu before = menu_;
                    const MenuEvent event = pressInMenu(menu_, key, demo_.user, demo_.keys);
                    clickIfAnswered(before, event);
                    obey(event);
                }
            } else if (photo_.on()) {
                photoKey(photoKeyOf(key, pad));
            } else if (key == GLFW_KEY_ESCAPE) {
                openMenu();
            }
            debugKey(key);
        }
    }
    // A gamepad's A flies up, as it jumps; its Y takes the picture.
    static int photoKeyOf(int key, int pad) {
        if (pad == kPadCode + GLFW_GAMEPAD_BUTTON_Y) return GLFW_KEY_ENTER;
        return pad && key == GLFW_KEY_ENTER ? 0 : key;
    }
    void photoKey(int key) {
        if (key == GLFW_KEY_ESCAPE) leavePhotos();
        if (key == GLFW_KEY_ENTER || key == GLFW_KEY_KP_ENTER || key == GLFW_KEY_F12) wantsPhoto_ = true;
        photo_.press(*demo_.game, key);
    }
    // Where the sky was another one, light that went on from it is forgotten, too.
    void leavePhotos() {
        if (photo_.changedSky()) renderer_.startAnew();
        photo_.leave(*demo_.game);
    }
    void takePhotos() {
        play();
        photo_.enter(*demo_.game);
    }
    void clickIfAnswered(const Menu& before, MenuEvent event) {
        const Sound click = soundOf(SoundId::kClick);
        const bool moved = menu_.page != before.page || menu_.selected != before.selected ||
                           menu_.waitsForKey != before.waitsForKey;
        if (moved || event != MenuEvent::kNone) speaker_.play({&click, 1});
    }
    void debugKey(int key) {
        if (key == GLFW_KEY_F11) {
            demo_.user.fullscreen = !demo_.user.fullscreen;
            usePlayerSettings();
            report(saveUserSettings(demo_.user, demo_.files.settings()));
        }
        if (key == GLFW_KEY_F1) panels_.showSettings = !panels_.showSettings;
        if (key == GLFW_KEY_F2) panels_.showPasses = !panels_.showPasses;
        if (key == GLFW_KEY_F3) panels_.showStatus = !panels_.showStatus;
        if (key == GLFW_KEY_F4) panels_.showWorld = !panels_.showWorld;
        if (key == GLFW_KEY_F9) panels_.showProfiler = !panels_.showProfiler;
        if (key == GLFW_KEY_F8 && !menu_.open) photo_.on() ? leavePhotos() : takePhotos();
        if (key == GLFW_KEY_F10) capture_.start(demo_.files.captures(), demo_.options.captureFrames);
        if (key == GLFW_KEY_TAB && !menu_.open) window_.captureCursor(!window_.cursorCaptured());
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9 && !menu_.waitsForKey)
            demo_.layer = render::layerOfKey(key - GLFW_KEY_0);
    }
    void obey(MenuEvent event) {
        switch (event) {
            case MenuEvent::kResume:
                play();
                break;
            case MenuEvent::kQuit:
                quit_ = true;
                break;
            case MenuEvent::kNewGame:
                start(&Playthrough::startAnew);
                break;
            case MenuEvent::kContinue:
                start(&Playthrough::continueSaved);
                break;
            case MenuEvent::kStartRoom:
                startRoom();
                break;
            case MenuEvent::kPhotoMode:
                takePhotos();
                break;
            case MenuEvent::kSettingsChanged:
                usePlayerSettings();
                report(saveUserSettings(demo_.user, demo_.files.settings()));
                break;
            case MenuEvent::kKeysChanged:
                report(saveBindings(demo_.keys, demo_.files.keys()));
                break;
            case MenuEvent::kNone:
                break;
        }
    }
    void report(const Status& status) {
        if (!status) menu_.message = status.error().message;
    }

    // --- The game ---
    // The menu stays open, with the reason, where it cannot begin.
    template <class... Args>
    void start(Status (Playthrough::*how)(Args...), Args... args) {
        const Game* before = demo_.game.get();
        const Status started = (playing_.*how)(args...);
        report(started);
        const bool other = demo_.game.get() != before;
        if (other) photo_.forget(), behind_ = 0;
        if (playing_.hasBegun() && (started || other)) play();
    }
    void startRoom() { start(&Playthrough::startRoom, int32_t(menu_.room)); }
    void advance(double elapsed) {
        const Input held = takeInput(elapsed);
        if (menu_.open) {
            behind_ = 0;
            return;
        }
        if (photo_.on()) {
            behind_ = 0;
            return photo_.move(*demo_.game, held, float(std::min(elapsed, kLongestStep)));
        }
        behind_ = std::min(behind_ + elapsed, kMostTicksPerFrame * kTick);
        turned_ += held.look;
        for (; behind_ >= kTick || playing_.isFresh(); behind_ = std::max(behind_ - kTick, 0.0)) {
            Input input = held;
            input.look =
                std::exchange(turned_, glm::vec2(0));  // mouse movement counts once, and is never lost
            playing_.tick(input);
            capture_.noteSystems(demo_.game->tickSchedule());
            speaker_.play(demo_.game->sounds());
        }
        report(playing_.keep(elapsed));
    }
    Input takeInput(double elapsed) {
        Input input = window_.takeInput(demo_.keys, elapsed);
        input.look *= demo_.user.sensitivity;
        if (demo_.user.invertLook) input.look.y = -input.look.y;
        return input;
    }

    // --- The picture ---
    void usePlayerSettings() {
        useQuality(demo_, demo_.user.quality, quality_.step());
        if (fullscreen_ != demo_.user.fullscreen) window_.setFullscreen(fullscreen_ = demo_.user.fullscreen);
        demo_.game->world().resource<Player>().verticalFov = glm::radians(demo_.user.fieldOfView);
    }
    bool automatic() const { return demo_.user.quality == Quality::kAutomatic; }
    void adapt() {
        if (photo_.on()) quality_.endMeasuring();
        if (automatic() && quality_.frame(renderer_, !menu_.open && !photo_.on())) usePlayerSettings();
    }
    FrameGraphOptions graphOptions() const {
        FrameGraphOptions graph = demo_.graph;
        graph.skip = graph.skip && !(automatic() && quality_.isMeasuring());
        return capture_.options(graph);
    }
    // In photo mode the world stands still, so that rays pay; pixels are as many as shown once the camera
    // rests.
    render::RenderSettings settings() const {
        render::RenderSettings s = shownSettings(demo_);
        if (!photo_.on()) return s;
        s.bounce.texelRays.enabled = true;
        if (photo_.rested() > kRestSeconds) s.antialiasing.scale = 1;
        return s;
    }
    // False while there is nothing to show on (minimised).
    bool show() {
        const auto image = swapchain_.acquire(window_.framebufferSize());
        if (!image) return false;
        const glm::uvec2 size = glm::max(window_.framebufferSize(), glm::uvec2(16));
        demo_.game->frame(size, menu_.open || photo_.on() ? 1.0f : float(behind_ / kTick));
        capture_.noteSystems(demo_.game->frameSchedule());
        speaker_.listenFrom(demo_.game->world().resource<ActiveCamera>().pose);
        drawUi();
        renderer_.render(
            demo_.game->scene(), size, settings(), graphOptions(),
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                shown_ = demo_.layer ? render::addLayerView(scope, view, frame, *demo_.layer, size,
                                                            demo_.gi.composite)
                                     : frame.outputs.display;
                scope.output(shown_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
                light_ = wantsPhoto_ ? render::addLayer(scope, view, frame,
                                                        demo_.layer.value_or(render::Layer::kRadiance))
                                     : ImageHandle{};
                if (light_) scope.output(light_);
                capture_.declare(scope, frame);
            },
            {.record =
                 [&](VkCommandBuffer commands) {
                     presentWithPanels(device_, commands, renderer_.graph().physical(shown_), swapchain_,
                                       *image, imgui_, drawn_++);
                 },
             .wait = image->acquired,
             .signal = image->rendered});
        // Readings are of some frames ago: none of the photo mode's reach the game.
        sincePhoto_ = photo_.on() ? 0 : sincePhoto_ + 1;
        if (sincePhoto_ > kFramesOfPhoto) demo_.game->takeReadings(renderer_.probeReadings());
        swapchain_.present(*image);
        if (std::exchange(wantsPhoto_, false)) savePhoto();
        if (capture_.recording()) capture_.note(subject(size));
        return true;
    }
    void savePhoto() {
        const auto stem = game::savePhoto(
            renderer_, shown_, light_, demo_.layer.value_or(render::Layer::kRadiance), demo_.files.photos());
        message_ =
            stem ? fmt::format("saved {}.png{}", *stem, light_ ? " and .exr" : "") : stem.error().message;
        messageUntil_ = Clock::now() + kMessage;
    }
    capture::Subject subject(glm::uvec2 size) {
        return {.scene = demo_.game->scene(),
                .name = demo_.game->level().name,
                .settings = fmt::format("the game, {} quality", qualityName(demo_.user.quality)),
                .gi = settings(),
                .graph = demo_.graph,
                .size = size,
                .schedules = {&demo_.game->tickSchedule(), &demo_.game->frameSchedule()}};
    }
    void drawUi() {
        MenuEvent event = MenuEvent::kNone;
        std::string message = capture_.message();
        if (message.empty() && Clock::now() < messageUntil_) message = message_;
        const Menu before = menu_;
        ui_.build(panels_, window_.pointer(), demo_.settings, renderer_.graph(), demo_.game->world(),
                  statusLine(), [&] {
                      drawMessage(message);
                      if (!menu_.open) photo_.on() ? drawPhoto() : drawGame();
                      if (menu_.open) event = drawMenu(menu_, demo_.user, demo_.keys, kGoal, keysLine());
                  });
        clickIfAnswered(before, event);
        chosen_ = event;  // obeyed before the next frame: this one is under way
    }
    void drawGame() {
        const RenderScene& scene = demo_.game->scene();
        HudState hud = readHud(demo_.game->world(), demo_.game->hints(), demo_.user.hints);
        hud.notice = playing_.notice();
        hud.heard = playing_.heard();
        drawHud(hud, glm::vec2(window_.framebufferSize()), {scene.camera.clipFromWorld, scene.originWorld});
    }
    void drawPhoto() {
        if (!photo_.showsLines()) return;
        const std::string layer = demo_.layer ? std::string(render::layerInfo(*demo_.layer).name) : "";
        drawPhotoLines(photo_.lines(*demo_.game, renderer_.probeReadings(), layer), kPhotoKeys,
                       glm::vec2(window_.framebufferSize()));
    }
    std::string keysLine() const {
        const auto key = [&](Action a) { return spokenName(demo_.keys.codes[size_t(a)]); };
        return fmt::format(
            "{} {} {} {}: walk    mouse: look around\n"
            "hold {}: aim the lamp alone\n"
            "{}: jump    {}: crouch\n"
            "{}: pick up or put down a crate",
            key(Action::kForward), key(Action::kLeft), key(Action::kBack), key(Action::kRight),
            key(Action::kLamp), key(Action::kJump), key(Action::kCrouch), key(Action::kUse));
    }
    std::string statusLine() const {
        const glm::vec2 shown(window_.framebufferSize());
        const glm::uvec2 size(shown * settings().antialiasing.scale + 0.5f);  // rendered
        const glm::dvec3 at = demo_.game->player().position;
        return fmt::format("{:.1f} ms  {:.1f}/s  {}x{} {}  at {:.2f} {:.2f}{}", frameMs_,
                           1000 / std::max(frameMs_, 1e-3), size.x, size.y,
                           automatic() ? fmt::format("auto ({})", quality_.step().name)
                                       : std::string(qualityName(demo_.user.quality)),
                           at.x, at.z,
                           demo_.layer ? fmt::format("\n{}", render::layerInfo(*demo_.layer).name) : "");
    }
    int saveScreenshot() {
        if (demo_.options.screenshot.empty() || !shown_) return 0;
        const Status saved = saveImage(render::readImage(renderer_, shown_), demo_.options.screenshot);
        return saved ? 0 : refuse(saved.error().message);
    }

    Demo& demo_;
    Window& window_;
    gpu::Device& device_;
    gpu::Swapchain swapchain_;
    render::Renderer renderer_;
    DebugUi ui_;
    ImGuiPass imgui_;
    AutomaticQuality quality_;
    capture::LiveCapture capture_;
    Speaker speaker_;
    DebugUiState panels_;
    Menu menu_;
    MenuEvent chosen_ = MenuEvent::kNone;
    Playthrough playing_;
    PhotoMode photo_;
    ImageHandle shown_, light_;  // light_: of a photo
    bool wantsPhoto_ = false;
    uint32_t sincePhoto_ = kFramesOfPhoto;  // frames
    std::string message_;
    Clock::time_point messageUntil_{};
    glm::vec2 turned_{0};  // mouse movement no tick has seen yet, pixels
    double behind_ = 0, frameMs_ = 16;
    bool fullscreen_ = false, quit_ = false;
    uint64_t drawn_ = 0;
};

}  // namespace

int runWindowed(Demo& demo) {
    if (const Status folder = openFolder(demo.files); !folder) return refuse(folder.error().message);
    auto window = Window::open("Afterglow", demo.options.size);
    if (!window) return refuse(window.error().message + "; try --headless");
    const auto renderDoc = gpu::RenderDoc::open(demo.options.renderDoc);
    if (!renderDoc) return refuse(renderDoc.error().message);
    auto surface = (*window)->surface();
    if (!surface) return refuse(surface.error().message);
    auto device = gpu::Device::create(deviceOptions(demo, *std::move(surface)));
    if (!device) return refuse(device.error().message);
    demo.device = (*device)->info().name;
    int exitCode = WindowedRun(demo, **window, **device, *renderDoc).loop();
    const int messages = (*device)->validationMessageCount();
    device->reset();  // before the window whose surface it holds
    return exitCode == 0 && messages > 0 ? 1 : exitCode;
}

}  // namespace ag::game
