#include "game/playthrough.h"

#include <utility>

#include "engine/core/log.h"
#include "engine/core/safe_file.h"
#include "game/save_game.h"

namespace ag::game {
namespace {

constexpr double kSaveSeconds = 60;  // between saves without an occasion
constexpr double kNoticeSeconds = 6;

}  // namespace

Playthrough::Playthrough(Demo& demo, render::Renderer& renderer)
    : demo_(demo), renderer_(renderer), save_(demo.files.save()), times_(demo.files.times()) {
    renderer_.load(demo.game->level().geometry);
    isElsewhere();
}

// Those of another level or of a recording are nobody's.
bool Playthrough::isOwn() const {
    return demo_.options.scene.empty() && demo_.replay.ticks.empty();
}

double Playthrough::now() const {
    return demo_.game->world().resource<GameTime>().seconds;
}

Status Playthrough::openTimes() {
    const Status opened = isOwn() ? times_.open(*demo_.game) : Status(Ok{});
    times_.startOver(*demo_.game);
    return opened;
}

// What is solved where the game goes on is no news.
void Playthrough::isElsewhere() {
    subtitles_.clear();
    notice_.clear();
    times_.startOver(*demo_.game);
    solved_ = demo_.game->progress().roomsSolved;
}

Status Playthrough::reload() {
    renderer_.waitIdle();
    if (Status loaded = loadLevel(demo_); !loaded) return loaded;
    renderer_.load(demo_.game->level().geometry);
    demo_.game->world().resource<Player>().verticalFov = glm::radians(demo_.user.fieldOfView);
    demo_.recorded.clear();
    ticks_ = 0;
    isElsewhere();
    return Ok{};
}

Status Playthrough::startAnew() {
    if (begun_ || !isFresh())
        if (Status loaded = reload(); !loaded) return loaded;
    begun_ = true;
    const Status room = save_.makeRoomForNewGame(*demo_.game);
    if (!room) spdlog::warn("{}", room.error().message);
    return Ok{};
}

// What starts elsewhere than the level does is no recording; what was recorded before it is kept.
Status Playthrough::endRecording() {
    if (demo_.options.record.empty()) return Ok{};
    Status kept = finishRecording(demo_);
    spdlog::warn("a recording starts with the level: this one ends here");
    demo_.options.record.clear();
    return kept;
}

Status Playthrough::startRoom(int32_t room) {
    const Status kept = endRecording();
    if (Status loaded = reload(); !loaded) return loaded;
    begun_ = startAtRoom(*demo_.game, room);
    isElsewhere();
    if (!begun_) return Error{"the level has no such room"};
    return kept;
}

// A save that cannot be read stays where it is, and so does the game under way.
Status Playthrough::continueSaved() {
    const auto text = readFile(save_.path());
    if (!text) return text.error();
    if (Status good = checkSave(*demo_.game, *text, save_.path()); !good) return good;
    const Status kept = endRecording();
    if (Status loaded = reload(); !loaded) return loaded;
    if (Status restored = restoreGame(*demo_.game, *text, save_.path()); !restored) return restored;
    isElsewhere();
    begun_ = true;
    return kept;
}

void Playthrough::autosave() {
    sinceSave_ = 0;
    if (begun_ && isOwn()) save_.save(*demo_.game);
}

void Playthrough::tick(const Input& input) {
    Game& game = *demo_.game;
    game.tick(nextInput(demo_, ticks_++, input));
    if (demo_.user.subtitles)
        subtitles_.hear(game.sounds(), game.world().resource<ActiveCamera>().pose, now());
    if (!isOwn()) return;
    if (std::string news = times_.follow(game); !news.empty())
        notice_ = std::move(news), noticeUntil_ = now() + kNoticeSeconds;
}

Status Playthrough::keep(double seconds) {
    sinceSave_ += seconds;
    const Progress& progress = demo_.game->progress();
    if (progress.roomsSolved != std::exchange(solved_, progress.roomsSolved) || sinceSave_ > kSaveSeconds)
        autosave();
    // Rooms one has been in can be started from the menu.
    const float reached = float(progress.room + 1);
    if (reached <= demo_.user.roomsReached || !isOwn()) return Ok{};
    demo_.user.roomsReached = reached;
    return saveUserSettings(demo_.user, demo_.files.settings());
}

std::string Playthrough::notice() const {
    return now() < noticeUntil_ ? notice_ : "";
}

std::vector<std::string> Playthrough::heard() const {
    return subtitles_.lines(now());
}

}  // namespace ag::game
