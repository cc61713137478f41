// The demo without a window: plays a replay, prints progress, leaves a picture and a report.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <map>

#include "engine/core/image.h"
#include "game/demo_options.h"

namespace ag::game {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

double quantile(std::vector<double> values, double q) {
    if (values.empty()) return 0;
    const auto nth = values.begin() + std::ptrdiff_t(q * double(values.size() - 1));
    std::nth_element(values.begin(), nth, values.end());
    return *nth;
}

// Times and outcomes of each pass over the run, in the order of the frame.
class PassLog {
  public:
    void add(const FrameGraph& graph) {
        for (const PassReport& pass : graph.report()) {
            auto [entry, added] = rows_.try_emplace(std::string(pass.name));
            if (added) order_.push_back(entry->first);
            ++entry->second.frames;
            entry->second.ran += pass.outcome == PassOutcome::kRan;
            if (pass.gpuMs > 0) entry->second.ms.push_back(pass.gpuMs);
        }
    }
    std::string text() const {
        std::string out =
            fmt::format("{:<36} {:>10} {:>10} {:>8}\n", "pass", "median ms", "p99 ms", "skipped");
        for (const std::string& name : order_) {
            const Row& row = rows_.at(name);
            out += fmt::format("{:<36} {:>10.3f} {:>10.3f} {:>7.0f}%\n", name, quantile(row.ms, 0.5),
                               quantile(row.ms, 0.99),
                               100.0 * double(row.frames - row.ran) / double(row.frames));
        }
        return out;
    }

  private:
    struct Row {
        std::vector<double> ms;
        uint64_t frames = 0, ran = 0;
    };
    std::map<std::string, Row> rows_;
    std::vector<std::string> order_;
};

}  // namespace

int runHeadless(Demo& demo) {
    const DemoOptions& o = demo.options;
    const uint32_t frames = o.frames ? o.frames : std::max<uint32_t>(uint32_t(demo.replay.size()), 1);
    const auto start = Clock::now();
    auto device = gpu::Device::create({.validation = o.validate});
    if (!device) return refuse(device.error().message);
    gi::GiRenderer renderer(**device);
    renderer.load(demo.game->level().geometry);

    PassLog passes;
    std::vector<double> frameMs;
    double firstMs = 0;
    ImageHandle shown;
    auto lastLine = start;
    for (uint32_t i = 0; i < frames; ++i) {
        const auto begin = Clock::now();
        demo.game->tick(nextInput(demo, i, {}), o.size);
        renderer.render(demo.game->scene(), o.size, demo.gi, demo.graph,
                        [&](FrameGraph& graph, const gi::SceneView& view, const gi::GiFrame& frame) {
                            shown = demo.layer ? gi::addLayerView(graph, view, frame, *demo.layer, o.size,
                                                                  demo.gi.composite)
                                               : frame.outputs.display;
                            graph.output(shown);
                        });
        // The wait of the frame before last is inside render(): the mean is the true rate.
        const auto end = Clock::now();
        if (i == 0) {
            renderer.waitIdle();
            firstMs = milliseconds(Clock::now() - start);
        } else {
            frameMs.push_back(milliseconds(end - begin));
            passes.add(renderer.graph());
        }
        if (end - lastLine > std::chrono::seconds(1)) {
            std::cerr << fmt::format("frame {} of {}\n", i + 1, frames);
            lastLine = end;
        }
    }
    renderer.waitIdle();
    const double median = quantile(frameMs, 0.5);
    std::string report = fmt::format(
        "device {}\n{} frames of {}x{}, first after {:.0f} ms (start and shader compilation), median {:.1f} "
        "ms "
        "({:.1f}/s), p99 {:.1f} ms\nplayer at {:.2f} {:.2f}\nworld hash {:016x}\ndevice memory {:.1f} "
        "MiB\n\n",
        (*device)->info().name, frames, o.size.x, o.size.y, firstMs, median, median > 0 ? 1000 / median : 0,
        quantile(frameMs, 0.99), demo.game->player().position.x, demo.game->player().position.z,
        demo.game->stateHash(), double(renderer.deviceBytes()) / 1048576.0);
    report += passes.text();
    std::cout << report;
    if (!o.report.empty() && !(std::ofstream(o.report) << report)) return refuse("cannot write " + o.report);
    if (!o.screenshot.empty()) {
        const Status saved = saveImage(gi::readImage(renderer, shown), o.screenshot);
        if (!saved) return refuse(saved.error().message);
    }
    return (*device)->validationMessageCount() == 0 ? 0 : 1;
}

}  // namespace ag::game
