// The demo without a window: plays a replay, prints progress, leaves pictures and a report.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iostream>

#include "engine/core/image.h"
#include "engine/core/process_memory.h"
#include "engine/core/safe_file.h"
#include "game/contact_sheet.h"
#include "game/demo_options.h"
#include "game/pass_log.h"
#include "game/picture_check.h"
#include "game/replay_notes.h"

namespace ag::game {
namespace {

constexpr uint32_t kMoments = 20, kFilmFrames = 60;

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::duration d) {
    return std::chrono::duration<double, std::milli>(d).count();
}

class HeadlessRun {
  public:
    HeadlessRun(Demo& demo, gpu::Device& device)
        : demo_(demo),
          renderer_(device, demo.options.serial ? 1 : 0),
          device_(device),
          budget_(demo.options.budgetMs, render::firstFullSizeStep()) {
        renderer_.load(demo.game->level().geometry);
        const uint32_t replay = uint32_t(demo.replay.ticks.size()), per = demo.options.ticksPerFrame;
        frames_ = demo.options.frames ? demo.options.frames : std::max((replay + per - 1) / per, 1u);
        const DemoOptions& o = demo.options;
        if (!o.moments.empty()) sheet_ = ContactSheet::moments(kMoments, frames_);
        const uint32_t middle = frames_ > kFilmFrames ? (frames_ - kFilmFrames) / 2 : 0;
        if (!o.film.empty()) film_ = ContactSheet::film(kFilmFrames, o.filmFrom.value_or(middle));
    }

    int run() {
        const auto start = Clock::now();
        auto lastLine = start;
        for (uint32_t i = 0; i < frames_; ++i) {
            const auto begin = Clock::now();
            for (uint32_t t = 0; t < demo_.options.ticksPerFrame; ++t)
                demo_.game->tick(nextInput(demo_, uint64_t(i) * demo_.options.ticksPerFrame + t, {}));
            show();
            // The wait of the frame before last is inside show(): the mean is the true rate.
            const auto end = Clock::now();
            note(i, milliseconds(end - begin), milliseconds(end - start));
            if (i == frames_ / 4) residentBefore_ = residentMib();
            for (ContactSheet* sheet : {&sheet_, &film_})
                if (sheet->wants(i)) sheet->add(render::readImage(renderer_, shown_));
            if (end - lastLine > std::chrono::seconds(1)) {
                std::cerr << progressLine(i);
                lastLine = end;
            }
        }
        renderer_.waitIdle();
        return finish();
    }

  private:
    void show() {
        const glm::uvec2 size = demo_.options.size;
        demo_.game->frame(size);
        renderer_.render(
            demo_.game->scene(), size, shownSettings(demo_), demo_.graph,
            [&](GraphScope scope, const render::SceneView& view, const render::RenderFrame& frame) {
                shown_ = demo_.layer ? render::addLayerView(scope, view, frame, *demo_.layer, size,
                                                            demo_.gi.composite)
                                     : frame.outputs.display;
                scope.output(shown_);
            });
        demo_.game->takeReadings(renderer_.probeReadings());
    }

    void note(uint32_t frame, double ms, double sinceStart) {
        if (frame == 0) {
            renderer_.waitIdle();
            firstMs_ = sinceStart;
            return;
        }
        frameMs_.add(ms);
        passes_.add(renderer_.graph());
        const double cost = cost_.add(renderer_.graph().report(), renderer_.timesArePartial());
        costMs_.add(cost);
        if (demo_.options.budgetMs > 0 && budget_.frame(cost)) {
            costMs_.clear();
            useQuality(demo_, Quality::kAutomatic, render::qualitySteps()[budget_.step()]);
        }
    }

    std::string progressLine(uint32_t frame) const {
        const Progress& p = demo_.game->progress();
        return fmt::format("frame {} of {}: {} of {} flowers open, {} of {} rooms solved\n", frame + 1,
                           frames_, p.flowersOpen, p.flowers, p.roomsSolved, p.rooms);
    }

