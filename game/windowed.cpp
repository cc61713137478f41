// The demo in a window: fixed ticks, frames as fast as they come, debug panels.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <chrono>
#include <thread>
#include <utility>

#include "engine/app/debug_ui.h"
#include "engine/app/imgui_pass.h"
#include "engine/app/window.h"
#include "engine/core/image.h"
#include "engine/gpu/barrier.h"
#include "engine/scene/describe_components.h"
#include "game/demo_options.h"

namespace ag::game {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMostTicksPerFrame = 5;         // a slow frame slows the world rather than piling up
constexpr double kShortestFrame = 1.0 / 144;  // s: nothing here is worth more frames

// Keys 1 to 9.
constexpr std::array<gi::Layer, 9> kKeyLayers = {
    gi::Layer::kFinal,  gi::Layer::kDirect, gi::Layer::kBounce1,  gi::Layer::kIrradiance, gi::Layer::kAlbedo,
    gi::Layer::kNormal, gi::Layer::kRsm,    gi::Layer::kClusters, gi::Layer::kVals};

void transition(VkCommandBuffer commands, VkImage image, VkImageLayout from, VkImageLayout to) {
    gpu::transitionImage(commands, image, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1}, from, to);
}

void blit(VkCommandBuffer commands, const gpu::Image& from, VkImage to, glm::uvec2 size) {
    VkImageBlit region{.srcSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                       .dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}};
    region.srcOffsets[1] = {int32_t(from.desc().size.x), int32_t(from.desc().size.y), 1};
    region.dstOffsets[1] = {int32_t(size.x), int32_t(size.y), 1};
    vkCmdBlitImage(commands, from.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, to,
                   VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &region, VK_FILTER_LINEAR);
}

struct Controls {
    DebugUiState panels;
    bool quit = false;
};

void handleKeys(Window& window, Demo& demo, Controls& controls) {
    for (const int key : window.takePressedKeys()) {
        if (key == GLFW_KEY_ESCAPE && !window.cursorCaptured()) controls.quit = true;
        if (key == GLFW_KEY_ESCAPE) window.captureCursor(false);
        if (key == GLFW_KEY_F1) controls.panels.showSettings = !controls.panels.showSettings;
        if (key == GLFW_KEY_F2) controls.panels.showPasses = !controls.panels.showPasses;
        if (key == GLFW_KEY_F3) controls.panels.showWorld = !controls.panels.showWorld;
        if (key == GLFW_KEY_TAB) window.captureCursor(!window.cursorCaptured());
        if (key >= GLFW_KEY_1 && key <= GLFW_KEY_9) {
            const gi::Layer layer = kKeyLayers[size_t(key - GLFW_KEY_1)];
            demo.layer = layer == gi::Layer::kFinal ? std::nullopt : std::optional(layer);
        }
    }
}

std::string statusLine(const Demo& demo, double frameMs) {
    const Player& player = demo.game->player();
    return fmt::format(
        "{:.1f} ms  {:.1f}/s  at {:.2f} {:.2f}\n{}WASD walk, mouse look, hold: lamp, 1-9 views, Tab mouse, "
        "F1 settings, F2 passes, F3 world",
        frameMs, 1000 / std::max(frameMs, 1e-3), player.position.x, player.position.z,
        demo.layer ? std::string(gi::layerName(*demo.layer)) + "\n" : "");
}

class WindowedRun {
  public:
    WindowedRun(Demo& demo, Window& window, gpu::Device& device)
        : demo_(demo),
          window_(window),
          swapchain_(device, window.framebufferSize()),
          renderer_(device),
          ui_(window.handle()),
          imgui_(device, renderer_.pipelines()) {
        renderer_.load(demo.game->level().geometry);
        describeSceneComponents();
    }

