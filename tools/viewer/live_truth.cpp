#include "tools/viewer/live_truth.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include "tools/reference/reference.h"

namespace ag::viewer {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uint32_t kBounces = 16;
constexpr uint32_t kMostAtOnce = 8;  // samples of a half between two pictures

uint32_t threadsFor(uint32_t asked) {
    return asked > 0 ? asked : std::max(std::thread::hardware_concurrency() / 2, 1u);
}

bool sameSurroundings(const RenderScene& a, const RenderScene& b) {
    return a.geometry == b.geometry && a.instancesVersion == b.instancesVersion && a.lights == b.lights &&
           a.sky == b.sky;
}

std::shared_ptr<const TruthPicture> pictureOf(const reference::Refinement& refinement, uint64_t subject,
                                              double seconds) {
    auto picture = std::make_shared<TruthPicture>();
    picture->subject = subject;
    for (uint32_t i = 0; i < 2; ++i)
        picture->halves[i] = refinement.half(i).radiance;
    picture->mean = meanOf({picture->halves[0], picture->halves[1]});
    picture->samples = uint32_t(2 * refinement.samplesOfHalf() + 0.5);
    picture->noise = reference::noiseOf(picture->halves[0], picture->halves[1]);
    picture->seconds = seconds;
    return picture;
}

}  // namespace

// What the tracing thread holds. Rays go through the scene, whose camera may move without another tree.
struct LiveTruth::Work {
    RenderScene scene;
    glm::uvec2 size{0};
    reference::PixelFilter filter{};
    uint64_t subject = 0;
    std::optional<reference::RayScene> rays;
};

Result<ImageDifference> compareWithTruth(const TruthPicture& truth, const Image& ours) {
    return compareImages({truth.halves[0], truth.halves[1]}, ours);
}

LiveTruth::LiveTruth(uint32_t threads, uint32_t mostSamples)
    : threads_(threadsFor(threads)), mostSamples_(mostSamples), thread_([this] { run(); }) {}

LiveTruth::~LiveTruth() {
    {
        const std::lock_guard lock(mutex_);
        leave_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void LiveTruth::follow(const RenderScene& scene, glm::uvec2 size, reference::PixelFilter filter) {
    const std::lock_guard lock(mutex_);
    const bool same = subject_ > 0 && size == size_ && filter == filter_ &&
                      sameSurroundings(scene, wanted_) &&
                      scene.camera.clipFromWorld == wanted_.camera.clipFromWorld;
    if (same) return;
    wanted_ = scene;
    size_ = size;
    filter_ = filter;
    wantedSubject_ = ++subject_;
    newest_ = nullptr;
    changed_.notify_all();
}

std::shared_ptr<const TruthPicture> LiveTruth::newest() const {
    const std::lock_guard lock(mutex_);
    return newest_;
}

bool LiveTruth::superseded(uint64_t subject) const {
    const std::lock_guard lock(mutex_);
    return leave_ || subject_ != subject;
}

// False: the end. Trees are kept while nothing but the camera changes.
bool LiveTruth::waitForWork(Work& work) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return leave_ || subject_ != work.subject; });
    if (leave_) return false;
    if (work.rays && sameSurroundings(work.scene, wanted_)) {
        work.scene.camera = wanted_.camera;
    } else {
        work.rays.reset();
        work.scene = wanted_;
    }
    work.size = size_;
    work.filter = filter_;
    work.subject = subject_;
    return true;
}

void LiveTruth::trace(Work& work) {
    const auto start = Clock::now();
    if (!work.rays) work.rays.emplace(work.scene);
    const reference::ReferenceSettings settings{
        .paths = {.bounces = kBounces, .glossy = true, .filter = work.filter}};
    JobRunner runner(threads_);
    reference::Refinement refinement(*work.rays, work.size, settings, runner);
    uint32_t count = 1;
    while (!superseded(work.subject) && 2 * refinement.samplesOfHalf() < mostSamples_) {
        if (!refinement.add(count)) return;
        count = std::min(2 * count, kMostAtOnce);
        const std::chrono::duration<double> spent = Clock::now() - start;
        auto picture = pictureOf(refinement, work.subject, spent.count());
        const std::lock_guard lock(mutex_);
        if (subject_ == work.subject) newest_ = std::move(picture);
    }
}

void LiveTruth::run() {
    Work work;
    while (waitForWork(work))
        trace(work);
}

}  // namespace ag::viewer