    std::string report() const {
        const DemoOptions& o = demo_.options;
        const Progress& p = demo_.game->progress();
        const glm::dvec3 at = demo_.game->player().position;
        const double median = frameMs_.quantile(0.5);
        return fmt::format(
                   "device {}\n{} frames of {}x{}, {} ticks each, first after {:.0f} ms (start and shader "
                   "compilation), median {:.1f} ms ({:.1f}/s), p99 {:.1f} ms\nplayer at {:.2f} {:.2f}{}\n"
                   "flowers open: {} of {}, rooms solved: {} of {}{}\nworld hash {:016x}\n"
                   "device memory {:.1f} MiB, resident {:.1f} MiB a quarter in and {:.1f} MiB at the end\n\n",
                   device_.info().name, frames_, o.size.x, o.size.y, o.ticksPerFrame, firstMs_, median,
                   median > 0 ? 1000 / median : 0, frameMs_.quantile(0.99), at.x, at.z,
                   demo_.game->player().carried ? ", carrying a crate" : "", p.flowersOpen, p.flowers,
                   p.roomsSolved, p.rooms, p.won ? ", finished" : "", demo_.game->stateHash(),
                   double(renderer_.deviceBytes()) / 1048576.0, residentBefore_, residentMib()) +
               verdict() + budgetLine() + momentLines() + passes_.text();
    }

    // Of a replay that was played to its end and not beyond.
    std::string verdict() const {
        const uint64_t played = uint64_t(frames_) * demo_.options.ticksPerFrame;
        const size_t ticks = demo_.replay.ticks.size();
        const bool whole = played >= ticks && played < ticks + demo_.options.ticksPerFrame;
        const std::string text = whole ? replayVerdict(demo_) : "";
        return text.empty() ? "" : text + "\n";
    }
    // Of each moment: what is nearly black, and what is burnt out.
    std::string momentLines() const {
        std::string text;
        Extremes worst;
        for (size_t i = 0; i < sheet_.pictures().size(); ++i) {
            const Extremes e = extremesOf(sheet_.pictures()[i]);
            text +=
                fmt::format("moment {}: {:.1f} % dark, {:.1f} % bright\n", i, 100 * e.dark, 100 * e.bright);
            worst = {std::max(worst.dark, e.dark), std::max(worst.bright, e.bright)};
        }
        if (text.empty()) return "";
        const bool good = worst.dark < kMostDark && worst.bright < kMostBright;
        return text + fmt::format("moments: at most {:.1f} % dark, {:.1f} % bright: {}\n\n", 100 * worst.dark,
                                  100 * worst.bright, good ? "good" : "too much");
    }
    std::string budgetLine() const {
        if (demo_.options.budgetMs <= 0) return "";
        return fmt::format(
            "budget {:.1f} ms: quality step {}, passes of a whole frame {:.1f} ms (median of the {} "
            "frames since it was chosen)\n\n",
            demo_.options.budgetMs, render::qualitySteps()[budget_.step()].name, costMs_.quantile(0.5),
            costMs_.count());
    }

    int finish() {
        const DemoOptions& o = demo_.options;
        const std::string text = report();
        std::cout << text;
        if (!o.report.empty())
            if (const Status saved = writeFileSafely(o.report, text); !saved)
                return refuse(saved.error().message);
        if (!o.screenshot.empty())
            if (const Status saved = saveImage(render::readImage(renderer_, shown_), o.screenshot); !saved)
                return refuse(saved.error().message);
        if (!o.moments.empty())
            if (const Status saved = saveImage(sheet_.image(), o.moments); !saved)
                return refuse(saved.error().message);
        if (!o.film.empty())
            if (const Status saved = saveImage(film_.image(), o.film); !saved)
                return refuse(saved.error().message);
        return device_.validationMessageCount() == 0 ? 0 : 1;
    }

    Demo& demo_;
    render::Renderer renderer_;
    gpu::Device& device_;
    render::BudgetController budget_;
    render::FrameCost cost_;
    PassLog passes_;
    ContactSheet sheet_, film_;
    TimeHistogram frameMs_, costMs_;  // of all frames; of whole frames at this quality
    double firstMs_ = 0, residentBefore_ = 0;
    uint32_t frames_ = 1;
    ImageHandle shown_;
};

}  // namespace

int runHeadless(Demo& demo) {
    auto device = gpu::Device::create(deviceOptions(demo));
    if (!device) return refuse(device.error().message);
    demo.device = (*device)->info().name;
    return HeadlessRun(demo, **device).run();
}

}  // namespace ag::game