    int loop() {
        window_.captureCursor(true);
        auto last = Clock::now();
        double behind = 0, smoothMs = 16;
        for (uint64_t frame = 0; !window_.wantsToClose() && !controls_.quit; ++frame) {
            window_.poll();
            handleKeys(window_, demo_, controls_);
            const auto now = Clock::now();
            const double elapsed = std::chrono::duration<double>(now - last).count();
            last = now;
            smoothMs += (elapsed * 1e3 - smoothMs) * 0.05;
            behind = std::min(behind + elapsed, kMostTicksPerFrame * kTick);
            const Input held = window_.takeInput();
            turned_ += held.look;
            for (; behind >= kTick || ticks_ == 0; behind -= kTick) {
                Input input = held;
                input.look =
                    std::exchange(turned_, glm::vec2(0));  // mouse movement counts once, and is never lost
                demo_.game->tick(nextInput(demo_, ticks_++, input), renderSize());
            }
            if (!show(smoothMs)) std::this_thread::sleep_for(std::chrono::milliseconds(20));
            if (demo_.options.frames && frame + 1 >= demo_.options.frames) break;
            std::this_thread::sleep_until(now + std::chrono::duration_cast<Clock::duration>(
                                                    std::chrono::duration<double>(kShortestFrame)));
        }
        renderer_.waitIdle();
        return saveScreenshot();
    }

  private:
    static constexpr double kTick = 1.0 / 60;  // s

    glm::uvec2 renderSize() const { return glm::max(window_.framebufferSize(), glm::uvec2(1)); }

    // False while there is nothing to show on (minimised).
    bool show(double frameMs) {
        const auto image = swapchain_.acquire(window_.framebufferSize());
        if (!image) return false;
        ui_.build(controls_.panels, demo_.settings, renderer_.graph(), demo_.game->world(),
                  statusLine(demo_, frameMs));
        // The window may have changed since the tick: the image is scaled onto it for that one frame.
        const glm::uvec2 size = demo_.game->world().resource<ActiveCamera>().size;
        renderer_.render(
            demo_.game->scene(), size, demo_.gi, demo_.graph,
            [&](FrameGraph& graph, const gi::SceneView& view, const gi::GiFrame& frame) {
                shown_ = demo_.layer
                             ? gi::addLayerView(graph, view, frame, *demo_.layer, size, demo_.gi.composite)
                             : frame.outputs.display;
                graph.output(shown_, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL);
            },
            [&](VkCommandBuffer commands) { present(commands, *image); }, {image->acquired, image->rendered});
        swapchain_.present(*image);
        return true;
    }

    void present(VkCommandBuffer commands, const gpu::SwapchainImage& target) {
        transition(commands, target.image, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
        blit(commands, renderer_.graph().physical(shown_), target.image, swapchain_.size());
        transition(commands, target.image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                   VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
        imgui_.draw(commands, target.view, swapchain_.format(), swapchain_.size(), uint32_t(drawn_++ % 2));
        transition(commands, target.image, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL,
                   VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
    }

    int saveScreenshot() {
        if (demo_.options.screenshot.empty() || !shown_) return 0;
        const Status saved = saveImage(gi::readImage(renderer_, shown_), demo_.options.screenshot);
        return saved ? 0 : refuse(saved.error().message);
    }

    Demo& demo_;
    Window& window_;
    gpu::Swapchain swapchain_;
    gi::GiRenderer renderer_;
    DebugUi ui_;
    ImGuiPass imgui_;
    Controls controls_;
    ImageHandle shown_;
    glm::vec2 turned_{0};  // mouse movement no tick has seen yet, pixels
    uint64_t ticks_ = 0, drawn_ = 0;
};

}  // namespace

int runWindowed(Demo& demo) {
    auto window = Window::open("Afterglow", demo.options.size);
    if (!window) return refuse(window.error().message + "; try --headless");
    auto device = gpu::Device::create({.validation = demo.options.validate, .window = (*window)->handle()});
    if (!device) return refuse(device.error().message);
    int exitCode = WindowedRun(demo, **window, **device).loop();
    const int messages = (*device)->validationMessageCount();
    device->reset();  // before the window whose surface it holds
    return exitCode == 0 && messages > 0 ? 1 : exitCode;
}

}  // namespace ag::game
